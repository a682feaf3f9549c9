//! A trade as a page and as charts: one file that asks for nothing else.

mod page;
mod section;

use std::path::Path;

use super::journal::Finding;
use super::results::Results;
use crate::error::LabError;
use crate::picture::save_atomically;

/// Writes `report.html` and a chart for each scene, softness and cost, as SVG.
pub(super) fn save(folder: &Path, results: &Results, findings: &[Finding]) -> Result<(), LabError> {
    let save = |name: &str, text: &str| {
        save_atomically(&folder.join(name), |file| file.write_all(text.as_bytes()))
    };
    let sections = section::sections(results, findings);
    for chart in sections.iter().flat_map(|section| &section.charts) {
        save(&format!("{}.svg", chart.name), &chart.svg)?;
    }
    save("report.html", &page::page(results, &sections, findings))
}
