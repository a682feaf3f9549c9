//! The reference host: lights, viewpoints, what is rendered, and pictures.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod drawing;
mod lights;
mod pictures;
