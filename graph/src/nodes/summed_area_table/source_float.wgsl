import moment_shadows::filter::summed_area_encoding::{summed_area_encoding_of_channels};
import moment_shadows::map::storage::{STORAGE_FLOAT16, storage_finite_texel};
import moment_shadows::moments::four_moments::{four_moments_clamp};
import node::map_encoding::{encoding_texel};
import node::specialization::{SOURCE_STORAGE, UNIT};

// Float maps of four moments or two, as the storage unorm16 has them. A texel with a channel that is not finite counts as
// the far end: no caster.

fn source_integers(texel: vec4f) -> vec4u {
    let finite = all(bitcast<vec4u>(storage_finite_texel(texel, SOURCE_STORAGE)) == bitcast<vec4u>(texel));
    let far = encoding_texel(vec4f(1.0));
    // Channels of float16 are the optimised basis less one half, those of float32 moments.
    var channels = texel + 0.5;
    if SOURCE_STORAGE != STORAGE_FLOAT16 {
        channels = encoding_texel(four_moments_clamp(texel));
    }
    return summed_area_encoding_of_channels(select(far, channels, finite), UNIT);
}
