//! What a graph costs, pass by pass and in total, as text and as JSON.

use core::fmt;

use serde::Serialize;

use super::bandwidth::{Memory, TimeBound};
use super::baseline::CopyWork;
use super::report::{Conditions, Time, mark, mebibytes, percent};

/// What one pass of a plan costs, or several small ones together.
#[derive(Clone, Debug, Serialize)]
pub struct PassCost {
    /// `node/pass`, or `node/first pass to last pass`.
    pub pass: String,
    /// The texture that it writes; the copies are of as many bytes.
    pub texture: String,
    /// Whether it dispatches or draws.
    pub work: CopyWork,
    /// Whether it writes fewer than 64x64 texels, so that beginning a pass weighs more than the work.
    pub small: bool,
    /// The time.
    pub time: Time,
    /// Bytes read, each texel once.
    pub bytes_read: u64,
    /// Bytes written.
    pub bytes_written: u64,
    /// The least that the pass moves: both of the above.
    pub minimum_bytes: u64,
    /// Minimum bytes per second, as a part of the bytes per second of the copy by a dispatch.
    pub efficiency: f64,
    /// The largest difference of the node's output from the reference, in the channels' unit, or the mean difference for
    /// a node that shades; none where there is no reference.
    pub error: Option<f64>,
}

/// What a graph costs.
#[derive(Clone, Debug, Serialize)]
pub struct GraphCost {
    /// Where and how.
    pub conditions: Conditions,
    /// Every pass that a shader does.
    pub passes: Vec<BoundedPass>,
    /// The time of all passes, as a ratio to that of all their copies.
    pub total: Time,
    /// Bytes of everything that the plan creates.
    pub bytes_resident: u64,
    /// Bytes that all passes move.
    pub bytes_moved: u64,
    /// The memories that bounds are given for.
    pub memories: Vec<Memory>,
    /// The least time that moving these bytes takes.
    pub bounds: Vec<TimeBound>,
}

/// A pass with the least time that moving its bytes takes.
#[derive(Clone, Debug, Serialize)]
pub struct BoundedPass {
    /// The pass.
    #[serde(flatten)]
    pub cost: PassCost,
    /// Per memory.
    pub bounds: Vec<TimeBound>,
}

impl GraphCost {
    /// Costs with the bounds that memories give.
    #[must_use]
    pub fn new(
        conditions: Conditions,
        passes: Vec<PassCost>,
        total: Time,
        [bytes_resident, bytes_moved]: [u64; 2],
        memories: Vec<Memory>,
    ) -> Self {
        let bounds = |bytes| memories.iter().map(|memory| memory.bound(bytes)).collect();
        Self {
            conditions,
            passes: passes
                .into_iter()
                .map(|cost| BoundedPass {
                    bounds: bounds(cost.minimum_bytes),
                    cost,
                })
                .collect(),
            total,
            bytes_resident,
            bytes_moved,
            bounds: bounds(bytes_moved),
            memories,
        }
    }
}

impl fmt::Display for GraphCost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.conditions)?;
        writeln!(
            f,
            "{:<32} {:<42} {:>9} {:>5} {:>7} {:>7} {:>10} {:>9}",
            "pass", "writes", "x compute", "IQR", "x API", "x draw", "efficiency", "error"
        )?;
        for BoundedPass { cost, .. } in &self.passes {
            let error = cost.error;
            write!(f, "{:<32} {:<42} ", cost.pass, cost.texture)?;
            ratios(f, &cost.time)?;
            writeln!(
                f,
                " {:>10} {:>9}{}{}",
                percent(cost.efficiency),
                error.map_or("-".to_owned(), |error| format!("{error:.1e}")),
                mark(&cost.time, self.conditions.clock),
                if cost.small { "  small" } else { "" },
            )?;
        }
        write!(f, "{:<32} {:<42} ", "total", "")?;
        ratios(f, &self.total)?;
        writeln!(f, "{}", mark(&self.total, self.conditions.clock))?;
        writeln!(
            f,
            "\nx compute: the median ratio to a copy of as many bytes as the pass writes, by a dispatch of 64x1 workgroups in the \
             same round; x API: to\n\
             one by copy_texture_to_texture; x draw: to one by a fullscreen draw; total: all passes to all their copies. \
             efficiency: minimum\n\
             bytes per second as a part of the compute copy's. error: the largest difference of the node's output from the \
             reference in f64, for\n\
             shading the mean one. small: fewer than 64x64 texels, where beginning a pass weighs more than the work.\n"
        )?;
        self.bytes(f)
    }
}

impl GraphCost {
    fn bytes(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:<32} {:>11} {:>11} {:>11}",
            "pass", "read", "written", "moved"
        )?;
        for memory in &self.memories {
            write!(f, " {:>14}", memory.name)?;
        }
        writeln!(f)?;
        let mut row = |name: &str, bytes: [Option<u64>; 3], bounds: &[TimeBound]| {
            write!(f, "{name:<32}")?;
            for bytes in bytes {
                write!(f, " {:>11}", bytes.map_or(String::new(), mebibytes))?;
            }
            for bound in bounds {
                write!(f, " {:>11.1} us", bound.microseconds)?;
            }
            writeln!(f)
        };
        for BoundedPass { cost, bounds } in &self.passes {
            let bytes = [cost.bytes_read, cost.bytes_written, cost.minimum_bytes];
            row(&cost.pass, bytes.map(Some), bounds)?;
        }
        row("total", [None, None, Some(self.bytes_moved)], &self.bounds)?;
        writeln!(f, "resident {}", mebibytes(self.bytes_resident))?;
        writeln!(
            f,
            "\nTimes in microseconds are bytes over bandwidth: a lower bound, not a measurement."
        )?;
        let memories: Vec<String> = self.memories.iter().map(ToString::to_string).collect();
        writeln!(f, "{}", memories.join("; "))
    }
}

fn ratios(f: &mut fmt::Formatter<'_>, time: &Time) -> fmt::Result {
    let draw = time.x_draw_copy;
    write!(
        f,
        "{:>9.2} {:>5} {:>7.2} {:>7}",
        time.x_compute_copy.median,
        percent(time.x_compute_copy.spread()),
        time.x_api_copy.median,
        draw.map_or("-".to_owned(), |draw| format!("{:.2}", draw.median)),
    )
}
