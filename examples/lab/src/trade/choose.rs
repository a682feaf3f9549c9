//! From what a trade found to one graph: the combination within given bounds that costs or errs least.

use core::fmt;

use serde_json::{Value, json};

use super::axes::Cell;
use super::held_out::HeldOut;
use super::interval::{LEAST, prediction};
use super::results::{Results, Row, SceneResults};
use crate::cost::table::Columns;
use crate::error::LabError;
use crate::graph_file::GraphFile;

/// What a choice has to keep to. Where there is a bound of the error, the time is made least, else the error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bounds {
    /// The largest mean error of the picture, in percent of full shadow.
    pub error: Option<f64>,
    /// The most bytes of all textures and buffers of the graph.
    pub bytes: Option<u64>,
    /// The longest time, in copies of 1,024 x 1,024 texels of 64 bits.
    pub time: Option<f64>,
}

/// A choice among the rows of a scene with one softness.
#[derive(Clone, Debug)]
pub struct Choice<'a> {
    /// The scene.
    pub scene: &'a SceneResults,
    /// The rows, the best first: those within the bounds, then the others from the nearest on.
    pub rows: Vec<&'a Row>,
    /// How many rows are within the bounds.
    pub within: usize,
    bounds: Bounds,
}

impl Bounds {
    /// By how much a row is beyond the bounds, at most: 0 within them, 0.5 where a figure is half as much again.
    fn excess(&self, row: &Row) -> f64 {
        let over = |figure: f64, bound: Option<f64>| {
            bound.map_or(0.0, |bound| {
                (figure / bound.max(f64::MIN_POSITIVE) - 1.0).max(0.0)
            })
        };
        let error = over(percent(row), self.error);
        let bytes = over(
            row.bytes_resident as f64,
            self.bytes.map(|bytes| bytes as f64),
        );
        error.max(bytes).max(over(row.time.total.median, self.time))
    }

    /// What is made least among rows within the bounds, and what next. Of errors that nobody sees none is less than another: what these
    /// views do not show decides.
    fn merit(&self, row: &Row) -> [f64; 3] {
        let (time, bytes) = (row.time.total.median, row.bytes_resident as f64);
        let seen = percent(row).max(100.0 * LEAST);
        let all = row.surface_error().unwrap_or(f64::INFINITY);
        match self.error {
            Some(_) => [time, bytes, seen],
            None => [seen, all, time],
        }
    }
}

impl<'a> Choice<'a> {
    /// Chooses among the rows of a scene whose filter has this radius.
    #[must_use]
    pub fn of(scene: &'a SceneResults, radius: u32, bounds: Bounds) -> Self {
        let mut rows: Vec<&Row> = (scene.rows.iter())
            .filter(|row| row.cell.radius == radius && row.error().is_some())
            .collect();
        let key = |row: &Row| {
            let [first, second, third] = bounds.merit(row);
            [bounds.excess(row), first, second, third]
        };
        rows.sort_by(|one, other| {
            let pairs = key(one).into_iter().zip(key(other));
            let mut orders = pairs.map(|(one, other)| one.total_cmp(&other));
            orders
                .find(|order| order.is_ne())
                .unwrap_or(core::cmp::Ordering::Equal)
        });
        Self {
            scene,
            within: rows.iter().filter(|row| bounds.excess(row) == 0.0).count(),
            rows,
            bounds,
        }
    }

