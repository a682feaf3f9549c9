//! What the nodes that shade a picture have in common: their shader, their target and their slots.

use moment_shadows::{
    TextureFormat::{
        self, R8Unorm, R16Float, R32Float, Rg16Float, Rg16Unorm, Rg32Float, Rgb10a2Unorm,
        Rgba8Unorm, Rgba16Float, Rgba32Float,
    },
    ViewParameters,
};

use super::tiled::Tiled;
use super::{Specialization, depth_input, wgsl, wrong_property};
use crate::{
    Binding, Connected, GraphError, NodeDesc, Off, ParameterBlock, Pass, ResourceDesc, Rule, Slot,
    Stage, TextureRule, bind,
};

/// The node: fullscreen passes from a map, whose input (and what belongs to it), bindings and modules are given, and
/// `camera_depth` to `shadow_intensity`, of a format that has a channel for each light, or four in each of several outputs
/// (`shadow_intensity_4`, `_8` and `_12`). The shader finds what a pixel's surface is
/// to each view of a light, and leaves the rest to the module `technique`.
pub(in crate::nodes) fn describe(
    name: &str,
    upstream: &Connected<'_>,
    (format, lights, views, borders): (Option<TextureFormat>, u32, u32, bool),
    inputs: impl IntoIterator<Item = Slot>,
    bindings: Vec<Binding>,
    specialization: Specialization,
) -> Result<NodeDesc, GraphError> {
    if !(1..=16).contains(&lights) {
        return Err(wrong_property(format!(
            "'lights' is {lights}; a node shades 1 to 16 lights, four in each of its outputs, and more nodes shade more"
        )));
    }
    let format = self::format(format, lights)?;
    if views < lights {
        return Err(wrong_property(format!(
            "'views' is {views}, but there are {lights} lights; each has at least one view"
        )));
    }
    if views > MOST_VIEWS {
        return Err(wrong_property(format!(
            "'views' is {views}; a node has at most {MOST_VIEWS}, and more nodes have more"
        )));
    }
    let camera = upstream.texture("camera_depth")?;
    let (specialization, normals) = surface(specialization, upstream);
    let specialization = depth_input::of_camera(specialization, camera)
        .unsigned("VIEWS", views)
        .unsigned("LIGHTS", lights)
        .module("views", include_str!("views.wgsl"));
    let tiled = Tiled::new(views, bindings.clone());
    let wgsl = tiled
        .list(specialization.clone())
        .link(wgsl!("shade.wgsl"))?;
    let shade = |first: u32| {
        let mut pass = Pass::fullscreen(
            numbered("shade", first),
            &numbered("shadow_intensity", first),
        )
        .shader(wgsl.as_str(), "shade")
        .bind("views", bind::parameters())
        .bind("camera_depth", bind::layer("camera_depth"));
        if borders {
            pass = pass.constant(BORDERS, 1);
        }
        if first > 0 {
            pass = pass.constant("FIRST_LIGHT", first);
        }
        pass.bindings
            .extend(bindings.clone().into_iter().chain(normals.clone()));
        pass.bindings.extend(tiled.bindings());
        pass
    };
    let block = ParameterBlock::of::<ViewParameters>("ViewParameters").elements(views);
    let firsts = (0..lights).step_by(4);
    let outputs = firsts.clone().map(|first| {
        let last = (first + 3).min(lights - 1);
        let description = match lights {
            1..=4 => "How much of each light is shadowed, a light per channel.".to_owned(),
            _ => format!("How much of lights {first} to {last} is shadowed, a light per channel."),
        };
        let target = TextureRule::new(format).extent(Rule::same_as("camera_depth"));
        Slot::output(&numbered("shadow_intensity", first), &description, target)
    });
    let desc = NodeDesc::new(name, Stage::AfterMainPass)
        .slots(inputs)
        .input("camera_depth", "Where surfaces are.", depth_input::camera())
        .slots([normals_slot()])
        .slots(outputs)
        .slots(tiled.slots())
        .passes(tiled.passes(&specialization)?)
        .passes(firsts.clone().map(shade))
        .parameters(block);
    // Lit.
    let lit = |desc: NodeDesc, first| {
        desc.off(
            &numbered("shadow_intensity", first),
            Off::Fill(vec![[0.0; 4]]),
        )
    };
    Ok(firsts.fold(desc, lit))
}

/// As many as a uniform buffer holds in core WebGPU.
const MOST_VIEWS: u32 = 256;

/// A name, of the first of several without a number.
pub(super) fn numbered(name: &str, first: u32) -> String {
    match first {
        0 => name.to_owned(),
        _ => format!("{name}_{first}"),
    }
}

/// The format that is given, or the smallest one that has a channel for each light, or for four of many.
pub(in crate::nodes) fn format(
    given: Option<TextureFormat>,
    lights: u32,
) -> Result<TextureFormat, GraphError> {
    let allowed = formats(lights);
    let format = given.unwrap_or(allowed[0]);
    if !allowed.contains(&format) {
        let names = allowed.chunks(3).map(|all| {
            let all: Vec<&str> = all.iter().map(|format| format.name()).collect();
            all.join(", ")
        });
        let names: Vec<String> = names.collect();
        return Err(wrong_property(format!(
            "lights need a channel each; for {lights} of them 'format' is {}, not {format}",
            names.join(" or ")
        )));
    }
    Ok(format)
}

/// The formats of shadow intensity that have a channel for each light, or for four of many, in threes of one and of four channels.
pub(in crate::nodes) fn formats(lights: u32) -> Vec<TextureFormat> {
    let one_and_four = [
        R8Unorm,
        R16Float,
        R32Float,
        Rgba8Unorm,
        Rgba16Float,
        Rgba32Float,
    ];
    one_and_four[if lights > 1 { 3 } else { 0 }..].to_vec()
}

/// The constant of a pass by which views have borders.
pub(crate) const BORDERS: &str = "BORDERS";

/// Formats of normals: those of two channels hold an octahedron, those without a sign hold [-1, 1] in [0, 1].
const NORMALS: [TextureFormat; 7] = [
    Rgba8Unorm,
    Rgb10a2Unorm,
    Rgba16Float,
    Rgba32Float,
    Rg16Unorm,
    Rg16Float,
    Rg32Float,
];

/// The optional input of normals.
pub(in crate::nodes) fn normals_slot() -> Slot {
    let rule = TextureRule::new(NORMALS.to_vec()).extent(Rule::same_as("camera_depth"));
    let description = "Where surfaces face, in the scene's axes: x, y and z, or an octahedron in two channels; from 0 to 1 where \
                       the format has no sign. Of curved and thin things they say more than depth does.";
    Slot::input("normals", description, rule).optional()
}

/// How a pixel's surface continues: the module `surface`, from normals where they are connected.
pub(in crate::nodes) fn surface(
    specialization: Specialization,
    upstream: &Connected<'_>,
) -> (Specialization, Option<Binding>) {
    let normals = upstream.get("normals").and_then(ResourceDesc::texture);
    let Some(normals) = normals else {
        let from_depth = include_str!("surface_from_depth.wgsl");
        return (specialization.module("surface", from_depth), None);
    };
    let format = normals.format;
    let unsigned = [Rgba8Unorm, Rgb10a2Unorm, Rg16Unorm].contains(&format);
    let specialization = specialization
        .constant("NORMALS_OCTAHEDRAL", format.channels() == 2)
        .constant("NORMALS_UNSIGNED", unsigned)
        .module("surface", include_str!("surface_from_normals.wgsl"));
    let binding = Binding::new("normals", bind::layer("normals"));
    (specialization, Some(binding))
}
