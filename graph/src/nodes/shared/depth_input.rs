//! Inputs that are depth maps: the camera's and a light's.

use moment_shadows::{DepthConversion, TextureFormat};

use super::Specialization;
use crate::{ParameterBlock, Rule, TextureDesc, TextureRule};

/// The formats of depth textures. Of those with a stencil the depth is read.
pub(in crate::nodes) const FORMATS: [TextureFormat; 5] = [
    TextureFormat::Depth32Float,
    TextureFormat::Depth24Plus,
    TextureFormat::Depth16Unorm,
    TextureFormat::Depth32FloatStencil8,
    TextureFormat::Depth24PlusStencil8,
];

/// The camera's depth: one layer, one sample or several.
pub(in crate::nodes) fn camera() -> TextureRule {
    TextureRule::new(FORMATS.to_vec()).samples(vec![1, 2, 4, 8])
}

/// A light's depth map, as depth or as distance: any number of layers, one sample or several.
pub(in crate::nodes) fn light() -> TextureRule {
    let formats = FORMATS.into_iter().chain([TextureFormat::R32Float]);
    TextureRule {
        format: Rule::OneOf(formats.collect()),
        ..camera().layers(Rule::Any).mips(Rule::Any)
    }
}

/// The WGSL type of one layer of it.
pub(in crate::nodes) fn texture_type(depth: &TextureDesc) -> &'static str {
    match (depth.format.is_depth(), depth.samples > 1) {
        (true, true) => "texture_depth_multisampled_2d",
        (true, false) => "texture_depth_2d",
        (false, true) => "texture_multisampled_2d<f32>",
        (false, false) => "texture_2d<f32>",
    }
}

/// What shaders know of the camera's depth: its type, and where in a pixel the sample lies that they load, the first one. WebGPU
/// says where it lies, counted from the pixel's top left corner.
pub(in crate::nodes) fn of_camera(
    specialization: Specialization,
    depth: &TextureDesc,
) -> Specialization {
    let place = match depth.samples {
        2 => "vec2f(0.75, 0.75)",
        4 => "vec2f(0.375, 0.125)",
        8 => "vec2f(0.5625, 0.3125)",
        _ => "vec2f(0.5, 0.5)",
    };
    specialization
        .module("camera_depth", include_str!("camera_depth.wgsl"))
        .alias("CameraDepth", texture_type(depth))
        .constant("CAMERA_SAMPLE", place)
}

/// How each region of each of its layers stores depth.
pub(in crate::nodes) fn conversions(depth: &TextureDesc) -> ParameterBlock {
    ParameterBlock::of::<DepthConversion>("DepthConversion")
        .elements(depth.regions)
        .each_layer_of("depth")
        .initial(&DepthConversion::orthographic())
}
