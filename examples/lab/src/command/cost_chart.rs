//! `moment-shadows-lab cost-chart`: what a graph costs over the size of its map, the size of the picture and the radius of its kernel.

mod panels;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

use serde::Serialize;
use serde_json::Value;

use super::CommandResult;
use crate::cost::statistics::Distribution;
use crate::cost::table::{Cell, Columns};
use crate::error::LabError;
use crate::graph_file::GraphFile;
use crate::picture::{create_folder, save_atomically};
use crate::progress;

/// What is charted.
#[derive(Clone, Debug, clap::Args)]
pub struct Options {
    /// A graph file with a blur and hard shadows, one view of one light.
    graph: PathBuf,
    /// A folder for `cost.svg`, `cost.png` and `cost.json`; it is made if need be.
    #[arg(long)]
    out: PathBuf,
    /// Another build of this command, which times the same graphs in turn with this one.
    #[arg(long, value_name = "LAB")]
    before: Option<PathBuf>,
    /// How often each of both builds times each graph, in turn.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=100))]
    runs: u32,
    /// Rounds of a run, at least 9.
    #[arg(long, default_value_t = 9, value_parser = clap::value_parser!(u32).range(9..=1000))]
    rounds: u32,
}

/// Texels per side, widths of the picture and radii that are timed; the others are as the file has them meanwhile.
const MAPS: [u32; 3] = [512, 1024, 2048];
const WIDTHS: [u32; 3] = [640, 1280, 1920];
const RADII: [u32; 4] = [2, 4, 8, 12];

/// One graph on one build.
struct Subject<'a> {
    label: &'static str,
    program: &'a Path,
    file: &'a GraphFile,
}

/// What a graph costs with one size or radius.
#[derive(Clone, Debug, Serialize)]
struct Point {
    /// Of which panel it is.
    over: &'static str,
    /// Texels per side, width or radius.
    value: u32,
    /// Which build and graph.
    subject: &'static str,
    /// Milliseconds of all that is made of the light's depth.
    map: f64,
    /// Milliseconds of shading.
    pixels: f64,
}

impl Options {
    /// Times all, prints the figures and draws the chart.
    pub fn run(self) -> CommandResult {
        create_folder(&self.out)?;
        let apart = GraphFile::read(&self.graph, None)?;
        let joined = apart.resolved_by_the_blur()?;
        let own = std::env::current_exe().map_err(|error| LabError::refused(error.to_string()))?;
        let this = |label, file| Subject {
            label,
            program: &own,
            file,
        };
        let mut subjects = vec![
            this("this build", &apart),
            this("this build, resolved by the blur", &joined),
        ];
        if let Some(program) = &self.before {
            let before = Subject {
                label: "before",
                program,
                file: &apart,
            };
            subjects.insert(0, before);
        }
        let points = self.points(&subjects)?;
        print!("{}", Columns(&rows(&points)));
        save_atomically(&self.out.join("cost.json"), |file| {
            serde_json::to_writer_pretty(&mut *file, &points)?;
            file.write_all(b"\n")
        })?;
        panels::chart(&points, &subjects).save(&self.out, "cost")?;
        Ok(ExitCode::SUCCESS)
    }

