//! Soft shadows in your renderer: a sun and a lamp of some size, in constant time per pixel.
//!
//! `cargo run --release --example soft_shadows [SCENE [FOLDER]]`. As in `hard_shadows` the small renderer of `examples/lab`
//! stands in for yours: it draws each light's depth and a G-buffer, and lights the picture with the shadow intensity.

use std::error::Error;
use std::path::Path;

use moment_shadows::{
    AreaLight, CameraView, DepthRange, LeakReduction, LightDepth, LightView, MapRegion, Profile,
    ReceiverBias, ViewParameters,
};
use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{Capabilities, Graph, NodeRegistry, Stage};
use moment_shadows_lab::frame::{Frame, FrameDesc};
use moment_shadows_lab::light::{LightShape, StoredDepth};
use moment_shadows_lab::soft::SoftLightChoice;
use moment_shadows_lab::{gpu::Gpu, picture, scene, view::View};
use pollster::block_on;

const PICTURE: [u32; 2] = [1280, 720];
const MAP: u32 = 1024;

/// Half of the largest kernel that the graph's table is made for, and next to nothing where shadows touch what casts them.
const RADII: std::ops::RangeInclusive<f64> = 1.0..=64.5;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let scene = arguments.next().unwrap_or("chairs".to_owned());
    let folder = arguments.next().unwrap_or("pictures".to_owned());

    // The host, and the graph compiled for what it has: once.
    let gpu = Gpu::open(Profile::Native)?;
    let scene = scene::load(&scene)?;
    let graph = Graph::parse(include_str!("soft_shadows.json"), &NodeRegistry::new())?;
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

    for choice in [SoftLightChoice::Directional, SoftLightChoice::Spot] {
        let frame = draw(&gpu, &scene, choice)?;
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

        // Every frame: where camera and light are, and how large the light is.
        let shade = shade_parameters(&frame.desc)?;
        let mut block = plan.parameters.initial();
        plan.parameters
            .write(&mut block, "resolve", 0, &shade.conversion)?;
        plan.parameters.write(&mut block, "shade", 0, &shade)?;
        gpu.queue.write_buffer(&parameters, 0, &block);

        // Every frame: each stage after the host's own pass.
        let mut encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        bindings.record(Stage::AfterShadowMaps, &mut encoder, Recording::default())?;
        bindings.record(Stage::AfterMainPass, &mut encoder, Recording::default())?;
        gpu.queue.submit([encoder.finish()]);

        let shadow = bindings
            .output("shadow_intensity")
            .ok_or("the graph has no such output")?;
        let pixels = frame.picture(&gpu, shadow)?;
        let out = Path::new(&folder).join(format!("soft_shadows_{}.png", choice.name()));
        picture::save_rgba(&out, PICTURE[0], PICTURE[1], &pixels)?;
        println!("{}", out.display());
    }
    Ok(())
}

/// The host's own passes: a light that covers the casters and whose range reaches to where their shadows fall.
fn draw(gpu: &Gpu, scene: &scene::Scene, choice: SoftLightChoice) -> Result<Frame, Box<dyn Error>> {
    let view = View::numbered(scene, 0);
    let map = [MAP; 2];
    let (light, shape) = choice.light(scene, &view, map, 4.0, None)?;
    let mut camera = view.camera;
    camera.aspect = f64::from(PICTURE[0]) / f64::from(PICTURE[1]);
    let desc = FrameDesc {
        picture: PICTURE,
        map,
        samples: 4,
        format: wgpu::TextureFormat::Depth32Float,
        light,
        shape,
        camera,
    };
    Ok(Frame::draw(gpu, scene, desc)?)
}

/// What the node is told about camera and light. Blocker search and filter widths follow from the light's size; so does the
/// receiver bias, from the width of each pixel's own filter.
fn shade_parameters(desc: &FrameDesc) -> Result<ViewParameters, Box<dyn Error>> {
    let light = &desc.light;
    let [near, far] = light.range;
    let range = DepthRange { near, far };
    let texel = light.texel_size(desc.map);
    let (area_light, depth, spread) = match (desc.shape, light.depth) {
        (LightShape::Directional { angular_diameter }, _) => (
            AreaLight::directional(angular_diameter, texel, range, RADII)?,
            LightDepth::Orthographic { reversed: false },
            1.0,
        ),
        (
            LightShape::Disk { diameter },
            StoredDepth::Perspective {
                near,
                far,
                reversed,
            },
        ) => (
            AreaLight::spot(diameter, texel, range, RADII)?,
            LightDepth::Perspective {
                near,
                far: far.unwrap_or(f64::INFINITY),
                reversed,
                range,
            },
            // Texels grow with distance.
            range.far,
        ),
        _ => return Err("this example has a sun and a lamp".into()),
    };
    let camera_view = CameraView {
        clip_from_world: desc.camera.clip_from_world_columns()?,
        far_depth: 0.0, // reversed depth
    };
    let light_view = LightView {
        clip_from_world: light.clip_from_world().as_mat4().to_cols_array_2d(),
        depth,
        layer: 0,
        region: MapRegion::WHOLE,
        channel: 0,
    };
    let depth_per_texel = 2.0 * texel[0].max(texel[1]) * spread / (far - near);
    let bias = ReceiverBias::for_kernel(0.0, depth_per_texel as f32);
    let mut shade = ViewParameters::new(&camera_view, &light_view, bias, LeakReduction::DEFAULT)?;
    shade.light = area_light;
    Ok(shade)
}
