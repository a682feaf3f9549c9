//! Lookups in filterable maps, each against plain arithmetic in f64: magnified, minified, and at the edges of regions.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod device;
mod edges;
mod footprints;
mod gradients;
mod map;
mod planes;
mod variances;
