//! What a report tells of marched scattering.

use serde::Serialize;

use crate::compare::{Errors, Row, Table};
use crate::metric::{NO_PIXEL, percent};
use crate::scattering::report::ScatteringError;

/// How far a picture is off, and what its graph takes.
#[derive(Clone, Debug, Serialize)]
pub struct MarchErrors {
    /// Lookups of maps per pixel.
    pub lookups: f64,
    /// Errors against rays through the plain maps.
    pub error: ScatteringError,
    /// Bytes of all textures and buffers of the plan.
    pub bytes_resident: u64,
    /// Bytes that its passes move at least.
    pub bytes_moved: u64,
}

impl Errors for MarchErrors {
    fn tables(rows: &[Row<Self>]) -> Vec<Table> {
        let mebibytes = |bytes: u64| format!("{:.2}", bytes as f64 / 1_048_576.0);
        let cells = |row: &Row<MarchErrors>| {
            let errors = &row.errors;
            let bias = errors.error.mean.iter().sum::<f64>() / 3.0;
            vec![
                ("percent of mean radiance", row.name.clone()),
                ("lookups", errors.lookups.to_string()),
                ("error", percent(errors.error.overall(), NO_PIXEL)),
                ("bias", format!("{:+.3}", 100.0 * bias)),
                ("largest", percent(errors.error.largest, NO_PIXEL)),
                ("NaN", errors.error.not_finite.to_string()),
                ("MiB resident", mebibytes(errors.bytes_resident)),
                ("MiB moved", mebibytes(errors.bytes_moved)),
            ]
        };
        vec![rows.iter().map(cells).collect()]
    }
}
