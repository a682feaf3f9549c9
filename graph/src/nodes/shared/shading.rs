//! What the nodes that shade a picture have in common: their shader, their target and their slots.

use moment_shadows::{TextureFormat, ViewParameters};

use super::{depth, wgsl};
use crate::{
    Binding, GraphError, GraphErrorKind, NodeDesc, ParameterBlock, Pass, Rule, Slot, Stage,
    TextureRule, bind,
};

/// The shader: it finds what a pixel's surface is to each view of a light, and leaves the rest to the virtual module
/// `technique`.
pub(in crate::nodes) const SHADER: (&str, &str) = wgsl!("shade.wgsl");

/// The format of the shadow intensity, if it has a channel for each light.
pub(in crate::nodes) fn target_format(
    format: Option<TextureFormat>,
    lights: u32,
    views: u32,
) -> Result<TextureFormat, GraphError> {
    let property = |message: String| Err(GraphError::new(GraphErrorKind::Property, message));
    if !(1..=4).contains(&lights) {
        return property(format!(
            "'lights' is {lights}; a node shades 1 to 4 lights, one per channel of its output, and more nodes shade more"
        ));
    }
    if views < lights {
        return property(format!(
            "'views' is {}, but there are {} lights; each has at least one view",
            views, lights
        ));
    }
    let one = [
        TextureFormat::R8Unorm,
        TextureFormat::R16Float,
        TextureFormat::R32Float,
    ];
    let four = [
        TextureFormat::Rgba8Unorm,
        TextureFormat::Rgba16Float,
        TextureFormat::Rgba32Float,
    ];
    let format = format.unwrap_or(if lights == 1 {
        TextureFormat::R8Unorm
    } else {
        TextureFormat::Rgba8Unorm
    });
    if four.contains(&format) || (lights == 1 && one.contains(&format)) {
        return Ok(format);
    }
    let names = |formats: &[TextureFormat]| {
        let names: Vec<&str> = formats.iter().map(|format| format.name()).collect();
        names.join(", ")
    };
    property(if lights == 1 {
        format!(
            "shadow intensity is one number per light; 'format' is {} or {}, not {format}",
            names(&one),
            names(&four)
        )
    } else {
        format!(
            "{} lights need a channel each; 'format' is {}, not {format}",
            lights,
            names(&four)
        )
    })
}

/// The node: a fullscreen pass from a map, whose inputs and bindings are given, and `camera_depth` to `shadow_intensity`.
pub(in crate::nodes) fn describe(
    name: &str,
    inputs: impl IntoIterator<Item = Slot>,
    bindings: impl IntoIterator<Item = Binding>,
    format: TextureFormat,
    views: u32,
    wgsl: String,
) -> NodeDesc {
    let mut pass = Pass::fullscreen("shade", "shadow_intensity")
        .shader(wgsl, "shade")
        .bind("views", bind::parameters())
        .bind("camera_depth", bind::layer("camera_depth"));
    pass.bindings.extend(bindings);
    NodeDesc::new(name, Stage::AfterMainPass)
        .slots(inputs)
        .input("camera_depth", "Where surfaces are.", depth())
        .output(
            "shadow_intensity",
            "How much of each light is shadowed, a light per channel.",
            TextureRule::new(format).extent(Rule::same_as("camera_depth")),
        )
        .pass(pass)
        .parameters(ParameterBlock::of::<ViewParameters>("ViewParameters").elements(views))
}
