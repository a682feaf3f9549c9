//! Translucent casters in maps of every storage, against the exact transmittance of each ray.

mod casters;
mod cost;
mod draw;
mod host_pass;
mod report;
mod scene;
mod stage;
mod triangles;

pub use casters::{Caster, Texture, plume, stack};
pub use cost::{CostReport, CostRow, costs};
pub use host_pass::{begin, blending};
pub use report::{PlumeRow, StackRow, TransmittanceReport, picture, plumes, stacks};
pub use scene::{SceneRow, SceneTransmittance};
pub use stage::{Surfaces, TranslucentStage};
