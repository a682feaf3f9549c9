//! What soft shadows cost per pixel.

use moment_shadows_graph::Stage;
use moment_shadows_graph::record::Recording;
use serde::Serialize;

use super::candidate::SoftCandidate;
use super::stage::SoftStage;
use crate::cost::CostError;
use crate::cost::clock::Clock;
use crate::cost::protocol::{Rounds, Subject};
use crate::cost::statistics::Distribution;
use crate::graph_frame::GraphFrame;

/// What a candidate costs.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct SoftCost {
    /// Nanoseconds per pixel of all that follows the camera's depth: shading.
    pub shading: Distribution,
    /// The same as a ratio to the first candidate's, round by round.
    pub shading_ratio: Distribution,
    /// Nanoseconds per pixel of what comes before: what is made of the map. None where a candidate reads the plain depth.
    pub preparation: Option<Distribution>,
    /// Both, as a ratio to the first candidate's.
    pub total_ratio: Distribution,
}

/// Times all candidates in the same rounds.
pub fn costs(
    clock: &Clock<'_>,
    stage: &SoftStage,
    candidates: &[SoftCandidate],
    rounds: u32,
    progress: impl FnMut(),
) -> Result<Vec<SoftCost>, CostError> {
    let gpu = clock.gpu();
    let mut graphs = Vec::new();
    for candidate in candidates {
        let graph = GraphFrame::new(gpu, stage.frame(&candidate.file), &candidate.file)?;
        // Everything that a stage reads has its contents before it is repeated alone.
        graph.run(gpu)?;
        graphs.push(graph);
    }
    let mut subjects = Vec::new();
    // Per candidate its numbers for preparation, if it has any, and shading.
    let mut numbers = Vec::new();
    for (candidate, graph) in candidates.iter().zip(&graphs) {
        let mut number = [None; 2];
        for (number, of) in number.iter_mut().zip(Stage::ALL) {
            if graph.plan.passes.iter().any(|pass| pass.stage == of) {
                *number = Some(subjects.len());
                subjects.push(Subject {
                    name: format!("{} {of:?}", candidate.name),
                    record: Box::new(move |encoder| {
                        Ok(graph.bindings.record(of, encoder, Recording::default())?)
                    }),
                });
            }
        }
        numbers.push(number);
    }
    let times = Rounds::run(clock, &subjects, rounds, progress)?;
    let [width, height] = stage.desc().picture;
    let per_pixel = 1e9 / (f64::from(width) * f64::from(height));
    let of = |number: Option<usize>| Vec::from_iter(number);
    let all = |[before, after]: [Option<usize>; 2]| [of(before), of(after)].concat();
    let first = numbers.first().copied().unwrap_or_default();
    Ok(numbers
        .iter()
        .map(|&number| SoftCost {
            shading: times.seconds(&of(number[1])).scaled(per_pixel),
            shading_ratio: times.ratio(&of(number[1]), &of(first[1])),
            preparation: number[0].map(|it| times.seconds(&[it]).scaled(per_pixel)),
            total_ratio: times.ratio(&all(number), &all(first)),
        })
        .collect())
}
