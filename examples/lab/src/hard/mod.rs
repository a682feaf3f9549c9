//! Hard shadows from end to end: filterable maps against comparisons with the plain depth map, in error, time and bytes.

mod candidate;
mod report;
mod stage;

pub use candidate::{HardCandidate, candidates};
pub use report::HardErrors;
pub use stage::HardStage;
