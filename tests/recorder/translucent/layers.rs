//! A host's pass is drawn once per layer that is made anew, to all planes of that layer.

use moment_shadows::TextureFormat;
use moment_shadows_graph::record::{HostPass, ImportedResource, Layers, Recording};
use moment_shadows_graph::{Stage, TextureDesc};

use crate::depth_map;
use crate::setup::{bind, capabilities, compiled, gpu};

const GRAPH: &str = r#"{
  "version": 2,
  "imports": [{ "name": "light_depth" }],
  "nodes": [
    { "name": "resolve", "type": "resolve", "properties": { "technique": "hamburger6", "storage": "float32", "blends": 3 } },
    { "name": "casters", "type": "translucent_casters" }
  ],
  "edges": [
    { "from": "light_depth", "to": "resolve.depth" },
    { "from": "resolve.map", "to": "casters.map" }
  ],
  "outputs": [{ "name": "map", "from": "casters.map" }]
}"#;

#[test]
fn each_dirty_layer_is_drawn_with_all_its_planes() {
    let gpu = gpu();
    let capabilities = moment_shadows_graph::Capabilities {
        blended: vec![TextureFormat::Rgba32Float],
        ..capabilities(&gpu)
    };
    let depth = TextureDesc {
        layers: 3,
        ..TextureDesc::new(TextureFormat::Depth32Float, [16, 16])
    };
    let plan = compiled(GRAPH, &capabilities, &[("light_depth", depth)]);
    let light = depth_map::texture(&gpu, wgpu::TextureFormat::Depth32Float, [16, 16], 3, 1);
    let bytes = plan.parameters.initial();
    let bound = bind(
        &gpu,
        plan,
        &[("light_depth", ImportedResource::from(&light))],
        &bytes,
    );
    let mut drawn = Vec::new();
    let mut handler = |pass: HostPass<'_>, encoder: &mut wgpu::CommandEncoder| {
        for (plane, view) in (0_u32..).zip(pass.targets) {
            drawn.push((pass.layer, plane));
            // A colour that says which they are.
            let value = f64::from(10 * pass.layer + plane);
            let colour = wgpu::Color {
                r: value,
                g: value,
                b: value,
                a: value,
            };
            encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: None,
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(colour),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                ..Default::default()
            });
        }
    };
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let recording = Recording {
        layers: Layers::Only(&[2, 1]),
        host_passes: Some(&mut handler),
        ..Recording::default()
    };
    bound
        .bindings
        .record(Stage::AfterShadowMaps, &mut encoder, recording)
        .unwrap();
    gpu.queue.submit([encoder.finish()]);
    gpu.check().unwrap();
    assert_eq!(drawn, [(2, 0), (2, 1), (1, 0), (1, 1)]);
    for (layer, plane) in drawn {
        let texels = bound.read_floats(&gpu, "map", 2 * layer + plane);
        let expected = (10 * layer + plane) as f32;
        assert!(texels.iter().all(|&it| it == expected), "{layer}, {plane}");
    }
    // The layer that was left out was never written.
    let left_out = bound.read_floats(&gpu, "map", 0);
    assert!(left_out.iter().all(|&it| it == 0.0));
}
