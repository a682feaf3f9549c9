//! What is shown of a scene with a softness: charts with fronts, a table, and the worst part of each technique's picture.

use super::super::Crop;
use super::super::chart::{self, Point};
use super::super::front::front;
use super::super::held_out::HeldOut;
use super::super::interval::prediction;
use super::super::journal::Finding;
use super::super::results::{Results, Row, SceneResults};

/// A scene with a softness.
pub(super) struct Section<'a> {
    pub scene: &'a str,
    /// The radius of the filter in texels of the largest map.
    pub radius: u32,
    pub charts: Vec<Chart>,
    /// Names of the series, in the order of their colours.
    pub series: Vec<String>,
    /// All rows, the least error first.
    pub rows: Vec<Line<'a>>,
    /// Whether what some views say holds for others.
    pub held_out: Option<HeldOut>,
    /// The worst parts of pictures, the least error first.
    pub crops: Vec<(&'a Row, &'a Crop)>,
}

/// A chart of errors against a cost.
pub(super) struct Chart {
    /// The name of its file, without the ending.
    pub name: String,
    pub svg: String,
    /// What it shows.
    pub caption: &'static str,
}

/// A row of the table.
pub(super) struct Line<'a> {
    pub row: &'a Row,
    /// The interval that the error of another view lies in with 90 %.
    pub interval: Option<[f64; 2]>,
    /// Which fronts it is on: by time, bytes and instructions.
    pub on_fronts: [bool; 3],
}

/// A cost by which rows are charted.
struct Cost {
    file: &'static str,
    axis: &'static str,
    caption: &'static str,
    of: fn(&Row) -> f64,
}

const COSTS: [Cost; 3] = [
    Cost {
        file: "time",
        axis: "time, in copies of 1024 x 1024 texels",
        caption: "Error against time: the map and the picture, in copies of a map of 64 bits per texel",
        of: |row| row.time.total.median,
    },
    Cost {
        file: "bytes",
        axis: "bytes of all textures and buffers",
        caption: "Error against memory",
        of: |row| row.bytes_resident as f64,
    },
    Cost {
        file: "isa",
        axis: "inverse throughput of the shader that shades",
        caption: "Error against instructions: a compiler's estimate for RDNA 2 of the cycles per pixel that shades",
        of: |row| {
            row.isa
                .map_or(f64::NAN, |isa| isa.inverse_throughput as f64)
        },
    },
];

/// A percentage of full shadow.
fn percent(error: Option<f64>) -> f64 {
    error.map_or(f64::NAN, |error| 100.0 * error)
}

/// Every scene with every softness.
pub(super) fn sections<'a>(results: &'a Results, findings: &'a [Finding]) -> Vec<Section<'a>> {
    let mut sections = Vec::new();
    for scene in &results.scenes {
        for &radius in &results.setting.axes.radii {
            let rows: Vec<&Row> = (scene.rows.iter())
                .filter(|row| row.cell.radius == radius)
                .collect();
            if !rows.is_empty() {
                sections.push(section(scene, radius, &rows, findings));
            }
        }
    }
    sections
}

fn section<'a>(
    scene: &'a SceneResults,
    radius: u32,
    rows: &[&'a Row],
    findings: &'a [Finding],
) -> Section<'a> {
    // Settings that follow from a storage are no series of their own.
    let mut names: Vec<String> = Vec::new();
    for name in rows.iter().map(|row| first_word(&row.name)) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let points = |cost: &Cost| -> Vec<Point> {
        let point = |row: &&Row| Point {
            at: [(cost.of)(row), percent(row.error())],
            series: names
                .iter()
                .position(|name| *name == first_word(&row.name))
                .unwrap_or(0),
            told: told(row),
            label: format!("{} {}", first_word(&row.name), stored(row)),
        };
        rows.iter().map(point).collect()
    };
    let chart = |cost: &Cost| Chart {
        name: format!("front-{}-{radius}-{}", file_name(&scene.scene), cost.file),
        svg: chart::svg(&points(cost), [cost.axis, "mean absolute error, percent"]),
        caption: cost.caption,
    };
    let on_front = |cost: &Cost| {
        let figures = |row: &&Row| [(cost.of)(row), percent(row.error())];
        front(&Vec::from_iter(rows.iter().map(figures)))
    };
    let fronts = COSTS.each_ref().map(on_front);
    let mut lines: Vec<Line> = (rows.iter().enumerate())
        .map(|(number, row)| Line {
            row,
            interval: prediction(&row.errors()),
            on_fronts: fronts.each_ref().map(|front| front.contains(&number)),
        })
        .collect();
    lines.sort_by(|one, other| {
        let error = |line: &Line| line.row.error().unwrap_or(f64::INFINITY);
        error(one).total_cmp(&error(other))
    });
    let crop_of = |line: &Line<'a>| {
        findings.iter().find_map(|finding| match finding {
            Finding::Row {
                scene: of,
                row,
                crop,
            } if *of == scene.scene && **row == *line.row => Some((line.row, crop.as_ref()?)),
            _ => None,
        })
    };
    Section {
        scene: &scene.scene,
        radius,
        charts: COSTS.iter().map(chart).collect(),
        held_out: HeldOut::of(&[(scene, radius)]),
        crops: lines.iter().filter_map(crop_of).collect(),
        series: names,
        rows: lines,
    }
}

/// A technique without its settings.
fn first_word(name: &str) -> String {
    name.split(' ').next().unwrap_or_default().to_owned()
}

/// The storage and the map of a row.
pub(super) fn stored(row: &Row) -> String {
    let storage = row.storage.map_or("depth", |storage| storage.name());
    format!("{storage} {}²", row.cell.map)
}

fn told(row: &Row) -> String {
    let error = percent(row.error());
    format!(
        "{}, {}, {} samples: error {error:.3} %, time {:.2}, {} bytes",
        row.name,
        stored(row),
        row.cell.samples,
        row.time.total.median,
        row.bytes_resident
    )
}

/// A scene's name as files have it.
fn file_name(scene: &str) -> String {
    let stem = std::path::Path::new(scene).file_stem();
    let stem = stem.map_or(String::new(), |stem| stem.to_string_lossy().into_owned());
    stem.replace(|letter: char| !letter.is_alphanumeric(), "-")
}
