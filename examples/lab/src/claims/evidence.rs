//! What the instrument has measured, and which of its figures a claim is about.

use super::table::Claim;
use crate::compare::{Cost, Report, Row};
use crate::scattering::ScatteringErrors;
use crate::soft::SoftErrors;
use crate::sweep::{Axis, Swept, Times};
use crate::trade::Judged;
use crate::trade::results::{Errors, Figures};

/// Which figure of two techniques is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Figure {
    /// The mean absolute error of pictures, for each scene, view and filter.
    Picture,
    /// That over all surfaces.
    Surfaces,
    /// The part of that which is too light.
    Leaking,
    /// The mean absolute error of light in the air, for each scene and camera.
    Air,
    /// The time of light in the air, for a picture of `PICTURE` pixels.
    AirTime,
    /// The mean absolute error of soft shadows, for each scene.
    Soft,
    /// The time of soft shadows, for a picture of `PICTURE` pixels.
    SoftTime,
    /// The time of hard shadows in a sweep.
    Time(Place),
    /// The power of the filter's width that the time grows with, between neighbours in a sweep.
    Growth,
}

/// Where in a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Everywhere.
    All,
    /// The largest map.
    LargestMap,
    /// The largest picture.
    LargestPicture,
    /// The widest filter.
    WidestFilter,
}

/// The picture that times per pixel are told for, beside a map of [`MAP`].
pub(super) const PICTURE: [f64; 2] = [1920.0, 1080.0];

/// Texels per side of maps.
pub(super) const MAP: u32 = 1024;

/// What was measured. Nothing of what no claim is about.
#[derive(Default)]
pub struct Evidence {
    /// Hard shadows on scenes.
    pub hard: Vec<Judged>,
    /// Light in the air: what was looked at, and the report.
    pub air: Vec<(String, Report<ScatteringErrors>)>,
    /// Soft shadows.
    pub soft: Vec<(String, Report<SoftErrors>)>,
    /// Times over maps, pictures and filters.
    pub swept: Option<Swept>,
}

/// The figures of both techniques at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The place, in words.
    pub place: String,
    /// The figures.
    pub figures: [f64; 2],
}

impl Figure {
    /// Whether it is one of hard shadows on scenes.
    #[must_use]
    pub fn of_scenes(self) -> bool {
        matches!(self, Self::Picture | Self::Surfaces | Self::Leaking)
    }

    /// What it is called, and its unit.
    pub(super) fn told(self) -> [&'static str; 2] {
        match self {
            Self::Picture => ["error in pictures", "%"],
            Self::Surfaces => ["error over all surfaces", "%"],
            Self::Leaking => ["leaks over all surfaces", "%"],
            Self::Air => ["error of radiance", "%"],
            Self::Soft => ["error in pictures", "%"],
            Self::AirTime | Self::SoftTime => ["time", "ms"],
            Self::Time(Place::All) => ["time", "copies"],
            Self::Time(Place::LargestMap) => ["time with the largest map", "copies"],
            Self::Time(Place::LargestPicture) => ["time with the largest picture", "copies"],
            Self::Time(Place::WidestFilter) => ["time with the widest filter", "copies"],
            Self::Growth => ["growth with the filter's width", "as power"],
        }
    }
}

impl Evidence {
    /// The figures of a claim, wherever both are there.
    #[must_use]
    pub fn cases(&self, claim: &Claim) -> Vec<Case> {
        let both = [claim.one, claim.other];
        match claim.figure {
            Figure::Picture => self.of_scenes(both, |errors| Some(errors.picture?.error)),
            Figure::Surfaces => self.of_scenes(both, |errors| Some(errors.surfaces?.error)),
            Figure::Leaking => {
                let leaking = |figures: Figures| figures.leaking;
                self.of_scenes(both, |errors| errors.surfaces.map(leaking))
            }
            Figure::Air => reported(&self.air, both, |row| {
                Some(100.0 * row.errors.plain.overall())
            }),
            Figure::Soft => reported(&self.soft, both, |row| {
                Some(100.0 * row.errors.error.facing.mean_absolute)
            }),
            Figure::AirTime => reported(&self.air, both, |row| row.cost.map(milliseconds)),
            Figure::SoftTime => reported(&self.soft, both, |row| row.cost.map(milliseconds)),
            Figure::Time(place) => self.times(both, place),
            Figure::Growth => self.growth(both),
        }
    }

