//! Nodes as a host would write them: a description, given as data.

use moment_shadows::TextureFormat;
use moment_shadows_graph::{
    Access, BindingResource, Connected, Direction, Edge, Graph, GraphError, Named, Node, NodeDesc,
    Pass, ResourceDesc, Rule, Slot, Stage, TextureDesc, TextureRule, bind,
};

/// Side of the textures that host nodes make.
pub(crate) const SIDE: u32 = 16;

/// A node that is its description.
#[derive(Debug)]
pub(crate) struct HostNode(pub(crate) NodeDesc);

impl Node for HostNode {
    fn describe(&self, _: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        Ok(self.0.clone())
    }
}

/// A node without slots and passes.
pub(crate) fn empty(stage: Stage) -> NodeDesc {
    NodeDesc::new("host", stage)
}

/// An input that takes any texture.
pub(crate) fn input(name: &str) -> Slot {
    let rule = TextureRule::new(TextureFormat::ALL.to_vec())
        .layers(Rule::Any)
        .mips(Rule::Any)
        .samples(Rule::Any);
    Slot::input(name, "Any texture.", rule.access(Access::READ))
}

/// A square texture of the node's own.
pub(crate) fn made(
    name: &str,
    direction: Direction,
    access: Access,
    format: TextureFormat,
    layers: u32,
) -> Slot {
    let rule = TextureRule::new(format)
        .extent([SIDE, SIDE])
        .layers(layers)
        .access(access);
    Slot {
        direction,
        ..Slot::output(name, "A square texture.", rule)
    }
}

/// An rgba32float output that a compute pass writes.
pub(crate) fn output(name: &str, layers: u32) -> Slot {
    made(
        name,
        Direction::Out,
        Access::STORAGE_WRITE,
        TextureFormat::Rgba32Float,
        layers,
    )
}

/// A compute pass over `covers` with the entry point `main` and workgroups of 8 x 8.
pub(crate) fn compute(
    wgsl: &str,
    covers: &str,
    each_layer: bool,
    variables: impl IntoIterator<Item = (&'static str, BindingResource)>,
) -> Pass {
    let pass = Pass::compute("main", covers, [8, 8]).shader(wgsl, "main");
    let pass = if each_layer { pass.each_layer() } else { pass };
    let variables = variables.into_iter();
    variables.fold(pass, |pass, (name, resource)| pass.bind(name, resource))
}

/// Copies a layer of an rgba32float texture to another.
pub(crate) const COPY: &str = "
@group(0) @binding(0) var source: texture_2d<f32>;
@group(0) @binding(1) var copied: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if all(id.xy < textureDimensions(copied)) {
        textureStore(copied, id.xy, textureLoad(source, id.xy, 0));
    }
}
";

/// Copies a layer of an rgba32float texture to another, with all layers of the source bound.
pub(crate) const COPY_OF_ALL: &str = "
@group(0) @binding(0) var source: texture_2d_array<f32>;
@group(0) @binding(1) var copied: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if all(id.xy < textureDimensions(copied)) {
        textureStore(copied, id.xy, textureLoad(source, id.xy, 0, 0));
    }
}
";

/// `from` to `to`, rgba32float, of its extent and regions.
fn copying(stage: Stage, layers: u32, pass: Pass) -> NodeDesc {
    let rule = TextureRule::new(TextureFormat::Rgba32Float)
        .like("from")
        .layers(layers);
    empty(stage)
        .slots([input("from"), Slot::output("to", "The copy.", rule)])
        .pass(pass)
}

/// What [`COPY`] binds.
pub(crate) fn from_and_to() -> [(&'static str, BindingResource); 2] {
    [
        ("source", bind::layer("from")),
        ("copied", bind::store("to")),
    ]
}

/// `from` to `to`, rgba32float, by layer.
pub(crate) fn copy(stage: Stage, layers: u32) -> NodeDesc {
    copying(stage, layers, compute(COPY, "to", true, from_and_to()))
}

/// As [`copy`], but once for all layers.
pub(crate) fn copy_every_time(stage: Stage) -> NodeDesc {
    copying(stage, 1, compute(COPY, "to", false, from_and_to()))
}

/// As [`copy`], but every pass binds all layers of the source.
pub(crate) fn copy_of_all(stage: Stage, layers_made: u32, each_layer: bool) -> NodeDesc {
    let variables = [
        ("source", bind::layers("from")),
        ("copied", bind::store("to")),
    ];
    let pass = compute(COPY_OF_ALL, "to", each_layer, variables);
    copying(stage, layers_made, pass)
}

/// A texture as an import is described.
pub(crate) fn rgba32(layers: u32) -> ResourceDesc {
    ResourceDesc::Texture(TextureDesc {
        layers,
        ..TextureDesc::new(TextureFormat::Rgba32Float, [SIDE, SIDE])
    })
}

/// A graph of host nodes; edges and outputs as pairs of texts.
pub(crate) fn graph(
    imports: &[(&str, ResourceDesc)],
    nodes: Vec<(&str, NodeDesc)>,
    edges: &[(&str, &str)],
    outputs: &[(&str, &str)],
) -> Graph {
    let imports = imports.iter();
    let nodes = nodes.into_iter();
    let boxed = |desc| -> Box<dyn Node> { Box::new(HostNode(desc)) };
    let outputs = outputs.iter();
    Graph {
        imports: imports
            .map(|(name, desc)| Named::new(*name, Some(desc.clone())))
            .collect(),
        nodes: nodes
            .map(|(name, desc)| Named::new(name, boxed(desc)))
            .collect(),
        edges: edges
            .iter()
            .map(|(from, to)| Edge {
                from: (*from).to_owned(),
                to: (*to).to_owned(),
                position: None,
            })
            .collect(),
        outputs: outputs
            .map(|(name, from)| Named::new(*name, (*from).to_owned()))
            .collect(),
        notes: Vec::new(),
    }
}
