//! A picture for each score: the worst part of every technique, with what it is compared with and the difference.

use core::fmt::Write;
use std::path::Path;

use super::judge::Scored;
use super::{NAMES, Part, Worst};
use crate::error::LabError;
use crate::picture::save_atomically;
use crate::trade::chart::escaped;
use crate::trade::crop::SIZE;

/// What the three parts of a picture are, and from where on a difference has the full colour.
const PARTS: [&str; 4] = [
    "the truth, the technique, and the difference: red where it is too dark; half of full shadow has the full colour",
    "without a receiver bias, with it, and the difference: blue where it takes shadow away; a tenth of full shadow has the full colour",
    "the truth around a leg, the technique, and the difference: blue where it is too light; half of full shadow has the full colour",
    "a frame, the next, and the difference: red where it is darker, blue where it is lighter; a tenth of full shadow has the full colour",
];

/// How much pictures are enlarged, and the room around them.
const ZOOM: f64 = 1.5;
const GAP: f64 = 12.0;
const LINE: f64 = 18.0;

/// Of all views the worst part for each score and bias.
pub(super) fn worst(row: &Scored, parts: Vec<Part>) -> Vec<Worst> {
    let storage = row.storage.map_or("depth", |storage| storage.name());
    let mut worst: Vec<Worst> = Vec::new();
    for (score, bias, crop) in parts {
        let told = format!(
            "{}: {} {storage}, {bias}, view {}, filter {}: {:.2} % here",
            row.scene,
            row.name,
            crop.view,
            row.cell.radius,
            100.0 * crop.error
        );
        let of = worst.iter_mut().find(|it| it.of == (score, bias));
        match of {
            Some(known) if known.crop.error >= crop.error => {}
            Some(known) => (known.told, known.crop) = (told, crop),
            None => worst.push(Worst {
                of: (score, bias),
                told,
                crop,
            }),
        }
    }
    worst
}

/// Writes a picture for each score that anything was found for, in two columns.
pub(super) fn save(folder: &Path, worst: &[Worst]) -> Result<(), LabError> {
    for (number, (name, parts)) in NAMES.iter().zip(PARTS).enumerate() {
        let shown: Vec<&Worst> = worst.iter().filter(|it| it.of.0 == number).collect();
        if !shown.is_empty() {
            let svg = svg(&format!("{name}: {parts}"), &shown);
            let path = folder.join(format!("{name}.svg"));
            save_atomically(&path, |file| file.write_all(svg.as_bytes()))?;
        }
    }
    Ok(())
}

fn svg(title: &str, shown: &[&Worst]) -> String {
    let [width, height] = [3.0 * f64::from(SIZE[0]), f64::from(SIZE[1])].map(|side| side * ZOOM);
    let [column, row] = [width + GAP, height + LINE + GAP];
    let rows = shown.len().div_ceil(2) as f64;
    let [full_width, full_height] = [2.0 * column + GAP, rows * row + 2.0 * GAP + LINE];
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {full_width} {full_height}\" width=\"{full_width}\" \
         height=\"{full_height}\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" \
         fill=\"#fff\"/>\n<text x=\"{GAP}\" y=\"{LINE}\">{}</text>\n",
        escaped(title)
    );
    for (number, Worst { told, crop, .. }) in shown.iter().enumerate() {
        let x = GAP + column * (number % 2) as f64;
        let y = GAP + LINE + row * (number / 2) as f64;
        // Writing into a string does not fail.
        let _ = writeln!(
            svg,
            "<text x=\"{x}\" y=\"{}\">{}</text>\n<image x=\"{x}\" y=\"{}\" width=\"{width}\" height=\"{height}\" \
             preserveAspectRatio=\"xMinYMin\" style=\"image-rendering:pixelated\" href=\"data:image/png;base64,{}\"/>",
            y + LINE - 5.0,
            escaped(told),
            y + LINE,
            crop.png
        );
    }
    svg + "</svg>\n"
}
