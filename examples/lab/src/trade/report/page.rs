//! The page.

use core::fmt::Write;

use super::super::chart::{colour, escaped};
use super::super::journal::Finding;
use super::super::results::{Results, Row};
use super::section::{Line, Section, stored};

const STYLE: &str = include_str!("style.css");

/// The page with all sections.
pub(super) fn page(results: &Results, sections: &[Section<'_>], findings: &[Finding]) -> String {
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" \
         content=\"width=device-width, initial-scale=1\">\n<title>moment-shadows: the trade</title>\n<style>\n{STYLE}</style>\n\
         </head>\n<body>\n<main>\n<h1>What shadows cost, and how far they are off</h1>\n"
    );
    page += &setting(results);
    page += "<nav><ul>\n";
    for (number, section) in sections.iter().enumerate() {
        let title = title(section);
        page += &format!("<li><a href=\"#s{number}\">{title}</a></li>\n");
    }
    page += "</ul></nav>\n";
    for (number, section) in sections.iter().enumerate() {
        page += &format!("<section id=\"s{number}\">\n<h2>{}</h2>\n", title(section));
        page += &shown(section);
        page += "</section>\n";
    }
    for finding in findings {
        if let Finding::Job {
            job, scene, text, ..
        } = finding
        {
            let what = match job.as_str() {
                "soft" => "Soft shadows of an area light, against the sampled light",
                _ => "Light in the air, against marched rays",
            };
            page += &format!(
                "<section>\n<h2>{what}: {}</h2>\n<pre>{}</pre>\n<p>Pictures are in the folder <code>{job}</code> beside this \
                 page.</p>\n</section>\n",
                escaped(scene),
                escaped(text)
            );
        }
    }
    page + "</main>\n</body>\n</html>\n"
}

fn title(section: &Section<'_>) -> String {
    let texels = match section.radius {
        1 => "1 texel".to_owned(),
        radius => format!("{radius} texels"),
    };
    let views = match section.rows.first().map_or(0, |line| line.row.views.len()) {
        1 => "1 view".to_owned(),
        views => format!("{views} views"),
    };
    format!("{}, filtered by {texels}, {views}", escaped(section.scene))
}

/// What the figures are of.
fn setting(results: &Results) -> String {
    let setting = &results.setting;
    let [width, height] = setting.picture;
    let time = match setting.is_software {
        true => {
            "The adapter is a processor, so times rank what is done as a processor does it: for a graphics card the charts of \
                 bytes and instructions say more"
        }
        false => "Times are of the device's own clock",
    };
    format!(
        "<p>Errors are mean absolute differences of shadow intensity in percent of full shadow, against percentage-closer filtering \
         of {} samples per texel of a map of {}² texels, whatever the map of the technique: a smaller map and fewer samples are \
         errors too. <b>Picture</b>: over the pixels of {width}x{height} that face the light, the mean of the views, with the \
         interval that another view of the scene lies in with 90 %: take it for what is seen from such cameras. <b>All surfaces</b>: over everything that the light's rays meet, hidden or not: take it where cameras go \
         anywhere, and for what leaks behind occluders. <b>FLIP</b>: how different the lit pictures look to someone who flips between \
         truth and technique, in percent, the mean over pixels at 67 of them per degree of sight.</p>\n\
         <p>Times are in copies of a map of 1024² texels of 64 bits by a compute shader, in the same rounds. {time}. Instructions \
         are those of the shader that shades, by the compiler for RDNA 2, where the kept table has its row.</p>\n\
         <p class=\"setting\">{}; profile {}; library {}</p>\n",
        setting.truth_samples,
        setting.truth_map,
        escaped(&setting.adapter),
        escaped(&setting.profile),
        escaped(&setting.library),
    )
}

