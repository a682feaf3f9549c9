//! The chart of the report.

use super::report::{Report, Row, SHARES};
use crate::plot::{Axis, Chart, Panel, Series};

/// Excesses from 1e-8 to 1.
const DECADES: i32 = 8;

/// The excess over the truth of every row: quantiles, the largest, and what is allowed.
#[must_use]
pub fn chart(report: &Report) -> Chart {
    let row_name = |row: &Row| {
        let fault = if row.passed() { "" } else { " FAULT" };
        format!("{} {}{fault}", row.technique, row.storage)
    };
    let series = |name: String, excess: &dyn Fn(&Row) -> f64| Series {
        name,
        points: (0..)
            .zip(&report.rows)
            .map(|(y, row)| {
                (
                    excess(row).log10().max(-f64::from(DECADES)),
                    f64::from(y),
                    0,
                )
            })
            .collect(),
    };
    let shares = SHARES.iter().enumerate();
    let mut lines: Vec<Series> = shares
        .map(|(index, share)| {
            let name = format!("{} %", (1e5 * share).round() / 1e3);
            series(name, &|row| row.quantiles[index].excess)
        })
        .collect();
    lines.extend([
        series("largest".to_owned(), &|row| {
            row.excess.drawn.max(row.wide.drawn)
        }),
        series("climbed".to_owned(), &|row| {
            row.excess.climbed.max(row.wide.climbed)
        }),
        series("allowed".to_owned(), &|row| row.excess.allowed),
    ]);
    let names: Vec<String> = report.rows.iter().map(row_name).collect();
    let rows = names.len();
    let name_of = move |row: &f64| names.get(row.round() as usize).cloned().unwrap_or_default();
    Chart {
        title: "shadow intensity above the truth".to_owned(),
        setting: format!("{}, {}", report.adapter, report.effort),
        panels: vec![Panel {
            title: "what is allowed is for filters up to 9 texels wide".to_owned(),
            axes: [
                Axis {
                    name: "excess",
                    range: -f64::from(DECADES)..0.0,
                    labels: 9,
                    label: Box::new(|decade| format!("1e{decade}")),
                },
                Axis {
                    name: "",
                    range: rows as f64 - 0.5..-0.5,
                    labels: rows,
                    label: Box::new(name_of),
                },
            ],
            label_width: 180,
            series: lines,
        }],
        markers: Vec::new(),
    }
}
