//! Glass and smoke that cast shadows: your pass blends them into the filtered map, between our nodes.
//!
//! `cargo run --release --example translucent [PICTURE]`. Ordinary alpha blending into a map of six moments, on any device; the other ways
//! are in `docs/translucent_casters/README.md`. The small renderer in `examples/renderer` stands in for yours.

mod renderer;
mod smoke;

use std::error::Error;

use moment_shadows::{DepthConversion, MapEncoding, Opacity, Source, link};
use moment_shadows_graph::record::HostPass;
use moment_shadows_graph::{CameraView, Graph, LightView, Session, Stage};
use pollster::block_on;
use renderer::{Matrix, Renderer, camera, sun};
use smoke::{Draw, sorted};

const SIZE: [u32; 2] = [1280, 720];
const TOWARDS_SUN: [f32; 4] = [0.55, 0.8, 0.5, 0.0];

/// The uniform struct of `translucent.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Frame {
    clip_from_world: [[f32; 4]; 4],
    light_clip_from_world: [[f32; 4]; 4],
    conversion: DepthConversion,
}

fn main() -> Result<(), Box<dyn Error>> {
    let out = std::env::args()
        .nth(1)
        .unwrap_or("pictures/translucent.png".to_owned());
    let yours = Renderer::open()?;
    let light_depth = yours.light_depth(1024);
    let picture = yours.picture(SIZE);

    // Once: the graph, for your device and your textures.
    let graph: Graph = include_str!("translucent.json").parse()?;
    let imports = [
        ("light_depth", (&light_depth).into()),
        ("camera_depth", (&picture.depth).into()),
    ];
    let options = Default::default();
    let session = Session::new(&yours.adapter, &yours.device, graph, &imports, options);
    let mut session = block_on(session)?;

    // Once: how casters are blended, which follows from the map.
    let map = session.output(0, "shadow_map");
    let map = map.ok_or("no such output")?.clone();
    let encoding = session.encoding("shadow_map").ok_or("no such map")?;
    let shader = shader(&yours, encoding)?;
    let blends = encoding.blend_states(Opacity::Alpha)?;

    // Every frame: where camera and light are.
    let towards = [0, 1, 2].map(|axis| f64::from(TOWARDS_SUN[axis]));
    let light = LightView::orthographic(sun(towards));
    let eye = CameraView {
        clip_from_world: camera([-5.5, 2.6, 6.0], [0.2, 1.2, -0.6], SIZE),
        far_depth: 0.0, // reversed depth
    };
    session.view(&yours.queue, 0, &eye, &[light])?;
    let frame = |matrix: &Matrix| -> Result<Frame, Box<dyn Error>> {
        let single = |matrix: &Matrix| matrix.map(|column| column.map(|entry| entry as f32));
        Ok(Frame {
            clip_from_world: single(matrix),
            light_clip_from_world: single(&light.clip_from_world),
            conversion: light.depth.conversion()?,
        })
    };
    let into_map = Draw::into_map(
        &yours,
        &shader,
        (&map, &blends[0]),
        &frame(&light.clip_from_world)?,
        &sorted(&light.clip_from_world, false),
        &light_depth,
    );
    let into_picture = Draw::into_picture(
        &yours,
        &shader,
        &picture,
        &frame(&eye.clip_from_world)?,
        &sorted(&eye.clip_from_world, true),
        &map,
    );

    // Every frame: each stage after your own pass. The first stage calls you where casters are to be blended into the map.
    let mut encoder = yours.device.create_command_encoder(&Default::default());
    yours.draw_light(&mut encoder, &light.clip_from_world, &light_depth);
    let mut draw = |pass: HostPass<'_>, encoder: &mut wgpu::CommandEncoder| {
        into_map.record(encoder, pass.targets, None);
    };
    session.record_with(Stage::AfterShadowMaps, &mut encoder, &mut draw)?;
    yours.draw_camera(&mut encoder, &eye.clip_from_world, TOWARDS_SUN, &picture);
    session.record(Stage::AfterMainPass, &mut encoder)?;

    // Your lighting reads the shadow intensity; then glass and smoke are seen, in the shadow of each other.
    let shadow = session
        .output(0, "shadow_intensity")
        .ok_or("the graph has no such output")?;
    yours.light(&mut encoder, &picture, shadow, None);
    into_picture.record(&mut encoder, &[picture.lit_view()], Some(&picture.depth));
    yours.save(encoder, &picture, &out)
}

/// Your shader, linked with the modules that it imports and with what it has to know of the map.
fn shader(yours: &Renderer, map: &MapEncoding) -> Result<wgpu::ShaderModule, Box<dyn Error>> {
    let (storage, blends) = (map.storage().wgsl_index(), map.blends());
    let constants = format!("const STORAGE = {storage}u;\nconst BLENDS = {blends}u;\n");
    let constants = Source {
        name: "map",
        text: &constants,
    };
    let text = include_str!("translucent.wgsl");
    let name = "translucent.wgsl";
    let linked = link(Source { name, text }, &[constants])?;
    let source = wgpu::ShaderSource::Wgsl(linked.into_wgsl().into());
    let label = Some("translucent");
    Ok(yours
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor { label, source }))
}
