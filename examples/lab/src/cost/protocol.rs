//! Rounds: every subject in turn, so that whatever else the machine does meets all of them alike.

use super::CostError;
use super::clock::{Clock, Reading};
use super::report::Time;
use super::statistics::Distribution;

/// Fewer rounds give no distribution.
pub const FEWEST_ROUNDS: u32 = 9;

/// A subject is repeated within one submission until it takes this long: shorter ones drown in the cost of submitting.
const SHORTEST: f64 = 1e-3;

/// The most repetitions within one submission.
const MOST_REPEATS: u32 = 1024;

/// What records a subject once.
pub type Record<'a> = Box<dyn Fn(&mut wgpu::CommandEncoder) -> Result<(), CostError> + 'a>;

/// Something whose time is taken.
pub struct Subject<'a> {
    /// Its name.
    pub name: String,
    /// Records it once.
    pub record: Record<'a>,
}

/// Times of all subjects, round by round.
pub struct Rounds {
    /// Per subject and round, for one repetition.
    readings: Vec<Vec<Reading>>,
}

impl Subject<'_> {
    fn time(&self, clock: &Clock<'_>, repeats: u32) -> Result<Reading, CostError> {
        let reading = clock.time(&self.name, |encoder| {
            (0..repeats).try_for_each(|_| (self.record)(encoder))
        })?;
        Ok(Reading {
            seconds: reading.seconds / f64::from(repeats),
            wall: reading.wall / f64::from(repeats),
        })
    }

    /// Warms up, and finds how often the subject has to be repeated.
    fn repeats(&self, clock: &Clock<'_>) -> Result<u32, CostError> {
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
    ) -> Result<Self, CostError> {
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

    /// A subject's time, beside that of the subjects that are its copies by a shader and by the interface.
    #[must_use]
    pub fn time(&self, subject: usize, [shader_copy, interface_copy]: [usize; 2]) -> Time {
        let of_reading =
            |figure: fn(&Reading) -> f64| Distribution::of(self.of(subject).iter().map(figure));
        let x_shader_copy = self.ratio(subject, shader_copy);
        Time {
            x_shader_copy,
            x_interface_copy: self.ratio(subject, interface_copy),
            seconds: of_reading(|reading| reading.seconds),
            wall: of_reading(|reading| reading.wall / reading.seconds),
            reliable: x_shader_copy.reliable(),
        }
    }

    fn ratio(&self, subject: usize, to: usize) -> Distribution {
        Distribution::of(
            self.of(subject)
                .iter()
                .zip(self.of(to))
                .map(|(subject, to)| subject.seconds / to.seconds),
        )
    }

    fn of(&self, subject: usize) -> &[Reading] {
        self.readings.get(subject).map_or(&[], Vec::as_slice)
    }
}