fn shown(section: &Section<'_>) -> String {
    let mut html = String::from("<div class=\"charts\">\n");
    for chart in &section.charts {
        html += &format!(
            "<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n",
            chart.svg, chart.caption
        );
    }
    html += "</div>\n<p class=\"legend\">\n";
    for (number, name) in section.series.iter().enumerate() {
        let colour = colour(number);
        html += &format!(
            "<span><i style=\"background:{colour}\"></i>{}</span>\n",
            escaped(name)
        );
    }
    html += "</p>\n";
    let (best, others): (Vec<&Line>, Vec<&Line>) =
        (section.rows.iter()).partition(|line| line.on_fronts.contains(&true));
    html += "<h3>What nothing beats</h3>\n";
    html += &table(&best);
    html += &format!("<details>\n<summary>The other {}</summary>\n", others.len());
    html += &table(&others);
    html += "</details>\n";
    if let Some(held_out) = section.held_out {
        html += &format!("<p>{held_out}</p>\n");
    }
    if !section.crops.is_empty() {
        html += "<h3>Where each errs most</h3>\n<p>The part of its worst view with the largest error: the truth, the technique, and the \
                 difference, red where it is too dark, blue where light leaks; half of full shadow has the full colour.</p>\n\
                 <div class=\"crops\">\n";
        for (row, crop) in &section.crops {
            html += &format!(
                "<figure>\n<img src=\"data:image/png;base64,{}\" alt=\"{}: truth, result and difference\">\n<figcaption>{}, {}<br>\
                 view {}, {:.1} % here</figcaption>\n</figure>\n",
                crop.png,
                escaped(&row.name),
                escaped(&row.name),
                stored(row),
                crop.view,
                100.0 * crop.error
            );
        }
        html += "</div>\n";
    }
    html
}

/// Heads of the table's columns.
const HEADS: [&str; 14] = [
    "technique",
    "storage",
    "map",
    "samples",
    "bits",
    "picture",
    "90 % interval",
    "leaking",
    "worst view",
    "FLIP",
    "all surfaces",
    "time",
    "MiB",
    "inv. thr.",
];

fn table(lines: &[&Line<'_>]) -> String {
    let mut html = String::from("<div class=\"wide\"><table>\n<thead><tr>");
    for head in HEADS {
        // Writing into a string does not fail.
        let _ = write!(html, "<th>{head}</th>");
    }
    html += "<th>best by</th></tr></thead>\n<tbody>\n";
    for line in lines {
        html += "<tr>";
        for cell in cells(line.row, line.interval) {
            let _ = write!(html, "<td>{}</td>", escaped(&cell));
        }
        let fronts = ["time", "bytes", "instructions"]
            .into_iter()
            .zip(line.on_fronts);
        let best: Vec<&str> = fronts.filter(|(_, on)| *on).map(|(name, _)| name).collect();
        let _ = writeln!(html, "<td>{}</td></tr>", best.join(", "));
    }
    html + "</tbody>\n</table></div>\n"
}

fn cells(row: &Row, interval: Option<[f64; 2]>) -> [String; 14] {
    let percent =
        |error: Option<f64>| error.map_or("-".to_owned(), |it| format!("{:.3}", 100.0 * it));
    let leaking = row.views.iter().filter_map(|view| view.picture);
    let leaking = super::super::results::mean(leaking.map(|picture| picture.leaking));
    let worst = row.worst_view().and_then(|view| view.picture);
    [
        row.name.clone(),
        row.storage
            .map_or("depth", |storage| storage.name())
            .to_owned(),
        row.cell.map.to_string(),
        row.cell.samples.to_string(),
        row.bits_per_texel.to_string(),
        percent(row.error()),
        interval.map_or("-".to_owned(), |[low, high]| {
            format!("{:.3} to {:.3}", 100.0 * low, 100.0 * high)
        }),
        percent(leaking),
        percent(worst.map(|picture| picture.error)),
        percent(row.flip()),
        percent(row.surface_error()),
        format!("{:.2}", row.time.total.median),
        format!("{:.1}", row.bytes_resident as f64 / f64::from(1 << 20)),
        row.isa
            .map_or("-".to_owned(), |isa| isa.inverse_throughput.to_string()),
    ]
}
