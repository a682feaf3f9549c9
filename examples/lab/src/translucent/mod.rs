//! Translucent casters in maps of every storage, against the exact transmittance of each ray.

mod casters;
mod draw;
mod report;
mod stage;

pub use casters::{Caster, Texture, plume, stack};
pub use report::{PlumeRow, StackRow, TransmittanceReport, picture, plumes, stacks};
pub use stage::{Surfaces, TranslucentStage};
