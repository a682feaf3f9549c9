//! Plots as SVG and PNG, and what they have in common.
//!
//! Text is laid out with a font of our own, so that a machine without any draws the same picture.

use core::ops::Range;
use std::path::{Path, PathBuf};

use plotters::backend::{BitMapBackend, DrawingBackend, SVGBackend};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::drawing::{DrawingArea, IntoDrawingArea};
use plotters::style::{FontStyle, RGBColor, WHITE, register_font};

use crate::error::LabError;
use crate::picture::{save_atomically, save_rgba};

/// The font of all text.
pub(crate) const FONT: &str = "sans-serif";

/// Colours that everyone can tell apart (Okabe and Ito, "Color Universal Design", 2008).
pub(crate) const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(0, 0, 0),
];

pub(crate) type Drawn<B> =
    Result<(), plotters::drawing::DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

/// Something that can be drawn.
pub(crate) trait Plot {
    /// Title of the whole plot.
    fn title(&self) -> &str;

    /// Size in pixels.
    fn size(&self) -> (u32, u32);

    /// Draws everything, on white.
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B>;
}

/// Draws a plot as SVG and as PNG into a folder, and gives their paths.
pub(crate) fn save(plot: &impl Plot, folder: &Path, stem: &str) -> Result<[PathBuf; 2], LabError> {
    let [svg, png] = ["svg", "png"].map(|extension| folder.join(format!("{stem}.{extension}")));
    let (width, height) = plot.size();
    let mut text = String::new();
    draw(
        plot,
        &SVGBackend::with_string(&mut text, plot.size()).into_drawing_area(),
    )?;
    save_atomically(&svg, |file| file.write_all(text.as_bytes()))?;
    let mut rgb = vec![255; 3 * (width * height) as usize];
    draw(
        plot,
        &BitMapBackend::with_buffer(&mut rgb, plot.size()).into_drawing_area(),
    )?;
    let rgba: Vec<u8> = rgb
        .chunks_exact(3)
        .flat_map(|pixel| [pixel[0], pixel[1], pixel[2], 255])
        .collect();
    save_rgba(&png, width, height, &rgba)?;
    Ok([svg, png])
}

fn draw<B: DrawingBackend>(plot: &impl Plot, area: &DrawingArea<B, Shift>) -> Result<(), LabError> {
    let failed = |reason: String| LabError::Plot {
        title: plot.title().to_owned(),
        reason,
    };
    register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT)
        .map_err(|_| failed("its font cannot be read".to_owned()))?;
    area.fill(&WHITE)
        .and_then(|()| plot.draw(area))
        .and_then(|()| area.present())
        .map_err(|error| failed(error.to_string()))
}

/// Without the digits that rounding adds to a multiple of a step.
pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A linear scale with ticks of our choice.
pub(crate) struct Scale {
    pub(crate) range: Range<f64>,
    pub(crate) ticks: Vec<f64>,
}

impl Scale {
    /// For some figures above 0: from 0 in round steps to `room` times the largest.
    pub(crate) fn of(figures: impl Iterator<Item = f64>, room: f64) -> Self {
        let largest = figures
            .filter(|figure| figure.is_finite())
            .fold(0.0, f64::max);
        let high = if largest > 0.0 { largest } else { 1.0 };
        let step = [0.1, 0.2, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0]
            .into_iter()
            .find(|step| high / step <= 6.0)
            .unwrap_or(high / 5.0);
        let count = (room * high / step).ceil();
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
