//! How cost grows: with the map, with the picture, and with the radius of the filter.

use core::fmt;

use serde::Serialize;

use super::harness::Measured;
use super::report::Conditions;
use super::statistics::Distribution;
use super::table::{LEGEND, Row, columns};

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
    /// The cost, under the node's name.
    #[serde(flatten)]
    pub row: Row,
    /// Time per texel as a multiple of that of the same node at the first value.
    pub per_texel: Distribution,
}

/// What nodes cost along an axis.
#[derive(Clone, Debug, Serialize)]
pub struct Growth {
    /// What is varied.
    pub axis: Axis,
    /// Per value and node.
    pub points: Vec<Point>,
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
    /// The plot's title, what is varied with its unit, and the stem of the plot's file name.
    #[must_use]
    pub fn texts(self) -> [&'static str; 3] {
        match self {
            Axis::MapSize => [
                "Cost against the size of the map",
                "map size (texels per side)",
                "cost-by-map-size",
            ],
            Axis::OutputSize => [
                "Cost of shading against the size of the output",
                "output size (pixels)",
                "cost-by-output-size",
            ],
            Axis::Radius => [
                "Cost of the blur, both directions, against its radius",
                "radius of the filter (texels)",
                "cost-by-radius",
            ],
        }
    }
}

impl Point {
    /// The time in copies by a dispatch, or by a draw for a node that draws.
    #[must_use]
    pub fn x_copy(&self) -> Distribution {
        let time = &self.row.time;
        time.x_draw_copy.unwrap_or(time.x_compute_copy)
    }
}

impl Growth {
    /// The costs of nodes that were timed together, with a value per row.
    #[must_use]
    pub fn of(axis: Axis, values: Vec<Value>, measured: &Measured) -> Self {
        let rows = &measured.rows;
        let point = |(number, (row, value)): (usize, (&Row, Value))| {
            let first = rows.iter().position(|other| other.name == row.name);
            let first = first.unwrap_or(number);
            let factor = rows[first].texels as f64 / row.texels as f64;
            let per_texel = measured.ratio(number, first).scaled(factor);
            Point {
                row: Row {
                    growth: Some(per_texel.median),
                    ..row.clone()
                },
                value,
                per_texel,
            }
        };
        let points = rows.iter().zip(values).enumerate().map(point).collect();
        Self { axis, points }
    }

    /// The points of each node.
    #[must_use]
    pub fn curves(&self) -> Vec<(&str, Vec<&Point>)> {
        let mut curves: Vec<(&str, Vec<&Point>)> = Vec::new();
        for point in &self.points {
            let name = point.row.name.as_str();
            match curves.iter_mut().find(|curve| curve.0 == name) {
                Some((_, points)) => points.push(point),
                None => curves.push((name, vec![point])),
            }
        }
        curves
    }
}

impl fmt::Display for CostGrowth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.conditions)?;
        for growth in &self.growths {
            writeln!(f, "{}", growth.axis.texts()[0])?;
            let points = growth.points.iter();
            let rows = points.map(|point| point.row.times(self.conditions.clock));
            columns(f, &Vec::from_iter(rows))?;
            writeln!(f)?;
        }
        writeln!(
            f,
            "growth: time per texel, as a multiple of that in the first row of the node. {LEGEND}\n"
        )?;
        self.plots.iter().try_for_each(|plot| writeln!(f, "{plot}"))
    }
}
