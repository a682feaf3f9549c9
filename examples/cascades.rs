//! Cascades of a sun in your renderer: four views of one map, which blend into each other, with penumbrae of one width.
//!
//! `cargo run --release --example cascades [FOLDER]`. The small renderer in `examples/renderer` stands in for yours. A second picture
//! has maps of four times as many texels: filters are as wide in the scene. A third one is the truth, by a ray to the sun from each pixel.

mod renderer;

use std::error::Error;

use moment_shadows::{Atlas, CascadeSplits, Cascades, Tile};
use moment_shadows_graph::{CameraView, Graph, Session, Stage};
use pollster::block_on;
use renderer::{Renderer, camera};

const SIZE: [u32; 2] = [1280, 720];
const TOWARDS_SUN: [f32; 4] = [0.55, 0.8, 0.5, 0.0];

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).unwrap_or("pictures".to_owned());
    let yours = Renderer::open()?;
    draw(&yours, 512, &format!("{folder}/cascades.png"))?;
    draw(&yours, 1024, &format!("{folder}/cascades_more_texels.png"))?;
    let truth = format!("{folder}/cascades_truth.png");
    yours.save_traced(&eye().clip_from_world, TOWARDS_SUN, SIZE, &truth)
}

fn eye() -> CameraView {
    CameraView {
        clip_from_world: camera([-5.5, 2.6, 6.0], [0.2, 1.2, -0.6], SIZE),
        far_depth: 0.0, // reversed depth
    }
}

/// Draws with so many texels per cascade and side.
fn draw(yours: &Renderer, texels: u32, out: &str) -> Result<(), Box<dyn Error>> {
    let atlas = Atlas {
        size: [2 * texels; 2],
        layers: 1,
    };
    let light_depth = yours.texture(atlas.size, 4, wgpu::TextureFormat::Depth32Float);
    let picture = yours.picture(SIZE);

    // Once: the graph, for your device and your textures.
    let graph: Graph = include_str!("cascades.json").parse()?;
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

    // Every frame: cascades that follow the camera, each with a place in the map.
    let eye = eye();
    let towards = [0, 1, 2].map(|axis| f64::from(TOWARDS_SUN[axis]));
    let cascades = Cascades {
        direction: towards.map(|along| -along),
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
        tile: Tile {
            texels,
            filter_radius: 16.0,
        },
    };
    let mut views = cascades.views(&eye)?;
    atlas.place(&mut views)?;
    session.view(&yours.queue, 0, &eye, &views)?;

    // Every frame: each stage after your own pass.
    let mut encoder = yours.device.create_command_encoder(&Default::default());
    yours.draw_views(&mut encoder, &views, &light_depth);
    session.record(Stage::AfterShadowMaps, &mut encoder)?;
    yours.draw_camera(&mut encoder, &eye.clip_from_world, TOWARDS_SUN, &picture);
    session.record(Stage::AfterMainPass, &mut encoder)?;
    let shadow = session
        .output(0, "shadow_intensity")
        .ok_or("the graph has no such output")?;
    yours.light(&mut encoder, &picture, shadow, None);
    yours.save(encoder, &picture, out)
}