    /// The best row, if one is within the bounds.
    #[must_use]
    pub fn chosen(&self) -> Option<&'a Row> {
        self.rows.first().copied().filter(|_| self.within > 0)
    }

    /// Why it is this one, and what the scene does not ask for, a sentence each.
    #[must_use]
    pub fn reasons(&self, results: &Results) -> Vec<String> {
        let Some(best) = self.rows.first() else {
            return vec!["nothing on this scene could be judged".to_owned()];
        };
        let mut reasons = vec![match self.within {
            0 => format!(
                "No combination keeps to the bounds; {} comes nearest.",
                named(best)
            ),
            count => format!(
                "{} has the least {} of the {count} combinations out of {} that keep to the bounds.",
                named(best),
                if self.bounds.error.is_some() {
                    "time"
                } else {
                    "error"
                },
                self.rows.len()
            ),
        }];
        if self.within > 0 {
            reasons.extend(self.two_moments(best));
        }
        let used = self.scene.probes.iter().map(|probe| probe.depth_used);
        let used = used.fold([1.0_f64, -1.0_f64], |[low, high], [near, far]| {
            [low.min(near), high.max(far)]
        });
        let share = 0.5 * (used[1] - used[0]);
        if share > 0.0 && share < 0.5 {
            reasons.push(format!(
                "Depths use {:.0} % of the light's range: with a range {:.1} times shorter the same storage leaks over distances as \
                 many times shorter.",
                100.0 * share,
                1.0 / share
            ));
        }
        let softness = results.setting.axes.radii.iter();
        let softness = softness
            .clone()
            .position(|&radius| radius == best.cell.radius);
        let counts = self.scene.probes.iter();
        let counts = counts.filter_map(|probe| probe.surfaces.get(softness?).copied());
        let counts: Vec<[f64; 4]> = counts.collect();
        if !counts.is_empty() {
            let mean = |at: usize| {
                100.0 * counts.iter().map(|shares| shares[at]).sum::<f64>() / counts.len() as f64
            };
            reasons.push(format!(
                "The filter meets one surface at {:.0} % of pixels, two at {:.0} %, three at {:.0} % and more at {:.0} %.",
                mean(0),
                mean(1),
                mean(2),
                mean(3)
            ));
        }
        let held_out = HeldOut::of(&[(self.scene, best.cell.radius)]);
        reasons.extend(held_out.map(|held_out| held_out.to_string()));
        reasons
    }

    /// Whether two moments, which know one surface in front of another, would do.
    fn two_moments(&self, best: &Row) -> Option<String> {
        let of_two = |row: &&&Row| matches!(row.technique.name(), "vsm" | "evsm2");
        let least = (self.rows.iter().filter(of_two))
            .min_by(|one, other| percent(one).total_cmp(&percent(other)))?;
        let bound = self.bounds.error?;
        Some(match percent(least) <= bound {
            true if of_two(&&best) => "Two moments suffice here.".to_owned(),
            true => format!(
                "Two moments would keep to the error, too: {} with {:.3} %.",
                named(least),
                percent(least)
            ),
            false => format!(
                "Two moments do not suffice: {} errs by {:.3} %.",
                named(least),
                percent(least)
            ),
        })
    }

    /// The graph of the chosen row, with a comment of why.
    pub fn graph(
        &self,
        file: &GraphFile,
        cell: Cell,
        results: &Results,
    ) -> Result<String, LabError> {
        let comment = self.reasons(results).join(" ");
        let mut graph: Value = serde_json::from_str(&file.text)?;
        graph["comment"] = json!(comment);
        retain_read(&mut graph);
        for import in graph["imports"].as_array_mut().into_iter().flatten() {
            if import["name"] == "light_depth" {
                import["texture"]["size"] = json!([cell.map, cell.map]);
                import["texture"]["samples"] = json!(cell.samples);
            }
        }
        written(&graph)
    }
}

/// Leaves out nodes that no output is made of, with their edges.
fn retain_read(graph: &mut Value) {
    let list = |graph: &Value, key: &str, end: &str| -> Vec<String> {
        let items = graph[key].as_array().into_iter().flatten();
        items
            .filter_map(|item| Some(item[end].as_str()?.to_owned()))
            .collect()
    };
    let node = |end: &str| end.split('.').next().unwrap_or_default().to_owned();
    let edges = list(graph, "edges", "from")
        .into_iter()
        .zip(list(graph, "edges", "to"));
    let edges: Vec<(String, String)> = edges.collect();
    let mut read: Vec<String> = list(graph, "outputs", "from")
        .iter()
        .map(|end| node(end))
        .collect();
    let mut next = 0;
    while let Some(reader) = read.get(next).cloned() {
        next += 1;
        for (from, _) in edges.iter().filter(|(_, to)| node(to) == reader) {
            if !read.contains(&node(from)) {
                read.push(node(from));
            }
        }
    }
    let is_read = |item: &Value, key: &str| {
        item[key]
            .as_str()
            .is_some_and(|end| read.contains(&node(end)))
    };
    for (list, key) in [("nodes", "name"), ("edges", "to")] {
        if let Some(items) = graph[list].as_array_mut() {
            items.retain(|item| is_read(item, key));
        }
    }
}

