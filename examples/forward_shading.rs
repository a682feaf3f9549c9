//! Forward shading: the graph ends with the filtered map, of four cascades, and the renderer's own lit shader samples it.
//!
//! `cargo run --release --example forward_shading [PICTURE]`. Runs on core WebGPU: half-precision storage. The small renderer
//! in `examples/renderer` stands in for yours; the lit shader is `examples/forward_shading.wgsl`.

mod renderer;

use std::error::Error;

use moment_shadows::{
    Atlas, Border, CascadeSplits, Cascades, MapRegion, ReceiverBias, Source, Tile, link,
};
use moment_shadows_graph::{CameraView, Graph, GraphError, LightView, Session, Stage};
use pollster::block_on;
use renderer::{Matrix, Renderer, SKY, camera, pass};

const SIZE: [u32; 2] = [1280, 720];
/// The map: four cascades of 512 texels.
const ATLAS: Atlas = Atlas {
    size: [1024; 2],
    layers: 1,
};
const TOWARDS_SUN: [f32; 4] = [0.6, 0.8, 0.35, 0.0];

/// The uniform struct of the lit shader.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Frame {
    clip_from_world: [[f32; 4]; 4],
    light: [f32; 4],
    cascades: [Cascade; 4],
}

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Cascade {
    light_clip_from_world: [[f32; 4]; 4],
    moment_depth: [f32; 4],
    receiver_bias: ReceiverBias,
    region: MapRegion,
    guard: f32,
    border: f32,
    fades: u32,
    padding: u32,
}

fn single(matrix: &Matrix) -> [[f32; 4]; 4] {
    matrix.map(|column| column.map(|entry| entry as f32))
}

/// The cascades of a camera, each with a place in the map.
fn cascades(eye: &CameraView) -> Result<Vec<LightView>, Box<dyn Error>> {
    let cascades = Cascades {
        direction: [0, 1, 2].map(|axis| -f64::from(TOWARDS_SUN[axis])),
        splits: CascadeSplits::Blend {
            count: 4,
            logarithmic: 0.7,
        },
        near: 1.0,
        far: 16.0,
        overlap: 0.1,
        blend: 0.1,
        casters: Some([[-8.0, -0.5, -8.0], [8.0, 6.0, 8.0]]),
        pancaking: false,
        reversed: false,
        // The blur's radius of 4 texels, up to mip level 2.
        tile: Tile {
            texels: 512,
            filter_radius: 16.0,
        },
    };
    let mut views = cascades.views(eye)?;
    ATLAS.place(&mut views)?;
    Ok(views)
}

/// What the lit shader is told of one. The receiver bias follows from the graph's kernel.
fn cascade(session: &Session, view: &LightView) -> Result<Cascade, GraphError> {
    Ok(Cascade {
        light_clip_from_world: single(&view.clip_from_world),
        moment_depth: view.depth.moment_depth_row(&view.clip_from_world),
        receiver_bias: session.receiver_bias("shadow_map", view)?,
        region: view.region,
        guard: view.guard as f32,
        border: view.border.width() as f32,
        fades: u32::from(matches!(view.border, Border::Fade(_))),
        padding: 0,
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let out = std::env::args()
        .nth(1)
        .unwrap_or("pictures/forward_shading.png".to_owned());
    let yours = Renderer::open()?;
    let light_depth = yours.light_depth(ATLAS.size[0]);

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

    // Every frame: where the camera and the cascades are.
    let eye = CameraView {
        clip_from_world: camera([-5.5, 2.6, 6.0], [0.2, 1.2, -0.6], SIZE),
        far_depth: 0.0, // reversed depth
    };
    let views = cascades(&eye)?;
    session.view(&yours.queue, 0, &eye, &views)?;
    let mut frame = Frame {
        clip_from_world: single(&eye.clip_from_world),
        light: TOWARDS_SUN,
        cascades: bytemuck::Zeroable::zeroed(),
    };
    for (place, view) in frame.cascades.iter_mut().zip(&views) {
        *place = cascade(&session, view)?;
    }
    let frame = yours.uniform(bytemuck::bytes_of(&frame));

    // Every frame: the light's depth, our stage, your lit pass.
    let mut encoder = yours.device.create_command_encoder(&Default::default());
    yours.draw_views(&mut encoder, &views, &light_depth);
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
