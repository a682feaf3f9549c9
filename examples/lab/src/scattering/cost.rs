//! What lighting the air costs.

use serde::Serialize;

use super::candidate::BoundCandidate;
use super::stage::ScatteringStage;
use crate::cost::CostError;
use crate::cost::clock::Clock;
use crate::cost::protocol::{Rounds, Subject};
use crate::cost::statistics::Distribution;

/// What a candidate costs.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ScatteringCost {
    /// Nanoseconds per pixel of all that is done per pixel.
    pub pixels: Distribution,
    /// Nanoseconds per texel of the light's map of all that is made of it. None where nothing is.
    pub map: Option<Distribution>,
    /// Both, as a ratio to the first candidate's, round by round.
    pub total_ratio: Distribution,
}

/// Times all candidates in the same rounds.
pub fn costs(
    clock: &Clock<'_>,
    stage: &ScatteringStage,
    candidates: &[(&str, BoundCandidate)],
    rounds: u32,
    progress: impl FnMut(),
) -> Result<Vec<ScatteringCost>, CostError> {
    let mut subjects = Vec::new();
    // Per candidate its numbers for the map, if it makes any, and the pixels.
    let mut numbers = Vec::new();
    for (name, bound) in candidates {
        let map = bound.makes_map().then_some(subjects.len());
        if map.is_some() {
            subjects.push(Subject {
                name: format!("{name} map"),
                record: Box::new(|encoder| Ok(bound.record_map(encoder)?)),
            });
        }
        numbers.push((map, subjects.len()));
        subjects.push(Subject {
            name: format!("{name} pixels"),
            record: Box::new(|encoder| Ok(bound.record_pixels(encoder)?)),
        });
    }
    let times = Rounds::run(clock, &subjects, rounds, progress)?;
    let per = |[width, height]: [u32; 2]| 1e9 / (f64::from(width) * f64::from(height));
    let desc = &stage.frame().desc;
    let all =
        |(map, pixels): (Option<usize>, usize)| Vec::from_iter(map.into_iter().chain([pixels]));
    let first = numbers
        .first()
        .map(|&numbers| all(numbers))
        .unwrap_or_default();
    Ok(numbers
        .iter()
        .map(|&(map, pixels)| ScatteringCost {
            pixels: times.seconds(&[pixels]).scaled(per(desc.picture)),
            map: map.map(|map| times.seconds(&[map]).scaled(per(desc.map))),
            total_ratio: times.ratio(&all((map, pixels)), &first),
        })
        .collect())
}
