//! Pictures of shadows, from a light's depth to the shadow intensity on the screen.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod contact;
mod conventions;
mod depth_maps;
mod layers;
mod planes;
mod stage;
mod truths;
