//! The chart: a panel for each of what varies.

use super::{Point, Subject};
use crate::plot::{Axis, Chart, Panel, Series};

/// A line for the map and for the pixels of each subject.
pub(super) fn chart(points: &[Point], subjects: &[Subject<'_>]) -> Chart {
    let panels = points.chunk_by(|a, b| a.over == b.over).map(|of_panel| {
        let along = |figure: fn(&Point) -> f64, marker| {
            subjects.iter().map(move |subject| {
                let own = of_panel
                    .iter()
                    .filter(|point| point.subject == subject.label);
                Series {
                    name: subject.label.to_owned(),
                    points: own
                        .map(|point| (f64::from(point.value), figure(point), marker))
                        .collect(),
                }
            })
        };
        let figures = of_panel.iter().flat_map(|point| [point.map, point.pixels]);
        let most = figures.fold(0.0, f64::max);
        let ends = [of_panel.first(), of_panel.last()];
        let [first, last] = ends.map(|point| point.map_or(0.0, |point| f64::from(point.value)));
        let over = of_panel.first().map_or("", |point| point.over);
        Panel {
            title: over.to_owned(),
            axes: [
                Axis {
                    name: over,
                    range: first - 0.05 * (last - first)..last + 0.05 * (last - first),
                    labels: 5,
                    label: Box::new(|value| format!("{value:.0}")),
                },
                Axis {
                    name: "milliseconds",
                    range: 0.0..1.05 * most,
                    labels: 8,
                    label: Box::new(|value| format!("{value:.0}")),
                },
            ],
            label_width: 56,
            series: along(|point| point.map, 0)
                .chain(along(|point| point.pixels, 1))
                .collect(),
        }
    });
    Chart {
        title: "Hard shadows: what the map and the pixels cost".to_owned(),
        setting: "median of processor time; other sizes as the graph file has them".to_owned(),
        panels: panels.collect(),
        markers: vec!["map", "pixels"],
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn panels_have_the_same_lines_and_room_for_all_points() {
        let file = crate::graph_file::GraphFile::parse(
            "graph",
            include_str!("../../../../hard_shadows.json").to_owned(),
            None,
        )
        .unwrap();
        let program = std::path::Path::new("lab");
        let subjects = ["before", "this build"].map(|label| Subject {
            label,
            program,
            file: &file,
        });
        let mut points = Vec::new();
        for (over, value) in [
            ("texels", 512),
            ("texels", 1024),
            ("radius", 2),
            ("radius", 12),
        ] {
            points.extend(subjects.iter().map(|subject| Point {
                over,
                value,
                subject: subject.label,
                map: f64::from(value),
                pixels: 2.0 * f64::from(value),
            }));
        }
        let panels = chart(&points, &subjects).panels;
        assert_eq!(panels.len(), 2);
        for (panel, last) in panels.iter().zip([1024.0, 12.0]) {
            let names: Vec<&str> = panel.series.iter().map(|it| it.name.as_str()).collect();
            assert_eq!(names, ["before", "this build", "before", "this build"]);
            assert_eq!(panel.series[0].points.last(), Some(&(last, last, 0)));
            assert_eq!(panel.series[3].points.last(), Some(&(last, 2.0 * last, 1)));
            let inside = |range: &core::ops::Range<f64>, value| range.contains(&value);
            for (x, y, _) in panel.series.iter().flat_map(|series| &series.points) {
                assert!(inside(&panel.axes[0].range, *x) && inside(&panel.axes[1].range, *y));
            }
        }
    }
}
