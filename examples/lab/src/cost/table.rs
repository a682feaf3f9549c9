//! What subjects cost: rows of one kind, whatever is measured, as text and as JSON.

use core::fmt;

use moment_shadows_graph::TextureDesc;
use serde::{Serialize, Serializer};
use serde_json::Value;

use super::bandwidth::TimeBound;
use super::clock::ClockKind;
use super::copies::CopyWork;
use super::report::{Conditions, Time, mark, mebibytes, percent};

/// The size that growth is measured from.
pub const FROM: u32 = 512;

/// A pass that writes fewer texels costs what submitting it does, and little besides.
pub const FEWEST_TEXELS: u64 = 64 * 64;

/// What tells a subject from others and is known without timing it: each a column of the table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facts(pub Vec<(&'static str, Value)>);

/// A cell of a table's text, after the name of its column.
pub(crate) type Cell<'a> = (&'a str, String);

/// What a subject may cost on a software adapter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Gate {
    /// Compute copies; beyond them the command fails.
    pub gate: Option<f64>,
    /// Compute copies that are aimed at.
    pub goal: Option<f64>,
    /// Time per texel, as a multiple of that at [`FROM`] texels per side; beyond it the command fails.
    pub largest_growth: Option<f64>,
}

/// What a subject costs.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// What errors call the subject.
    #[serde(skip)]
    pub name: String,
    /// What tells it from others.
    #[serde(flatten)]
    pub facts: Facts,
    /// The textures that it writes; the copies are of as many bytes.
    pub texture: String,
    /// Whether it dispatches or draws.
    pub work: CopyWork,
    /// Whether it writes fewer than 64x64 texels, so that beginning a pass weighs more than the work.
    pub small: bool,
    /// Texels that it writes, of one layer.
    pub texels: u64,
    /// The time.
    pub time: Time,
    /// Bytes read, each texel once.
    pub bytes_read: u64,
    /// Bytes written.
    pub bytes_written: u64,
    /// The least that it moves: both of the above.
    pub minimum_bytes: u64,
    /// Minimum bytes per texel written.
    pub bytes_per_texel: f64,
    /// Minimum bytes per second, as a part of the bytes per second of the copy by a dispatch.
    pub efficiency: f64,
    /// How far the result is from the reference in f64; none where there is no reference.
    pub error: Option<f64>,
    /// Its bounds, where they hold.
    #[serde(flatten)]
    pub gate: Gate,
    /// Time per texel as a multiple of that at [`FROM`] texels per side, if that was measured.
    pub growth: Option<f64>,
    /// The least time that moving its bytes takes, per memory.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub bounds: Vec<TimeBound>,
}

/// What a list of subjects costs.
#[derive(Clone, Debug, Serialize)]
pub struct CostTable {
    /// Where and how the subjects were measured.
    pub conditions: Conditions,
    /// What is measured.
    pub title: &'static str,
    /// Texels per side of the largest map.
    pub size: u32,
    /// A row per size and subject.
    pub rows: Vec<Row>,
    /// Whether gates hold here: on software adapters.
    pub bounded: bool,
}

impl Facts {
    fn cells(&self) -> impl Iterator<Item = Cell<'_>> {
        self.0.iter().map(|(name, value)| match value {
            Value::String(text) => (*name, text.clone()),
            _ => (*name, value.to_string()),
        })
    }

    fn size(&self) -> u32 {
        let size = self.0.iter().find(|(name, _)| *name == "size");
        size.and_then(|(_, size)| size.as_u64()).unwrap_or(0) as u32
    }
}

