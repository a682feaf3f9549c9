//! What the nodes that shade a picture have in common: their shader, their target and their slots.

use moment_shadows::{
    Technique,
    TextureFormat::{
        self, R8Unorm, R16Float, R32Float, Rg16Float, Rg16Unorm, Rg32Float, Rgb10a2Unorm,
        Rgba8Unorm, Rgba16Float, Rgba32Float,
    },
    ViewParameters,
};

use super::debug_view::{self, DebugView};
use super::stored_targets::{self, STORED};
use super::tiled::Tiled;
use super::{Specialization, depth_input, wgsl, wrong_property};
use crate::{
    Binding, BindingResource, Connected, GraphError, NodeDesc, Off, ParameterBlock, Pass,
    ResourceDesc, Rule, Slot, Stage, TextureDesc, TextureRule, bind,
};

/// Properties of both nodes.
pub(in crate::nodes) struct Settings {
    pub(in crate::nodes) format: Option<TextureFormat>,
    pub(in crate::nodes) lights: u32,
    pub(in crate::nodes) views: u32,
    pub(in crate::nodes) borders: bool,
    pub(in crate::nodes) debug: Option<DebugView>,
}

/// The node: a fullscreen pass from a map, whose input (and what belongs to it), bindings and modules are given, and
/// `camera_depth` to `shadow_intensity`, of a format that has a channel for each light; or, where there are more lights than channels,
/// a compute pass to several outputs of four each (`shadow_intensity_4`, `_8` and `_12`). The shader finds what a pixel's surface is
/// to each view of a light, and leaves the rest to the module `technique`.
pub(in crate::nodes) fn describe(
    name: &str,
    upstream: &Connected<'_>,
    settings: Settings,
    (technique, soft): (&Technique, bool),
    inputs: impl IntoIterator<Item = Slot>,
    bindings: Vec<Binding>,
    specialization: Specialization,
) -> Result<NodeDesc, GraphError> {
    let Settings {
        format,
        lights,
        views,
        borders,
        debug,
    } = settings;
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
    // The first light of each output.
    let firsts = (0..lights).step_by(4);
    let camera = upstream.texture("camera_depth")?;
    let (specialization, neighbours) = surface(specialization, upstream, camera);
    let specialization = depth_input::of_camera(specialization, camera)
        .unsigned("VIEWS", views)
        .unsigned("LIGHTS", lights)
        .unsigned("TARGETS", firsts.len() as u32)
        .module("views", include_str!("views.wgsl"))
        .module("view_receiver", include_str!("view_receiver.wgsl"));
    let tiled = Tiled::new(views, bindings.clone());
    let listed = tiled.list(specialization.clone());
    // What both passes over the picture read.
    let bound = |pass: Pass| {
        let mut pass = pass
            .bind("views", bind::parameters())
            .bind("camera_depth", bind::layer("camera_depth"));
        let given = bindings.clone().into_iter().chain(neighbours.clone());
        pass.bindings.extend(given.chain(tiled.bindings()));
        pass
    };
    let shading = listed
        .clone()
        .module("shade_pixel", include_str!("shade_pixel.wgsl"));
    let shade = if lights > 4 {
        // One pass for all: what a pixel is, and which views contain it, is found once.
        let stored = stored_targets::module(firsts.clone(), format);
        let shading = shading
            .constant("SHADED", SHADED)
            .module("shade_targets", stored);
        let pass = Pass::compute("shade", "shadow_intensity", [SHADED; 2])
            .shader(shading.link(wgsl!("shade_computed.wgsl"))?, "shade");
        firsts.clone().fold(bound(pass), |pass, first| {
            let slot = numbered("shadow_intensity", first);
            pass.bind(&numbered(STORED, first), bind::store(&slot))
        })
    } else {
        let pass = Pass::fullscreen("shade", "shadow_intensity");
        bound(pass.shader(shading.link(wgsl!("shade_drawn.wgsl"))?, "shade"))
    };
    let shade = if borders {
        shade.constant(BORDERS, 1)
    } else {
        shade
    };
    let shown = match debug {
        None => None,
        Some(view) => {
            let listed = view.modules(listed.clone(), technique, soft)?;
            let wgsl = listed.link(wgsl!("debug/debug_shading.wgsl"))?;
            let mut pass = bound(Pass::fullscreen("debug", "debug").shader(wgsl, "debug"));
            // Most views look nothing up.
            let wgsl = pass.wgsl.as_str();
            let is_used = |binding: &Binding| wgsl.contains(&format!(" {}:", binding.variable));
            let used = pass.bindings.iter().filter(|it| is_used(it)).cloned();
            pass.bindings = used.collect();
            Some(pass)
        }
    };
    let block = ParameterBlock::of::<ViewParameters>("ViewParameters").elements(views);
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
        .slots(shown.as_ref().map(|_| debug_view::slot()))
        .slots(tiled.slots())
        .passes(tiled.passes(&specialization)?)
        .passes(shown.clone())
        .passes([shade])
        .parameters(block);
    // Lit.
    let lit = |desc: NodeDesc, first| {
        desc.off(
            &numbered("shadow_intensity", first),
            Off::Fill(vec![[0.0; 4]]),
        )
    };
    let desc = firsts.fold(desc, lit);
    Ok(match shown {
        None => desc,
        Some(_) => desc.off("debug", Off::Fill(vec![[0.0; 4]])),
    })
}

/// Pixels along each side that a workgroup shades: a part of a tile.
const SHADED: u32 = 8;

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

/// How a pixel's surface continues: the module `surface`, from normals where they are connected, and otherwise from the camera's depth. With it
/// what it binds beside that.
pub(in crate::nodes) fn surface(
    specialization: Specialization,
    upstream: &Connected<'_>,
    camera: &TextureDesc,
) -> (Specialization, Vec<Binding>) {
    let has_samples = camera.samples > 1;
    let neighbours = if has_samples {
        include_str!("neighbours_loaded.wgsl")
    } else {
        include_str!("neighbours_gathered.wgsl")
    };
    let specialization = specialization.module("neighbours", neighbours);
    let nearest = BindingResource::Sampler {
        filtering: false,
        anisotropy: 1,
    };
    let sampler = Binding::new("camera_sampler", nearest);
    let normals = upstream.get("normals").and_then(ResourceDesc::texture);
    let Some(normals) = normals else {
        let from_depth = include_str!("surface_from_depth.wgsl");
        let sampler = (!has_samples).then_some(sampler);
        return (
            specialization.module("surface", from_depth),
            sampler.into_iter().collect(),
        );
    };
    let format = normals.format;
    let unsigned = [Rgba8Unorm, Rgb10a2Unorm, Rg16Unorm].contains(&format);
    let specialization = specialization
        .constant("NORMALS_OCTAHEDRAL", format.channels() == 2)
        .constant("NORMALS_UNSIGNED", unsigned)
        .module("surface", include_str!("surface_from_normals.wgsl"));
    let normals = Binding::new("normals", bind::layer("normals"));
    (specialization, vec![normals, sampler])
}
