//! Plots of how cost grows: time in copies on the left, time per texel on the right.

use std::path::{Path, PathBuf};

use plotters::backend::DrawingBackend;
use plotters::chart::{ChartBuilder, SeriesLabelPosition};
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{Circle, PathElement};
use plotters::series::LineSeries;
use plotters::style::{Color, RGBColor, ShapeStyle, WHITE};

use super::baseline::CopyWork;
use super::growth::{Axis, Curve, Growth, Point};
use super::report::Conditions;
use super::statistics::Distribution;
use crate::plot::{COLOURS, Drawn, FONT, Plot, PlotError, Scale, number};

/// Pixels.
const SIZE: (u32, u32) = (1280, 560);

/// Of a linear scale, in multiples of the largest figure: the legend stands above.
const ROOM: f64 = 1.35;

/// Draws a plot as SVG and as PNG into a folder, and gives their paths.
pub fn save(
    growth: &Growth,
    conditions: &Conditions,
    folder: &Path,
) -> Result<[PathBuf; 2], PlotError> {
    let stem = growth.axis.file_stem();
    crate::plot::save(&GrowthPlot { growth, conditions }, folder, stem)
}

struct GrowthPlot<'a> {
    growth: &'a Growth,
    conditions: &'a Conditions,
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

impl Plot for GrowthPlot<'_> {
    fn title(&self) -> &str {
        self.growth.axis.title()
    }

    fn size(&self) -> (u32, u32) {
        SIZE
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        let Self { growth, conditions } = self;
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
        draw_panel(&right, growth, &per_texel)
    }
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
    let y_axis = Scale::of(medians, panel.logarithmic, ROOM);
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