/// A graph file as people read it: an item of a list per line.
fn written(graph: &Value) -> Result<String, LabError> {
    let mut text = String::from("{");
    for (number, key) in ["version", "comment", "imports", "nodes", "edges", "outputs"]
        .into_iter()
        .enumerate()
    {
        text += if number > 0 { ",\n" } else { "\n" };
        let value = match graph[key].as_array() {
            Some(items) => {
                let lines: Result<Vec<String>, serde_json::Error> = (items.iter())
                    .map(|item| Ok(format!("    {}", serde_json::to_string(item)?)))
                    .collect();
                format!("[\n{}\n  ]", lines?.join(",\n"))
            }
            None => serde_json::to_string(&graph[key])?,
        };
        text += &format!("  \"{key}\": {value}");
    }
    Ok(text + "\n}\n")
}

fn percent(row: &Row) -> f64 {
    row.error().map_or(f64::INFINITY, |error| 100.0 * error)
}

fn named(row: &Row) -> String {
    let storage = row
        .storage
        .map_or("the plain depth map", |storage| storage.name());
    let samples = match row.cell.samples {
        1 => "1 sample".to_owned(),
        count => format!("{count} samples"),
    };
    format!(
        "{} in {storage}, {}² texels, {samples}",
        row.name, row.cell.map
    )
}

impl fmt::Display for Choice<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cells = |(number, row): (usize, &&Row)| {
            let interval = prediction(&row.errors());
            vec![
                ("", if number < self.within { "+" } else { "-" }.to_owned()),
                ("technique", row.name.clone()),
                (
                    "storage",
                    row.storage.map_or("depth", |it| it.name()).to_owned(),
                ),
                ("map", row.cell.map.to_string()),
                ("samples", row.cell.samples.to_string()),
                ("bits", row.bits_per_texel.to_string()),
                ("error %", format!("{:.3}", percent(row))),
                (
                    "90 % of views",
                    interval.map_or("-".to_owned(), |[low, high]| {
                        format!("{:.3} .. {:.3}", 100.0 * low, 100.0 * high)
                    }),
                ),
                ("time", format!("{:.2}", row.time.total.median)),
                (
                    "MiB",
                    format!("{:.2}", row.bytes_resident as f64 / f64::from(1 << 20)),
                ),
                (
                    "inv. thr.",
                    row.isa
                        .map_or("-".to_owned(), |isa| isa.inverse_throughput.to_string()),
                ),
            ]
        };
        write!(
            f,
            "{}",
            Columns(&Vec::from_iter(self.rows.iter().enumerate().map(cells)))
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::held_out::tests::{row, scene};
    use super::super::results::Figures;
    use super::*;

    #[test]
    fn of_errors_that_nobody_sees_that_over_all_surfaces_decides() {
        let with = |mut row: Row, error: f64| {
            for view in &mut row.views {
                view.surfaces = view.picture.map(|picture| Figures { error, ..picture });
            }
            row
        };
        let chosen = |seen: [f64; 2]| {
            let [one, other] = [0, 1].map(|at| row(at, 1.0, &[seen[at]]));
            let scene = scene(vec![with(one, 0.2), with(other, 0.1)]);
            let choice = Choice::of(&scene, 4, Bounds::default());
            choice.chosen().map(|row| row.cell.candidate)
        };
        assert_eq!(chosen([1e-6, 9e-5]), Some(1));
        assert_eq!(chosen([1e-6, 2e-4]), Some(0));
    }
}
