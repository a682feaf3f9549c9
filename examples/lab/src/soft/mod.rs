//! Soft shadows of area lights, judged: candidates against the sampled light.

mod candidate;
mod cost;
mod light;
mod report;
mod stage;

pub use candidate::{NamedGraph, SoftCandidate, candidates};
pub use cost::{SoftCost, costs};
pub use light::{LightSize, SoftLightChoice};
pub(crate) use report::size;
pub use report::{SoftEdges, SoftReport, SoftRow};
pub use stage::{SoftPicture, SoftStage, StageDesc};
