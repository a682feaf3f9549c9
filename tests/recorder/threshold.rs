//! The node of `graph/docs/write_a_node.md` on the device, against plain arithmetic.

use moment_shadows::TextureFormat;
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_graph::{Graph, NodeRegistry, ResourceDesc, TextureDesc};
use wgpu::util::DeviceExt as _;

use crate::setup::{bind, capabilities, gpu};
use crate::threshold_node::Threshold;

#[test]
fn the_documented_node_is_this_one() {
    let document = include_str!("../../graph/docs/write_a_node.md").replace("\r\n", "\n");
    let node = include_str!("threshold_node.rs").replace("\r\n", "\n");
    assert!(document.contains(&format!("```rust\n{node}")));
}

#[test]
fn a_threshold_is_white_above_its_level() {
    let gpu = gpu();
    let mut registry = NodeRegistry::new();
    registry.register::<Threshold>("threshold");
    let text = r#"{
  "version": 2,
  "imports": [{ "name": "map" }],
  "nodes": [{ "name": "node", "type": "threshold", "properties": { "level": 0.25 } }],
  "edges": [{ "from": "map", "to": "node.map" }],
  "outputs": [{ "name": "picture", "from": "node.picture" }]
}"#;
    let graph = Graph::parse(text, &registry).unwrap();
    // Sides that no workgroup divides, and values on both sides of the level and on it.
    let size = [13, 11];
    let layers = 2;
    let values: Vec<f32> = (0..size[0] * size[1] * layers)
        .map(|index| (index % 7) as f32 / 8.0 - 0.125)
        .collect();
    let texels: Vec<[f32; 4]> = values.iter().map(|&x| [x, 1.0, 1.0, 1.0]).collect();
    let desc = TextureDesc {
        layers,
        ..TextureDesc::new(TextureFormat::Rgba32Float, size)
    };
    let imports = [("map", ResourceDesc::Texture(desc))];
    let plan = graph.compile(&capabilities(&gpu), &imports).unwrap();
    let map = gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: Some("map"),
            size: wgpu::Extent3d {
                width: size[0],
                height: size[1],
                depth_or_array_layers: layers,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        bytemuck::cast_slice(&texels),
    );
    let bound = bind(&gpu, plan, &[("map", ImportedResource::from(&map))], &[]);
    bound.run(&gpu);
    let of_layer = values.chunks_exact((size[0] * size[1]) as usize);
    for (layer, values) in (0..).zip(of_layer) {
        let found: Vec<[u8; 4]> = bytemuck::pod_collect_to_vec(&bound.read(&gpu, "picture", layer));
        let expected: Vec<[u8; 4]> = values
            .iter()
            .map(|&value| {
                if value > 0.25 {
                    [255; 4]
                } else {
                    [0, 0, 0, 255]
                }
            })
            .collect();
        assert_eq!(found, expected, "layer {layer}");
    }
}
