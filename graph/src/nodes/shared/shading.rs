//! What the nodes that shade a picture have in common: their shader, their target and their slots.

use moment_shadows::{
    TextureFormat::{self, R8Unorm, R16Float, R32Float, Rgba8Unorm, Rgba16Float, Rgba32Float},
    ViewParameters,
};

use super::{Specialization, depth_input, wgsl, wrong_property};
use crate::{
    Binding, GraphError, NodeDesc, ParameterBlock, Pass, Rule, Slot, Stage, TextureRule, bind,
};

/// The node: a fullscreen pass from a map, whose input (and what belongs to it), bindings and modules are given, and
/// `camera_depth` to `shadow_intensity`, of a format that has a channel for each light. The shader finds what a pixel's surface is
/// to each view of a light, and leaves the rest to the module `technique`.
pub(in crate::nodes) fn describe(
    name: &str,
    (format, lights, views): (Option<TextureFormat>, u32, u32),
    inputs: impl IntoIterator<Item = Slot>,
    bindings: impl IntoIterator<Item = Binding>,
    specialization: Specialization,
) -> Result<NodeDesc, GraphError> {
    if !(1..=4).contains(&lights) {
        return Err(wrong_property(format!(
            "'lights' is {lights}; a node shades 1 to 4 lights, one per channel of its output, and more nodes shade more"
        )));
    }
    if views < lights {
        return Err(wrong_property(format!(
            "'views' is {views}, but there are {lights} lights; each has at least one view"
        )));
    }
    let one_and_four = [
        [R8Unorm, R16Float, R32Float],
        [Rgba8Unorm, Rgba16Float, Rgba32Float],
    ];
    let allowed = &one_and_four[usize::from(lights > 1)..];
    let format = format.unwrap_or(allowed[0][0]);
    if !allowed.as_flattened().contains(&format) {
        let names = allowed.iter().map(|all| all.map(TextureFormat::name));
        let names: Vec<String> = names.map(|all| all.join(", ")).collect();
        return Err(wrong_property(format!(
            "lights need a channel each; for {lights} of them 'format' is {}, not {format}",
            names.join(" or ")
        )));
    }
    let wgsl = specialization
        .unsigned("VIEWS", views)
        .unsigned("LIGHTS", lights)
        .link(wgsl!("shade.wgsl"))?;
    let mut pass = Pass::fullscreen("shade", "shadow_intensity")
        .shader(wgsl, "shade")
        .bind("views", bind::parameters())
        .bind("camera_depth", bind::layer("camera_depth"));
    pass.bindings.extend(bindings);
    let block = ParameterBlock::of::<ViewParameters>("ViewParameters").elements(views);
    let intensity = "How much of each light is shadowed, a light per channel.";
    let target = TextureRule::new(format).extent(Rule::same_as("camera_depth"));
    Ok(NodeDesc::new(name, Stage::AfterMainPass)
        .slots(inputs)
        .input("camera_depth", "Where surfaces are.", depth_input::camera())
        .output("shadow_intensity", intensity, target)
        .pass(pass)
        .parameters(block))
}
