//! The histogram of how well choices of functions do.

use core::ops::Range;
use std::path::{Path, PathBuf};

use plotters::backend::DrawingBackend;
use plotters::chart::ChartBuilder;
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{PathElement, Rectangle, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, IntoFont, RGBColor, ShapeStyle};

use super::subsets::{CANDIDATES, Subsets};
use crate::plot::{self, Drawn, FONT, Plot, PlotError};

/// Pixels.
const SIZE: (u32, u32) = (1000, 560);

const BARS: usize = 40;

/// Colours that everyone can tell apart (Okabe and Ito, "Color Universal Design", 2008).
const BAR: RGBColor = RGBColor(86, 180, 233);
const MARKS: [RGBColor; 2] = [RGBColor(213, 94, 0), RGBColor(0, 114, 178)];

/// Draws the histogram as `bases.svg` and as `bases.png` into a folder, and gives their paths.
pub fn save(subsets: &Subsets, folder: &Path) -> Result<[PathBuf; 2], PlotError> {
    plot::save(subsets, folder, "bases")
}

impl Plot for Subsets {
    fn title(&self) -> &str {
        "Sets of four functions by the error of their lower bound"
    }

    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        draw_chart(area, self)
    }
}

fn draw_chart<B: DrawingBackend>(area: &DrawingArea<B, Shift>, subsets: &Subsets) -> Drawn<B> {
    let percents: Vec<f64> = subsets
        .ranked
        .iter()
        .map(|subset| 100.0 * subset.mean_error)
        .collect();
    let (bars, range) = histogram(&percents);
    let highest = bars.iter().copied().max().unwrap_or(1);
    let top = 1.25 * f64::from(highest);
    let below = area.titled(subsets.title(), (FONT, 24))?;
    let names: Vec<String> = CANDIDATES.iter().map(ToString::to_string).collect();
    let setting = format!(
        "{} distributions of four surfaces, {} receivers, margin {}; functions: {}",
        subsets.samples,
        subsets.receivers,
        subsets.margin,
        names.join(", ")
    );
    let below = below.titled(&setting, (FONT, 14))?;
    let mut chart = ChartBuilder::on(&below)
        .margin(14)
        .x_label_area_size(52)
        .y_label_area_size(64)
        .build_cartesian_2d(range.clone(), 0.0..top)?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .max_light_lines(1)
        .x_desc("mean error of shadow intensity (percent)")
        .y_desc("sets of functions")
        .x_label_formatter(&|x| format!("{x:.1}"))
        .y_label_formatter(&|y| format!("{y:.0}"))
        .label_style((FONT, 15))
        .axis_desc_style((FONT, 17))
        .draw()?;
    let width = (range.end - range.start) / BARS as f64;
    chart.draw_series(bars.iter().enumerate().map(|(index, &count)| {
        let left = range.start + index as f64 * width;
        let corners = [
            (left + 0.05 * width, 0.0),
            (left + 0.95 * width, f64::from(count)),
        ];
        Rectangle::new(corners, BAR.filled())
    }))?;
    let marked = [
        (Subsets::POWERS, "the library's"),
        (Subsets::TRIGONOMETRIC, "trigonometric"),
    ];
    for (index, ((indices, remark), colour)) in marked.into_iter().zip(MARKS).enumerate() {
        let Some((rank, subset)) = subsets.rank(indices) else {
            continue;
        };
        let x = 100.0 * subset.mean_error;
        let height = top * (0.97 - 0.07 * index as f64);
        let line = ShapeStyle::from(&colour).stroke_width(2);
        chart.draw_series([PathElement::new(vec![(x, 0.0), (x, height)], line)])?;
        let text = format!("{} ({remark}): {x:.2} %, rank {rank}", subset.name);
        // Towards the middle of the plot.
        let (side, away) = if x > 0.5 * (range.start + range.end) {
            (HPos::Right, -0.2 * width)
        } else {
            (HPos::Left, 0.2 * width)
        };
        let style = (FONT, 15)
            .into_font()
            .color(&colour)
            .pos(Pos::new(side, VPos::Top));
        chart.draw_series([Text::new(text, (x + away, height), style)])?;
    }
    Ok(())
}

/// How many values each bar stands for, and the range of all bars.
fn histogram(values: &[f64]) -> ([u32; BARS], Range<f64>) {
    let (low, high) = values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &value| {
            (low.min(value), high.max(value))
        });
    let (low, high) = if low < high { (low, high) } else { (0.0, 1.0) };
    let mut bars = [0; BARS];
    for value in values {
        let place = (value - low) / (high - low) * BARS as f64;
        bars[(place as usize).min(BARS - 1)] += 1;
    }
    (bars, low..high)
}
