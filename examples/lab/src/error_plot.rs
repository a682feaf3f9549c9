//! Plots of error against the bits of a texel: a panel per kernel, a line per technique, a marker per storage.

use std::path::{Path, PathBuf};

use moment_shadows::Storage;
use plotters::backend::DrawingBackend;
use plotters::chart::ChartBuilder;
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{Circle, PathElement, Polygon, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{BLACK, Color, IntoFont, RGBColor, ShapeStyle};

use crate::error::LabError;
use crate::picture::PictureError;
use crate::plot::{self, COLOURS, Drawn, FONT, Plot, Scale, number};

/// Pixels.
const PANEL_WIDTH: u32 = 480;
const LEGEND_WIDTH: u32 = 220;
const HEIGHT: u32 = 600;

/// Half the width of a marker, in pixels.
const MARKER: i32 = 5;

/// The share of a doubling of bits by which neighbouring series stand apart, so that none covers another.
const APART: f64 = 0.045;

/// A plot.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorPlot {
    /// What is shown.
    pub title: String,
    /// How it was measured.
    pub setting: String,
    /// Panels from left to right. All have the same series, in the same order.
    pub panels: Vec<ErrorPanel>,
}

/// A part of a plot with axes of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorPanel {
    /// What is shown.
    pub title: String,
    /// The techniques.
    pub series: Vec<ErrorSeries>,
}

/// A technique.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorSeries {
    /// Its name.
    pub name: String,
    /// Points from few bits to many.
    pub points: Vec<ErrorPoint>,
}

/// A technique in a storage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorPoint {
    /// Bits of a texel, all planes.
    pub bits: u32,
    /// Mean absolute error in percent.
    pub percent: f64,
    /// The storage; none for the plain depth map.
    pub storage: Option<Storage>,
}

impl ErrorPlot {
    /// Draws it as SVG and as PNG into a folder, which is made if need be, and gives their paths.
    pub fn save(&self, folder: &Path, stem: &str) -> Result<[PathBuf; 2], LabError> {
        std::fs::create_dir_all(folder).map_err(|source| PictureError::Unwritable {
            path: folder.to_owned(),
            source,
        })?;
        plot::save(self, folder, stem)
    }
}

impl Plot for ErrorPlot {
    fn title(&self) -> &str {
        &self.title
    }

    fn size(&self) -> (u32, u32) {
        let panels = PANEL_WIDTH * self.panels.len() as u32;
        (panels + LEGEND_WIDTH, HEIGHT)
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        let below = area.titled(&self.title, (FONT, 24))?;
        let below = below.titled(&self.setting, (FONT, 14))?;
        let (panels, legend) = below.split_horizontally(self.size().0 - LEGEND_WIDTH);
        let areas = panels.split_evenly((1, self.panels.len()));
        for (area, panel) in areas.iter().zip(&self.panels) {
            draw_panel(area, panel)?;
        }
        let series = self.panels.first().map_or(&[][..], |panel| &panel.series);
        draw_legend(&legend, series)
    }
}

/// Colours come again after a round, then with hollow markers.
fn look(index: usize) -> (RGBColor, bool) {
    let colour = COLOURS[index % COLOURS.len()];
    (colour, index < COLOURS.len())
}

