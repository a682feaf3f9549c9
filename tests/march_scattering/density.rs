//! A host's own density: the same as the fog's where it says the same, and none where it is none.

use crate::pictures::{error, march};
use crate::scene::{Lamp, Scene};
use crate::stage::gpu;
use moment_shadows::HeightFog;

/// The properties of a node with a density whose value is an expression.
fn with(expression: &str) -> String {
    format!(
        r#""steps": 64, "dithered": false, "density": "fn density(position: vec3f, own: vec4f) -> f32 {{ return {expression}; }}""#
    )
}

#[test]
fn a_host_that_says_what_the_fog_says_gets_the_same_picture() {
    let gpu = gpu();
    for lamp in [Lamp::Sun, Lamp::Spot] {
        let mut scene = Scene::new(lamp);
        let truth = scene.truth(20, crate::pictures::WALL);
        let of_fog = error(&march(&with("1.0")).picture(&gpu, &scene, 20), &truth);
        scene.air.own = [scene.air.fog.falloff as f32, 0.0, 0.0, 0.0];
        scene.air.fog = HeightFog::NONE;
        let found = march(&with("exp(-own.x * position.y)")).picture(&gpu, &scene, 20);
        let of_host = error(&found, &truth);
        println!("{lamp:?}: {of_fog} and {of_host}");
        // The way from the light to the air has the fog alone.
        let most = if lamp == Lamp::Sun { 0.002 } else { 0.2 };
        assert!(
            (of_host - of_fog).abs() < most,
            "{lamp:?}: {of_fog} {of_host}"
        );
        for (pixel, (.., transmittance)) in found.iter().zip(&truth) {
            let difference = f64::from(pixel[3]) - transmittance;
            // Of the midpoint rule, over steps that are long where the lamp is far.
            let most = if lamp == Lamp::Sun { 1e-4 } else { 0.02 };
            assert!(difference.abs() < most, "{lamp:?}: {difference}");
        }
    }
}

#[test]
fn a_density_that_is_none_is_no_fog_to_the_bit() {
    let gpu = gpu();
    let mut scene = Scene::new(Lamp::Spot);
    scene.air.own = [f32::NAN, f32::INFINITY, -1.0, 0.0];
    for density in [
        "own.x",
        "own.y",
        "own.z",
        "own.w",
        "-own.w",
        "own.x * position.y",
    ] {
        for pixel in march(&with(density)).picture(&gpu, &scene, 20) {
            assert_eq!(
                pixel.map(f32::to_bits),
                [0.0_f32, 0.0, 0.0, 1.0].map(f32::to_bits),
                "{density}"
            );
        }
    }
}