impl Serialize for Facts {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

impl Row {
    /// The row of something by its name that writes these textures, without a bound or a reference.
    #[must_use]
    pub fn new(
        (name, facts): (String, Facts),
        written: &[TextureDesc],
        [bytes_read, bytes_written]: [u64; 2],
        time: Time,
    ) -> Self {
        let minimum_bytes = bytes_read + bytes_written;
        let copied: u64 = written.iter().map(|desc| 2 * desc.bytes()).sum();
        let plane = |desc: &TextureDesc| u64::from(desc.size[0]) * u64::from(desc.size[1]);
        let plane: u64 = written.iter().map(plane).sum();
        let textures: Vec<String> = written.iter().map(ToString::to_string).collect();
        Self {
            name,
            facts,
            texture: between(&textures, " .. "),
            work: CopyWork::Compute,
            small: written.iter().all(|desc| texels(desc) < FEWEST_TEXELS),
            texels: plane,
            efficiency: minimum_bytes as f64 / copied as f64 / time.x_compute_copy.median,
            time,
            bytes_read,
            bytes_written,
            minimum_bytes,
            bytes_per_texel: minimum_bytes as f64 / plane as f64,
            error: None,
            gate: Gate::default(),
            growth: None,
            bounds: Vec::new(),
        }
    }

    /// Nanoseconds per texel.
    #[must_use]
    pub fn nanoseconds_per_texel(&self) -> f64 {
        1e9 * self.time.seconds.median / self.texels as f64
    }

    /// Whether the time is within its bounds, if it has any.
    #[must_use]
    pub fn passed(&self) -> bool {
        let Gate {
            gate,
            largest_growth,
            ..
        } = self.gate;
        let within = |figure: Option<f64>, bound: Option<f64>| match (figure, bound) {
            (Some(figure), Some(bound)) => figure <= bound,
            _ => true,
        };
        within(Some(self.time.x_compute_copy.median), gate) && within(self.growth, largest_growth)
    }

    /// The columns of times, with their names.
    pub(super) fn times(&self, clock: ClockKind) -> Vec<Cell<'_>> {
        let some = |figure: Option<f64>| figure.map_or("-".to_owned(), |it| it.to_string());
        let figure = |figure: Option<f64>| figure.map_or("-".to_owned(), |it| format!("{it:.2}"));
        let verdict = match (self.gate == Gate::default(), self.passed()) {
            (true, _) => "",
            (false, true) => "ok",
            (false, false) => "gate missed",
        };
        let small = if self.small { "small" } else { "" };
        let marks = [verdict, mark(&self.time, clock), small];
        let marks = marks.into_iter().filter(|mark| !mark.is_empty());
        let measures = [
            ("writes", self.texture.clone()),
            ("x compute", figure(Some(self.time.x_compute_copy.median))),
            ("IQR", percent(self.time.x_compute_copy.spread())),
            ("x API", figure(Some(self.time.x_api_copy.median))),
            (
                "x draw",
                figure(self.time.x_draw_copy.map(|draw| draw.median)),
            ),
            ("efficiency", percent(self.efficiency)),
            ("ns/texel", figure(Some(self.nanoseconds_per_texel()))),
            ("B/texel", format!("{:.1}", self.bytes_per_texel)),
            ("growth", figure(self.growth)),
            (
                "most",
                some(self.gate.largest_growth.filter(|_| self.growth.is_some())),
            ),
            ("gate", some(self.gate.gate)),
            ("goal", some(self.gate.goal)),
            (
                "error",
                self.error
                    .map_or("-".to_owned(), |error| format!("{error:.1e}")),
            ),
            ("", marks.collect::<Vec<_>>().join(", ")),
        ];
        self.facts.cells().chain(measures).collect()
    }

    /// The columns of bytes, with their names.
    pub(super) fn bytes(&self) -> Vec<Cell<'_>> {
        let bytes = [
            ("read", mebibytes(self.bytes_read)),
            ("written", mebibytes(self.bytes_written)),
            ("moved", mebibytes(self.minimum_bytes)),
        ];
        let bound = |bound: &'_ TimeBound| format!("{:.1} us", bound.microseconds);
        let bounds = self.bounds.iter();
        let bounds = bounds.map(|it| (it.memory.as_str(), bound(it)));
        let all = bytes.into_iter().chain(bounds);
        self.facts.cells().chain(all).collect()
    }
}

