//! From a plan to pictures: what is created when, timestamps and labels.

use moment_shadows::{Profile, TextureFormat};
use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{Plan, Stage, TextureDesc};
use moment_shadows_lab::gpu::Gpu;
use pollster::block_on;

use crate::depth_map;
use crate::setup::{EXAMPLE, aligned_view, bind, block, capabilities, compiled, gpu, uniform};

fn plan(gpu: &Gpu, map: [u32; 2], picture: [u32; 2]) -> Plan {
    let depth = |size| TextureDesc::new(TextureFormat::Depth32Float, size);
    let imports = [
        ("light_depth", depth(map)),
        ("camera_depth", depth(picture)),
    ];
    compiled(EXAMPLE, &capabilities(gpu), &imports)
}

/// The picture of the example at some sizes, with the pipelines of a plan of any sizes.
fn picture(gpu: &Gpu, pipelines: &Pipelines, map: [u32; 2], size: [u32; 2]) -> Vec<u8> {
    let plan = plan(gpu, map, size);
    let light = depth_map::of(gpu, map, |x, _| if x < map[0] / 2 { 0.2 } else { 1.0 });
    let camera = depth_map::of(gpu, size, |_, _| 0.8);
    let resources = block_on(Resources::create(&gpu.device, &plan)).unwrap();
    let imports = [
        ("light_depth", ImportedResource::from(&light)),
        ("camera_depth", ImportedResource::from(&camera)),
    ];
    let parameters = uniform(gpu, &block(&plan, &aligned_view(0)));
    let bindings = block_on(Bindings::create(
        &gpu.device,
        &plan,
        pipelines,
        &resources,
        &imports,
        Some(&parameters),
    ))
    .unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    for stage in Stage::ALL {
        bindings
            .record(stage, &mut encoder, Recording::default())
            .unwrap();
    }
    gpu.queue.submit([encoder.finish()]);
    gpu.check().unwrap();
    gpu.read_texture(bindings.output("shadow_intensity").unwrap(), 0, "picture")
        .unwrap()
}

#[test]
fn a_resize_makes_no_pipeline() {
    let gpu = gpu();
    let mut pipelines = Pipelines::default();
    assert!(pipelines.is_empty());
    let small = plan(&gpu, [64, 64], [32, 32]);
    let options = PipelineOptions::default();
    let made = block_on(pipelines.extend(&gpu.device, &small, options.clone())).unwrap();
    assert_eq!((made, pipelines.len()), (4, 4));
    let large = plan(&gpu, [128, 256], [100, 50]);
    assert_eq!(
        block_on(pipelines.extend(&gpu.device, &large, options)).unwrap(),
        0
    );
    for (map, size) in [([64, 64], [32, 32]), ([128, 256], [100, 50])] {
        let found = picture(&gpu, &pipelines, map, size);
        // Shadow at the left edge, light at the right one.
        assert_eq!(
            (found[0], found[size[0] as usize - 1]),
            (255, 0),
            "{size:?}"
        );
        assert_eq!(found.len() as u32, size[0] * size[1]);
    }
}

#[test]
fn plans_share_the_pipelines_that_they_have_in_common() {
    let gpu = gpu();
    let mut pipelines = block_on(Pipelines::create(
        &gpu.device,
        &plan(&gpu, [64, 64], [32, 32]),
        PipelineOptions::default(),
    ))
    .unwrap();
    // Another kernel: resolve and shade stay, both directions of the blur are new.
    let text = EXAMPLE.replace("\"radius\": 4", "\"radius\": 2");
    let other = compiled(
        &text,
        &capabilities(&gpu),
        &[(
            "light_depth",
            TextureDesc::new(TextureFormat::Depth32Float, [64, 64]),
        )],
    );
    assert_eq!(
        block_on(pipelines.extend(&gpu.device, &other, PipelineOptions::default())).unwrap(),
        2
    );
    assert_eq!(pipelines.len(), 6);
}

