//! A sweep as text and as a chart.

use core::fmt;

use super::{Swept, Times};
use crate::cost::table::{Cell, Columns};
use crate::plot::{self, Chart, Panel, Series};

impl Times {
    /// Where it is along an axis, as a number.
    fn place(&self, axis: usize) -> f64 {
        let [width, height] = self.at.picture.map(f64::from);
        match axis {
            0 => f64::from(self.at.map),
            1 => width * height,
            _ => f64::from(self.at.filter),
        }
    }

    /// Where it is along an axis, as it is told.
    fn told(&self, axis: usize) -> String {
        let [width, height] = self.at.picture;
        match axis {
            0 => self.at.map.to_string(),
            1 => format!("{width}x{height}"),
            _ => self.at.filter.to_string(),
        }
    }
}

impl Swept {
    /// Where along each axis techniques take less time than percentage-closer filtering in the shader, a sentence for each place and
    /// those that do so there.
    #[must_use]
    pub fn overtaken(&self) -> Vec<String> {
        let mut sentences = Vec::new();
        for (number, axis) in self.axes.iter().enumerate() {
            let mut groups: Vec<(Vec<String>, Vec<&str>)> = Vec::new();
            for (row, name) in self.techniques.iter().enumerate().skip(1) {
                let less = axis.points.iter();
                let less = less.filter(|times| times.of_percentage_closer[row].median < 1.0);
                let places: Vec<String> = less.map(|times| times.told(number)).collect();
                match groups.iter_mut().find(|(known, _)| *known == places) {
                    Some((_, names)) => names.push(name),
                    None => groups.push((places, vec![name])),
                }
            }
            for (places, names) in groups {
                let count = axis.points.len();
                let at = match places.len() {
                    0 => "nowhere".to_owned(),
                    all if all == count => "everywhere".to_owned(),
                    _ => format!("at {}", places.join(", ")),
                };
                sentences.push(format!(
                    "{}: less time than pcf {at}: {}",
                    axis.name,
                    names.join(", ")
                ));
            }
        }
        sentences
    }

    /// Times over each axis, both on logarithmic scales.
    #[must_use]
    pub fn chart(&self) -> Chart {
        let power = |label: f64| {
            let value = label.exp2();
            match value {
                _ if value >= 1e6 => format!("{:.1}M", value / 1e6),
                _ if value >= 10.0 => format!("{value:.0}"),
                _ => format!("{value:.2}"),
            }
        };
        let panel = |(number, axis): (usize, &super::Axis)| {
            let at = |times: &Times| times.place(number).log2();
            let of = |row: usize| {
                axis.points
                    .iter()
                    .map(move |times| (at(times), times.copies[row].median.log2(), 0))
            };
            let ys = (0..self.techniques.len()).flat_map(|row| of(row).map(|point| point.1));
            let ends = |values: &mut dyn Iterator<Item = f64>| {
                let (low, high) = values
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| {
                        (low.min(at), high.max(at))
                    });
                let room = (0.06 * (high - low)).max(0.05);
                low - room..high + room
            };
            Panel {
                title: axis.name.to_owned(),
                axes: [
                    plot::Axis {
                        name: axis.name,
                        range: ends(&mut axis.points.iter().map(at)),
                        labels: 6,
                        label: Box::new(move |label| power(*label)),
                    },
                    plot::Axis {
                        name: "time, in copies of the map",
                        range: ends(&mut { ys }),
                        labels: 8,
                        label: Box::new(move |label| power(*label)),
                    },
                ],
                label_width: 60,
                series: (self.techniques.iter().enumerate())
                    .map(|(row, name)| Series {
                        name: name.clone(),
                        points: of(row).collect(),
                    })
                    .collect(),
            }
        };
        Chart {
            title: "Time over map, picture and filter".to_owned(),
            setting: format!("{}, {}", self.scene, self.conditions.adapter),
            panels: self.axes.iter().enumerate().map(panel).collect(),
            markers: Vec::new(),
        }
    }
}

impl fmt::Display for Swept {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.conditions)?;
        for (number, axis) in self.axes.iter().enumerate() {
            let held = axis.points.first().map(|times| times.at);
            if let Some(held) = held {
                let [width, height] = held.picture;
                let others = match number {
                    0 => format!("picture {width}x{height}, filter {0}x{0}", held.filter),
                    1 => format!("map {0}x{0}, filter {1}x{1}", held.map, held.filter),
                    _ => format!("map {0}x{0}, picture {width}x{height}", held.map),
                };
                writeln!(
                    f,
                    "{} ({others}): times as parts of those of pcf",
                    axis.name
                )?;
            }
            let points: Vec<String> = axis.points.iter().map(|times| times.told(number)).collect();
            let cells = |(row, name): (usize, &String)| {
                let mut cells: Vec<Cell<'_>> = vec![("technique", name.clone())];
                for (times, point) in axis.points.iter().zip(&points) {
                    cells.push((
                        point,
                        format!("{:.3}", times.of_percentage_closer[row].median),
                    ));
                }
                cells
            };
            let table: Vec<Vec<Cell<'_>>> = self.techniques.iter().enumerate().map(cells).collect();
            writeln!(f, "{}", Columns(&table))?;
        }
        for sentence in self.overtaken() {
            writeln!(f, "{sentence}")?;
        }
        Ok(())
    }
}
