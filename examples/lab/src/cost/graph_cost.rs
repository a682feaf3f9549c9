//! What a graph costs, pass by pass and in total, as text and as JSON.

use core::fmt;

use serde::Serialize;

use super::bandwidth::{Memory, TimeBound};
use super::harness::Measured;
use super::report::{Conditions, Time, mebibytes};
use super::table::{LEGEND, Row, columns};

/// What a graph costs.
#[derive(Clone, Debug, Serialize)]
pub struct GraphCost {
    /// Where and how the graph was measured.
    pub conditions: Conditions,
    /// Every pass that a shader does.
    pub passes: Vec<Row>,
    /// The time of all passes, as a ratio to that of all their copies.
    pub total: Time,
    /// The row of all passes.
    #[serde(skip)]
    sum: Row,
    /// Bytes of everything that the plan creates.
    pub bytes_resident: u64,
    /// Bytes that all passes move.
    pub bytes_moved: u64,
    /// The memories that bounds are given for.
    pub memories: Vec<Memory>,
    /// The least time that moving these bytes takes.
    pub bounds: Vec<TimeBound>,
}

impl GraphCost {
    /// Costs with the bounds that memories give.
    #[must_use]
    pub fn new(
        conditions: Conditions,
        measured: Measured,
        [bytes_resident, bytes_moved]: [u64; 2],
        memories: Vec<Memory>,
    ) -> Self {
        let bounds = |bytes| Vec::from_iter(memories.iter().map(|memory| memory.bound(bytes)));
        let bounded = |row: Row| Row {
            bounds: bounds(row.minimum_bytes),
            ..row
        };
        let sum = bounded(measured.total());
        Self {
            conditions,
            passes: measured.rows.into_iter().map(bounded).collect(),
            total: sum.time.clone(),
            bytes_resident,
            bytes_moved,
            bounds: bounds(bytes_moved),
            sum,
            memories,
        }
    }
}

impl fmt::Display for GraphCost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.conditions)?;
        let rows = || self.passes.iter().chain([&self.sum]);
        let clock = self.conditions.clock;
        columns(f, &Vec::from_iter(rows().map(|row| row.times(clock))))?;
        writeln!(f, "\n{LEGEND} total: all passes to all their copies.\n")?;
        columns(f, &Vec::from_iter(rows().map(Row::bytes)))?;
        writeln!(f, "resident {}", mebibytes(self.bytes_resident))?;
        let memories: Vec<String> = self.memories.iter().map(ToString::to_string).collect();
        writeln!(
            f,
            "\nTimes in microseconds are bytes over bandwidth: a lower bound, not a measurement.\n{}",
            memories.join("; ")
        )
    }
}
