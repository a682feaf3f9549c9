//! Pictures of the marching node against rays of 1,024 steps, for every light and both kinds of map.

use glam::{DMat4, DVec3};
use moment_shadows_lab::gpu::Gpu;

use crate::scene::{Lamp, PICTURE, Scene};
use crate::stage::{capabilities, gpu, run};

/// What a marching node is told, and what reads it.
pub(crate) struct March<'a> {
    pub(crate) slot: &'a str,
    pub(crate) properties: &'a str,
    pub(crate) upsampled: bool,
}

pub(crate) fn march<'a>(properties: &'a str) -> March<'a> {
    March {
        slot: "map",
        properties,
        upsampled: false,
    }
}

impl March<'_> {
    fn graph(&self, views: usize) -> String {
        let (slot, properties) = (self.slot, self.properties);
        let (node, edges, output) = if self.upsampled {
            let node = r#", { "name": "upsample", "type": "upsample_scattering" }"#;
            let edges = r#", { "from": "march.scattering", "to": "upsample.scattering" }, { "from": "camera_depth", "to": "upsample.camera_depth" }"#;
            (node, edges, "upsample.upsampled")
        } else {
            ("", "", "march.scattering")
        };
        format!(
            r#"{{ "version": 2,
  "imports": [{{ "name": "map" }}, {{ "name": "camera_depth" }}],
  "nodes": [{{ "name": "march", "type": "march_scattering", "properties": {{ "format": "rgba32float", "views": {views}, {properties} }} }}{node}],
  "edges": [{{ "from": "map", "to": "march.{slot}" }}, {{ "from": "camera_depth", "to": "march.camera_depth" }}{edges}],
  "outputs": [{{ "name": "scattering", "from": "{output}" }}] }}"#
        )
    }

    /// The picture of a scene with a wall in its left columns.
    pub(crate) fn picture(&self, gpu: &Gpu, scene: &Scene, columns: u32) -> Vec<[f32; 4]> {
        let map = match self.slot {
            "map" => scene.moments(gpu),
            _ => scene.depth_map(gpu),
        };
        let camera_depth = scene.camera_depth(gpu, columns, WALL);
        let (parameters, upsampling) = (scene.parameters(), scene.upsampling());
        let mut blocks = vec![("march", parameters.as_slice())];
        if self.upsampled {
            blocks.push(("upsample", bytemuck::bytes_of(&upsampling)));
        }
        let layers = run(
            gpu,
            &capabilities(gpu),
            &self.graph(scene.views.len()),
            &[("map", &map), ("camera_depth", &camera_depth)],
            &blocks,
            "scattering",
        );
        bytemuck::pod_collect_to_vec(&layers[0])
    }
}

/// How far away the wall is along the camera's axis.
pub(crate) const WALL: f64 = 4.0;

/// The mean absolute error over pixels and colours, as a part of the mean radiance without shadows.
pub(crate) fn error(found: &[[f32; 4]], truth: &[([f64; 3], [f64; 3], f64)]) -> f64 {
    assert_eq!(found.len(), truth.len());
    let (mut sum, mut scale) = (0.0, 0.0);
    for (found, (lit, all, _)) in found.iter().zip(truth) {
        for colour in 0..3 {
            sum += (f64::from(found[colour]) - lit[colour]).abs();
            scale += all[colour];
        }
    }
    sum / scale
}

