//! Nodes as a host would write them: a description, given as data.

use moment_shadows::TextureFormat;
use moment_shadows_graph::{
    Access, Binding, BindingResource, Connected, CountRule, Direction, Edge, Endpoint, ExtentRule,
    FormatRule, Graph, GraphError, GraphNode, Import, Lifetime, Node, NodeDesc, Output, Pass,
    ResourceDesc, Slot, SlotResource, Stage, TextureDesc, Work,
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
    NodeDesc {
        name: "host".to_owned(),
        stage,
        slots: Vec::new(),
        passes: Vec::new(),
        parameters: None,
    }
}

pub(crate) fn slot(name: &str, direction: Direction, resource: SlotResource) -> Slot {
    Slot {
        name: name.to_owned(),
        direction,
        lifetime: Lifetime::Frame,
        optional: false,
        resource,
    }
}

/// An input that takes any texture.
pub(crate) fn input(name: &str) -> Slot {
    slot(
        name,
        Direction::In,
        SlotResource::Texture {
            access: Access::READ,
            format: FormatRule::OneOf(TextureFormat::ALL.to_vec()),
            extent: ExtentRule::Any,
            layers: CountRule::Any,
            mips: CountRule::Any,
            samples: CountRule::Any,
        },
    )
}

/// A square texture of the node's own.
pub(crate) fn made(
    name: &str,
    direction: Direction,
    access: Access,
    format: TextureFormat,
    layers: u32,
) -> Slot {
    slot(
        name,
        direction,
        SlotResource::Texture {
            access,
            format: FormatRule::Exact(format),
            extent: ExtentRule::Exact([SIDE, SIDE]),
            layers: CountRule::Exact(layers),
            mips: CountRule::Exact(1),
            samples: CountRule::Exact(1),
        },
    )
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

/// The same, of the extent and the regions of the input `from`.
fn like_from(name: &str, layers: u32) -> Slot {
    slot(
        name,
        Direction::Out,
        SlotResource::Texture {
            access: Access::STORAGE_WRITE,
            format: FormatRule::Exact(TextureFormat::Rgba32Float),
            extent: ExtentRule::SameAs("from".to_owned()),
            layers: CountRule::Exact(layers),
            mips: CountRule::Exact(1),
            samples: CountRule::Exact(1),
        },
    )
}

pub(crate) fn bindings(resources: impl IntoIterator<Item = BindingResource>) -> Vec<Binding> {
    (0..)
        .zip(resources)
        .map(|(binding, resource)| Binding { binding, resource })
        .collect()
}

pub(crate) fn layer(slot: &str) -> BindingResource {
    BindingResource::Layer(slot.to_owned())
}

pub(crate) fn layers(slot: &str) -> BindingResource {
    BindingResource::Layers(slot.to_owned())
}

pub(crate) fn storage(slot: &str) -> BindingResource {
    BindingResource::StorageLayer(slot.to_owned())
}

/// A compute pass over `covers` with the entry point `main` and workgroups of 8 x 8.
pub(crate) fn compute(
    wgsl: &str,
    covers: &str,
    each_layer: bool,
    resources: impl IntoIterator<Item = BindingResource>,
) -> Pass {
    Pass {
        label: "main".to_owned(),
        wgsl: wgsl.to_owned(),
        entry_point: "main".to_owned(),
        bindings: bindings(resources),
        constants: [].into(),
        plane: 0,
        work: Work::Compute {
            covers: covers.to_owned(),
            texels_per_workgroup: [8, 8],
            each_layer,
        },
    }
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

/// The same, with all layers of the source bound.
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

/// `from` to `to`, rgba32float, by layer.
pub(crate) fn copy(stage: Stage, layers: u32) -> NodeDesc {
    NodeDesc {
        slots: vec![input("from"), like_from("to", layers)],
        passes: vec![compute(COPY, "to", true, [layer("from"), storage("to")])],
        ..empty(stage)
    }
}

/// As [`copy`], but once for all layers.
pub(crate) fn copy_every_time(stage: Stage) -> NodeDesc {
    NodeDesc {
        slots: vec![input("from"), like_from("to", 1)],
        passes: vec![compute(COPY, "to", false, [layer("from"), storage("to")])],
        ..empty(stage)
    }
}

/// As [`copy`], but every pass binds all layers of the source.
pub(crate) fn copy_of_all(stage: Stage, layers_made: u32, each_layer: bool) -> NodeDesc {
    NodeDesc {
        slots: vec![input("from"), like_from("to", layers_made)],
        passes: vec![compute(
            COPY_OF_ALL,
            "to",
            each_layer,
            [layers("from"), storage("to")],
        )],
        ..empty(stage)
    }
}

/// A texture as an import is described.
pub(crate) fn rgba32(layers: u32) -> ResourceDesc {
    ResourceDesc::Texture(TextureDesc {
        layers,
        ..TextureDesc::new(TextureFormat::Rgba32Float, [SIDE, SIDE])
    })
}

fn endpoint(text: &str) -> Endpoint {
    let (owner, slot) = text.split_once('.').unwrap_or((text, ""));
    Endpoint {
        owner: owner.to_owned(),
        slot: (!slot.is_empty()).then(|| slot.to_owned()),
    }
}

/// A graph of host nodes; edges and outputs as pairs of texts.
pub(crate) fn graph(
    imports: &[(&str, ResourceDesc)],
    nodes: Vec<(&str, NodeDesc)>,
    edges: &[(&str, &str)],
    outputs: &[(&str, &str)],
) -> Graph {
    Graph {
        imports: imports
            .iter()
            .map(|(name, desc)| Import {
                name: (*name).to_owned(),
                expected: Some(desc.clone()),
                position: None,
            })
            .collect(),
        nodes: nodes
            .into_iter()
            .map(|(name, desc)| GraphNode {
                name: name.to_owned(),
                node: Box::new(HostNode(desc)),
                position: None,
            })
            .collect(),
        edges: edges
            .iter()
            .map(|(from, to)| Edge {
                from: endpoint(from),
                to: endpoint(to),
                position: None,
            })
            .collect(),
        outputs: outputs
            .iter()
            .map(|(name, from)| Output {
                name: (*name).to_owned(),
                from: endpoint(from),
                position: None,
            })
            .collect(),
        notes: Vec::new(),
    }
}
