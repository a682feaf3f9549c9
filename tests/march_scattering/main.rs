//! Marched single scattering: its arithmetic against quadrature in double precision, and its nodes against marched rays.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod blue_noise;
mod cones;
mod declarations;
mod density;
mod hostile;
mod pictures;
mod quadrature;
mod rays;
mod resolutions;
mod scene;
mod thickness;

#[path = "../single_scattering/stage.rs"]
#[allow(dead_code, reason = "shared with the tests of prefiltered scattering")]
mod stage;
