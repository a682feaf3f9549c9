//! Whether what some views say holds for others: intervals and choices of every other view, tried on the rest.

use core::fmt;

use super::choose::{Bounds, Choice};
use super::interval::{LEAST, prediction, width};
use super::results::{Results, Row, SceneResults, mean};
use crate::cost::statistics::Distribution;
use crate::cost::table::Columns;

/// How well every other view of scenes foretells the rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeldOut {
    /// The share of errors of the rest that lie in the intervals for nine of ten.
    pub covered: f64,
    /// The median of the factors between the ends of these intervals.
    pub width: f64,
    /// By how much more the choice errs on the rest than the best choice there, in the mean over all bounds of bytes and of time: 0.1
    /// is a tenth. A bound of the error leads to one of these choices, since whatever takes less time was seen to err more.
    pub regret: f64,
}

/// What each interval and each choice came to.
#[derive(Default)]
struct Tally {
    /// Errors of views that were held out, and how many of them lie in the intervals.
    errors: [usize; 2],
    widths: Vec<f64>,
    regrets: Vec<f64>,
}

impl Tally {
    fn add(&mut self, scene: &SceneResults, radius: u32) {
        let [seen, rest] = [0, 1].map(|parity| half(scene, radius, parity));
        for (seen, rest) in seen.rows.iter().zip(&rest.rows) {
            let Some([low, high]) = prediction(&seen.errors()) else {
                continue;
            };
            let rest = rest.errors();
            let within = rest.iter().filter(|error| (low..=high).contains(*error));
            self.errors[1] += within.count();
            self.errors[0] += rest.len();
            self.widths.push(width([low, high]));
        }
        let error_there = |row: &Row| {
            let mut there = rest.rows.iter();
            there.find(|it| it.cell == row.cell).and_then(Row::error)
        };
        for bounds in seen.rows.iter().flat_map(bounds_of) {
            let choice = |half| Choice::of(half, radius, bounds).chosen();
            let errors = [&seen, &rest].map(|half| choice(half).and_then(error_there));
            if let [Some(chosen), Some(best)] = errors {
                let [chosen, best] = [chosen, best].map(|error| error.max(LEAST));
                self.regrets.push(chosen / best - 1.0);
            }
        }
    }

    /// `None` with fewer than three views, every other of which tells nothing.
    fn summed(self) -> Option<HeldOut> {
        let [errors, within] = self.errors;
        (errors > 0).then_some(HeldOut {
            covered: within as f64 / errors as f64,
            width: Distribution::of(self.widths).median,
            regret: mean(self.regrets.into_iter())?,
        })
    }
}

/// Every other view of a scene's rows with one softness, from the first or from the second on.
fn half(scene: &SceneResults, radius: u32, parity: usize) -> SceneResults {
    let rows = scene.rows.iter().filter(|row| row.cell.radius == radius);
    let of_half = |row: &Row| Row {
        views: row.views.iter().copied().skip(parity).step_by(2).collect(),
        ..row.clone()
    };
    SceneResults {
        rows: rows.map(of_half).collect(),
        ..scene.clone()
    }
}

/// The bounds of bytes and of time that a row just keeps to.
fn bounds_of(row: &Row) -> [Bounds; 2] {
    let bytes = Some(row.bytes_resident);
    let time = Some(row.time.total.median);
    let none = Bounds::default();
    [Bounds { bytes, ..none }, Bounds { time, ..none }]
}

impl HeldOut {
    /// Of some scenes' rows with one softness each; `None` where none has three views: one tells nothing of others.
    #[must_use]
    pub fn of(scenes: &[(&SceneResults, u32)]) -> Option<Self> {
        let mut tally = Tally::default();
        for (scene, radius) in scenes {
            tally.add(scene, *radius);
        }
        tally.summed()
    }
}

