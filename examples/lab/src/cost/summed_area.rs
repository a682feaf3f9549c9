//! What summed-area tables cost: both tiles of the node, and the usual way, at several sizes.

use core::fmt;

use moment_shadows::{MapEncoding, MapRegion, Storage, Technique};
use moment_shadows_graph::nodes::LargestKernel;
use moment_shadows_graph::record::Layers;
use moment_shadows_graph::{Capabilities, TextureDesc};
use serde::Serialize;

use super::CostError;
use super::baseline::{Copies, CopyWork};
use super::clock::{Clock, ClockKind};
use super::protocol::{CopyNumbers, Rounds, Subject};
use super::report::{Conditions, Time, mark, percent};
use super::texels::{encode, noise};
use crate::gpu::Gpu;
use crate::summed_area::{NaiveTable, SummedMap, reference};

/// What the node may cost on a software adapter, in compute copies of its table.
pub const GATE: f64 = 3.5;

/// What is aimed at.
pub const GOAL: f64 = 2.3;

/// Time per texel at the largest size, at most this many times that at [`FROM`].
pub const LARGEST_GROWTH: f64 = 1.3;

/// The size that growth is measured from.
pub const FROM: u32 = 512;

/// The sizes that are measured.
pub const SIZES: [u32; 6] = [256, 512, 1024, 2048, 4096, 8192];

/// Ways to make a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// The node with the tiles for software adapters.
    SoftwareTiles,
    /// The node with the tiles for graphics cards.
    HardwareTiles,
    /// A row, then a column, per invocation.
    Naive,
}

/// What a method costs at a size.
#[derive(Clone, Debug, Serialize)]
pub struct TableRow {
    /// Texels per side.
    pub size: u32,
    /// How the table is made.
    pub method: Method,
    /// The time.
    pub time: Time,
    /// Bytes that all passes move per texel.
    pub bytes_per_texel: f64,
    /// Invocations of the passes over texels.
    pub invocations: u64,
    /// Time per texel as a multiple of that at [`FROM`], if that was measured.
    pub growth: Option<f64>,
    /// Whether the node makes its tables like this on this device.
    pub chosen: bool,
}

/// What tables cost.
#[derive(Clone, Debug, Serialize)]
pub struct TableCost {
    /// Where and how.
    pub conditions: Conditions,
    /// By size, then by method.
    pub rows: Vec<TableRow>,
    /// Whether the bounds hold here: on software adapters.
    pub bounded: bool,
}

impl Method {
    const ALL: [Method; 3] = [Method::SoftwareTiles, Method::HardwareTiles, Method::Naive];

    fn name(self) -> &'static str {
        match self {
            Method::SoftwareTiles => "tiles of 16x16",
            Method::HardwareTiles => "tiles of 8x16",
            Method::Naive => "naive",
        }
    }

    fn invocations(self, size: u32) -> u64 {
        let [across, down] = match self {
            Method::SoftwareTiles => [16, 16],
            Method::HardwareTiles => [8, 16],
            Method::Naive => [size, 1],
        };
        u64::from(size.div_ceil(across)) * u64::from(size.div_ceil(down))
    }
}

