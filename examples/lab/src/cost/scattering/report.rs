//! What the nodes of single scattering cost, as text and as JSON.

use core::fmt;

use serde::Serialize;

use super::super::clock::ClockKind;
use super::super::report::{Conditions, Time, mark, percent};

/// What sums by a row per invocation may cost on a software adapter, in compute copies of both planes.
pub const GATE: f64 = 1.3;

/// Time per texel at the largest size, at most this many times that at [`FROM`].
pub const LARGEST_GROWTH: f64 = 1.3;

/// The size that growth is measured from.
pub const FROM: u32 = 512;

/// The sizes that are measured.
pub const SIZES: [u32; 5] = [256, 512, 1024, 2048, 4096];

/// What is timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Resampling of a light's map of four moments.
    Rectify,
    /// Sums by a row per invocation.
    Serial,
    /// Sums by a row per workgroup.
    Parallel,
}

/// What a node costs at a size.
#[derive(Clone, Debug, Serialize)]
pub struct ScatteringRow {
    /// Texels per side of both the light's map and the rectified one.
    pub size: u32,
    /// What is timed.
    pub method: Method,
    /// The time, for both planes.
    pub time: Time,
    /// Bytes that both planes move per texel.
    pub bytes_per_texel: f64,
    /// The largest difference from the reference in f64.
    pub error: f64,
    /// Time per texel as a multiple of that at [`FROM`], if that was measured.
    pub growth: Option<f64>,
    /// Whether this is what the nodes do on this device.
    pub chosen: bool,
}

/// What the nodes cost at all sizes.
#[derive(Clone, Debug, Serialize)]
pub struct ScatteringCost {
    /// Where and how.
    pub conditions: Conditions,
    /// By size, then by method.
    pub rows: Vec<ScatteringRow>,
    /// Whether the bounds hold here: on software adapters.
    pub bounded: bool,
}

impl Method {
    /// Whether nodes do this on a software adapter, or on any other one.
    pub(super) fn chosen(self, software_adapter: bool) -> bool {
        match self {
            Method::Rectify => true,
            Method::Serial => software_adapter,
            Method::Parallel => !software_adapter,
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Method::Rectify => "rectify",
            Method::Serial => "integrate, serial",
            Method::Parallel => "integrate, parallel",
        })
    }
}

impl ScatteringRow {
    fn nanoseconds_per_texel(&self) -> f64 {
        1e9 * self.time.seconds.median / (f64::from(self.size) * f64::from(self.size))
    }

    /// Whether the time, if this is what the nodes do, is within the bounds of software adapters.
    #[must_use]
    pub fn passed(&self) -> bool {
        let gate = match self.method {
            Method::Rectify => f64::INFINITY,
            _ => GATE,
        };
        !self.chosen
            || (self.time.x_compute_copy.median <= gate
                && self.growth.is_none_or(|growth| growth <= LARGEST_GROWTH))
    }
}

impl ScatteringCost {
    /// The rows of all sizes, with their growth.
    #[must_use]
    pub fn new(conditions: Conditions, mut rows: Vec<ScatteringRow>) -> Self {
        let from: Vec<(Method, f64)> = rows
            .iter()
            .filter(|row| row.size == FROM)
            .map(|row| (row.method, row.nanoseconds_per_texel()))
            .collect();
        for row in rows.iter_mut().filter(|row| row.size >= FROM) {
            let first = from.iter().find(|(method, _)| *method == row.method);
            row.growth = first.map(|(_, first)| row.nanoseconds_per_texel() / first);
        }
        Self {
            bounded: conditions.clock == ClockKind::ProcessTime,
            conditions,
            rows,
        }
    }

    /// Whether every row is within its bounds; true where there are none.
    #[must_use]
    pub fn passed(&self) -> bool {
        !self.bounded || self.rows.iter().all(ScatteringRow::passed)
    }
}

impl fmt::Display for ScatteringCost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.conditions)?;
        writeln!(
            f,
            "six moments in two planes of rgba16float, in copies of both planes"
        )?;
        writeln!(
            f,
            "{:>5} {:<19} {:>7} {:>6} {:>7} {:>9} {:>7} {:>8} {:>9}",
            "size", "", "x copy", "IQR", "x API", "ns/texel", "growth", "B/texel", "error"
        )?;
        for row in &self.rows {
            let growth = row
                .growth
                .map_or("-".to_owned(), |growth| format!("{growth:.2}"));
            let verdict = match (self.bounded && row.chosen, row.passed()) {
                (true, true) => "  ok",
                (true, false) => "  gate missed",
                _ => "",
            };
            writeln!(
                f,
                "{:>5} {:<19} {:>7.2} {:>6} {:>7.2} {:>9.2} {:>7} {:>8.1} {:>9.1e}{verdict}{}",
                row.size,
                row.method,
                row.time.x_compute_copy.median,
                percent(row.time.x_compute_copy.spread()),
                row.time.x_api_copy.median,
                row.nanoseconds_per_texel(),
                growth,
                row.bytes_per_texel,
                row.error,
                mark(&row.time, self.conditions.clock),
            )?;
        }
        writeln!(
            f,
            "\nok: serial sums at most {GATE} copies on a software adapter, and from {FROM} texels per side on at most \
             {LARGEST_GROWTH} times the time per texel. error: the largest difference of a channel from the same in f64"
        )
    }
}
