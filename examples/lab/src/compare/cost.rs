//! What candidates cost per pixel.

use moment_shadows_graph::Stage;
use serde::Serialize;

use super::Technique;
use crate::cost::clock::Clock;
use crate::cost::protocol::{Rounds, Subject};
use crate::cost::statistics::Distribution;
use crate::error::LabError;
use crate::frame::FrameDesc;

/// What a candidate costs.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Cost {
    /// Nanoseconds per pixel of all that is done per pixel.
    pub pixels: Distribution,
    /// The time per pixel as a ratio to the first candidate's, round by round.
    pub pixels_ratio: Distribution,
    /// Nanoseconds of all that is made of the light's map, per texel. None where nothing is.
    pub map: Option<Distribution>,
    /// Time per pixel and time for the map together, as a ratio to the first candidate's.
    pub total_ratio: Distribution,
}

/// Times all candidates in the same rounds.
pub(super) fn costs(
    clock: &Clock<'_>,
    drawn: &FrameDesc,
    bound: &[(String, Box<dyn Technique>)],
    rounds: u32,
    progress: impl FnMut(),
) -> Result<Vec<Cost>, LabError> {
    let mut subjects = Vec::new();
    // Per candidate the numbers of what it does to the map, if anything, and to pixels.
    let mut numbers = Vec::new();
    for (name, technique) in bound {
        numbers.push(Stage::ALL.map(|stage| {
            let number = technique.works_in(stage).then_some(subjects.len());
            if number.is_some() {
                subjects.push(Subject {
                    name: format!("{name} {stage:?}"),
                    record: Box::new(move |encoder| technique.record(stage, encoder)),
                });
            }
            Vec::from_iter(number)
        }));
    }
    let times = Rounds::run(clock, &subjects, rounds, progress)?;
    let [per_pixel, per_texel] = [drawn.picture, drawn.map]
        .map(|[width, height]| 1e9 / (f64::from(width) * f64::from(height)));
    let first = numbers.first().cloned().unwrap_or_default();
    let costs = numbers.iter().map(|both| {
        let [map, pixels] = both;
        Cost {
            pixels: times.seconds(pixels).scaled(per_pixel),
            pixels_ratio: times.ratio(pixels, &first[1]),
            map: (!map.is_empty()).then(|| times.seconds(map).scaled(per_texel)),
            total_ratio: times.ratio(&both.concat(), &first.concat()),
        }
    });
    Ok(costs.collect())
}
