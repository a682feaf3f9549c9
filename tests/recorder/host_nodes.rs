//! Nodes that a host registers are recorded like the library's own.

use moment_shadows::TextureFormat::{R32Float, Rgba32Float};
use moment_shadows_graph::{
    Access, Connected, Direction, Graph, GraphError, Node, NodeDesc, NodeRegistry, ParameterBlock,
    Pass, Slot, SlotResource, Stage, TextureRule, bind,
};
use moment_shadows_lab::gpu::Gpu;
use serde::Deserialize;

use crate::host_node::{COPY, SIDE, compute, empty, graph, made, output};
use crate::setup::{Bound, bind, capabilities, gpu};

const EARLY: Stage = Stage::AfterShadowMaps;

/// A node of a host's own file: fills every layer with a property times the layer's parameter.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Fill {
    value: f32,
    layers: u32,
}

const FILL: &str = "
override value: f32;
struct Factor { factor: vec4f }
@group(0) @binding(0) var<uniform> parameters: Factor;
@group(0) @binding(1) var filled: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    textureStore(filled, id.xy, value * parameters.factor);
}
";

impl Node for Fill {
    fn describe(&self, _: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        Ok(NodeDesc::new("fill", EARLY)
            .slots([output("filled", self.layers)])
            .pass(
                Pass::compute("fill", "filled", [8, 8])
                    .each_layer()
                    .shader(FILL, "main")
                    .bind("parameters", bind::parameters())
                    .bind("filled", bind::store("filled"))
                    .constant("value", self.value),
            )
            .parameters(
                ParameterBlock::of::<[f32; 4]>("Factor")
                    .each_layer_of("filled")
                    .initial(&[1.0_f32; 4]),
            ))
    }
}

#[test]
fn a_registered_node_is_read_from_a_file_with_parameters_per_layer() {
    let gpu = gpu();
    let mut registry = NodeRegistry::new();
    registry.register::<Fill>("fill");
    let text = r#"{ "version": 2, "imports": [], "edges": [],
        "nodes": [{ "name": "fill", "type": "fill", "properties": { "value": 3, "layers": 3 } }],
        "outputs": [{ "name": "filled", "from": "fill.filled" }] }"#;
    let graph = Graph::parse(text, &registry).unwrap();
    let plan = graph.compile(&capabilities(&gpu), &[]).unwrap();
    let mut bytes = plan.parameters.initial();
    plan.parameters
        .write(&mut bytes, "fill", 1, &[1.0_f32, 2.0, 3.0, 4.0])
        .unwrap();
    plan.parameters
        .write(&mut bytes, "fill", 2, &[-1.0_f32; 4])
        .unwrap();
    let bound = bind(&gpu, plan, &[], &bytes);
    bound.run(&gpu);
    let expected = [[3.0; 4], [3.0, 6.0, 9.0, 12.0], [-3.0; 4]];
    for (layer, texel) in (0..).zip(expected) {
        let found = bound.read_floats(&gpu, "filled", layer);
        assert_eq!(found.len(), (SIDE * SIDE * 4) as usize);
        assert!(
            found.chunks_exact(4).all(|found| found == texel),
            "layer {layer}"
        );
    }
}

/// Runs a node without inputs and gives the first layer of its output `to`.
fn run(gpu: &Gpu, node: NodeDesc) -> Bound {
    let graph = graph(&[], vec![("host", node)], &[], &[("out", "host.to")]);
    let plan = graph.compile(&capabilities(gpu), &[]).unwrap();
    let bound = bind(gpu, plan, &[], &[]);
    bound.run(gpu);
    bound
}

#[test]
fn an_internal_slot_connects_passes() {
    let gpu = gpu();
    let place = "
@group(0) @binding(0) var place: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) { textureStore(place, id.xy, vec4f(vec4u(id, 7u))); }
";
    let access = Access::READ.union(Access::STORAGE_WRITE);
    let first = compute(place, "between", true, [("place", bind::store("between"))]);
    let second = compute(
        COPY,
        "to",
        true,
        [
            ("source", bind::layer("between")),
            ("copied", bind::store("to")),
        ],
    );
    let node = NodeDesc {
        slots: vec![
            made("between", Direction::Internal, access, Rgba32Float, 1),
            output("to", 1),
        ],
        passes: vec![
            Pass {
                label: "place".to_owned(),
                ..first
            },
            second,
        ],
        ..empty(EARLY)
    };
    let found = run(&gpu, node).read_floats(&gpu, "out", 0);
    for (index, texel) in (0..).zip(found.chunks_exact(4)) {
        assert_eq!(
            texel,
            [(index % SIDE) as f32, (index / SIDE) as f32, 0.0, 7.0]
        );
    }
}

