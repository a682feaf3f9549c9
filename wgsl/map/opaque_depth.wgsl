import super::super::map::depth::{DepthConversion, depth_to_moment_depth};

// Opaque casters before which translucent ones are drawn, where a light's depth map has several samples per texel.
//
// No pass can test such a map beside a map of one sample per texel, so fragments read it. Whatever sample decides, bounds stay lower
// bounds: where a fragment behind an opaque sample is drawn, shadow moves away from the light, and where one before a sample is left
// out, shadow is missing. With the farthest sample what lies behind both casters is exact, and some of the opaque caster's shadow is
// missing between them alone; with the nearest one, or by the share of the samples, edges of opaque casters are bright seams in the
// shadow of translucent ones.

// The moment depth of a texel's farthest sample. A translucent fragment is drawn where it lies before this depth.
fn opaque_depth_farthest(depth_map: texture_depth_multisampled_2d, texel: vec2i, conversion: DepthConversion) -> f32 {
    var farthest = -1.0;
    for (var index = 0; index < i32(textureNumSamples(depth_map)); index++) {
        farthest = max(farthest, depth_to_moment_depth(textureLoad(depth_map, texel, index), conversion));
    }
    return farthest;
}
