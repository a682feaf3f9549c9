//! Hard shadows in your renderer: a graph file between the renderer's depth maps and its lighting.
//!
//! `cargo run --release --example hard_shadows [SCENE [PICTURE]]`. The small renderer of `examples/lab` stands in for
//! yours: it draws the light's depth and a G-buffer, and lights the picture with the shadow intensity.

use std::error::Error;
use std::path::Path;

use moment_shadows::{
    CameraView, Kernel, LeakReduction, LightDepth, LightView, MapRegion, Profile, ReceiverBias,
    ViewParameters,
};
use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{Capabilities, Graph, NodeRegistry, Stage};
use moment_shadows_lab::command::render::RenderOptions;
use moment_shadows_lab::{frame::Frame, gpu::Gpu, picture, scene};
use pollster::block_on;

const PICTURE: [u32; 2] = [1280, 720];
const MAP: u32 = 1024;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let scene = arguments.next().unwrap_or("fence-and-foliage".to_owned());
    let out = arguments
        .next()
        .unwrap_or("pictures/hard_shadows.png".to_owned());

    // The host: a device, a light's depth with four samples per texel, the camera's depth.
    let gpu = Gpu::open(Profile::Native)?;
    let scene = scene::load(&scene)?;
    let frame: Frame = RenderOptions::default().frame(&gpu, &scene, 4)?;
    let (light, camera) = (&frame.desc.light, &frame.desc.camera);

    // Once: compile the graph for what the host has, and make its pipelines.
    let graph = Graph::parse(include_str!("hard_shadows.json"), &NodeRegistry::new())?;
    let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
    // The file describes the imports as this host has them; a host with other textures gives descriptions of its own.
    let plan = graph.compile(&capabilities, &[])?;
    let pipelines = block_on(Pipelines::create(
        &gpu.device,
        &plan,
        PipelineOptions::default(),
    ))?;

    // Once per size: textures, and a block of parameters per view.
    let resources = block_on(Resources::create(&gpu.device, &plan))?;
    let parameters = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("parameters of one view"),
        size: u64::from(plan.parameters.size),
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let bindings = block_on(Bindings::create(
        &gpu.device,
        &plan,
        &pipelines,
        &resources,
        &[
            (
                "light_depth",
                ImportedResource::Texture(&frame.light_map.texture),
            ),
            (
                "camera_depth",
                ImportedResource::Texture(&frame.surface.depth),
            ),
        ],
        Some(&parameters),
    ))?;

    // Every frame: where camera and light are. The receiver bias follows from the kernel of the graph.
    let kernel = Kernel::gaussian(4, 2.4)?;
    let [width, height] = light.texel_size([MAP, MAP]);
    let depth_per_texel = 2.0 * width.max(height) / (light.range[1] - light.range[0]);
    let light_view = LightView {
        clip_from_world: light.clip_from_world().as_mat4().to_cols_array_2d(),
        depth: LightDepth::Orthographic { reversed: false },
        layer: 0,
        region: MapRegion::WHOLE,
        channel: 0,
    };
    let camera_view = CameraView {
        clip_from_world: camera.clip_from_world_columns()?,
        far_depth: 0.0, // reversed depth
    };
    let shade = ViewParameters::new(
        &camera_view,
        &light_view,
        ReceiverBias::for_kernel(kernel.standard_deviation(), depth_per_texel as f32),
        LeakReduction::DEFAULT,
    )?;
    let mut block = plan.parameters.initial();
    plan.parameters
        .write(&mut block, "resolve", 0, &light_view.depth.conversion()?)?;
    plan.parameters.write(&mut block, "shade", 0, &shade)?;
    gpu.queue.write_buffer(&parameters, 0, &block);

    // Every frame: each stage after the host's own pass.
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    bindings.record(Stage::AfterShadowMaps, &mut encoder, Recording::default())?;
    bindings.record(Stage::AfterMainPass, &mut encoder, Recording::default())?;
    gpu.queue.submit([encoder.finish()]);

    // The host's lighting reads the shadow intensity.
    let shadow = bindings
        .output("shadow_intensity")
        .ok_or("the graph has no such output")?;
    let pixels = frame.picture(&gpu, shadow)?;
    picture::save_rgba(Path::new(&out), PICTURE[0], PICTURE[1], &pixels)?;
    println!("{out}");
    Ok(())
}
