//! A point light in your renderer: the six faces around it in one map, without a seam where they meet.
//!
//! `cargo run --release --example point_light [FOLDER]`. The small renderer in `examples/renderer` stands in for yours. A second
//! picture has maps of four times as many texels: filters are as wide in the scene. A third one is the truth, by a ray to the light from each
//! pixel.

mod renderer;

use std::error::Error;

use moment_shadows::{Atlas, PointLight, Tile};
use moment_shadows_graph::{CameraView, DepthRange, Graph, LightDepth, Session, Stage};
use pollster::block_on;
use renderer::{Renderer, camera};

const SIZE: [u32; 2] = [1280, 720];
const POSITION: [f32; 4] = [0.6, 1.9, 0.4, 1.0];

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).unwrap_or("pictures".to_owned());
    let yours = Renderer::open()?;
    draw(&yours, 512, &format!("{folder}/point_light.png"))?;
    draw(
        &yours,
        1024,
        &format!("{folder}/point_light_more_texels.png"),
    )?;
    let truth = format!("{folder}/point_light_truth.png");
    yours.save_traced(&eye().clip_from_world, POSITION, SIZE, &truth)
}

fn eye() -> CameraView {
    CameraView {
        clip_from_world: camera([-5.5, 2.6, 6.0], [0.2, 1.2, -0.6], SIZE),
        far_depth: 0.0, // reversed depth
    }
}

/// Draws with so many texels per face and side.
fn draw(yours: &Renderer, texels: u32, out: &str) -> Result<(), Box<dyn Error>> {
    let atlas = Atlas {
        size: [3 * texels, 2 * texels],
        layers: 1,
    };
    let light_depth = yours.texture(atlas.size, 4, wgpu::TextureFormat::Depth32Float);
    let picture = yours.picture(SIZE);

    // Once: the graph, for your device and your textures.
    let graph: Graph = include_str!("point_light.json").parse()?;
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

    // When the light moves: its faces, each with a place in the map.
    let (near, far) = (0.1, 20.0);
    let light = PointLight {
        position: [0, 1, 2].map(|axis| f64::from(POSITION[axis])),
        depth: LightDepth::Perspective {
            near,
            far,
            reversed: false,
            range: DepthRange { near, far: 12.0 },
        },
        tile: Tile {
            texels,
            filter_radius: 16.0,
        },
        // All boxes are farther away.
        nearest_caster: Some(1.0),
    };
    let mut faces = light.faces()?;
    atlas.place(&mut faces)?;

    // Every frame: where the camera is, and each stage after your own pass.
    let eye = eye();
    session.view(&yours.queue, 0, &eye, &faces)?;
    let mut encoder = yours.device.create_command_encoder(&Default::default());
    yours.draw_views(&mut encoder, &faces, &light_depth);
    session.record(Stage::AfterShadowMaps, &mut encoder)?;
    yours.draw_camera(&mut encoder, &eye.clip_from_world, POSITION, &picture);
    session.record(Stage::AfterMainPass, &mut encoder)?;
    let shadow = session
        .output(0, "shadow_intensity")
        .ok_or("the graph has no such output")?;
    yours.light(&mut encoder, &picture, shadow, None);
    yours.save(encoder, &picture, out)
}
