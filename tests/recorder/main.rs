//! Plans recorded on the adapter: the life cycle, nodes of a host's own, layers, views, errors and numbers.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod adapter;
mod camera_samples;
mod contact_rays;
mod contact_shadows;
mod debug;
mod depth_map;
mod depth_tests;
mod errors;
mod fit_cascades;
mod fit_range;
mod fit_seen;
mod fitted_shading;
#[allow(dead_code, reason = "shared with the tests of the compiler")]
#[path = "../support/host_node.rs"]
mod host_node;
mod host_nodes;
mod host_passes;
mod host_targets;
mod layers;
mod leak_reduction;
mod life_cycle;
mod lights_and_layers;
mod lost;
mod minified;
mod place_layers;
mod receiver_bias;
mod receiver_plane;
mod recording;
mod regions;
mod resolve;
mod resolved_blur;
mod setup;
mod shade;
mod shade_regions;
mod six_moments;
mod six_moments_minified;
mod techniques;
mod threshold;
mod threshold_node;
mod timestamps;
mod translucent;
mod views;
