//! Hard shadows of a sun in your renderer: its depth maps go in, a texture of shadow intensity comes out.
//!
//! `cargo run --release --example hard_shadows [PICTURE]`. The small renderer in `examples/renderer` stands in for yours.

mod renderer;

use std::error::Error;

use moment_shadows_graph::{CameraView, Graph, LightView, Session, Stage};
use pollster::block_on;
use renderer::{Renderer, camera, sun};

const SIZE: [u32; 2] = [1280, 720];
const TOWARDS_SUN: [f32; 4] = [0.55, 0.8, 0.5, 0.0];

fn main() -> Result<(), Box<dyn Error>> {
    let out = std::env::args()
        .nth(1)
        .unwrap_or("pictures/hard_shadows.png".to_owned());
    let yours = Renderer::open()?;
    let light_depth = yours.light_depth(1024);
    let picture = yours.picture(SIZE);

    // Once: the graph, for your device and your textures.
    let graph: Graph = include_str!("hard_shadows.json").parse()?;
    let mut session = block_on(Session::new(
        &yours.adapter,
        &yours.device,
        graph,
        &[
            ("light_depth", (&light_depth).into()),
            ("camera_depth", (&picture.depth).into()),
        ],
        Default::default(),
    ))?;

    // Every frame: where camera and light are.
    let towards = [0, 1, 2].map(|axis| f64::from(TOWARDS_SUN[axis]));
    let light = LightView::orthographic(sun(towards));
    let eye = CameraView {
        clip_from_world: camera([-5.5, 2.6, 6.0], [0.2, 1.2, -0.6], SIZE),
        far_depth: 0.0, // reversed depth
    };
    session.view(&yours.queue, 0, &eye, &[light])?;

    // Every frame: each stage after your own pass.
    let mut encoder = yours.device.create_command_encoder(&Default::default());
    yours.draw_light(&mut encoder, &light.clip_from_world, &light_depth);
    session.record(Stage::AfterShadowMaps, &mut encoder)?;
    yours.draw_camera(&mut encoder, &eye.clip_from_world, TOWARDS_SUN, &picture);
    session.record(Stage::AfterMainPass, &mut encoder)?;

    // Your lighting reads the shadow intensity: 0 in light, 1 in shadow.
    let shadow = session
        .output(0, "shadow_intensity")
        .ok_or("the graph has no such output")?;
    yours.light(&mut encoder, &picture, shadow, None);
    yours.save(encoder, &picture, &out)
}
