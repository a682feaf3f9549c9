//! Shafts of light in your renderer: a sun in thin fog, for two texture fetches per pixel.
//!
//! `cargo run --release --example volumetric_scattering [FOLDER]`. The small renderer in `examples/renderer` stands in for
//! yours. The shadow map serves twice, for surfaces and for the air in front of them.

mod renderer;

use std::error::Error;

use moment_shadows_graph::{CameraView, Graph, LightView, Session, SingleScattering, Stage};
use pollster::block_on;
use renderer::{Renderer, camera, sun};

const SIZE: [u32; 2] = [1280, 720];
const TOWARDS_SUN: [f32; 4] = [0.45, 0.8, -0.5, 0.0];

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).unwrap_or("pictures".to_owned());
    let yours = Renderer::open()?;
    let light_depth = yours.light_depth(1024);
    let picture = yours.picture(SIZE);

    let graph: Graph = include_str!("volumetric_scattering.json").parse()?;
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

    // Fog that takes a 25th of the light per unit, a little more of blue; up to 30 units from the camera it is lit.
    let extinction = [0.036, 0.04, 0.044];
    let scattering = extinction.map(|extinction| 0.9 * extinction);
    session.medium = (
        SingleScattering::new(extinction, scattering, 0.4, [14.0, 13.0, 11.0])?,
        30.0,
    );

    let towards = [0, 1, 2].map(|axis| f64::from(TOWARDS_SUN[axis]));
    let light = LightView::orthographic(sun(towards));
    let eyes = [[-5.5, 1.6, 4.5], [0.0, 1.2, 5.5], [4.5, 1.0, 1.0]];
    for (number, eye) in eyes.into_iter().enumerate() {
        let eye = CameraView {
            clip_from_world: camera(eye, [0.0, 1.5, -1.2], SIZE),
            far_depth: 0.0, // reversed depth
        };
        session.view(&yours.queue, 0, &eye, &[light])?;
        let mut encoder = yours.device.create_command_encoder(&Default::default());
        yours.draw_light(&mut encoder, &light.clip_from_world, &light_depth);
        session.record(Stage::AfterShadowMaps, &mut encoder)?;
        yours.draw_camera(&mut encoder, &eye.clip_from_world, TOWARDS_SUN, &picture);
        session.record(Stage::AfterMainPass, &mut encoder)?;

        // Your lighting adds the radiance to what the transmittance, in its alpha, leaves of a surface.
        let missing = "the graph has no such output";
        let shadow = session.output(0, "shadow_intensity").ok_or(missing)?;
        let air = session.output(0, "scattering").ok_or(missing)?;
        yours.light(&mut encoder, &picture, shadow, Some(air));
        yours.save(
            encoder,
            &picture,
            &format!("{folder}/volumetric_scattering_{number}.png"),
        )?;
    }
    Ok(())
}