/// Makes and checks tables of a map of noise, then times them in turn with copies of a table.
pub fn rows(
    gpu: &Gpu,
    clock: &Clock<'_>,
    size: u32,
    rounds: u32,
) -> Result<Vec<TableRow>, CostError> {
    let source = MapEncoding::new(Technique::Hamburger4, Storage::Unorm16)?;
    let bytes = encode(
        source.storage(),
        &noise(source.storage(), (size * size) as usize),
    );
    let desc = TextureDesc::of_map(source.clone(), [size; 2]);
    let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
    let tiles = [true, false].map(|software_adapter| {
        let capabilities = Capabilities {
            software_adapter,
            ..capabilities.clone()
        };
        SummedMap::new(gpu, &capabilities, &desc, &bytes, LargestKernel::default())
    });
    let [software, hardware] = tiles;
    let tiles = [software?, hardware?];
    let naive = NaiveTable::new(gpu, &desc, &bytes)?;
    let integers: Vec<u32> = bytes
        .chunks_exact(2)
        .map(|pair| u32::from(u16::from_le_bytes([pair[0], pair[1]])))
        .collect();
    let whole = MapRegion::new([0; 2], [size; 2]);
    let expected = reference::table(&integers, 4, size as usize, &[whole]);
    for (summed, method) in tiles.iter().zip(Method::ALL) {
        summed.run(gpu, Layers::All)?;
        check(method, size, &summed.read(gpu, 0)?, &expected)?;
    }
    check(Method::Naive, size, &naive.run(gpu)?, &expected)?;
    let bytes_per_texel = Method::ALL.map(|method| {
        let texels = f64::from(size) * f64::from(size);
        match method {
            Method::SoftwareTiles => tiles[0].bytes_moved() as f64 / texels,
            Method::HardwareTiles => tiles[1].bytes_moved() as f64 / texels,
            Method::Naive => f64::from(NaiveTable::bytes_per_texel()),
        }
    });
    let format = moment_shadows::TextureFormat::Rgba32Uint;
    let copies = Copies::new(gpu, &TextureDesc::new(format, [size; 2]), CopyWork::Compute)?;
    let mut subjects = vec![
        Subject {
            name: "compute copy".to_owned(),
            record: copies.by_shader(),
        },
        Subject {
            name: "interface copy".to_owned(),
            record: copies.by_interface(),
        },
    ];
    subjects.extend(
        tiles
            .iter()
            .zip(Method::ALL)
            .map(|(summed, method)| Subject {
                name: method.name().to_owned(),
                record: Box::new(|encoder| Ok(summed.record(encoder, Layers::All)?)),
            }),
    );
    subjects.push(Subject {
        name: Method::Naive.name().to_owned(),
        record: Box::new(|encoder| {
            naive.record(encoder);
            Ok(())
        }),
    });
    let times = Rounds::run(clock, &subjects, rounds, || ())?;
    let copies = CopyNumbers {
        compute: 0,
        api: 1,
        draw: None,
    };
    let rows = (2..).zip(Method::ALL).zip(bytes_per_texel);
    Ok(rows
        .map(|((subject, method), bytes_per_texel)| TableRow {
            size,
            method,
            time: times.time(subject, copies),
            bytes_per_texel,
            invocations: method.invocations(size),
            growth: None,
            chosen: (method == Method::SoftwareTiles) == capabilities.software_adapter
                && method != Method::Naive,
        })
        .collect())
}

fn check(method: Method, size: u32, found: &[u32], expected: &[u32]) -> Result<(), CostError> {
    if found == expected {
        return Ok(());
    }
    let differences = found
        .iter()
        .zip(expected)
        .map(|(one, other)| one.abs_diff(*other));
    Err(CostError::WrongResult {
        what: format!("{} of {size}x{size}", method.name()),
        error: f64::from(differences.max().unwrap_or(0)),
        tolerance: 0.0,
    })
}

impl TableRow {
    fn nanoseconds_per_texel(&self) -> f64 {
        1e9 * self.time.seconds.median / (f64::from(self.size) * f64::from(self.size))
    }

    /// Whether the time, if the node makes its tables like this, is within the bounds of software adapters.
    #[must_use]
    pub fn passed(&self) -> bool {
        !self.chosen
            || (self.time.x_compute_copy.median <= GATE
                && self.growth.is_none_or(|growth| growth <= LARGEST_GROWTH))
    }
}

impl TableCost {
    /// The rows of all sizes, with their growth.
    #[must_use]
    pub fn new(conditions: Conditions, mut rows: Vec<TableRow>, kind: ClockKind) -> Self {
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
            conditions,
            rows,
            bounded: kind == ClockKind::ProcessTime,
        }
    }

    /// Whether every row is within its bounds; true where there are none.
    #[must_use]
    pub fn passed(&self) -> bool {
        !self.bounded || self.rows.iter().all(TableRow::passed)
    }
}

impl fmt::Display for TableCost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.conditions)?;
        writeln!(
            f,
            "summed-area table of rgba16unorm, in copies of the table, rgba32uint"
        )?;
        writeln!(
            f,
            "{:>5} {:<15} {:>7} {:>6} {:>7} {:>9} {:>7} {:>8} {:>11}",
            "size", "", "x copy", "IQR", "x API", "ns/texel", "growth", "B/texel", "invocations"
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
                "{:>5} {:<15} {:>7.2} {:>6} {:>7.2} {:>9.2} {:>7} {:>8.1} {:>11}{verdict}{}",
                row.size,
                row.method.name(),
                row.time.x_compute_copy.median,
                percent(row.time.x_compute_copy.spread()),
                row.time.x_api_copy.median,
                row.nanoseconds_per_texel(),
                growth,
                row.bytes_per_texel,
                row.invocations,
                mark(&row.time, self.conditions.clock),
            )?;
        }
        writeln!(
            f,
            "\nok: at most {GATE} copies on a software adapter (goal {GOAL}), and from {FROM} texels per side on at most {LARGEST_GROWTH} \
             times the time per texel"
        )
    }
}
