//! Ground truths: what a filtered shadow should have been, from the unfiltered map, in f64 on the processor.

pub mod area_light;
pub mod exact_bound;
pub mod fragment;
pub mod kernel;
pub mod lookup;
mod opacity;
pub mod pcf;
pub mod peel;
pub mod surface;

use crate::error::LabError;

/// Refuses a list that has not one entry for each pixel or sample.
pub(crate) fn check_length(what: &str, found: usize, expected: usize) -> Result<(), LabError> {
    if found == expected {
        return Ok(());
    }
    Err(LabError::refused(format!(
        "{what} has {found} entries where its size asks for {expected}"
    )))
}

/// Refuses a map without a texel to look up.
fn check_map([width, height]: [u32; 2]) -> Result<(), LabError> {
    if width > 0 && height > 0 {
        return Ok(());
    }
    Err(LabError::refused(format!(
        "a map of {width}x{height} texels is empty; give it at least one texel each way"
    )))
}
