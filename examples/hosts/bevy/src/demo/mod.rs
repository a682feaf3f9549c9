//! A scene to look at, with and without a window: what the examples and the tests of this folder draw.

mod headless;
mod scene;
mod world;

pub use headless::{Drawn, draw};
pub use world::{Fog, Look, add_to};
