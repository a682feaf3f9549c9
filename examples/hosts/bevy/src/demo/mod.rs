//! A scene to look at, with and without a window: what the command and the tests of this folder draw.

mod headless;
mod scene;
mod windowed;
mod world;

pub use headless::Stage;
pub use windowed::show;
pub use world::{Fog, Look, add_to, sun};