#[test]
fn stages_are_recorded_apart() {
    let gpu = gpu();
    let size = [32, 32];
    let light = depth_map::of(&gpu, size, |_, _| 0.2);
    let camera = depth_map::texture(&gpu, wgpu::TextureFormat::Depth32Float, size, 1, 1);
    let imports = [
        ("light_depth", ImportedResource::from(&light)),
        ("camera_depth", ImportedResource::from(&camera)),
    ];
    let plan = plan(&gpu, size, size);
    let bytes = block(&plan, &aligned_view(0));
    let bound = bind(&gpu, plan, &imports, &bytes);
    let record = |stage| {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        bound
            .bindings
            .record(stage, &mut encoder, Recording::default())
            .unwrap();
        gpu.queue.submit([encoder.finish()]);
    };
    record(Stage::AfterShadowMaps);
    // The host draws its main pass between the stages.
    depth_map::draw(&gpu, &camera, 0, &depth_map::values(size, |_, _| 0.8));
    record(Stage::AfterMainPass);
    gpu.check().unwrap();
    assert!(
        bound
            .read(&gpu, "shadow_intensity", 0)
            .iter()
            .all(|&intensity| intensity >= 254)
    );
    assert!(bound.pipelines.len() == 4 && format!("{:?}", bound.resources).contains("resolve.map"));
}

#[test]
fn every_pass_writes_its_timestamps() {
    let gpu = Gpu::open_with(Profile::Native, wgpu::Features::TIMESTAMP_QUERY).unwrap();
    if !gpu
        .device
        .features()
        .contains(wgpu::Features::TIMESTAMP_QUERY)
    {
        return;
    }
    let size = [64, 64];
    let light = depth_map::of(&gpu, size, |_, _| 0.2);
    let imports = [
        ("light_depth", ImportedResource::from(&light)),
        ("camera_depth", ImportedResource::from(&light)),
    ];
    let plan = plan(&gpu, size, size);
    let bytes = block(&plan, &aligned_view(0));
    let bound = bind(&gpu, plan, &imports, &bytes);
    let count = 10;
    let queries = gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
        label: None,
        ty: wgpu::QueryType::Timestamp,
        count,
    });
    let resolved = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 8 * 8,
        usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    for stage in Stage::ALL {
        let timestamps = Some((&queries, 2));
        bound
            .bindings
            .record(
                stage,
                &mut encoder,
                Recording {
                    timestamps,
                    ..Recording::default()
                },
            )
            .unwrap();
    }
    encoder.resolve_query_set(&queries, 2..10, &resolved, 0);
    gpu.queue.submit([encoder.finish()]);
    let bytes = gpu.read_buffer(&resolved, "timestamps").unwrap();
    let times: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
    for (index, pass) in times.chunks_exact(2).enumerate() {
        assert!(pass[0] > 0 && pass[0] <= pass[1], "pass {index}: {pass:?}");
    }
}

#[test]
fn errors_of_the_device_carry_the_labels_of_the_plan() {
    let gpu = gpu();
    let size = [32, 32];
    let light = depth_map::of(&gpu, size, |_, _| 0.2);
    let imports = [
        ("light_depth", ImportedResource::from(&light)),
        ("camera_depth", ImportedResource::from(&light)),
    ];
    let plan = plan(&gpu, size, size);
    let bytes = block(&plan, &aligned_view(0));
    let bound = bind(&gpu, plan, &imports, &bytes);
    // The pipeline draws to r8unorm; this pass has depth alone.
    let view = light.create_view(&Default::default());
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: None,
        color_attachments: &[],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &view,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(1.0),
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    });
    bound.bindings.draw("shade/shade", &mut pass, 0).unwrap();
    drop(pass);
    let _ = encoder.finish();
    let error = gpu.check().unwrap_err().to_string();
    assert!(error.contains("moment-shadows/shade/shade"), "{error}");
}

#[test]
fn creation_can_wait_on_any_thread() {
    fn assert_send<T: Send>(_: T) {}
    let gpu = gpu();
    let plan = plan(&gpu, [32, 32], [32, 32]);
    let pipelines = Pipelines::default();
    let resources = block_on(Resources::create(&gpu.device, &plan)).unwrap();
    assert_send(Pipelines::create(
        &gpu.device,
        &plan,
        PipelineOptions::default(),
    ));
    assert_send(Resources::create(&gpu.device, &plan));
    assert_send(Bindings::create(
        &gpu.device,
        &plan,
        &pipelines,
        &resources,
        &[],
        None,
    ));
}
