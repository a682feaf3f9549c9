//! Holes in the plan where the host draws.

use moment_shadows::TextureFormat::{Depth32Float, R32Float};
use moment_shadows_graph::record::Recording;
use moment_shadows_graph::{GraphError, GraphErrorKind, NodeDesc, Pass, Plan, Stage, TextureRule};

use crate::host_node::{SIDE, compute, from_and_to, graph, input, output};
use crate::setup::{bind, capabilities, gpu};

const EARLY: Stage = Stage::AfterShadowMaps;

/// A host draws to an r32float and a depth target; a node after it reads what was drawn.
fn plan(capabilities: &moment_shadows_graph::Capabilities) -> Plan {
    let square = |format| TextureRule::new(format).extent([SIDE, SIDE]);
    let drawn = NodeDesc::new("drawn", EARLY)
        .output("colour", "What the host draws.", square(R32Float))
        .internal("depth", "What it tests.", square(Depth32Float))
        .pass(Pass::host("casters", &["colour"], Some("depth")));
    let doubled = "
@group(0) @binding(0) var source: texture_2d<f32>;
@group(0) @binding(1) var copied: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    textureStore(copied, id.xy, vec4f(2.0 * textureLoad(source, id.xy, 0).x));
}
";
    let after = NodeDesc::new("after", EARLY)
        .slots([input("from"), output("to", 1)])
        .pass(compute(doubled, "to", true, from_and_to()));
    let graph = graph(
        &[],
        vec![("host", drawn), ("after", after)],
        &[("host.colour", "after.from")],
        &[("out", "after.to")],
    );
    graph.compile(capabilities, &[]).unwrap()
}

#[test]
fn the_hosts_handler_draws_between_passes() {
    let gpu = gpu();
    let bound = bind(&gpu, plan(&capabilities(&gpu)), &[], &[]);
    let mut drawn = Vec::new();
    let mut handler = |pass: moment_shadows_graph::record::HostPass<'_>,
                       encoder: &mut wgpu::CommandEncoder| {
        drawn.push((
            pass.name.to_owned(),
            pass.targets.len(),
            pass.depth.is_some(),
            pass.blend,
        ));
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: None,
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &pass.targets[0],
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color {
                        r: 21.0,
                        g: 0.0,
                        b: 0.0,
                        a: 0.0,
                    }),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: pass.depth.unwrap(),
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
    };
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let recording = Recording {
        host_passes: Some(&mut handler),
        ..Recording::default()
    };
    bound
        .bindings
        .record(EARLY, &mut encoder, recording)
        .unwrap();
    gpu.queue.submit([encoder.finish()]);
    gpu.check().unwrap();
    assert_eq!(drawn, [("host/casters".to_owned(), 1, true, false)]);
    assert!(
        bound
            .read_floats(&gpu, "out", 0)
            .iter()
            .all(|&value| value == 42.0)
    );
}

#[test]
fn a_host_pass_without_a_handler_is_an_error_before_anything_is_recorded() {
    let gpu = gpu();
    let bound = bind(&gpu, plan(&capabilities(&gpu)), &[], &[]);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let error = bound
        .bindings
        .record(EARLY, &mut encoder, Recording::default())
        .unwrap_err();
    let says =
        "stage AfterShadowMaps has the host's pass 'host/casters'; give a handler that draws it";
    assert_eq!(error, GraphError::new(GraphErrorKind::Recording, says));
    // The other stage has no such pass.
    bound
        .bindings
        .record(Stage::AfterMainPass, &mut encoder, Recording::default())
        .unwrap();
    gpu.queue.submit([encoder.finish()]);
    gpu.check().unwrap();
}
