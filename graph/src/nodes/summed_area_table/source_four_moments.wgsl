import moment_shadows::moments::four_moments::{four_moments_clamp, four_moments_to_texel};
import node::specialization::{STORAGE, UNIT};
import moment_shadows::map::storage::{STORAGE_FLOAT16, STORAGE_UNORM16, storage_finite_texel};
import moment_shadows::filter::summed_area_encoding::{summed_area_encoding_of_channels};

// Float maps of four moments. A texel with a channel that is not finite counts as the far end: no caster.

fn source_integers(texel: vec4f) -> vec4u {
    let finite = all(bitcast<vec4u>(storage_finite_texel(texel, STORAGE)) == bitcast<vec4u>(texel));
    let far = four_moments_to_texel(vec4f(1.0), STORAGE_UNORM16);
    // Channels of float16 are the optimised basis less one half, those of float32 moments.
    var channels = texel + 0.5;
    if STORAGE != STORAGE_FLOAT16 {
        channels = four_moments_to_texel(four_moments_clamp(texel), STORAGE_UNORM16);
    }
    return summed_area_encoding_of_channels(select(far, channels, finite), UNIT);
}
