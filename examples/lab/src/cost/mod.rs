//! What passes cost: time as a ratio to a copy of the same format in the same round, and bytes.
//!
//! A ratio to a copy says more than milliseconds: it carries over between machines of a kind, and it survives a machine
//! that does other work. Every round times the copies and all passes in turn; the median of the ratios is reported with
//! their spread, and only after the output has been found right.

pub mod bandwidth;
pub mod baseline;
pub mod blur;
pub mod clock;
mod copy_sets;
mod error;
pub mod graph_cost;
pub mod growth;
mod opened;
pub mod passes;
pub mod plot;
pub mod protocol;
pub mod reference;
pub mod report;
pub mod scattering;
mod shading;
pub mod statistics;
pub mod summed_area;
pub mod texels;

pub use error::CostError;
