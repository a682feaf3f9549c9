//! Plots of how cost grows: time in copies on the left, time per texel on the right.

use std::path::{Path, PathBuf};

use plotters::backend::DrawingBackend;
use plotters::chart::{ChartBuilder, SeriesLabelPosition};
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{Circle, PathElement};
use plotters::series::LineSeries;
use plotters::style::{Color, RGBColor, ShapeStyle, WHITE};

use super::copies::CopyWork;
use super::growth::{Axis, Growth, Point};
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
    let stem = growth.axis.texts()[2];
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
    /// What follows a node's name in the legend.
    unit: fn(CopyWork) -> &'static str,
}

impl Plot for GrowthPlot<'_> {
    fn title(&self) -> &str {
        self.growth.axis.texts()[0]
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
        let below = area.titled(self.title(), (FONT, 24))?;
        let below = below.titled(&setting, (FONT, 14))?;
        let (left, right) = below.split_horizontally(SIZE.0 / 2);
        let copies = Panel {
            label: "time (copies of the output)",
            figure: Point::x_copy,
            logarithmic: true,
            unit: |work| match work {
                CopyWork::Compute => " (compute copies)",
                CopyWork::Fullscreen => " (copies by a draw)",
            },
        };
        let per_texel = Panel {
            label: "time per texel (multiple of the first)",
            figure: |point| point.per_texel,
            logarithmic: growth.axis == Axis::Radius,
            unit: |_| "",
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
    let points = growth.points.iter();
    let values = points.clone().map(|point| &point.value);
    let mut values: Vec<_> = values.map(|value| (value.x.log2(), &value.label)).collect();
    values.sort_by(|one, other| one.0.total_cmp(&other.0));
    values.dedup();
    let ends = [values.first(), values.last()].map(|end| end.map_or(0.0, |value| value.0));
    let medians = points.map(|point| (panel.figure)(point).median);
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
        near.map_or(String::new(), |value| value.1.clone())
    };
    let logarithmic = panel.logarithmic;
    chart
        .configure_mesh()
        .x_desc(growth.axis.texts()[1])
        .y_desc(panel.label)
        .x_label_formatter(&label)
        .y_label_formatter(&|y: &f64| number(if logarithmic { y.exp2() } else { *y }))
        .label_style((FONT, 15))
        .axis_desc_style((FONT, 17))
        .draw()?;
    let place = |value: f64| if logarithmic { value.log2() } else { value };
    let at = |point: &Point, offset: f64| {
        let figure = (panel.figure)(point);
        let value = figure.median + offset * figure.interquartile_range;
        (point.value.x.log2(), place(value.max(f64::MIN_POSITIVE)))
    };
    for ((node, points), &colour) in growth.curves().into_iter().zip(COLOURS.iter().cycle()) {
        let style = ShapeStyle::from(&colour).stroke_width(2);
        let work = points.first().map(|point| point.row.work);
        let line = LineSeries::new(points.iter().map(|point| at(point, 0.0)), style);
        chart
            .draw_series(line)?
            .label(format!("{node}{}", work.map_or("", panel.unit)))
            .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 22, y)], style));
        let spread = |point: &&Point| vec![at(point, -0.5), at(point, 0.5)];
        let spreads = points.iter().map(spread);
        chart.draw_series(spreads.map(|ends| PathElement::new(ends, colour)))?;
        let medians = points.iter().map(|point| at(point, 0.0));
        chart.draw_series(medians.map(|place| Circle::new(place, 4, colour.filled())))?;
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