#[test]
fn a_buffer_slot_is_written_and_read() {
    let gpu = gpu();
    let write = "
@group(0) @binding(0) var<storage, read_write> squares: array<u32>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) { let n = id.y * 16u + id.x; squares[n] = n * n; }
";
    let read = "
@group(0) @binding(0) var<storage, read> squares: array<u32>;
@group(0) @binding(1) var copied: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    textureStore(copied, id.xy, vec4f(f32(squares[id.y * 16u + id.x])));
}
";
    let buffer = || ("squares", bind::buffer("squares"));
    let squares = SlotResource::Buffer {
        access: Access::READ.union(Access::STORAGE_WRITE),
        size: 4 * 256,
    };
    // A pass has one declared access per slot, so both passes bind the buffer writable.
    let read = read.replace("<storage, read>", "<storage, read_write>");
    let node = NodeDesc {
        slots: vec![
            Slot::output("squares", "Square numbers.", squares),
            output("to", 1),
        ],
        passes: vec![
            Pass {
                label: "write".to_owned(),
                ..compute(write, "to", false, [buffer()])
            },
            compute(
                &read,
                "to",
                false,
                [buffer(), ("copied", bind::store("to"))],
            ),
        ],
        ..empty(EARLY)
    };
    let graph = graph(
        &[],
        vec![("host", node)],
        &[],
        &[("out", "host.to"), ("squares", "host.squares")],
    );
    let plan = graph.compile(&capabilities(&gpu), &[]).unwrap();
    let bound = bind(&gpu, plan, &[], &[]);
    bound.run(&gpu);
    let found = bound.read_floats(&gpu, "out", 0);
    for (index, texel) in found.chunks_exact(4).enumerate() {
        assert_eq!(texel, [(index * index) as f32; 4]);
    }
    let buffer = bound.bindings.output_buffer("squares").unwrap();
    let bytes = gpu.read_buffer(buffer, "squares").unwrap();
    assert_eq!(
        bytemuck::pod_collect_to_vec::<u8, u32>(&bytes)[255],
        255 * 255
    );
    assert!(bound.bindings.output("squares").is_none());
}

const LAYER_COLOUR: &str = "
struct Value { value: vec4f }
@group(0) @binding(0) var<uniform> parameters: Value;
@vertex fn fullscreen(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0, 0.0, 1.0);
}
@fragment fn main() -> @location(0) vec4f { return parameters.value; }
";

/// A fullscreen pass per layer of an r32float target, with a value per layer.
pub(crate) fn fullscreen_by_layer(layers: u32) -> NodeDesc {
    let square = TextureRule::new(R32Float).extent([SIDE, SIDE]);
    NodeDesc::new("host", EARLY)
        .output("to", "A value per layer.", square.layers(layers))
        .pass(
            Pass::fullscreen("draw", "to")
                .each_layer()
                .shader(LAYER_COLOUR, "main")
                .bind("parameters", bind::parameters()),
        )
        .parameters(ParameterBlock::of::<[f32; 4]>("Value").each_layer_of("to"))
}

#[test]
fn a_fullscreen_pass_is_drawn_to_every_dirty_layer() {
    let gpu = gpu();
    let graph = graph(
        &[],
        vec![("host", fullscreen_by_layer(3))],
        &[],
        &[("out", "host.to")],
    );
    let plan = graph.compile(&capabilities(&gpu), &[]).unwrap();
    let block = |factor: f32| {
        let mut bytes = plan.parameters.initial();
        for layer in 0..3 {
            plan.parameters
                .write(&mut bytes, "host", layer, &[factor * (layer + 1) as f32; 4])
                .unwrap();
        }
        bytes
    };
    let bound = bind(&gpu, plan.clone(), &[], &block(1.0));
    bound.run(&gpu);
    gpu.queue.write_buffer(&bound.parameters, 0, &block(10.0));
    bound.run_layers(&gpu, moment_shadows_graph::record::Layers::Only(&[2, 0]));
    for (layer, expected) in (0..).zip([10.0, 2.0, 30.0]) {
        let found = bound.read_floats(&gpu, "out", layer);
        assert!(
            found.iter().all(|&value| value == expected),
            "layer {layer}: {}",
            found[0]
        );
    }
}

#[test]
fn bindings_may_have_gaps() {
    let gpu = gpu();
    let node = NodeDesc {
        slots: vec![output("to", 1)],
        passes: vec![compute(
            "@group(0) @binding(5) var copied: texture_storage_2d<rgba32float, write>;
             @compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3u) { textureStore(copied, id.xy, vec4f(5.0)); }",
            "to",
            true,
            [("copied", bind::store("to"))],
        )],
        ..empty(EARLY)
    };
    assert!(
        run(&gpu, node)
            .read_floats(&gpu, "out", 0)
            .iter()
            .all(|&value| value == 5.0)
    );
}
