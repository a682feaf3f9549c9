//! Whether what some views say holds for others: intervals and choices of every other view, tried on the rest.

use core::fmt;

use serde::{Deserialize, Serialize};

use super::interval::prediction;
use super::results::{Row, SceneResults, mean};

/// How well every other view of a scene foretells the rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeldOut {
    /// The share of errors of the rest that lie in the intervals for nine of ten.
    pub covered: f64,
    /// By how much more, in the mean over all bounds of time, the choice errs on the rest than the best choice there: 0.1 is a tenth.
    pub regret: f64,
}

impl HeldOut {
    /// Of a scene's rows with one softness; `None` with fewer than four views, half of which can tell nothing.
    #[must_use]
    pub fn of(scene: &SceneResults, radius: u32) -> Option<Self> {
        let rows: Vec<&Row> = scene
            .rows
            .iter()
            .filter(|row| row.cell.radius == radius)
            .collect();
        let errors = |row: &Row, parity: usize| -> Vec<f64> {
            let pictures = row.views.iter().skip(parity).step_by(2);
            pictures
                .filter_map(|view| Some(view.picture?.error))
                .collect()
        };
        let (mut covered, mut all) = (0, 0);
        for row in &rows {
            let [low, high] = prediction(&errors(row, 0))?;
            let others = errors(row, 1);
            all += others.len();
            covered += others
                .iter()
                .filter(|error| (low..=high).contains(*error))
                .count();
        }
        let mean_of = |row: &Row, parity: usize| mean(errors(row, parity).into_iter());
        let mut regrets = Vec::new();
        for bound in rows.iter().map(|row| row.time.total.median) {
            let within = || rows.iter().filter(|row| row.time.total.median <= bound);
            let least = |parity: usize| {
                within().min_by(|one, other| {
                    let [one, other] = [one, other].map(|row| mean_of(row, parity).unwrap_or(1.0));
                    one.total_cmp(&other)
                })
            };
            let chosen = mean_of(least(0)?, 1)?;
            let best = mean_of(least(1)?, 1)?;
            regrets.push(chosen / best - 1.0);
        }
        (all > 0).then_some(Self {
            covered: covered as f64 / all as f64,
            regret: mean(regrets.into_iter())?,
        })
    }
}

impl fmt::Display for HeldOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "What every other view says holds for the rest: {:.0} % of their errors lie in the intervals for 90 %, and the choice within a \
             time errs {:.1} % more than the best there.",
            100.0 * self.covered,
            100.0 * self.regret
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::statistics::Distribution;
    use crate::trade::axes::Cell;
    use crate::trade::results::{Errors, Figures, Time};
    use moment_shadows::Technique;

    fn row(candidate: usize, time: f64, errors: &[f64]) -> Row {
        let once = Distribution::of([time]);
        let views = errors.iter().zip(0..).map(|(&error, view)| Errors {
            view,
            picture: Some(Figures {
                error,
                leaking: error,
                too_dark: 0.0,
                percentile_95: error,
            }),
            penumbra: None,
            surfaces: None,
            facing_surfaces: None,
            nan: 0,
            flip: None,
        });
        Row {
            cell: Cell {
                map: 64,
                samples: 1,
                radius: 4,
                candidate,
            },
            name: String::new(),
            technique: Technique::Vsm,
            storage: None,
            bits_per_texel: 32,
            bytes_resident: 1,
            bytes_moved: 1,
            time: Time {
                map: once,
                pixels: once,
                total: once,
            },
            isa: None,
            views: views.collect(),
        }
    }

    #[test]
    fn a_choice_that_the_rest_does_not_bear_out_is_regretted() {
        let scene = |rows| SceneResults {
            scene: String::new(),
            triangles: 1,
            probes: Vec::new(),
            rows,
        };
        // The slower one seems better by the first, third and fifth view, and is half as bad again on the others.
        let rows = vec![
            row(0, 1.0, &[0.011, 0.010, 0.012, 0.011, 0.010, 0.010]),
            row(1, 2.0, &[0.009, 0.015, 0.010, 0.0165, 0.0095, 0.015]),
        ];
        let found = HeldOut::of(&scene(rows), 4);
        let found = found.unwrap_or(HeldOut {
            covered: 0.0,
            regret: 0.0,
        });
        // At the first bound there is no choice.
        assert!((found.regret - 0.25).abs() < 1e-9, "{found:?}");
        assert_eq!(found.covered, 0.5, "{found:?}");
        assert_eq!(HeldOut::of(&scene(vec![row(0, 1.0, &[0.1, 0.2])]), 4), None);
    }
}
