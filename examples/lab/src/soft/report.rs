//! Errors and costs of soft shadows, as text and as JSON.

use core::fmt;

use serde::Serialize;

use super::cost::SoftCost;
use super::light::SoftLightChoice;
use crate::cost::report::Conditions;
use crate::light::LightShape;
use crate::metric::Comparison;
use crate::scene::EDGE_HEIGHTS;

/// How soft shadows of a scene compare.
#[derive(Clone, Debug, Serialize)]
pub struct SoftReport {
    /// The scene's name.
    pub scene: String,
    /// What kind of area light.
    pub light: SoftLightChoice,
    /// Its size: degrees both times for a directional light, else width and height in scene units.
    pub light_size: [f64; 2],
    /// Where moment depth begins and ends, along the light's axis in scene units.
    pub light_range: [f64; 2],
    /// Width and height of a texel of the light's map in scene units; at distance 1 if the light has a position.
    pub texel: [f64; 2],
    /// Texels per side of the light's map.
    pub map: u32,
    /// Width and height of the picture.
    pub picture: [u32; 2],
    /// Places on the light that the truth is the mean of.
    pub places: u32,
    /// Seconds that the truth took.
    pub truth_seconds: f64,
    /// Widths of the penumbrae of straight edges, 10 % to 90 %, in scene units: as geometry has them, and on the truth.
    pub edges: Option<SoftEdges>,
    /// The candidates.
    pub rows: Vec<SoftRow>,
    /// How costs were taken, if they were.
    pub conditions: Option<Conditions>,
}

/// Penumbrae of straight edges.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct SoftEdges {
    /// As geometry has them.
    pub exact: [f64; EDGE_HEIGHTS.len()],
    /// Measured on the truth.
    pub truth: [Option<f64>; EDGE_HEIGHTS.len()],
}

/// A candidate.
#[derive(Clone, Debug, Serialize)]
pub struct SoftRow {
    /// Its name.
    pub name: String,
    /// Its error over the pixels that face the light within its map, and over those of them in a penumbra.
    pub error: Comparison,
    /// Penumbrae of straight edges.
    pub edges: Option<[Option<f64>; EDGE_HEIGHTS.len()]>,
    /// What it costs, if that was measured.
    pub cost: Option<SoftCost>,
}

/// The size of a light as reports have it.
#[must_use]
pub(crate) fn size(shape: LightShape) -> [f64; 2] {
    match shape {
        LightShape::Directional { angular_diameter } => [angular_diameter.to_degrees(); 2],
        _ => shape.extent(),
    }
}

impl fmt::Display for SoftReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [width, height] = self.light_size;
        let light = match self.light {
            SoftLightChoice::Directional => format!("{width:.3} degrees"),
            SoftLightChoice::Spot => format!("disk of {width:.3}"),
            SoftLightChoice::Rectangle => format!("{width:.3} x {height:.3}"),
        };
        let ([columns, rows], map) = (self.picture, self.map);
        writeln!(
            f,
            "{}: {} light, {light}; map {map}x{map}, picture {columns}x{rows}; truth of {} places in {:.1} s",
            self.scene,
            self.light.name(),
            self.places,
            self.truth_seconds
        )?;
        self.errors(f)?;
        if let Some(edges) = &self.edges {
            self.widths(f, edges)?;
        }
        if let Some(conditions) = &self.conditions {
            self.costs(f, conditions)?;
        }
        Ok(())
    }
}

impl SoftReport {
    fn errors(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count =
            |of: fn(&Comparison) -> usize| self.rows.first().map_or(0, |row| of(&row.error));
        writeln!(
            f,
            "{:<14} {:>38}   {:>38} {:>5}",
            "mean absolute",
            format!("facing, {} pixels", count(|error| error.facing.samples)),
            format!("penumbra, {} pixels", count(|error| error.penumbra.samples)),
            ""
        )?;
        writeln!(
            f,
            "{:<14} {:>9} {:>9} {:>9} {:>8}   {:>9} {:>9} {:>9} {:>8} {:>5}",
            "error",
            "mean",
            "leaking",
            "95 %",
            "maximum",
            "mean",
            "leaking",
            "95 %",
            "maximum",
            "NaN"
        )?;
        for row in &self.rows {
            write!(f, "{:<14}", row.name)?;
            for (space, figures) in [(" ", &row.error.facing), ("   ", &row.error.penumbra)] {
                write!(
                    f,
                    "{space}{:>9.5} {:>9.5} {:>9.5} {:>8.4}",
                    figures.mean_absolute, figures.leaking, figures.percentile_95, figures.maximum
                )?;
            }
            writeln!(f, " {:>5}", row.error.nan_pixels)?;
        }
        Ok(())
    }

    fn widths(&self, f: &mut fmt::Formatter<'_>, edges: &SoftEdges) -> fmt::Result {
        write!(f, "penumbra 10 % to 90 %")?;
        for height in EDGE_HEIGHTS {
            write!(f, " {:>20}", format!("edge at {height}"))?;
        }
        writeln!(f)?;
        let measured = self.rows.iter().map(|row| (row.name.as_str(), row.edges));
        let exact = ("exact", Some(edges.exact.map(Some)));
        for (name, widths) in [exact, ("truth", Some(edges.truth))]
            .into_iter()
            .chain(measured)
        {
            write!(f, "{name:<21}")?;
            for (width, exact) in widths.unwrap_or_default().iter().zip(edges.exact) {
                let text = width.map_or("-".to_owned(), |width| {
                    format!("{width:.4} ({:+.1} %)", 100.0 * (width / exact - 1.0))
                });
                write!(f, " {text:>20}")?;
            }
            writeln!(f)?;
        }
        Ok(())
    }

    fn costs(&self, f: &mut fmt::Formatter<'_>, conditions: &Conditions) -> fmt::Result {
        let first = self.rows.first().map_or("", |row| row.name.as_str());
        writeln!(f, "\n{conditions}")?;
        writeln!(
            f,
            "{:<14} {:>14} {:>10} {:>6} {:>14} {:>12}",
            "cost",
            "shading, ns/px",
            format!("x {first}"),
            "IQR",
            "map, ns/px",
            format!("total x {first}")
        )?;
        for row in &self.rows {
            let Some(cost) = &row.cost else { continue };
            let map = cost.preparation;
            writeln!(
                f,
                "{:<14} {:>14.2} {:>10.3} {:>6} {:>14} {:>12.3}",
                row.name,
                cost.shading.median,
                cost.shading_ratio.median,
                format!("{:.0} %", 100.0 * cost.shading_ratio.spread()),
                map.map_or("-".to_owned(), |map| format!("{:.2}", map.median)),
                cost.total_ratio.median
            )?;
        }
        Ok(())
    }
}
