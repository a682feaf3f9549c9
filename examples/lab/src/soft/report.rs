//! What a report tells of soft shadows.

use serde::Serialize;

use crate::compare::{Errors, Row, Table};
use crate::metric::{Comparison, ErrorFigures, NO_PIXEL, percent};

/// How far a picture is off.
#[derive(Clone, Debug, Serialize)]
pub struct SoftErrors {
    /// Its error over the pixels that face the light within its map, and over those of them in a penumbra.
    pub error: Comparison,
}

impl Errors for SoftErrors {
    fn tables(rows: &[Row<Self>]) -> Vec<Table> {
        type Figures = fn(&Comparison) -> &ErrorFigures;
        let sets: [(&str, Figures); 2] = [
            ("percent, facing", |error| &error.facing),
            ("percent, penumbra", |error| &error.penumbra),
        ];
        let errors = sets.map(|(name, figures)| {
            let cells = |row: &Row<Self>| {
                let (error, figure) = (&row.errors.error, |value: f64| percent(value, NO_PIXEL));
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
        errors.to_vec()
    }
}
