//! Inputs that are depth maps: the camera's and a light's.

use moment_shadows::{DepthConversion, TextureFormat};

use crate::{ParameterBlock, Rule, TextureDesc, TextureRule};

/// The formats of depth maps.
pub(in crate::nodes) const FORMATS: [TextureFormat; 2] =
    [TextureFormat::Depth32Float, TextureFormat::Depth16Unorm];

/// The camera's depth: one layer, one sample.
pub(in crate::nodes) fn camera() -> TextureRule {
    TextureRule::new(FORMATS.to_vec())
}

/// A light's depth map: any number of layers, one sample or several.
pub(in crate::nodes) fn light() -> TextureRule {
    camera()
        .layers(Rule::Any)
        .mips(Rule::Any)
        .samples(vec![1, 2, 4, 8])
}

/// The WGSL type of one layer of it.
pub(in crate::nodes) fn texture_type(depth: &TextureDesc) -> &'static str {
    if depth.samples > 1 {
        "texture_depth_multisampled_2d"
    } else {
        "texture_depth_2d"
    }
}

/// How each region of each of its layers stores depth.
pub(in crate::nodes) fn conversions(depth: &TextureDesc) -> ParameterBlock {
    ParameterBlock::of::<DepthConversion>("DepthConversion")
        .elements(depth.regions)
        .each_layer_of("depth")
        .initial(&DepthConversion::orthographic())
}