fn draw_panel<B: DrawingBackend>(area: &DrawingArea<B, Shift>, panel: &ErrorPanel) -> Drawn<B> {
    let points = || panel.series.iter().flat_map(|series| &series.points);
    let bits = points().map(|point| f64::from(point.bits).log2());
    let (low, high) = bits.fold((f64::INFINITY, 0.0_f64), |(low, high), bits| {
        (low.min(bits), high.max(bits))
    });
    let (first, last) = (low.min(high).floor(), high.ceil());
    let x_axis = Scale {
        range: first - 0.5..last + 0.5,
        ticks: (first as i32..=last as i32).map(f64::from).collect(),
    };
    let y_axis = Scale::of(points().map(|point| point.percent), 1.05);
    let mut chart = ChartBuilder::on(area)
        .margin(14)
        .caption(&panel.title, (FONT, 18))
        .x_label_area_size(52)
        .y_label_area_size(56)
        .build_cartesian_2d(x_axis, y_axis)?;
    chart
        .configure_mesh()
        .x_desc("bits per texel")
        .y_desc("mean absolute error (percent)")
        .x_label_formatter(&|bits: &f64| number(bits.exp2()))
        .y_label_formatter(&|percent: &f64| number(*percent))
        .label_style((FONT, 15))
        .axis_desc_style((FONT, 16))
        .draw()?;
    let middle = 0.5 * (panel.series.len() as f64 - 1.0);
    for (index, series) in panel.series.iter().enumerate() {
        let (colour, filled) = look(index);
        let offset = APART * (index as f64 - middle);
        let at = |point: &ErrorPoint| (f64::from(point.bits).log2() + offset, point.percent);
        let line: Vec<_> = series.points.iter().map(at).collect();
        chart.draw_series([PathElement::new(line.clone(), colour.mix(0.45))])?;
        let plotting = chart.plotting_area();
        for (point, place) in series.points.iter().zip(line) {
            let pixel = plotting.map_coordinate(&place);
            draw_marker(area, pixel, point.storage, colour, filled)?;
        }
    }
    Ok(())
}

/// The marker of a storage about a pixel of the whole plot.
fn draw_marker<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    pixel: (i32, i32),
    storage: Option<Storage>,
    colour: RGBColor,
    filled: bool,
) -> Drawn<B> {
    let (left, top) = area.get_base_pixel();
    let (x, y) = (pixel.0 - left, pixel.1 - top);
    let style = if filled {
        colour.filled()
    } else {
        ShapeStyle::from(&colour).stroke_width(2)
    };
    let around = |corners: &[(i32, i32)]| -> Vec<(i32, i32)> {
        corners.iter().map(|(dx, dy)| (x + dx, y + dy)).collect()
    };
    let m = MARKER;
    let corners = match storage {
        None => return area.draw(&Circle::new((x, y), m, style)),
        Some(Storage::Unorm16) => around(&[(-m, -m), (m, -m), (m, m), (-m, m)]),
        Some(Storage::Float16) => around(&[(0, -m - 1), (m + 1, m), (-m - 1, m)]),
        Some(Storage::Float32) => around(&[(0, -m - 2), (m + 2, 0), (0, m + 2), (-m - 2, 0)]),
        Some(Storage::Unorm10) => around(&[(-m - 1, 0), (m + 1, -m - 1), (m + 1, m + 1)]),
        Some(_) => around(&[(-m - 1, -m), (m + 1, -m), (0, m + 1)]),
    };
    if filled {
        return area.draw(&Polygon::new(corners, style));
    }
    let outline: Vec<_> = corners.iter().chain(corners.first()).copied().collect();
    area.draw(&PathElement::new(outline, style))
}

fn draw_legend<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    series: &[ErrorSeries],
) -> Drawn<B> {
    let (left, top) = area.get_base_pixel();
    let text = |label: &str, row: i32| {
        let style = (FONT, 15).into_font().color(&BLACK);
        let style = style.pos(Pos::new(HPos::Left, VPos::Center));
        Text::new(label.to_owned(), (40, row), style)
    };
    let mut row = 40;
    for (index, series) in series.iter().enumerate() {
        let (colour, filled) = look(index);
        let storage = series.points.first().and_then(|point| point.storage);
        draw_marker(area, (left + 22, top + row), storage, colour, filled)?;
        area.draw(&text(&series.name, row))?;
        row += 21;
    }
    row += 14;
    let storages = [
        (Some(Storage::Unorm8), "unorm8"),
        (Some(Storage::Unorm10), "unorm10"),
        (Some(Storage::Unorm16), "unorm16"),
        (Some(Storage::Float16), "float16"),
        (Some(Storage::Float32), "float32"),
        (None, "plain depth"),
    ];
    for (storage, name) in storages {
        let grey = RGBColor(110, 110, 110);
        draw_marker(area, (left + 22, top + row), storage, grey, true)?;
        area.draw(&text(name, row))?;
        row += 21;
    }
    Ok(())
}