#[test]
fn every_light_is_that_of_marched_rays_with_moments_and_with_the_plain_map() {
    let gpu = gpu();
    for lamp in [Lamp::Sun, Lamp::Point, Lamp::Spot] {
        let scene = Scene::new(lamp);
        let truth = scene.truth(20, WALL);
        let [lit, all] = [0, 1].map(|which| -> f64 {
            truth
                .iter()
                .map(|it| if which == 0 { it.0[1] } else { it.1[1] })
                .sum()
        });
        assert!(
            lit > 0.1 * all && lit < 0.9 * all,
            "{lamp:?}: {lit} of {all} is lit"
        );
        for (slot, technique) in [("map", "hamburger4"), ("depth", "binary")] {
            let errors = [8, 32, 128].map(|steps| {
                let properties = format!(r#""steps": {steps}, "technique": "{technique}""#);
                let march = March {
                    slot,
                    ..march(&properties)
                };
                let found = march.picture(&gpu, &scene, 20);
                for (pixel, (.., transmittance)) in found.iter().zip(&truth) {
                    let difference = f64::from(pixel[3]) - transmittance;
                    assert!(difference.abs() < 2e-6, "{lamp:?}: {difference}");
                }
                error(&found, &truth)
            });
            println!("{lamp:?} {technique}: {errors:?}");
            assert!(
                errors[1] < 0.5 * errors[0] && errors[2] < 0.6 * errors[1],
                "{lamp:?} {technique}: {errors:?}"
            );
            assert!(
                errors[0] < 0.1 && errors[2] < 0.015,
                "{lamp:?} {technique}: {errors:?}"
            );
        }
    }
}

#[test]
fn air_beyond_the_lights_range_is_lit() {
    let gpu = gpu();
    let mut scene = Scene::new(Lamp::Sun);
    // A fifth of the range ends above the roof, so that the map holds nothing.
    let sun = &mut scene.views[0];
    let clip = DMat4::from_cols_array_2d(&sun.clip_from_world);
    let fifth = DMat4::from_scale(DVec3::new(1.0, 1.0, 5.0)) * clip;
    sun.clip_from_world = fifth.to_cols_array_2d();
    let truth = scene.truth(20, WALL).into_iter();
    let truth: Vec<_> = truth.map(|(_, all, through)| (all, all, through)).collect();
    for (slot, technique) in [("map", "hamburger4"), ("depth", "binary")] {
        let properties = format!(r#""steps": 64, "technique": "{technique}""#);
        let march = March {
            slot,
            ..march(&properties)
        };
        let error = error(&march.picture(&gpu, &scene, 20), &truth);
        println!("{technique}: {error}");
        assert!(error < 0.01, "{technique}: {error}");
    }
}

#[test]
fn without_density_there_is_no_fog_to_the_bit() {
    let gpu = gpu();
    for lamp in [Lamp::Sun, Lamp::Point, Lamp::Spot] {
        let mut scene = Scene::new(lamp);
        scene.medium.extinction = [0.0; 3];
        scene.medium.scattering = [0.0; 3];
        for (properties, upsampled) in [
            (r#""steps": 4"#, false),
            (r#""steps": 4, "resolution": "half""#, true),
        ] {
            let march = March {
                upsampled,
                ..march(properties)
            };
            let found = march.picture(&gpu, &scene, 20);
            assert_eq!(found.len(), (PICTURE[0] * PICTURE[1]) as usize);
            for pixel in found {
                assert_eq!(
                    pixel.map(f32::to_bits),
                    [0.0_f32, 0.0, 0.0, 1.0].map(f32::to_bits),
                    "{lamp:?}"
                );
            }
        }
    }
}

#[test]
fn frames_differ_where_steps_are_dithered_and_nowhere_else() {
    let gpu = gpu();
    let mut scene = Scene::new(Lamp::Sun);
    for (dithered, properties) in [
        (true, r#""steps": 8"#),
        (false, r#""steps": 8, "dithered": false"#),
    ] {
        let frames = [0, 1, 0].map(|frame| {
            scene.air.frame = frame;
            march(properties).picture(&gpu, &scene, 0)
        });
        assert_eq!(frames[0], frames[2]);
        assert_eq!(frames[0] != frames[1], dithered);
    }
    // The mean of many frames has the error of as many steps.
    let truth = scene.truth(0, WALL);
    let mut sums = vec![[0.0_f32; 4]; truth.len()];
    let mut single = 0.0;
    const FRAMES: u32 = 8;
    for frame in 0..FRAMES {
        scene.air.frame = frame;
        let found = march(r#""steps": 8"#).picture(&gpu, &scene, 0);
        single += error(&found, &truth) / f64::from(FRAMES);
        for (sum, pixel) in sums.iter_mut().zip(&found) {
            for (sum, value) in sum.iter_mut().zip(pixel) {
                *sum += value / FRAMES as f32;
            }
        }
    }
    let together = error(&sums, &truth);
    println!("one frame {single}, eight {together}");
    assert!(together < 0.35 * single, "{together} {single}");
}
