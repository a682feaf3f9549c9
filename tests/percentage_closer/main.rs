//! The tests on the plain depth map: binary, percentage closer filtering and percentage closer soft shadows.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod brute_force;
mod depth;
#[path = "../recorder/depth_map.rs"]
#[allow(dead_code, reason = "the tests of the recorder use the rest")]
mod depth_map;
mod device;
mod disk_samples;
mod hardware;
mod hostile;
mod kernels;
mod lights;
mod poisson;
mod slopes;
mod soft;
mod truth;
