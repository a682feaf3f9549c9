//! What a report tells of hard shadows.

use serde::Serialize;

use crate::compare::{Errors, Row, Table};
use crate::cost::report::mebibytes;
use crate::metric::{Comparison, NO_PIXEL, percent};

/// How far a picture is off, and what its graph takes and moves.
#[derive(Clone, Debug, Serialize)]
pub struct HardErrors {
    /// The picture's error.
    pub error: Comparison,
    /// Bytes of everything that the plan creates.
    pub bytes_resident: u64,
    /// Bytes that its passes move, each texel once.
    pub bytes_moved: u64,
}

impl Errors for HardErrors {
    fn tables(rows: &[Row<Self>]) -> Vec<Table> {
        let figure = |value: f64| percent(value, NO_PIXEL);
        let cells = |row: &Row<Self>| {
            let HardErrors {
                error,
                bytes_resident,
                bytes_moved,
            } = &row.errors;
            vec![
                ("percent", row.name.clone()),
                ("facing", figure(error.facing.mean_absolute)),
                ("leaking", figure(error.facing.leaking)),
                ("penumbra", figure(error.penumbra.mean_absolute)),
                ("NaN", error.nan_pixels.to_string()),
                ("resident", mebibytes(*bytes_resident)),
                ("moved", mebibytes(*bytes_moved)),
            ]
        };
        vec![rows.iter().map(cells).collect()]
    }
}
