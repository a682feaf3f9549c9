//! Marched single scattering, judged: every light in height fog, by the library's marching nodes with filtered maps and with plain ones.

mod bound;
mod candidate;
mod lamp;
mod record;
mod report;
mod stage;
mod truth;

pub use candidate::{MarchCandidate, march_candidates};
pub use lamp::Lamp;
pub use record::{WayRow, WaysRecord, ways_record};
pub use report::MarchErrors;
pub use stage::{MarchStage, MarchStageDesc};
