//! Soft shadows in your renderer: a sun and a lamp of some size, in constant time per pixel.
//!
//! `cargo run --release --example soft_shadows [FOLDER]`. The small renderer in `examples/renderer` stands in for yours.

mod renderer;

use std::error::Error;

use moment_shadows_graph::{CameraView, DepthRange, Graph, LightSize, LightView, Session, Stage};
use pollster::block_on;
use renderer::{Renderer, camera, lamp, sun};

const SIZE: [u32; 2] = [1280, 720];

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).unwrap_or("pictures".to_owned());
    let yours = Renderer::open()?;
    let light_depth = yours.light_depth(1024);
    let picture = yours.picture(SIZE);

    let graph: Graph = include_str!("soft_shadows.json").parse()?;
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
    let eye = CameraView {
        clip_from_world: camera([-5.5, 2.6, 6.0], [0.2, 1.2, -0.6], SIZE),
        far_depth: 0.0, // reversed depth
    };

    // A sun that appears as a disk of three degrees, and a lamp of half a unit's diameter. Blocker search, the widths of
    // filters and the receiver bias follow from their sizes.
    let sun = LightView {
        size: LightSize::AngularDiameter(3f64.to_radians()),
        ..LightView::orthographic(sun([0.55, 0.8, 0.5]))
    };
    let position = [1.5, 2.6, 4.5];
    let range = DepthRange {
        near: 1.0,
        far: 12.0,
    };
    let lamp = LightView {
        size: LightSize::Disk(0.5),
        ..LightView::perspective(
            lamp(position, range.near, range.far),
            range.near,
            range.far,
            range,
        )
    };
    let towards = [[0.55, 0.8, 0.5, 0.0], [1.5, 2.6, 4.5, 1.0]];
    for (name, light, towards) in [("directional", sun, towards[0]), ("spot", lamp, towards[1])] {
        session.view(&yours.queue, 0, &eye, &[light])?;
        let mut encoder = yours.device.create_command_encoder(&Default::default());
        yours.draw_light(&mut encoder, &light.clip_from_world, &light_depth);
        session.record(Stage::AfterShadowMaps, &mut encoder)?;
        yours.draw_camera(&mut encoder, &eye.clip_from_world, towards, &picture);
        session.record(Stage::AfterMainPass, &mut encoder)?;
        let shadow = session
            .output(0, "shadow_intensity")
            .ok_or("the graph has no such output")?;
        yours.light(&mut encoder, &picture, shadow, None);
        yours.save(
            encoder,
            &picture,
            &format!("{folder}/soft_shadows_{name}.png"),
        )?;
    }
    Ok(())
}
