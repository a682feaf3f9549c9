//! Devices that are lost, and memory that is not there.

use moment_shadows::TextureFormat::Rgba32Float;
use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{
    Access, Direction, GraphError, GraphErrorKind, Rule, SlotResource, Stage, TextureRule,
};
use pollster::block_on;

use crate::host_node::{copy, graph, made, rgba32};
use crate::setup::{bind, capabilities, gpu, uniform};

#[test]
fn a_destroyed_device_gives_errors_and_no_panic() {
    let gpu = gpu();
    let device = &gpu.device;
    let copies = graph(
        &[("map", rgba32(1))],
        vec![("copy", copy(Stage::AfterShadowMaps, 1))],
        &[("map", "copy.from")],
        &[("out", "copy.to")],
    );
    let plan = copies.compile(&capabilities(&gpu), &[]).unwrap();
    let map = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: 16,
            height: 16,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    let imports = [("map", ImportedResource::from(&map))];
    let bound = bind(&gpu, plan.clone(), &imports, &[]);
    let parameters = uniform(&gpu, &[]);
    device.destroy();

    let pipelines = block_on(Pipelines::create(device, &plan, PipelineOptions::default()));
    assert_eq!(
        pipelines.err().map(|error| error.kind),
        Some(GraphErrorKind::Lost)
    );
    assert_eq!(
        block_on(Resources::create(device, &plan))
            .err()
            .map(|error| error.kind),
        Some(GraphErrorKind::Lost)
    );
    let bindings = block_on(Bindings::create(
        device,
        &plan,
        &bound.pipelines,
        &bound.resources,
        &imports,
        Some(&parameters),
    ));
    assert_eq!(
        bindings.err().map(|error| error.kind),
        Some(GraphErrorKind::Lost)
    );

    let mut encoder = device.create_command_encoder(&Default::default());
    bound
        .bindings
        .record(Stage::AfterShadowMaps, &mut encoder, Recording::default())
        .unwrap();
    let _ = encoder.finish();
}

#[test]
fn too_little_memory_is_an_error() {
    let gpu = gpu();
    let limits = gpu.device.limits();
    let (side, layers) = (
        limits.max_texture_dimension_2d,
        limits.max_texture_array_layers,
    );
    let mut huge = made(
        "to",
        Direction::Out,
        Access::STORAGE_WRITE,
        Rgba32Float,
        layers,
    );
    if let SlotResource::Texture(TextureRule {
        extent,
        layers: count,
        ..
    }) = &mut huge.resource
    {
        *extent = Rule::Exact([side, side]);
        *count = Rule::Exact(layers);
    }
    let mut node = copy(Stage::AfterShadowMaps, 1);
    node.slots[1] = huge;
    let copies = graph(
        &[("map", rgba32(layers))],
        vec![("copy", node)],
        &[("map", "copy.from")],
        &[("out", "copy.to")],
    );
    let plan = copies.compile(&capabilities(&gpu), &[]).unwrap();
    // A quarter of a terabyte: no device gives it.
    assert_eq!(
        plan.bytes_resident(),
        u64::from(side) * u64::from(side) * u64::from(layers) * 16
    );
    let error = block_on(Resources::create(&gpu.device, &plan))
        .err()
        .unwrap();
    let says = "the device has no memory left for moment-shadows/copy.to; use smaller maps or a storage with fewer bits";
    assert_eq!(error, GraphError::new(GraphErrorKind::OutOfMemory, says));
    // The device works on.
    let small = graph(
        &[("map", rgba32(1))],
        vec![("copy", copy(Stage::AfterShadowMaps, 1))],
        &[("map", "copy.from")],
        &[("out", "copy.to")],
    );
    let plan = small.compile(&capabilities(&gpu), &[]).unwrap();
    assert!(block_on(Resources::create(&gpu.device, &plan)).is_ok());
}