impl CostTable {
    /// The rows of all sizes, with their growth. Gates hold where processor time is measured.
    #[must_use]
    pub fn new(conditions: Conditions, title: &'static str, mut rows: Vec<Row>) -> Self {
        let bounded = conditions.clock == ClockKind::ProcessTime;
        let from: Vec<(String, f64)> = rows
            .iter()
            .filter(|row| row.facts.size() == FROM)
            .map(|row| (row.name.clone(), row.nanoseconds_per_texel()))
            .collect();
        for row in &mut rows {
            let first = from.iter().find(|(name, _)| *name == row.name);
            row.growth = first
                .filter(|_| row.facts.size() >= FROM)
                .map(|(_, first)| row.nanoseconds_per_texel() / first);
            if !bounded {
                row.gate = Gate::default();
            }
        }
        Self {
            title,
            size: rows.iter().map(|row| row.facts.size()).max().unwrap_or(0),
            rows,
            bounded,
            conditions,
        }
    }

    /// Whether every row is within its bounds, if it has any.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.rows.iter().all(Row::passed)
    }
}

impl fmt::Display for CostTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}\n{}", self.conditions, self.title)?;
        let clock = self.conditions.clock;
        let rows: Vec<_> = self.rows.iter().map(|row| row.times(clock)).collect();
        columns(f, &rows)?;
        writeln!(
            f,
            "\nok: on a software adapter at most the gate in compute copies, and from {FROM} texels per side on at most so many \
             times\nthe time per texel. {LEGEND}"
        )
    }
}

/// What the columns of times mean.
pub(super) const LEGEND: &str = "x compute: the median ratio to a copy of as many bytes as are written, by a dispatch of 64x1 workgroups in \
the\nsame round; x API: to one by copy_texture_to_texture; x draw: to one by a fullscreen draw. efficiency: minimum bytes per second\n\
as a part of the compute copy's. error: the largest difference from the reference in f64, for shading the mean one. small: fewer\nthan 64x64 \
texels, where beginning a pass weighs more than the work.";

/// All texels of a texture's first mip level.
pub(super) fn texels(desc: &TextureDesc) -> u64 {
    desc.size.map(u64::from).iter().product::<u64>() * u64::from(desc.layers)
}

/// The first and the last of some texts, or the only one.
pub(super) fn between(texts: &[String], joint: &str) -> String {
    match texts {
        [] => String::new(),
        [only] => only.clone(),
        [first, .., last] => format!("{first}{joint}{last}"),
    }
}

/// Rows of named cells below their names, words to the left and figures to the right; a column without a figure is left out.
pub(crate) struct Columns<'a>(pub(crate) &'a [Vec<Cell<'a>>]);

impl fmt::Display for Columns<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        columns(f, self.0)
    }
}

/// Writes [`Columns`].
pub(crate) fn columns(f: &mut fmt::Formatter<'_>, rows: &[Vec<Cell<'_>>]) -> fmt::Result {
    let Some(first) = rows.first() else {
        return Ok(());
    };
    let cells = |column: usize| rows.iter().filter_map(move |row| row.get(column));
    let shown: Vec<(usize, usize)> = (0..first.len())
        .filter(|&column| cells(column).any(|(_, cell)| cell != "-"))
        .map(|column| {
            let widths = cells(column).flat_map(|(name, cell)| [name.len(), cell.len()]);
            (column, widths.max().unwrap_or(0))
        })
        .collect();
    let names = first
        .iter()
        .map(|(name, _)| (*name, (*name).to_owned()))
        .collect();
    for row in std::iter::once(&names).chain(rows) {
        let line: Vec<String> = shown
            .iter()
            .filter_map(|&(column, width)| {
                let words = first
                    .get(column)?
                    .1
                    .starts_with(|letter: char| letter.is_alphabetic());
                let (_, cell) = row.get(column)?;
                Some(if words {
                    format!("{cell:<width$}")
                } else {
                    format!("{cell:>width$}")
                })
            })
            .collect();
        writeln!(f, "{}", line.join("  ").trim_end())?;
    }
    Ok(())
}
