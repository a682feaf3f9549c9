//! Soft shadows of area lights, judged: candidates against the sampled light.

mod candidate;
mod light;
mod report;
mod stage;

pub use candidate::{NamedGraph, SoftCandidate, candidates};
pub use light::{LightSize, SoftLightChoice};
pub use report::SoftErrors;
pub use stage::{SoftPicture, SoftStage, StageDesc};
