//! Times, and where and how they were taken.

use core::fmt;

use serde::Serialize;

use super::clock::{Clock, ClockKind};
use super::protocol::FEWEST_ROUNDS;
use super::statistics::Distribution;

/// Wall and timestamps differ by the cost of submitting; by more than this part, one of them is wrong.
const LARGEST_DISAGREEMENT: f64 = 0.2;

/// Where and how times were taken.
#[derive(Clone, Debug, Serialize)]
pub struct Conditions {
    /// The adapter's name.
    pub adapter: String,
    /// The driver and its version.
    pub driver: String,
    /// Cpu, IntegratedGpu, DiscreteGpu, ..
    pub device_type: String,
    /// What was read.
    pub clock: ClockKind,
    /// Rounds after the warm-up.
    pub rounds: u32,
}

/// A time, as ratios to the copies of the same round.
#[derive(Clone, Debug, Serialize)]
pub struct Time {
    /// In copies by a dispatch, of the same bytes.
    pub x_compute_copy: Distribution,
    /// In copies by the interface, of the same bytes.
    pub x_api_copy: Distribution,
    /// In copies by a draw, of the same format and size; only for what draws.
    pub x_draw_copy: Option<Distribution>,
    /// In seconds by the clock.
    pub seconds: Distribution,
    /// Seconds by the wall, as a part of those by the clock.
    pub wall: Distribution,
    /// Whether the spread of the ratio to a copy by a dispatch is small enough to judge by.
    pub reliable: bool,
}

impl Conditions {
    /// The conditions of measurements with a clock.
    #[must_use]
    pub fn of(clock: &Clock<'_>, rounds: u32) -> Self {
        let info = clock.gpu().adapter.get_info();
        Self {
            adapter: info.name,
            driver: format!("{} {}", info.driver, info.driver_info),
            device_type: format!("{:?}", info.device_type),
            clock: clock.kind(),
            rounds: rounds.max(FEWEST_ROUNDS),
        }
    }
}

impl fmt::Display for Conditions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "adapter  {}", self.adapter)?;
        writeln!(f, "driver   {}", self.driver)?;
        writeln!(f, "type     {}", self.device_type)?;
        let clock = match self.clock {
            ClockKind::ProcessTime => "processor time of this process",
            ClockKind::Timestamps => "timestamps of the device",
            ClockKind::Wall => "wall, from submission to completion",
        };
        writeln!(f, "clock    {clock}, {} rounds", self.rounds)
    }
}

/// What to doubt about a time. Processor time has no reason to agree with the wall; a device's timestamps do.
pub(super) fn mark(time: &Time, clock: ClockKind) -> &'static str {
    let disagrees = (time.wall.median - 1.0).abs() > LARGEST_DISAGREEMENT;
    match (time.reliable, clock) {
        (false, _) => "  unreliable",
        (true, ClockKind::Timestamps) if disagrees => "  timestamps and wall disagree",
        (true, _) => "",
    }
}

pub(crate) fn percent(part: f64) -> String {
    format!("{:.0} %", 100.0 * part)
}

pub(crate) fn mebibytes(bytes: u64) -> String {
    format!("{:.2} MiB", bytes as f64 / f64::from(1 << 20))
}
