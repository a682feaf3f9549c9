//! Area lights: the sampled truth against geometry, and percentage closer soft shadows against the truth.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod command;
mod errors;
mod truth;
mod widths;

use moment_shadows::Profile;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::light::{LightShape, LightView};
use moment_shadows_lab::scene::Scene;
use moment_shadows_lab::soft::{LightSize, SoftLightChoice};
use moment_shadows_lab::view::View;

/// A light of each kind, with a size that makes wide penumbrae in the scene of straight edges.
const LIGHTS: [(SoftLightChoice, [f64; 2]); 3] = [
    (SoftLightChoice::Directional, [8.0, 8.0]),
    (SoftLightChoice::Spot, [2.0, 2.0]),
    (SoftLightChoice::Rectangle, [0.7, 2.0]),
];

fn open() -> Gpu {
    Gpu::open(Profile::Native).unwrap()
}

/// The light of a scene's first viewpoint.
fn light(scene: &Scene, choice: SoftLightChoice, size: [f64; 2]) -> (LightView, LightShape) {
    let view = View::numbered(scene, 0);
    choice
        .light(scene, &view, [512; 2], 6.0, Some(LightSize(size)))
        .unwrap()
}
