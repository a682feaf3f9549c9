//! What a host gives: its open pass, a map without casters, lights that are refused.

use crate::cameras::{Lens, looking, pair};
use crate::pictures::{
    FAR, MAP, PICTURE, Sun, camera, camera_view, directions, graph, medium, picture, truth,
};
use crate::stage::{draw_over, gpu, sky, upload};
use bytemuck::bytes_of;
use glam::DVec3;
use moment_shadows::{
    LightDepth, LightView, MapEncoding, ScatteringParameters, Storage, Technique,
};

#[test]
fn a_hosts_open_pass_is_dimmed_and_lit() {
    let gpu = gpu();
    let sun = Sun::new(DVec3::new(0.5, -1.0, 0.3));
    let moments = sun.moments();
    let pair = camera(DVec3::new(1.0, 0.2, 0.1));
    let graph = graph("\"hamburger6\"", "float16");
    let behind = [0.5, 0.25, 0.125, 0.75];
    for density in [0.0, 1.0] {
        let medium = medium(density);
        let apart = picture(&gpu, &pair, &sun, medium, &moments, &graph);
        let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float32).unwrap();
        let map = upload(&gpu, &encoding, [MAP; 2], &moments);
        let parameters =
            ScatteringParameters::new(&camera_view(&pair), FAR, &sun.view(), medium).unwrap();
        let blended = draw_over(
            &gpu,
            &graph,
            &[("map", &map), ("camera_depth", &sky(&gpu, PICTURE))],
            &[
                ("rectify", bytes_of(&parameters.rectify)),
                ("integrate", bytes_of(&parameters.integrate)),
                ("composite", bytes_of(&parameters.composite)),
            ],
            PICTURE,
            wgpu::Color {
                r: behind[0],
                g: behind[1],
                b: behind[2],
                a: behind[3],
            },
        );
        for (pixel, apart) in blended.chunks_exact(8).zip(&apart) {
            let found = [0, 1, 2, 3].map(|channel: usize| {
                half::f16::from_le_bytes([pixel[2 * channel], pixel[2 * channel + 1]]).to_f64()
            });
            for colour in 0..3 {
                let expected = behind[colour] * f64::from(apart[3]) + f64::from(apart[colour]);
                // A float16 near 1; to the bit where there is no medium.
                let tolerance = if density == 0.0 { 0.0 } else { 1e-3 };
                assert!(
                    (found[colour] - expected).abs() <= tolerance,
                    "{found:?} {apart:?}"
                );
            }
            assert_eq!(found[3], behind[3]);
        }
    }
}

#[test]
fn a_map_without_casters_and_a_camera_outside_of_it_are_lit() {
    let gpu = gpu();
    // The light's range ends within the frustum; what has no caster is lit beyond, too.
    let sun = Sun::ending(DVec3::new(0.5, -1.0, 0.3), 5.0);
    let medium = medium(1.0);
    let empty = vec![[1.0; 4]; (MAP * MAP) as usize];
    let dark = vec![[-1.0, 1.0, -1.0, 1.0]; (MAP * MAP) as usize];
    for (name, forward) in directions(&sun) {
        for (eye, moments) in [(DVec3::ZERO, &empty), (DVec3::new(500.0, 0.0, 0.0), &dark)] {
            let lens = Lens {
                field_of_view: 1.1,
                aspect: 1.5,
                near: 0.1,
                far: None,
            };
            let pair = pair(eye, looking(forward, 0.2), lens, FAR, DVec3::NEG_Y);
            let graph = graph("\"hamburger6\"", "float32");
            let found = picture(&gpu, &pair, &sun, medium, moments, &graph);
            let truth = truth(&pair, &sun, &medium);
            for (found, truth) in found.iter().zip(&truth) {
                for colour in 0..3 {
                    // The bounds of moments at the far end alone; upper ones near it spread by the bias.
                    let ratio = f64::from(found[colour]) / truth[1][colour];
                    assert!((0.9..=1.01).contains(&ratio), "{name}, {eye}: {ratio}");
                }
            }
        }
    }
}

#[test]
fn point_lights_and_broken_lights_are_refused() {
    let sun = Sun::new(DVec3::NEG_Y);
    let pair = camera(DVec3::X);
    let of = |light: &LightView| {
        ScatteringParameters::new(&camera_view(&pair), FAR, light, medium(1.0))
            .unwrap_err()
            .to_string()
    };
    let perspective = "the light is a point or spot light";
    let singular = "the light's clip_from_world is singular";
    let mut light = sun.view();
    light.clip_from_world = pair.clip_from_world;
    assert!(of(&light).starts_with(perspective));
    light.clip_from_world = [[0.0; 4]; 4];
    assert!(of(&light).starts_with(singular));
    light.clip_from_world = [[f64::NAN; 4]; 4];
    let found = of(&light);
    assert!(
        found.starts_with(perspective) || found.starts_with(singular),
        "{found}"
    );
    light = sun.view();
    light.depth = LightDepth::Perspective {
        near: 0.1,
        far: 10.0,
        reversed: true,
        range: moment_shadows::DepthRange {
            near: 0.1,
            far: 10.0,
        },
    };
    assert!(of(&light).starts_with(perspective));
}
