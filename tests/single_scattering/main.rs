//! Prefiltered single scattering: its coordinates, its resampling, its sums and what a picture gets of them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod angle;
mod cameras;
mod declarations;
mod enclosed;
mod frame;
mod frame_errors;
mod hostile;
mod hosts;
mod light_maps;
mod lookups;
mod media;
mod medium;
mod mip_levels;
mod pictures;
mod stage;
mod sums;
mod two_diracs;
mod view_rays;
mod weights;
