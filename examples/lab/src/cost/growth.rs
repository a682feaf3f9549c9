//! How cost grows: with the map, with the picture, and with the radius of the filter.

use core::fmt;

use serde::Serialize;

use super::baseline::CopyWork;
use super::passes::PassSubjects;
use super::protocol::Rounds;
use super::report::{Conditions, Time, mark, percent};
use super::statistics::Distribution;

/// What is varied.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    /// Texels per side of the light's map.
    MapSize,
    /// Pixels of the picture.
    OutputSize,
    /// Texels on either side of the filter's centre.
    Radius,
}

/// A value that is varied.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Value {
    /// Its place on the axis, above 0.
    pub x: f64,
    /// What is written there.
    pub label: String,
}

/// What a node costs at one value.
#[derive(Clone, Debug, Serialize)]
pub struct Point {
    /// The value.
    #[serde(flatten)]
    pub value: Value,
    /// Texels of what the node writes.
    pub texels: u64,
    /// The time.
    pub time: Time,
    /// Time per texel as a multiple of that at the first value.
    pub per_texel: Distribution,
}

/// What a node costs at all values.
#[derive(Clone, Debug, Serialize)]
pub struct Curve {
    /// The node's name.
    pub node: String,
    /// What the copies are that its time is given in: dispatches, or draws for a node that draws.
    pub copy: CopyWork,
    /// Per value.
    pub points: Vec<Point>,
}

/// What nodes cost along an axis.
#[derive(Clone, Debug, Serialize)]
pub struct Growth {
    /// What is varied.
    pub axis: Axis,
    /// Per node.
    pub curves: Vec<Curve>,
}

/// Everything that was varied.
#[derive(Clone, Debug, Serialize)]
pub struct CostGrowth {
    /// Where and how.
    pub conditions: Conditions,
    /// Per axis.
    pub growths: Vec<Growth>,
    /// The plots that were written.
    pub plots: Vec<String>,
}

impl Axis {
    /// The stem of the plot's file name.
    #[must_use]
    pub fn file_stem(self) -> &'static str {
        match self {
            Axis::MapSize => "cost-by-map-size",
            Axis::OutputSize => "cost-by-output-size",
            Axis::Radius => "cost-by-radius",
        }
    }

    /// What is varied, with its unit.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Axis::MapSize => "map size (texels per side)",
            Axis::OutputSize => "output size (pixels)",
            Axis::Radius => "radius of the filter (texels)",
        }
    }

    /// The plot's title.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Axis::MapSize => "Cost against the size of the map",
            Axis::OutputSize => "Cost of shading against the size of the output",
            Axis::Radius => "Cost of the blur, both directions, against its radius",
        }
    }
}

impl Point {
    /// The time in copies of the curve's kind.
    #[must_use]
    pub fn x_copy(&self) -> Distribution {
        self.time.x_draw_copy.unwrap_or(self.time.x_compute_copy)
    }
}

impl Growth {
    /// The curves of subjects that were timed together, a set per value, one after the other.
    #[must_use]
    pub fn of(axis: Axis, measured: &[(Value, PassSubjects)], rounds: &Rounds) -> Self {
        let mut curves: Vec<Curve> = Vec::new();
        // Per curve, the subject and the texels of its first point.
        let mut firsts: Vec<(usize, u64)> = Vec::new();
        let mut offset = 0;
        for (value, subjects) in measured {
            let numbers = subjects.numbers(offset);
            offset += subjects.subjects().len();
            for ((node, texels), (subject, copies)) in subjects.nodes().zip(numbers) {
                let known = curves.iter().position(|curve| curve.node == node);
                let index = known.unwrap_or_else(|| {
                    curves.push(Curve {
                        node: node.to_owned(),
                        copy: match copies.draw {
                            Some(_) => CopyWork::Fullscreen,
                            None => CopyWork::Compute,
                        },
                        points: Vec::new(),
                    });
                    firsts.push((subject, texels));
                    curves.len() - 1
                });
                let (first, first_texels) = firsts[index];
                let factor = first_texels as f64 / texels as f64;
                curves[index].points.push(Point {
                    value: value.clone(),
                    texels,
                    time: rounds.time(subject, copies),
                    per_texel: rounds.ratio(&[subject], &[first]).scaled(factor),
                });
            }
        }
        Self { axis, curves }
    }
}

impl fmt::Display for CostGrowth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.conditions)?;
        for growth in &self.growths {
            writeln!(
                f,
                "{:<16} {:>12} {:>8} {:>6} {:>8} {:>10} {:>10}",
                growth.axis.file_stem().trim_start_matches("cost-by-"),
                "",
                "x copy",
                "IQR",
                "x API",
                "ms",
                "per texel"
            )?;
            for curve in &growth.curves {
                for point in &curve.points {
                    writeln!(
                        f,
                        "{:<16} {:>12} {:>8.2} {:>6} {:>8.2} {:>10.3} {:>10.2}{}",
                        curve.node,
                        point.value.label,
                        point.x_copy().median,
                        percent(point.x_copy().spread()),
                        point.time.x_api_copy.median,
                        1e3 * point.time.seconds.median,
                        point.per_texel.median,
                        mark(&point.time, self.conditions.clock),
                    )?;
                }
            }
            writeln!(f)?;
        }
        writeln!(
            f,
            "x copy: in copies of what the node writes, by a dispatch, for a node that draws by a draw; per texel: time per texel, \
             as a multiple\nof that in the first row of the node\n"
        )?;
        self.plots.iter().try_for_each(|plot| writeln!(f, "{plot}"))
    }
}
