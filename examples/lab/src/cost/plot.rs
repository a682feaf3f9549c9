//! Plots of how cost grows: time in copies on the left, time per texel on the right.
//!
//! Text is laid out with a font of our own, so that a machine without any draws the same picture.

use core::ops::Range;
use std::path::{Path, PathBuf};

use plotters::backend::{BitMapBackend, DrawingBackend, SVGBackend};
use plotters::chart::{ChartBuilder, SeriesLabelPosition};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::element::{Circle, PathElement};
use plotters::series::LineSeries;
use plotters::style::{Color, FontStyle, RGBColor, ShapeStyle, WHITE, register_font};

use super::CostError;
use super::baseline::CopyWork;
use super::growth::{Axis, Curve, Growth, Point};
use super::report::Conditions;
use super::statistics::Distribution;
use crate::picture::{save_atomically, save_rgba};

/// Pixels.
const SIZE: (u32, u32) = (1280, 560);

const FONT: &str = "sans-serif";

/// Colours that everyone can tell apart (Okabe and Ito, "Color Universal Design", 2008).
const COLOURS: [RGBColor; 5] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
];

/// Draws a plot as SVG and as PNG into a folder, and gives their paths.
pub fn save(
    growth: &Growth,
    conditions: &Conditions,
    folder: &Path,
) -> Result<[PathBuf; 2], CostError> {
    let path = |extension| {
        let stem = growth.axis.file_stem();
        folder.join(format!("{stem}.{extension}"))
    };
    let [svg, png] = [path("svg"), path("png")];
    let text = draw_svg(growth, conditions)?;
    save_atomically(&svg, |file| file.write_all(text.as_bytes()))?;
    let rgba = draw_rgba(growth, conditions)?;
    save_rgba(&png, SIZE.0, SIZE.1, &rgba)?;
    Ok([svg, png])
}

fn draw_svg(growth: &Growth, conditions: &Conditions) -> Result<String, CostError> {
    let mut text = String::new();
    draw(
        SVGBackend::with_string(&mut text, SIZE).into_drawing_area(),
        growth,
        conditions,
    )?;
    Ok(text)
}

/// Four bytes per pixel.
fn draw_rgba(growth: &Growth, conditions: &Conditions) -> Result<Vec<u8>, CostError> {
    let mut rgb = vec![255; 3 * (SIZE.0 * SIZE.1) as usize];
    draw(
        BitMapBackend::with_buffer(&mut rgb, SIZE).into_drawing_area(),
        growth,
        conditions,
    )?;
    let pixels = rgb.chunks_exact(3);
    Ok(pixels
        .flat_map(|pixel| [pixel[0], pixel[1], pixel[2], 255])
        .collect())
}

fn draw<B: DrawingBackend>(
    area: DrawingArea<B, Shift>,
    growth: &Growth,
    conditions: &Conditions,
) -> Result<(), CostError> {
    let failed = |reason: String| CostError::Plot {
        title: growth.axis.title().to_owned(),
        reason,
    };
    register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT)
        .map_err(|_| failed("its font cannot be read".to_owned()))?;
    draw_panels(&area, growth, conditions).map_err(|error| failed(error.to_string()))
}

/// What a panel shows of a point.
struct Panel {
    label: &'static str,
    figure: fn(&Point) -> Distribution,
    /// Whether the figure is drawn by its logarithm.
    logarithmic: bool,
    /// Whether the legend says what copies are.
    in_copies: bool,
}

type Drawn<B> =
    Result<(), plotters::drawing::DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

fn draw_panels<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    growth: &Growth,
    conditions: &Conditions,
) -> Drawn<B> {
    area.fill(&WHITE)?;
    let setting = format!(
        "{}, {:?}, median of {} rounds with the interquartile range",
        conditions.adapter, conditions.clock, conditions.rounds
    );
    let below = area.titled(growth.axis.title(), (FONT, 24))?;
    let below = below.titled(&setting, (FONT, 14))?;
    let (left, right) = below.split_horizontally(SIZE.0 / 2);
    let copies = Panel {
        label: "time (copies of the output)",
        figure: Point::x_copy,
        logarithmic: true,
        in_copies: true,
    };
    let per_texel = Panel {
        label: "time per texel (multiple of the first)",
        figure: |point| point.per_texel,
        logarithmic: growth.axis == Axis::Radius,
        in_copies: false,
    };
    draw_panel(&left, growth, &copies)?;
    draw_panel(&right, growth, &per_texel)?;
    area.present()
}

