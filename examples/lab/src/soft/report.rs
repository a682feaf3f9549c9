//! What a report tells of soft shadows.

use core::fmt;

use serde::Serialize;

use super::light::SoftLightChoice;
use crate::compare::{Row, Setting, Table};
use crate::light::LightShape;
use crate::metric::{Comparison, ErrorFigures};
use crate::scene::EDGE_HEIGHTS;

/// A scene under an area light.
#[derive(Clone, Debug, Serialize)]
pub struct SoftSetting {
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
    /// Widths of the penumbrae of straight edges, 10 % to 90 %, in scene units: as geometry has them, and on the truth.
    pub edges: Option<SoftEdges>,
}

/// Penumbrae of straight edges.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct SoftEdges {
    /// Penumbrae as geometry has them.
    pub exact: [f64; EDGE_HEIGHTS.len()],
    /// Measured on the truth.
    pub truth: [Option<f64>; EDGE_HEIGHTS.len()],
}

/// How far a picture is off.
#[derive(Clone, Debug, Serialize)]
pub struct SoftErrors {
    /// Its error over the pixels that face the light within its map, and over those of them in a penumbra.
    pub error: Comparison,
    /// Penumbrae of straight edges.
    pub edges: Option<[Option<f64>; EDGE_HEIGHTS.len()]>,
}

/// The size of a light as reports have it.
pub(super) fn size(shape: LightShape) -> [f64; 2] {
    match shape {
        LightShape::Directional { angular_diameter } => [angular_diameter.to_degrees(); 2],
        _ => shape.extent(),
    }
}

impl fmt::Display for SoftSetting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [width, height] = self.light_size;
        let light = match self.light {
            SoftLightChoice::Directional => format!("{width:.3} degrees"),
            SoftLightChoice::Spot => format!("disk of {width:.3}"),
            SoftLightChoice::Rectangle => format!("{width:.3} x {height:.3}"),
        };
        let ([columns, rows], map) = (self.picture, self.map);
        write!(
            f,
            "{}: {} light, {light}; map {map}x{map}, picture {columns}x{rows}; truth of {} places",
            self.scene,
            self.light.name(),
            self.places
        )
    }
}

impl Setting for SoftSetting {
    type Errors = SoftErrors;
    const MAP_COST: &'static str = "map, per pixel";

    fn stem(&self) -> String {
        format!("{}-{}", self.scene, self.light.name())
    }

    fn tables(&self, rows: &[Row<SoftErrors>]) -> Vec<Table> {
        type Figures = fn(&Comparison) -> &ErrorFigures;
        let sets: [(&str, Figures); 2] = [
            ("facing", |error| &error.facing),
            ("penumbra", |error| &error.penumbra),
        ];
        let errors = sets.map(|(name, figures)| {
            let cells = |row: &Row<SoftErrors>| {
                let (error, figure) = (&row.errors.error, |value: f64| format!("{value:.5}"));
                let of = figures(error);
                vec![
                    (name, row.name.clone()),
                    ("pixels", of.samples.to_string()),
                    ("mean absolute", figure(of.mean_absolute)),
                    ("leaking", figure(of.leaking)),
                    ("95 %", figure(of.percentile_95)),
                    ("maximum", figure(of.maximum)),
                    ("NaN", error.nan_pixels.to_string()),
                ]
            };
            rows.iter().map(cells).collect()
        });
        let widths = self.edges.iter().flat_map(|edges| {
            let measured = rows.iter().map(|row| (row.name.as_str(), row.errors.edges));
            let exact = ("exact", Some(edges.exact.map(Some)));
            let known = [exact, ("truth", Some(edges.truth))];
            known.into_iter().chain(measured).map(|(name, widths)| {
                let widths = widths.unwrap_or_default().into_iter().zip(edges.exact);
                let cells = widths.zip(EDGES).map(|((width, exact), edge)| {
                    let text = width.map(|width| {
                        format!("{width:.4} ({:+.1} %)", 100.0 * (width / exact - 1.0))
                    });
                    (edge, text.unwrap_or("-".to_owned()))
                });
                let name = ("penumbra 10 % to 90 %", name.to_owned());
                std::iter::once(name).chain(cells).collect()
            })
        });
        errors.into_iter().chain([widths.collect()]).collect()
    }
}

/// What the columns of straight edges are called.
const EDGES: [&str; EDGE_HEIGHTS.len()] = ["lowest edge", "middle edge", "highest edge"];
