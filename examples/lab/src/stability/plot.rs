//! The picture of the report.

use std::path::{Path, PathBuf};

use plotters::backend::DrawingBackend;
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{PathElement, Rectangle, Text};
use plotters::style::{BLACK, Color, IntoFont, RGBColor};

use super::report::{Report, Row};
use crate::error::LabError;
use crate::plot::{self, Drawn, FONT, Plot};

/// Pixels.
const WIDTH: u32 = 1280;
const ROW: i32 = 22;
const TOP: i32 = 92;
const LEFT: i32 = 230;
const RIGHT: i32 = 1180;

/// Excesses from 1e-8 to 1.
const DECADES: i32 = 8;

/// Colours of the quantiles, of the largest and of the climbed excess (Okabe and Ito, "Color Universal Design", 2008).
const COLOURS: [(&str, RGBColor); 6] = [
    ("99 %", RGBColor(86, 180, 233)),
    ("99.9 %", RGBColor(0, 114, 178)),
    ("99.99 %", RGBColor(0, 158, 115)),
    ("99.999 %", RGBColor(230, 159, 0)),
    ("largest", RGBColor(213, 94, 0)),
    ("climbed", RGBColor(204, 121, 167)),
];

/// Draws the excess over the truth of every row: quantiles, the largest, and what is allowed.
pub fn save(report: &Report, folder: &Path) -> Result<[PathBuf; 2], LabError> {
    plot::save(report, folder, "stability")
}

impl Plot for Report {
    fn title(&self) -> &str {
        "shadow intensity above the truth"
    }

    fn size(&self) -> (u32, u32) {
        (WIDTH, TOP as u32 + self.rows.len() as u32 * ROW as u32 + 46)
    }

    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B> {
        draw_rows(area, self)
    }
}

/// The place of an excess; what is below the scale is at its left end.
fn place(excess: f64) -> i32 {
    let share = (excess.max(1e-30).log10() / f64::from(DECADES) + 1.0).clamp(0.0, 1.0);
    LEFT + (share * f64::from(RIGHT - LEFT)).round() as i32
}

fn draw_rows<B: DrawingBackend>(area: &DrawingArea<B, Shift>, report: &Report) -> Drawn<B> {
    let text = |text: String, at: (i32, i32), size: i32| {
        Text::new(text, at, (FONT, size).into_font().color(&BLACK))
    };
    let effort = report.effort;
    let setting = format!(
        "{}, {} inputs per technique and storage, {} hill-climbs, seed {}; bars end at what is allowed for filters up to 9 texels wide",
        report.adapter,
        effort.samples,
        super::CLIMBS,
        effort.seed
    );
    area.draw(&text(report.title().to_owned(), (16, 12), 24))?;
    area.draw(&text(setting, (16, 42), 14))?;
    for (index, (name, colour)) in (0..).zip(COLOURS) {
        let x = LEFT + 130 * index;
        area.draw(&Rectangle::new([(x, 68), (x + 10, 78)], colour.filled()))?;
        area.draw(&text(name.to_owned(), (x + 16, 65), 15))?;
    }
    let bottom = TOP + report.rows.len() as i32 * ROW;
    for decade in 0..=DECADES {
        let excess = 10.0_f64.powi(decade - DECADES);
        let x = place(excess);
        let line = vec![(x, TOP), (x, bottom)];
        area.draw(&PathElement::new(line, RGBColor(220, 220, 220)))?;
        let name = if decade == DECADES {
            "1".to_owned()
        } else {
            format!("1e{}", decade - DECADES)
        };
        area.draw(&text(name, (x - 12, bottom + 8), 14))?;
    }
    for (index, row) in (0..).zip(&report.rows) {
        let y = TOP + index * ROW;
        let name = format!("{} {}", row.technique, row.storage);
        area.draw(&text(name, (16, y + 2), 15))?;
        draw_row(area, row, y)?;
    }
    Ok(())
}

fn draw_row<B: DrawingBackend>(area: &DrawingArea<B, Shift>, row: &Row, y: i32) -> Drawn<B> {
    let allowed = [(LEFT, y + 5), (place(row.excess.allowed), y + ROW - 5)];
    let shade = if row.passed() {
        RGBColor(232, 232, 232)
    } else {
        RGBColor(255, 200, 200)
    };
    area.draw(&Rectangle::new(allowed, shade.filled()))?;
    let values = row.quantiles.iter().map(|quantile| quantile.excess).chain([
        row.excess.drawn.max(row.wide.drawn),
        row.excess.climbed.max(row.wide.climbed),
    ]);
    for (value, (_, colour)) in values.zip(COLOURS) {
        let x = place(value);
        let mark = [(x - 2, y + 3), (x + 2, y + ROW - 3)];
        area.draw(&Rectangle::new(mark, colour.filled()))?;
    }
    Ok(())
}