fn draw_panel<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    growth: &Growth,
    panel: &Panel,
) -> Drawn<B> {
    let points: Vec<&Point> = growth
        .curves
        .iter()
        .flat_map(|curve| &curve.points)
        .collect();
    let mut values: Vec<(f64, &str)> = points
        .iter()
        .map(|point| (point.value.x.log2(), point.value.label.as_str()))
        .collect();
    values.sort_by(|one, other| one.0.total_cmp(&other.0));
    values.dedup();
    let ends = [values.first(), values.last()].map(|end| end.map_or(0.0, |value| value.0));
    let medians = points.iter().map(|point| (panel.figure)(point).median);
    let y_axis = Scale::of(medians, panel.logarithmic);
    let x_axis = Scale {
        range: ends[0] - 0.3..ends[1] + 0.3,
        ticks: values.iter().map(|value| value.0).collect(),
    };
    let mut chart = ChartBuilder::on(area)
        .margin(14)
        .x_label_area_size(52)
        .y_label_area_size(64)
        .build_cartesian_2d(x_axis, y_axis)?;
    let label = |x: &f64| {
        let near = values.iter().find(|value| (value.0 - x).abs() < 1e-9);
        near.map_or(String::new(), |value| value.1.to_owned())
    };
    let logarithmic = panel.logarithmic;
    let figure = |y: &f64| number(if logarithmic { y.exp2() } else { *y });
    chart
        .configure_mesh()
        .x_desc(growth.axis.label())
        .y_desc(panel.label)
        .x_label_formatter(&label)
        .y_label_formatter(&figure)
        .label_style((FONT, 15))
        .axis_desc_style((FONT, 17))
        .draw()?;
    let place = |value: f64| if logarithmic { value.log2() } else { value };
    for (curve, colour) in growth.curves.iter().zip(COLOURS.iter().cycle()) {
        let style = ShapeStyle::from(colour).stroke_width(2);
        let at = |point: &Point, offset: f64| {
            let figure = (panel.figure)(point);
            let value = figure.median + offset * figure.interquartile_range;
            (point.value.x.log2(), place(value.max(f64::MIN_POSITIVE)))
        };
        let line = LineSeries::new(curve.points.iter().map(|point| at(point, 0.0)), style);
        let colour = *colour;
        chart
            .draw_series(line)?
            .label(name(curve, panel))
            .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 22, y)], style));
        chart.draw_series(curve.points.iter().map(|point| {
            let ends = vec![at(point, -0.5), at(point, 0.5)];
            PathElement::new(ends, colour)
        }))?;
        chart.draw_series(
            curve
                .points
                .iter()
                .map(|point| Circle::new(at(point, 0.0), 4, colour.filled())),
        )?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE.mix(0.85))
        .border_style(RGBColor(200, 200, 200))
        .legend_area_size(30)
        .label_font((FONT, 15))
        .draw()
}

fn name(curve: &Curve, panel: &Panel) -> String {
    match (panel.in_copies, curve.copy) {
        (true, CopyWork::Compute) => format!("{} (compute copies)", curve.node),
        (true, CopyWork::Fullscreen) => format!("{} (copies by a draw)", curve.node),
        (false, _) => curve.node.clone(),
    }
}

/// Without the digits that rounding adds to a multiple of a step.
fn number(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A linear scale with ticks of our choice.
struct Scale {
    range: Range<f64>,
    ticks: Vec<f64>,
}

impl Scale {
    /// For some figures above 0, with room for the legend above them: their logarithms with ticks at powers of two, or
    /// from 0 in round steps.
    fn of(figures: impl Iterator<Item = f64>, logarithmic: bool) -> Self {
        let (low, high) = figures
            .filter(|figure| figure.is_finite() && *figure > 0.0)
            .fold((f64::INFINITY, 0.0_f64), |(low, high), figure| {
                (low.min(figure), high.max(figure))
            });
        let (low, high) = if low <= high { (low, high) } else { (1.0, 1.0) };
        if logarithmic {
            let (first, last) = (low.log2().floor().min(0.0), high.log2().ceil() + 1.0);
            return Self {
                range: first..last,
                ticks: (first as i32..=last as i32).map(f64::from).collect(),
            };
        }
        let step = [0.1, 0.2, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0]
            .into_iter()
            .find(|step| high / step <= 6.0)
            .unwrap_or(high / 5.0);
        let count = (1.35 * high / step).ceil();
        Self {
            range: 0.0..step * count,
            ticks: (0..=count as u32)
                .map(|tick| step * f64::from(tick))
                .collect(),
        }
    }
}

impl Ranged for Scale {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (first, last): (i32, i32)) -> i32 {
        let part = (value - self.range.start) / (self.range.end - self.range.start);
        first + (part * f64::from(last - first)).round() as i32
    }

    fn key_points<H: KeyPointHint>(&self, hint: H) -> Vec<f64> {
        // No finer lines between the ticks.
        if hint.weight().allow_light_points() {
            Vec::new()
        } else {
            self.ticks.clone()
        }
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}