    fn points(&self, subjects: &[Subject<'_>]) -> Result<Vec<Point>, LabError> {
        let over = [
            ("texels per side of the map", &MAPS[..]),
            ("width of the picture", &WIDTHS[..]),
            ("radius of the kernel", &RADII[..]),
        ];
        let count: usize = over.iter().map(|(_, values)| values.len()).sum();
        let bar = progress::bar(u64::from(self.runs) * count as u64, "timing");
        let mut points = Vec::new();
        for (over, value) in over
            .iter()
            .flat_map(|(over, values)| values.iter().map(|it| (*over, *it)))
        {
            let mut times = vec![[Vec::new(), Vec::new()]; subjects.len()];
            for _ in 0..self.runs {
                for (subject, times) in subjects.iter().zip(&mut times) {
                    let found = self.time(subject, over, value)?;
                    times
                        .iter_mut()
                        .zip(found)
                        .for_each(|(times, time)| times.push(time));
                }
                bar.inc(1);
            }
            for (subject, times) in subjects.iter().zip(times) {
                let [map, pixels] = times.map(|times| 1e3 * Distribution::of(times).median);
                points.push(Point {
                    over,
                    value,
                    subject: subject.label,
                    map,
                    pixels,
                });
            }
        }
        bar.finish_and_clear();
        Ok(points)
    }

    /// Seconds of what is made of the light's depth, and of shading, by a process of its own.
    fn time(&self, subject: &Subject<'_>, over: &str, value: u32) -> Result<[f64; 2], LabError> {
        let file = match over.split(' ').next() {
            Some("texels") => subject.file.with_import_size("light_depth", [value; 2])?,
            Some("width") => subject
                .file
                .with_import_size("camera_depth", [value, value * 9 / 16])?,
            _ => subject.file.with_radius(value)?,
        };
        let path = self.out.join("timed.json");
        save_atomically(&path, |out| out.write_all(file.text.as_bytes()))?;
        let refused = |reason: String| {
            LabError::unsuitable(
                subject.program.display(),
                format!("{reason}; give a build that has 'cost FILE --json'"),
            )
        };
        let rounds = self.rounds.to_string();
        let output = Command::new(subject.program)
            .arg("cost")
            .arg(&path)
            .args(["--json", "--rounds", &rounds])
            .stderr(Stdio::null())
            .output();
        // Whether it ran or not, nothing is left of what it was given.
        std::fs::remove_file(&path).map_err(|error| LabError::refused(error.to_string()))?;
        let output = output.map_err(|error| refused(error.to_string()))?;
        let report: Value = serde_json::from_slice(&output.stdout).map_err(|error| {
            refused(format!(
                "its report on {over} {value} cannot be read: {error}"
            ))
        })?;
        let shade = file.node_of("shade_hard").unwrap_or_default();
        let shade = format!("{}/", shade["name"].as_str().unwrap_or_default());
        let mut seconds = [0.0; 2];
        for pass in report["passes"].as_array().into_iter().flatten() {
            let is_shading = pass["pass"]
                .as_str()
                .is_some_and(|name| name.starts_with(&shade));
            let median = pass["time"]["seconds"]["median"].as_f64();
            seconds[usize::from(is_shading)] += median.unwrap_or(f64::NAN);
        }
        Ok(seconds)
    }
}

fn rows(points: &[Point]) -> Vec<Vec<Cell<'_>>> {
    let row = |point: &Point| {
        vec![
            ("over", point.over.to_owned()),
            ("", point.value.to_string()),
            ("subject", point.subject.to_owned()),
            ("map, ms", format!("{:.2}", point.map)),
            ("pixels, ms", format!("{:.2}", point.pixels)),
        ]
    };
    points.iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn a_program_that_is_no_lab_is_refused_by_name_and_leaves_nothing() {
        let file = GraphFile::parse(
            "graph",
            include_str!("../../../hard_shadows.json").to_owned(),
            None,
        )
        .unwrap();
        let folder = tempfile::tempdir().unwrap();
        let options = Options {
            graph: PathBuf::new(),
            out: folder.path().to_owned(),
            before: None,
            runs: 1,
            rounds: 9,
        };
        for program in ["/bin/echo", "no/such/lab"] {
            let subject = Subject {
                label: "before",
                program: Path::new(program),
                file: &file,
            };
            let refused = options.time(&subject, "radius of the kernel", 2);
            let refused = refused.unwrap_err().to_string();
            assert!(
                refused.contains(program) && refused.contains("cost FILE --json"),
                "{refused}"
            );
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        }
    }
}
