//! What passes cost: time as a ratio to a copy of the same format in the same round, and bytes.
//!
//! A ratio to a copy says more than milliseconds: it carries over between machines of a kind, and it survives a machine
//! that does other work. Every round times the copies and all subjects in turn; the median of the ratios is reported with
//! their spread, and only after the output has been found right.

pub mod bandwidth;
pub mod blur;
pub mod clock;
pub mod copies;
pub mod graph_cost;
pub mod harness;
mod opened;
pub mod passes;
pub mod protocol;
pub mod reference;
pub mod report;
pub mod scattering;
mod shading;
pub mod statistics;
pub mod summed_area;
pub mod table;
pub mod texels;

use self::harness::Case;
use crate::error::LabError;
use crate::gpu::Gpu;

/// A list of subjects: cases per size of a map.
pub struct SubjectList {
    /// What is measured.
    pub title: &'static str,
    /// Texels per side that are measured in turn; none where only the size that was asked for is.
    pub sizes: &'static [u32],
    /// Makes the subjects for a size, runs each once, and compares what it gives with its reference.
    pub cases: fn(&Gpu, u32) -> Result<Vec<Case>, LabError>,
}
