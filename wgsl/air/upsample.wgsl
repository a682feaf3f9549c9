// Upsampling of what was rendered at a part of the resolution, by place and by depth (Kopf et al., "Joint bilateral upsampling",
// SIGGRAPH 2007).

// A texel whose surface is farther or nearer by more than this part of the distance saw something else.
const UPSAMPLE_SIMILAR: f32 = 0.03;

// What is left of the weight of a texel that saw something else: where all did, the nearest count.
const UPSAMPLE_LEAST: f32 = 1e-4;

// The weight of one of four texels around a pixel: `share` is its weight by place alone, and both others are one over distances
// along the camera's axis, of the pixel and of what the texel saw; above 0.
fn upsample_weight(share: f32, per_distance: f32, per_texel_distance: f32) -> f32 {
    let ratio = per_distance / max(per_texel_distance, 1e-30) - 1.0;
    let difference = clamp(ratio / UPSAMPLE_SIMILAR, -8.0, 8.0);
    return share * (exp(-difference * difference) + UPSAMPLE_LEAST);
}
