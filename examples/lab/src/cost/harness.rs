//! The one way to a row: a subject whose result is right is timed in turn with copies of what it writes.

use moment_shadows_graph::TextureDesc;

use super::clock::Clock;
use super::copies::{Copies, CopyWork, storable};
use super::protocol::{CopyNumbers, Record, Rounds, Subject};
use super::statistics::Distribution;
use super::table::{Facts, Gate, Row};
use crate::error::LabError;
use crate::gpu::Gpu;

/// How far a result is from its reference in double precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// The largest difference; NaN where the result is.
    pub error: f64,
    /// What rounding explains.
    pub tolerance: f64,
}

/// Something that can be timed and judged.
pub struct Case {
    /// What errors call it.
    pub name: String,
    /// What tells it from others in the table.
    pub facts: Facts,
    /// Records it once.
    pub record: Record<'static>,
    /// What it writes and copies are made of.
    pub written: Vec<TextureDesc>,
    /// Whether it dispatches or draws.
    pub work: CopyWork,
    /// Bytes that it reads and writes, each texel once.
    pub bytes: [u64; 2],
    /// How far its result is from the reference; none where there is no reference.
    pub difference: Option<Difference>,
    /// What it may cost on a software adapter.
    pub gate: Gate,
}

/// Cases that were timed in the same rounds.
pub struct Measured {
    /// A row per case.
    pub rows: Vec<Row>,
    /// What all cases write.
    written: Vec<TextureDesc>,
    times: Rounds,
    /// The number of each case and those of its copies.
    numbers: Vec<(usize, CopyNumbers)>,
}

impl Difference {
    /// The difference between numbers in pairs, as many as there should be; NaN if one of them is, or if there are others.
    #[must_use]
    pub fn of(
        found: impl ExactSizeIterator<Item = f64>,
        expected: impl ExactSizeIterator<Item = f64>,
        tolerance: f64,
    ) -> Self {
        let counts = if found.len() == expected.len() {
            0.0
        } else {
            f64::NAN
        };
        let differences = found.zip(expected).map(|(one, other)| (one - other).abs());
        Self {
            error: differences.fold(counts, largest),
            tolerance,
        }
    }

    /// The one with the larger error; that with NaN if one is.
    #[must_use]
    pub fn worse(self, other: Self) -> Self {
        if other.error.is_nan() || other.error > self.error {
            other
        } else {
            self
        }
    }

    /// The error of a right result.
    pub fn accepted(self, what: &str) -> Result<f64, LabError> {
        let Self { error, tolerance } = self;
        // Not NaN, either.
        if error <= tolerance {
            return Ok(error);
        }
        Err(LabError::WrongResult {
            what: what.to_owned(),
            error,
            tolerance,
        })
    }
}

/// The larger of two differences; NaN if one of them is, which `f64::max` would drop.
pub(super) fn largest(one: f64, other: f64) -> f64 {
    if one.is_nan() || one > other {
        one
    } else {
        other
    }
}

impl Measured {
    /// Refuses cases whose results are wrong, and times the others beside copies. `progress` is called after each round.
    pub fn of(
        clock: &Clock<'_>,
        cases: &[Case],
        rounds: u32,
        progress: impl FnMut(),
    ) -> Result<Self, LabError> {
        let mut copies = CopySets::default();
        let (mut errors, mut copy_numbers) = (Vec::new(), Vec::new());
        for case in cases {
            let accepted = |difference: Difference| difference.accepted(&case.name);
            errors.push(case.difference.map(accepted).transpose()?);
            copy_numbers.push(copies.numbers(clock.gpu(), &case.written, case.work)?);
        }
        let mut subjects = copies.subjects();
        let numbers: Vec<_> = (subjects.len()..).zip(copy_numbers).collect();
        subjects.extend(cases.iter().map(|case| Subject {
            name: case.name.clone(),
            record: Box::new(|encoder| (case.record)(encoder)),
        }));
        let times = Rounds::run(clock, &subjects, rounds, progress)?;
        let rows = cases.iter().zip(errors).zip(&numbers);
        Ok(Self {
            rows: rows
                .map(|((case, error), &(subject, copies))| {
                    let time = times.time(&[(subject, copies)]);
                    let name = (case.name.clone(), case.facts.clone());
                    Row {
                        work: case.work,
                        error,
                        gate: case.gate,
                        ..Row::new(name, &case.written, case.bytes, time)
                    }
                })
                .collect(),
            written: cases.iter().flat_map(|case| case.written.clone()).collect(),
            times,
            numbers,
        })
    }

    /// The row of all cases together, beside all their copies.
    #[must_use]
    pub fn total(&self) -> Row {
        let sum = |bytes: fn(&Row) -> u64| self.rows.iter().map(bytes).sum();
        let bytes = [sum(|row| row.bytes_read), sum(|row| row.bytes_written)];
        let name = ("total".to_owned(), Facts(vec![("pass", "total".into())]));
        let time = self.times.time(&self.numbers);
        Row {
            texture: String::new(),
            ..Row::new(name, &self.written, bytes, time)
        }
    }

    /// A row's time as a ratio to another's in the same round.
    #[must_use]
    pub fn ratio(&self, row: usize, to: usize) -> Distribution {
        let number = |row: usize| Vec::from_iter(self.numbers.get(row).map(|number| number.0));
        self.times.ratio(&number(row), &number(to))
    }
}

/// The copies of several cases, each set of textures only once.
#[derive(Default)]
struct CopySets(Vec<(Vec<TextureDesc>, CopyWork, Copies)>);

impl CopySets {
    /// The numbers of the subjects that copy these textures: two per set, by a shader and by the interface.
    fn numbers(
        &mut self,
        gpu: &Gpu,
        written: &[TextureDesc],
        work: CopyWork,
    ) -> Result<CopyNumbers, LabError> {
        let storable: Vec<TextureDesc> = written.iter().map(storable).collect();
        let compute = self.number(gpu, &storable, CopyWork::Compute)?;
        let draw = match work {
            CopyWork::Compute => None,
            CopyWork::Fullscreen => Some(self.number(gpu, written, CopyWork::Fullscreen)?),
        };
        Ok(CopyNumbers {
            compute,
            api: compute + 1,
            draw,
        })
    }

    fn number(
        &mut self,
        gpu: &Gpu,
        descs: &[TextureDesc],
        work: CopyWork,
    ) -> Result<usize, LabError> {
        let same = |set: &(Vec<TextureDesc>, CopyWork, Copies)| set.0 == descs && set.1 == work;
        if let Some(set) = self.0.iter().position(same) {
            return Ok(2 * set);
        }
        self.0
            .push((descs.to_vec(), work, Copies::new(gpu, descs, work)?));
        Ok(2 * self.0.len() - 2)
    }

    fn subjects(&self) -> Vec<Subject<'_>> {
        let mut subjects = Vec::new();
        for (_, work, copies) in &self.0 {
            for (by, record) in [
                ("shader", copies.by_shader()),
                ("interface", copies.by_interface()),
            ] {
                let name = format!("{work:?} copy by the {by}");
                subjects.push(Subject { name, record });
            }
        }
        subjects
    }
}
