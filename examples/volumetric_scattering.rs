//! Shafts of light in your renderer: a sun in thin fog, for two texture fetches per pixel.
//!
//! `cargo run --release --example volumetric_scattering [SCENE [FOLDER]]`. As in `hard_shadows` the small renderer of
//! `examples/lab` stands in for yours: it draws the light's depth and a G-buffer, and lights the picture. The shadow map then
//! serves twice, for surfaces and for the air in front of them. Pictures of several viewpoints are written.

use std::error::Error;
use std::path::Path;

use moment_shadows::{
    CameraView, Kernel, LeakReduction, LightDepth, LightView, MapRegion, Profile, ReceiverBias,
    ScatteringParameters, SingleScattering, ViewParameters,
};
use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{Capabilities, Graph, NodeRegistry, Stage};
use moment_shadows_lab::frame::{Frame, FrameDesc};
use moment_shadows_lab::light::LightShape;
use moment_shadows_lab::{gpu::Gpu, picture, scene, view::View};
use pollster::block_on;

const PICTURE: [u32; 2] = [1280, 720];
const MAP: u32 = 1024;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().unwrap_or("hall".to_owned());
    let folder = arguments.next().unwrap_or("pictures".to_owned());

    // The host, and the graph compiled for what it has: once.
    let gpu = Gpu::open(Profile::Native)?;
    let scene = scene::load(&name)?;
    let graph = Graph::parse(
        include_str!("volumetric_scattering.json"),
        &NodeRegistry::new(),
    )?;
    let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
    let plan = graph.compile(&capabilities, &[])?;
    let options = PipelineOptions::default();
    let pipelines = block_on(Pipelines::create(&gpu.device, &plan, options))?;
    let resources = block_on(Resources::create(&gpu.device, &plan))?;
    let parameters = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("parameters of one view"),
        size: u64::from(plan.parameters.size),
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });

    // Fog through which half of the light comes across the scene, thicker for blue.
    let radius = scene.bounds().radius();
    let density = (0.35 / radius) as f32;
    let extinction = [0.9, 1.0, 1.1].map(|colour| colour * density);
    let scattering = extinction.map(|extinction| 0.9 * extinction);
    let medium = SingleScattering::new(extinction, scattering, 0.4, [9.0, 8.4, 7.5])?;
    let far = 3.0 * radius;

    for number in 0..3 {
        let frame = draw(&gpu, &scene, number)?;
        let imports = [
            (
                "light_depth",
                ImportedResource::Texture(&frame.light_map.texture),
            ),
            (
                "camera_depth",
                ImportedResource::Texture(&frame.surface.depth),
            ),
        ];
        let bindings = block_on(Bindings::create(
            &gpu.device,
            &plan,
            &pipelines,
            &resources,
            &imports,
            Some(&parameters),
        ))?;

        // Every frame: where camera and light are, and what is in the air.
        let (camera, light) = views(&frame.desc)?;
        let shade = shade_parameters(&frame.desc, &camera, &light)?;
        let scattering = ScatteringParameters::new(&camera, far, &light, medium)?;
        let mut block = plan.parameters.initial();
        let blocks = &plan.parameters;
        blocks.write(&mut block, "resolve", 0, &light.depth.conversion()?)?;
        blocks.write(&mut block, "shade", 0, &shade)?;
        blocks.write(&mut block, "rectify", 0, &scattering.rectify)?;
        blocks.write(&mut block, "integrate", 0, &scattering.integrate)?;
        blocks.write(&mut block, "composite", 0, &scattering.composite)?;
        gpu.queue.write_buffer(&parameters, 0, &block);

        // Every frame: each stage after the host's own pass.
        let mut encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        bindings.record(Stage::AfterShadowMaps, &mut encoder, Recording::default())?;
        bindings.record(Stage::AfterMainPass, &mut encoder, Recording::default())?;
        gpu.queue.submit([encoder.finish()]);

        // A host blends the radiance over its picture: source + source alpha x destination. This one does so here.
        let missing = "the graph has no such output";
        let shadow = bindings.output("shadow_intensity").ok_or(missing)?;
        let mut pixels = frame.picture(&gpu, shadow)?;
        let fog = bindings.output("scattering").ok_or(missing)?;
        blend(&mut pixels, &gpu.read_texture(fog, 0, "scattering")?);
        let out = Path::new(&folder).join(format!("volumetric_scattering_{number}.png"));
        picture::save_rgba(&out, PICTURE[0], PICTURE[1], &pixels)?;
        println!("{}", out.display());
    }
    Ok(())
}

/// The host's own passes: a viewpoint of the scene and its sun.
fn draw(gpu: &Gpu, scene: &scene::Scene, number: u32) -> Result<Frame, Box<dyn Error>> {
    let view = View::numbered(scene, number);
    let mut camera = view.camera;
    camera.aspect = f64::from(PICTURE[0]) / f64::from(PICTURE[1]);
    let desc = FrameDesc {
        picture: PICTURE,
        map: [MAP; 2],
        samples: 4,
        format: wgpu::TextureFormat::Depth32Float,
        light: view.sun(scene, [MAP; 2], 4.0, false)?,
        shape: LightShape::Directional {
            angular_diameter: 0.0,
        },
        camera,
    };
    Ok(Frame::draw(gpu, scene, desc)?)
}

fn views(desc: &FrameDesc) -> Result<(CameraView, LightView), Box<dyn Error>> {
    let camera = CameraView {
        clip_from_world: desc.camera.clip_from_world_columns()?,
        far_depth: 0.0, // reversed depth
    };
    let light = LightView {
        clip_from_world: desc.light.clip_from_world().as_mat4().to_cols_array_2d(),
        depth: LightDepth::Orthographic { reversed: false },
        layer: 0,
        region: MapRegion::WHOLE,
        channel: 0,
    };
    Ok((camera, light))
}

/// For the surfaces; the receiver bias follows from the kernel of the graph.
fn shade_parameters(
    desc: &FrameDesc,
    camera: &CameraView,
    light: &LightView,
) -> Result<ViewParameters, Box<dyn Error>> {
    let [near, far] = desc.light.range;
    let [width, height] = desc.light.texel_size([MAP; 2]);
    let depth_per_texel = 2.0 * width.max(height) / (far - near);
    let kernel = Kernel::gaussian(2, 1.2)?;
    let bias = ReceiverBias::for_kernel(kernel.standard_deviation(), depth_per_texel as f32);
    let leaks = LeakReduction::DEFAULT;
    Ok(ViewParameters::new(camera, light, bias, leaks)?)
}

/// Adds radiance to what is left of a picture of sRGB bytes, pixel by pixel.
fn blend(pixels: &mut [u8], radiance: &[u8]) {
    for (pixel, texel) in pixels.chunks_exact_mut(4).zip(radiance.chunks_exact(8)) {
        let channel = |index: usize| {
            half::f16::from_le_bytes([texel[2 * index], texel[2 * index + 1]]).to_f32()
        };
        let transmittance = channel(3);
        for (colour, byte) in pixel.iter_mut().take(3).enumerate() {
            let behind = (f32::from(*byte) / 255.0).powf(2.2);
            let sum = behind * transmittance + channel(colour);
            *byte = (sum.clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0).round() as u8;
        }
    }
}
