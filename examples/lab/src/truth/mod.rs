//! Ground truths: what a filtered shadow should have been, from the unfiltered map, in f64 on the processor.

pub mod area_light;
mod error;
pub mod exact_bound;
pub mod fragment;
pub mod kernel;
mod opacity;
pub mod pcf;
pub mod peel;
pub mod surface;

pub use error::TruthError;
pub(crate) use error::check_length;
