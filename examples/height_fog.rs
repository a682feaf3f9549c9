//! Light of a spot in fog that thins with height: marched at half the resolution, with 24 lookups of the filtered map per ray.
//!
//! `cargo run --release --example height_fog [FOLDER]`. The small renderer in `examples/renderer` stands in for yours.

mod renderer;

use std::error::Error;

use moment_shadows::{PointLight, Tile};
use moment_shadows_graph::{
    CameraView, DepthRange, Graph, HeightFog, LightDepth, MarchedAir, Session, SingleScattering,
    SpotCone, Stage,
};
use pollster::block_on;
use renderer::{Renderer, camera};

const SIZE: [u32; 2] = [1280, 720];
const MAP: u32 = 1024;
const POSITION: [f64; 3] = [3.2, 4.6, -3.4];

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).unwrap_or("pictures".to_owned());
    let yours = Renderer::open()?;
    let light_depth = yours.light_depth(MAP);
    let picture = yours.picture(SIZE);

    let graph: Graph = include_str!("height_fog.json").parse()?;
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

    // On the ground fog takes a twentieth of the light per unit, and a third of that two and a half units higher. The irradiance is that
    // of a surface at distance 1 from the lamp.
    let extinction = [0.045, 0.05, 0.055];
    let scattering = extinction.map(|extinction| 0.9 * extinction);
    let medium = SingleScattering::new(extinction, scattering, 0.4, [1100.0, 1000.0, 850.0])?;
    session.medium = (medium, 30.0);
    let cone = SpotCone {
        inner: 0.9,
        outer: 1.2,
    };
    session.marched = MarchedAir {
        fog: HeightFog {
            falloff: 0.4,
            ..HeightFog::NONE
        },
        cone: Some(cone),
        ..MarchedAir::default()
    };

    let range = DepthRange {
        near: 0.5,
        far: 12.0,
    };
    let lamp = PointLight {
        position: POSITION,
        depth: LightDepth::Perspective {
            near: range.near,
            far: range.far,
            reversed: false,
            range,
        },
        tile: Tile {
            texels: MAP,
            filter_radius: 2.0,
        },
        nearest_caster: None,
    };
    let spot = lamp.spot([-0.6, -0.8, 0.55], cone.outer)?;
    let eye = CameraView {
        clip_from_world: camera([-5.0, 1.6, 5.0], [0.6, 1.6, -1.2], SIZE),
        far_depth: 0.0, // reversed depth
    };
    session.view(&yours.queue, 0, &eye, &[spot])?;
    let mut encoder = yours.device.create_command_encoder(&Default::default());
    yours.draw_views(&mut encoder, &[spot], &light_depth);
    session.record(Stage::AfterShadowMaps, &mut encoder)?;
    let [x, y, z] = POSITION.map(|component| component as f32);
    yours.draw_camera(&mut encoder, &eye.clip_from_world, [x, y, z, 1.0], &picture);
    session.record(Stage::AfterMainPass, &mut encoder)?;

    let missing = "the graph has no such output";
    let shadow = session.output(0, "shadow_intensity").ok_or(missing)?;
    let air = session.output(0, "scattering").ok_or(missing)?;
    yours.light(&mut encoder, &picture, shadow, Some(air));
    yours.save(encoder, &picture, &format!("{folder}/height_fog.png"))
}
