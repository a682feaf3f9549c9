//! Charts of lines as SVG and PNG.
//!
//! Text is laid out with a font of our own, so that a machine without any draws the same picture.

use core::f64::consts::TAU;
use core::ops::Range;
use std::path::{Path, PathBuf};

use plotters::backend::{BitMapBackend, DrawingBackend, SVGBackend};
use plotters::chart::ChartBuilder;
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::element::{EmptyElement, PathElement, Polygon, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{
    BLACK, Color, FontStyle, IntoFont, RGBAColor, RGBColor, WHITE, register_font,
};

use crate::error::LabError;
use crate::picture::{create_folder, save_atomically, save_rgba};

/// The font of all text.
const FONT: &str = "sans-serif";

/// Colours that everyone can tell apart (Okabe and Ito, "Color Universal Design", 2008).
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(0, 0, 0),
];

/// Pixels.
const PANEL_WIDTH: u32 = 480;
const LEGEND_WIDTH: u32 = 220;
const HEIGHT: u32 = 600;

/// Half the width of a marker, in pixels.
const MARKER: f64 = 6.0;

type Drawn<B> =
    Result<(), plotters::drawing::DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

/// A chart with panels side by side.
pub struct Chart {
    /// What is shown.
    pub title: String,
    /// How it was measured.
    pub setting: String,
    /// Panels from left to right. All have the same series, in the same order.
    pub panels: Vec<Panel>,
    /// What the markers of points stand for.
    pub markers: Vec<&'static str>,
}

/// A part of a chart with axes of its own.
pub struct Panel {
    /// What is shown.
    pub title: String,
    /// Along x and y.
    pub axes: [Axis; 2],
    /// Pixels for the labels of y.
    pub label_width: u32,
    /// The lines.
    pub series: Vec<Series>,
}

/// A linear scale.
pub struct Axis {
    /// What is along it.
    pub name: &'static str,
    /// From one end to the other.
    pub range: Range<f64>,
    /// The most labels that it has.
    pub labels: usize,
    /// What a label says of its place.
    pub label: Box<dyn Fn(&f64) -> String>,
}

/// A line.
pub struct Series {
    /// Its name.
    pub name: String,
    /// Points in the order in which they are joined: x, y and which of the chart's markers.
    pub points: Vec<(f64, f64, usize)>,
}

impl Chart {
    /// Draws it as SVG and as PNG into a folder, which is made if need be, and gives their paths.
    pub fn save(&self, folder: &Path, stem: &str) -> Result<[PathBuf; 2], LabError> {
        create_folder(folder)?;
        let [svg, png] = ["svg", "png"].map(|extension| folder.join(format!("{stem}.{extension}")));
        let size = (
            PANEL_WIDTH * self.panels.len() as u32 + LEGEND_WIDTH,
            HEIGHT,
        );
        let mut text = String::new();
        self.draw_on(&SVGBackend::with_string(&mut text, size).into_drawing_area())?;
        save_atomically(&svg, |file| file.write_all(text.as_bytes()))?;
        let mut rgb = vec![255; 3 * (size.0 * size.1) as usize];
        self.draw_on(&BitMapBackend::with_buffer(&mut rgb, size).into_drawing_area())?;
        let rgba: Vec<u8> = rgb
            .chunks_exact(3)
            .flat_map(|pixel| [pixel[0], pixel[1], pixel[2], 255])
            .collect();
        save_rgba(&png, size.0, size.1, &rgba)?;
        Ok([svg, png])
    }

    fn draw_on<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<(), LabError> {
        let failed = |reason: &str| {
            LabError::refused(format!(
                "the plot '{}' cannot be drawn: {reason}",
                self.title
            ))
        };
        register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT)
            .map_err(|_| failed("its font cannot be read"))?;
        area.fill(&WHITE)
            .and_then(|()| self.draw(area))
            .and_then(|()| area.present())
            .map_err(|error| failed(&error.to_string()))
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        let below = area.titled(&self.title, (FONT, 24))?;
        let below = below.titled(&self.setting, (FONT, 14))?;
        let (panels, legend) = below.split_horizontally(PANEL_WIDTH * self.panels.len() as u32);
        let areas = panels.split_evenly((1, self.panels.len()));
        for (area, panel) in areas.iter().zip(&self.panels) {
            panel.draw(area)?;
        }
        let series = self.panels.first().map_or(&[][..], |panel| &panel.series);
        let lines = series.iter().enumerate();
        let lines = lines.map(|(index, line)| {
            let marker = line.points.first().map_or(0, |point| point.2);
            (marker, colour(index), line.name.as_str())
        });
        let grey = RGBColor(110, 110, 110).to_rgba();
        let markers = self.markers.iter().enumerate();
        let markers = markers.map(|(marker, name)| (marker, grey, *name));
        for (y, (marker, colour, name)) in (40..).step_by(21).zip(lines.chain(markers)) {
            legend.draw(&(EmptyElement::at((22, y)) + shape(marker, colour)))?;
            let style = (FONT, 15).into_font().color(&BLACK);
            let style = style.pos(Pos::new(HPos::Left, VPos::Center));
            legend.draw(&Text::new(name.to_owned(), (40, y), style))?;
        }
        Ok(())
    }
}

impl Panel {
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        let [x, y] = &self.axes;
        let mut chart = ChartBuilder::on(area)
            .margin(14)
            .caption(&self.title, (FONT, 18))
            .x_label_area_size(52)
            .y_label_area_size(self.label_width)
            .build_cartesian_2d(x.range.clone(), y.range.clone())?;
        chart
            .configure_mesh()
            .max_light_lines(0)
            .x_desc(x.name)
            .y_desc(y.name)
            .x_labels(x.labels)
            .y_labels(y.labels)
            .x_label_formatter(&x.label)
            .y_label_formatter(&y.label)
            .label_style((FONT, 15))
            .axis_desc_style((FONT, 16))
            .draw()?;
        for (index, series) in self.series.iter().enumerate() {
            let colour = colour(index);
            let line = series.points.iter().map(|&(x, y, _)| (x, y)).collect();
            let line: PathElement<(f64, f64)> =
                PathElement::new::<Vec<_>, _>(line, colour.mix(0.45));
            chart.draw_series([line])?;
            let points = series.points.iter();
            chart.draw_series(
                points.map(|&(x, y, marker)| EmptyElement::at((x, y)) + shape(marker, colour)),
            )?;
        }
        Ok(())
    }
}

/// Colours come again after a round, lighter.
fn colour(index: usize) -> RGBAColor {
    let colour = COLOURS[index % COLOURS.len()];
    colour.mix(if index < COLOURS.len() { 1.0 } else { 0.5 })
}

/// A marker about a pixel: a disk, then polygons of three and more corners.
fn shape(marker: usize, colour: RGBAColor) -> Polygon<(i32, i32)> {
    let corners = if marker == 0 { 16 } else { marker + 2 };
    let at = |corner: usize| {
        let (sin, cos) = (TAU * corner as f64 / corners as f64).sin_cos();
        let round = |part: f64| (MARKER * part).round() as i32;
        (round(sin), round(-cos))
    };
    Polygon::new((0..corners).map(at).collect::<Vec<_>>(), colour.filled())
}
