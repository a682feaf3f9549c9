//! Forward shading: the graph ends with the filtered map, and the renderer's own lit shader samples it.
//!
//! `cargo run --release --example forward_shading [PICTURE]`. Runs on core WebGPU: half-precision storage. The small renderer
//! in `examples/renderer` stands in for yours; the lit shader is `examples/forward_shading.wgsl`.

mod renderer;

use std::error::Error;

use moment_shadows::{ReceiverBias, Source, link};
use moment_shadows_graph::{CameraView, Graph, LightView, Session, Stage};
use pollster::block_on;
use renderer::{Matrix, Renderer, SKY, camera, pass, sun};

const SIZE: [u32; 2] = [1280, 720];
const MAP: u32 = 1024;
const TOWARDS_SUN: [f32; 4] = [0.6, 0.8, 0.35, 0.0];

/// The uniform struct of the lit shader.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Frame {
    clip_from_world: [[f32; 4]; 4],
    light_clip_from_world: [[f32; 4]; 4],
    moment_depth: [f32; 4],
    light: [f32; 4],
    receiver_bias: ReceiverBias,
}

fn main() -> Result<(), Box<dyn Error>> {
    let out = std::env::args()
        .nth(1)
        .unwrap_or("pictures/forward_shading.png".to_owned());
    let yours = Renderer::open()?;
    let light_depth = yours.light_depth(MAP);

    // Once: the graph, from the light's depth to the filtered map.
    let graph: Graph = include_str!("forward_shading.json").parse()?;
    let imports = [("light_depth", (&light_depth).into())];
    let options = Default::default();
    let session = Session::new(&yours.adapter, &yours.device, graph, &imports, options);
    let mut session = block_on(session)?;

    // Once: your shader is linked with the modules that it imports.
    let source = Source {
        name: "forward_shading.wgsl",
        text: include_str!("forward_shading.wgsl"),
    };
    let shader = yours
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("forward shading"),
            source: wgpu::ShaderSource::Wgsl(link(source, &[])?.into_wgsl().into()),
        });
    let colour = wgpu::TextureFormat::Rgba8UnormSrgb;
    let compare = Some(wgpu::CompareFunction::Greater);
    let pipeline = yours.pipeline(&shader, ["draw", "lit"], &[colour], compare, 1);
    let sampler = yours.device.create_sampler(&wgpu::SamplerDescriptor {
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        anisotropy_clamp: 8,
        ..Default::default()
    });

    // Every frame: where camera and light are. The receiver bias follows from the graph's kernel.
    let towards = [0, 1, 2].map(|axis| f64::from(TOWARDS_SUN[axis]));
    let light = LightView::orthographic(sun(towards));
    let eye = CameraView {
        clip_from_world: camera([-5.5, 2.6, 6.0], [0.2, 1.2, -0.6], SIZE),
        far_depth: 0.0, // reversed depth
    };
    session.view(&yours.queue, 0, &eye, &[light])?;
    let single = |matrix: &Matrix| matrix.map(|column| column.map(|entry| entry as f32));
    let frame = yours.uniform(bytemuck::bytes_of(&Frame {
        clip_from_world: single(&eye.clip_from_world),
        light_clip_from_world: single(&light.clip_from_world),
        moment_depth: light.depth.moment_depth_row(&light.clip_from_world),
        light: TOWARDS_SUN,
        receiver_bias: session.receiver_bias("shadow_map", &light)?,
    }));

    // Every frame: the light's depth, our stage, your lit pass.
    let mut encoder = yours.device.create_command_encoder(&Default::default());
    yours.draw_light(&mut encoder, &light.clip_from_world, &light_depth);
    session.record(Stage::AfterShadowMaps, &mut encoder)?;
    let map = session
        .output(0, "shadow_map")
        .ok_or("the graph has no such output")?;
    let map = map.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    });
    let shadows = [
        wgpu::BindingResource::TextureView(&map),
        wgpu::BindingResource::Sampler(&sampler),
    ];
    let picture = yours.texture(SIZE, 1, colour);
    let depth = yours.texture(SIZE, 1, wgpu::TextureFormat::Depth32Float);
    let mut lit = pass(&mut encoder, &[(&picture, SKY)], Some((&depth, 0.0)));
    lit.set_pipeline(&pipeline);
    lit.set_bind_group(
        0,
        &yours.group(&pipeline, 0, &[frame.as_entire_binding()]),
        &[],
    );
    lit.set_bind_group(1, &yours.group(&pipeline, 1, &shadows), &[]);
    yours.draw_boxes(&mut lit);
    drop(lit);
    yours.save_texture(encoder, &picture, &out)
}
