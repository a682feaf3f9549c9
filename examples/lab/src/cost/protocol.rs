//! Rounds: every subject in turn, so that whatever else the machine does meets all of them alike.

use super::clock::{Clock, Reading};
use super::report::Time;
use super::statistics::Distribution;
use crate::error::LabError;

/// Fewer rounds give no distribution.
pub const FEWEST_ROUNDS: u32 = 9;

/// A subject is repeated within one submission until it takes this long: shorter ones drown in the cost of submitting.
const SHORTEST: f64 = 1e-3;

/// The most repetitions within one submission.
const MOST_REPEATS: u32 = 1024;

/// What records a subject once.
pub type Record<'a> = Box<dyn Fn(&mut wgpu::CommandEncoder) -> Result<(), LabError> + 'a>;

/// Something whose time is taken.
pub struct Subject<'a> {
    /// Its name.
    pub name: String,
    /// Records it once.
    pub record: Record<'a>,
}

/// Which subjects are the copies that another one is compared with, by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CopyNumbers {
    /// The copy by a dispatch.
    pub compute: usize,
    /// The copy by the interface.
    pub api: usize,
    /// The copy by a draw, for what draws.
    pub draw: Option<usize>,
}

/// Times of all subjects, round by round.
pub struct Rounds {
    /// Readings per subject and round, for one repetition.
    readings: Vec<Vec<Reading>>,
}

impl Subject<'_> {
    fn time(&self, clock: &Clock<'_>, repeats: u32) -> Result<Reading, LabError> {
        let reading = clock.time(&self.name, |encoder| {
            (0..repeats).try_for_each(|_| (self.record)(encoder))
        })?;
        Ok(Reading {
            seconds: reading.seconds / f64::from(repeats),
            wall: reading.wall / f64::from(repeats),
        })
    }

    /// Warms up, and finds how often the subject has to be repeated.
    fn repeats(&self, clock: &Clock<'_>) -> Result<u32, LabError> {
        let mut repeats = 1;
        self.time(clock, 1)?;
        while repeats < MOST_REPEATS {
            let reading = self.time(clock, repeats)?;
            if reading.seconds * f64::from(repeats) >= SHORTEST {
                break;
            }
            repeats *= 2;
        }
        Ok(repeats)
    }
}

impl Rounds {
    /// Times all subjects in each of `rounds` rounds, after a warm-up that is discarded. `progress` is called after each.
    pub fn run(
        clock: &Clock<'_>,
        subjects: &[Subject<'_>],
        rounds: u32,
        mut progress: impl FnMut(),
    ) -> Result<Self, LabError> {
        let repeats = subjects
            .iter()
            .map(|subject| subject.repeats(clock))
            .collect::<Result<Vec<_>, _>>()?;
        let mut readings = vec![Vec::new(); subjects.len()];
        for _ in 0..rounds.max(FEWEST_ROUNDS) {
            for ((subject, &repeats), readings) in subjects.iter().zip(&repeats).zip(&mut readings)
            {
                readings.push(subject.time(clock, repeats)?);
            }
            progress();
        }
        Ok(Self { readings })
    }

    /// The time of one subject or of several together, beside that of all their copies together.
    #[must_use]
    pub fn time(&self, parts: &[(usize, CopyNumbers)]) -> Time {
        let subjects: Vec<usize> = parts.iter().map(|(subject, _)| *subject).collect();
        let copies = |number: fn(&CopyNumbers) -> usize| -> Vec<usize> {
            parts.iter().map(|(_, copies)| number(copies)).collect()
        };
        let draws: Option<Vec<usize>> = parts.iter().map(|(_, copies)| copies.draw).collect();
        let seconds = self.summed(&subjects, |reading| reading.seconds);
        let wall = self.summed(&subjects, |reading| reading.wall);
        let x_compute_copy = self.ratio(&subjects, &copies(|copies| copies.compute));
        Time {
            x_compute_copy,
            x_api_copy: self.ratio(&subjects, &copies(|copies| copies.api)),
            x_draw_copy: draws.map(|draws| self.ratio(&subjects, &draws)),
            wall: Distribution::of(wall.iter().zip(&seconds).map(|(wall, clock)| wall / clock)),
            seconds: Distribution::of(seconds),
            reliable: x_compute_copy.reliable(),
        }
    }

    /// The time of some subjects together, in seconds by the clock.
    #[must_use]
    pub fn seconds(&self, subjects: &[usize]) -> Distribution {
        Distribution::of(self.summed(subjects, |reading| reading.seconds))
    }

    /// Some subjects' time as a ratio to that of others, both in the same round.
    #[must_use]
    pub fn ratio(&self, subjects: &[usize], to: &[usize]) -> Distribution {
        let [subjects, to] =
            [subjects, to].map(|subjects| self.summed(subjects, |reading| reading.seconds));
        Distribution::of(subjects.iter().zip(to).map(|(subject, to)| subject / to))
    }

    /// The sum of a figure over some subjects, per round.
    fn summed(&self, subjects: &[usize], figure: fn(&Reading) -> f64) -> Vec<f64> {
        let rounds = self.readings.first().map_or(0, Vec::len);
        let of = |subject: &usize, round: usize| {
            let reading = self.readings.get(*subject).and_then(|all| all.get(round));
            reading.map_or(f64::NAN, figure)
        };
        (0..rounds)
            .map(|round| subjects.iter().map(|subject| of(subject, round)).sum())
            .collect()
    }
}