impl fmt::Display for HeldOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "What every other view says holds for the rest: {:.0} % of their errors lie in the intervals for 90 %, whose ends are a factor \
             of {:.1} apart, and the choice within a time or within bytes errs {:.1} % more than the best there.",
            100.0 * self.covered,
            self.width,
            100.0 * self.regret
        )
    }
}

/// A line for each scene and softness with three views or more, and one for all of them.
pub struct Table<'a>(pub &'a Results);

impl fmt::Display for Table<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let radii = &self.0.setting.axes.radii;
        let scenes = self.0.scenes.iter();
        let pairs: Vec<(&SceneResults, u32)> = scenes
            .flat_map(|scene| radii.iter().map(move |&radius| (scene, radius)))
            .collect();
        let line = |scene: &str, radius: String, found: HeldOut| {
            vec![
                ("scene", scene.to_owned()),
                ("radius", radius),
                ("covered %", format!("{:.0}", 100.0 * found.covered)),
                ("width", format!("{:.1}", found.width)),
                ("regret %", format!("{:.2}", 100.0 * found.regret)),
            ]
        };
        let of_one = |(scene, radius): &(&SceneResults, u32)| {
            let found = HeldOut::of(&[(*scene, *radius)])?;
            Some(line(&scene.scene, radius.to_string(), found))
        };
        let mut lines: Vec<_> = pairs.iter().filter_map(of_one).collect();
        if let Some(all) = HeldOut::of(&pairs).filter(|_| lines.len() > 1) {
            lines.push(line("all", "-".to_owned(), all));
        }
        write!(f, "{}", Columns(&lines))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::cost::statistics::Distribution;
    use crate::trade::axes::Cell;
    use crate::trade::results::{Errors, Figures, Time};
    use moment_shadows::Technique;

    pub(in crate::trade) fn row(candidate: usize, time: f64, errors: &[f64]) -> Row {
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
            bytes_resident: candidate as u64,
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

    pub(in crate::trade) fn scene(rows: Vec<Row>) -> SceneResults {
        SceneResults {
            scene: String::new(),
            triangles: 1,
            probes: Vec::new(),
            rows,
        }
    }

    fn found(rows: Vec<Row>) -> Option<HeldOut> {
        HeldOut::of(&[(&scene(rows), 4)])
    }

    #[test]
    fn a_choice_that_the_rest_does_not_bear_out_is_regretted() {
        // The larger and slower one seems better by the first, third and fifth view, and is half as bad again on the others.
        let found = found(vec![
            row(0, 1.0, &[0.011, 0.010, 0.012, 0.011, 0.010, 0.010]),
            row(1, 2.0, &[0.009, 0.015, 0.010, 0.0165, 0.0095, 0.015]),
        ]);
        // Within the smaller bounds there is no choice.
        assert!(
            found.is_some_and(|it| (it.regret - 0.25).abs() < 1e-9 && it.covered == 1.0),
            "{found:?}"
        );
    }

    #[test]
    fn errors_beyond_the_intervals_are_counted() {
        let found = found(vec![row(0, 1.0, &[0.01, 0.1, 0.01, 0.01, 0.01, 0.01])]);
        let width = prediction(&[0.01; 3]).map_or(0.0, width);
        assert!(
            found
                .is_some_and(|it| it.covered == 2.0 / 3.0 && it.regret == 0.0 && it.width == width),
            "{found:?}"
        );
        assert!((7.0..8.0).contains(&width), "{width}");
    }

    #[test]
    fn two_views_tell_nothing() {
        assert_eq!(found(vec![row(0, 1.0, &[0.1, 0.2])]), None);
    }

    #[test]
    fn all_scenes_are_summed_up() {
        let [one, other] =
            [0.01, 0.1].map(|error| scene(vec![row(0, 1.0, &[0.01, error, 0.01, error])]));
        let found = HeldOut::of(&[(&one, 4), (&other, 4), (&other, 5)]);
        assert!(found.is_some_and(|it| it.covered == 0.5), "{found:?}");
    }
}
