//! Timestamps of passes that are drawn to several layers: a render pass for each, and a pair of queries for all of them.

use moment_shadows::{Profile, TextureFormat};
use moment_shadows_graph::record::{ImportedResource, Layers, Recording};
use moment_shadows_graph::{PlannedWork, Stage, TextureDesc};
use moment_shadows_lab::gpu::Gpu;

use crate::depth_map;
use crate::setup::{EXAMPLE, bind, capabilities, compiled};

const LAYERS: u32 = 4;

#[test]
fn a_pass_drawn_to_several_layers_writes_its_first_and_its_last_query() {
    let feature = wgpu::Features::TIMESTAMP_QUERY;
    let gpu = Gpu::open_with(Profile::WebgpuCore, feature).unwrap();
    if !gpu.device.features().contains(feature) {
        return;
    }
    // No compute shader writes ten bits: all passes are drawn.
    let text = EXAMPLE
        .replace(
            "\"storage\": \"unorm16\"",
            "\"technique\": \"hamburger6\", \"storage\": \"unorm10\"",
        )
        .replace(
            "{ \"name\": \"shadow_intensity\", \"from\": \"shade.shadow_intensity\" }",
            "{ \"name\": \"blurred\", \"from\": \"blur.blurred\" }",
        );
    let desc = TextureDesc {
        layers: LAYERS,
        ..TextureDesc::new(TextureFormat::Depth32Float, [64, 64])
    };
    let plan = compiled(&text, &capabilities(&gpu), &[("light_depth", desc)]);
    let drawn = |pass: &moment_shadows_graph::PlannedPass| {
        pass.layers == LAYERS && matches!(pass.work, PlannedWork::Fullscreen { .. })
    };
    assert!(plan.passes.iter().all(drawn));
    let map = depth_map::texture(&gpu, wgpu::TextureFormat::Depth32Float, [64, 64], LAYERS, 1);
    let bytes = plan.parameters.initial();
    let count = 2 * plan.passes.len() as u32;
    let passes = plan.passes.len();
    let imports = [("light_depth", ImportedResource::from(&map))];
    let bound = bind(&gpu, plan, &imports, &bytes);
    let device = &gpu.device;
    for dirty in [&[0, 1, 2, 3][..], &[2], &[3, 1], &[1, 0, 3], &[]] {
        let queries = device.create_query_set(&wgpu::QuerySetDescriptor {
            label: None,
            ty: wgpu::QueryType::Timestamp,
            count,
        });
        let resolved = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 8 * u64::from(count),
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        let recording = Recording {
            layers: Layers::Only(dirty),
            timestamps: Some((&queries, 0)),
            ..Recording::default()
        };
        bound
            .bindings
            .record(Stage::AfterShadowMaps, &mut encoder, recording)
            .unwrap();
        if !dirty.is_empty() {
            encoder.resolve_query_set(&queries, 0..count, &resolved, 0);
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.check().unwrap();
        if dirty.is_empty() {
            continue;
        }
        let bytes = gpu.read_buffer(&resolved, "timestamps").unwrap();
        let times: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
        // Written at all, and in the order of the passes: a query that nobody writes is 0.
        assert!(times.iter().all(|&time| time > 0), "{dirty:?}: {times:?}");
        assert!(times.is_sorted(), "{dirty:?}: {times:?}");
        assert_eq!(times.len(), 2 * passes);
    }
}