    fn of_scenes(&self, both: [&str; 2], figure: impl Fn(&Errors) -> Option<f64>) -> Vec<Case> {
        let mut cases = Vec::new();
        for one in self.hard.iter().filter(|row| row.name == both[0]) {
            let is_it = |row: &&Judged| {
                row.name == both[1] && row.scene == one.scene && row.radius == one.radius
            };
            let Some(other) = self.hard.iter().find(is_it) else {
                continue;
            };
            for (first, second) in one.views.iter().zip(&other.views) {
                if let (Some(first_figure), Some(second_figure)) = (figure(first), figure(second)) {
                    let (scene, view, radius) = (&one.scene, first.view, one.radius);
                    cases.push(Case {
                        place: format!("{scene}, view {view}, radius {radius}"),
                        figures: [first_figure, second_figure].map(|figure| 100.0 * figure),
                    });
                }
            }
        }
        cases
    }

    /// Both rows of the sweep.
    fn swept(&self, both: [&str; 2]) -> Option<(&Swept, [usize; 2])> {
        let swept = self.swept.as_ref()?;
        let row = |name: &str| swept.techniques.iter().position(|it| is_named(it, name));
        Some((swept, [row(both[0])?, row(both[1])?]))
    }

    fn times(&self, both: [&str; 2], place: Place) -> Vec<Case> {
        let Some((swept, rows)) = self.swept(both) else {
            return Vec::new();
        };
        let last = |axis: &Axis| axis.points.last().cloned();
        let axis = |number: usize| swept.axes.get(number).and_then(last).into_iter().collect();
        let points: Vec<Times> = match place {
            Place::All => (swept.axes.iter())
                .flat_map(|axis| axis.points.clone())
                .collect(),
            Place::LargestMap => axis(0),
            Place::LargestPicture => axis(1),
            Place::WidestFilter => axis(2),
        };
        let case = |times: &Times| Case {
            place: told(times),
            figures: rows.map(|row| times.copies[row].median),
        };
        let mut cases: Vec<Case> = points.iter().map(case).collect();
        // Where the axes meet, one time is enough.
        let mut places: Vec<String> = Vec::new();
        cases.retain(|case| {
            let is_new = !places.contains(&case.place);
            places.push(case.place.clone());
            is_new
        });
        cases
    }

    fn growth(&self, both: [&str; 2]) -> Vec<Case> {
        let Some((swept, rows)) = self.swept(both) else {
            return Vec::new();
        };
        let filters = swept.axes.last().map_or(&[][..], |axis| &axis.points);
        let case = |pair: &[Times]| {
            let widths = [0, 1].map(|index| f64::from(pair[index].at.filter));
            let power = |row: usize| {
                let grown = pair[1].copies[row].median / pair[0].copies[row].median;
                grown.ln() / (widths[1] / widths[0]).ln()
            };
            Case {
                place: format!("filters of {} to {} texels", widths[0], widths[1]),
                figures: rows.map(power),
            }
        };
        filters.windows(2).map(case).collect()
    }
}

/// Whether a technique of a sweep, `evsm4 40/5 float32`, is the one that is named without its settings.
fn is_named(technique: &str, name: &str) -> bool {
    let ends = |text: &str| {
        let mut words = text.split(' ');
        let first = words.next().map(str::to_owned);
        (first, words.next_back().map(str::to_owned))
    };
    ends(technique) == ends(name)
}

/// A place of a sweep in words.
fn told(times: &Times) -> String {
    let [width, height] = times.at.picture;
    let (map, filter) = (times.at.map, times.at.filter);
    format!("map {map}, picture {width}x{height}, filter {filter}")
}

/// Both rows of each report.
fn reported<E>(
    reports: &[(String, Report<E>)],
    both: [&str; 2],
    figure: impl Fn(&Row<E>) -> Option<f64>,
) -> Vec<Case> {
    let case = |(place, report): &(String, Report<E>)| {
        let of = |name: &str| figure(report.rows.iter().find(|row| row.name == name)?);
        Some(Case {
            place: place.clone(),
            figures: [of(both[0])?, of(both[1])?],
        })
    };
    reports.iter().filter_map(case).collect()
}

/// The time of a whole map and of a picture of [`PICTURE`].
fn milliseconds(cost: Cost) -> f64 {
    let texels = f64::from(MAP) * f64::from(MAP);
    let map = cost.map.map_or(0.0, |map| map.median * texels);
    1e-6 * (map + cost.pixels.median * PICTURE[0] * PICTURE[1])
}
