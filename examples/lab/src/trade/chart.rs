//! A chart of errors against a cost, both on logarithmic scales, as SVG.

use core::fmt::Write;

use super::front::front;

/// Colours that everyone can tell apart (Okabe and Ito, "Color Universal Design", 2008), and darker ones of the same.
const COLOURS: [&str; 14] = [
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000", "#004a75",
    "#8c3d00", "#00614a", "#8f4673", "#2f7fb0", "#966700", "#777777",
];

/// The colour of the series of a number.
#[must_use]
pub fn colour(series: usize) -> &'static str {
    COLOURS[series % COLOURS.len()]
}

/// Width and height of the drawing, and where its axes lie.
const SIZE: [f64; 2] = [520.0, 380.0];
const LEFT: f64 = 58.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 14.0;
const BOTTOM: f64 = 46.0;

/// A point.
#[derive(Clone, Debug)]
pub struct Point {
    /// Cost and error, both above 0.
    pub at: [f64; 2],
    /// The number of its series, which gives the colour.
    pub series: usize,
    /// What a reader is told who points at it.
    pub told: String,
    /// What stands beside it if it is on the front.
    pub label: String,
}

/// The chart of some points with their front. `axes` say what is along x and y.
#[must_use]
pub fn svg(points: &[Point], axes: [&str; 2]) -> String {
    let drawn: Vec<&Point> = (points.iter())
        .filter(|point| {
            point
                .at
                .iter()
                .all(|figure| figure.is_finite() && *figure > 0.0)
        })
        .collect();
    let [width, height] = SIZE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"system-ui, sans-serif\" \
         font-size=\"12\" role=\"img\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
    );
    if drawn.is_empty() {
        svg += "<text x=\"20\" y=\"30\">there is nothing to show</text>\n</svg>\n";
        return svg;
    }
    let scales = [0, 1].map(|axis| Scale::over(drawn.iter().map(|point| point.at[axis])));
    let place = |at: [f64; 2]| {
        let [x, y] = [0, 1].map(|axis| scales[axis].share(at[axis]));
        [
            LEFT + x * (width - LEFT - RIGHT),
            height - BOTTOM - y * (height - TOP - BOTTOM),
        ]
    };
    // Writing into a string does not fail.
    let mut put = |line: String| {
        let _ = writeln!(svg, "{line}");
    };
    let (bottom, right) = (height - BOTTOM, width - RIGHT);
    for value in scales[0].ticks() {
        let [x, _] = place([value, scales[1].low]);
        put(format!(
            "<path d=\"M{x:.1} {TOP}V{bottom}\" stroke=\"#e4e4e4\"/>"
        ));
        let (y, text) = (bottom + 17.0, number(value));
        put(format!(
            "<text x=\"{x:.1}\" y=\"{y}\" text-anchor=\"middle\" fill=\"#444\">{text}</text>"
        ));
    }
    for value in scales[1].ticks() {
        let [_, y] = place([scales[0].low, value]);
        put(format!(
            "<path d=\"M{LEFT} {y:.1}H{right}\" stroke=\"#e4e4e4\"/>"
        ));
        let (x, base, text) = (LEFT - 7.0, y + 4.0, number(value));
        put(format!(
            "<text x=\"{x}\" y=\"{base:.1}\" text-anchor=\"end\" fill=\"#444\">{text}</text>"
        ));
    }
    put(format!(
        "<path d=\"M{LEFT} {TOP}V{bottom}H{right}\" fill=\"none\" stroke=\"#444\"/>"
    ));
    let (middle, below) = (0.5 * (LEFT + right), height - 9.0);
    put(format!(
        "<text x=\"{middle}\" y=\"{below}\" text-anchor=\"middle\">{}</text>",
        escaped(axes[0])
    ));
    let half = 0.5 * (TOP + bottom);
    put(format!(
        "<text transform=\"translate(15 {half}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        escaped(axes[1])
    ));
    let best = front(&Vec::from_iter(drawn.iter().map(|point| point.at)));
    let mut line = String::new();
    for (index, &number) in best.iter().enumerate() {
        let [x, y] = place(drawn[number].at);
        line += &match index {
            0 => format!("M{x:.1} {y:.1}"),
            _ => format!("H{x:.1}V{y:.1}"),
        };
    }
    put(format!(
        "<path d=\"{line}\" fill=\"none\" stroke=\"#999\" stroke-width=\"1.5\"/>"
    ));
    for (number, point) in drawn.iter().enumerate() {
        let [x, y] = place(point.at);
        let (radius, opacity) = match best.contains(&number) {
            true => (5.0, 1.0),
            false => (3.2, 0.55),
        };
        put(format!(
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{}\" fill-opacity=\"{opacity}\"><title>{}</title></circle>",
            colour(point.series),
            escaped(&point.told)
        ));
    }
    let mut taken: Vec<[f64; 3]> = Vec::new();
    for &number in &best {
        let point = drawn[number];
        let [x, y] = place(point.at);
        // About what a letter of this size takes.
        let length = 6.0 * point.label.chars().count() as f64;
        let (anchor, beside, from) = match x + 8.0 + length > width {
            true => ("end", x - 8.0, x - 8.0 - length),
            false => ("start", x + 8.0, x + 8.0),
        };
        // Labels that would lie over others are left out: the table has them.
        let is_free = |&[left, right, other]: &[f64; 3]| {
            from > right || from + length < left || (other - y).abs() > 13.0
        };
        if !taken.iter().all(is_free) {
            continue;
        }
        taken.push([from, from + length, y]);
        put(format!(
            "<text x=\"{beside:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\" font-size=\"11\" paint-order=\"stroke\" stroke=\"#fff\" \
             stroke-width=\"3\" fill=\"#222\">{}</text>",
            y - 6.0,
            escaped(&point.label)
        ));
    }
    svg += "</svg>\n";
    svg
}

/// A logarithmic scale.
struct Scale {
    low: f64,
    high: f64,
}

impl Scale {
    fn over(figures: impl Iterator<Item = f64>) -> Self {
        let (low, high) = figures.fold((f64::INFINITY, 0.0_f64), |(low, high), figure| {
            (low.min(figure), high.max(figure))
        });
        Self {
            low: low / 1.25,
            high: high * 1.25,
        }
    }

    fn share(&self, figure: f64) -> f64 {
        (figure / self.low).ln() / (self.high / self.low).ln()
    }

    /// Round numbers between the ends: powers of 10 times 1, 2 and 5, fewer where there would be many.
    fn ticks(&self) -> Vec<f64> {
        let decades = (self.low.log10().floor() as i32)..=(self.high.log10().ceil() as i32);
        let of = |steps: &'static [f64]| {
            let all = decades
                .clone()
                .flat_map(move |decade| steps.iter().map(move |step| step * 10.0_f64.powi(decade)));
            Vec::from_iter(all.filter(|tick| (self.low..=self.high).contains(tick)))
        };
        let many = of(&[1.0, 2.0, 5.0]);
        let few = of(&[1.0]);
        if many.len() <= 9 || few.len() < 2 {
            many
        } else {
            few
        }
    }
}

/// A number as short as it can be told.
fn number(value: f64) -> String {
    match value {
        _ if value >= 1e9 => format!("{}G", round(value / 1e9)),
        _ if value >= 1e6 => format!("{}M", round(value / 1e6)),
        _ if value >= 1e4 => format!("{}k", round(value / 1e3)),
        _ => round(value),
    }
}

fn round(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Text as XML and HTML have it.
#[must_use]
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_labels_and_ticks_are_drawn() {
        let point = |at: [f64; 2], label: &str| Point {
            at,
            series: 0,
            told: format!("{label} & more"),
            label: label.to_owned(),
        };
        let points = [
            point([1.0, 0.1], "fast"),
            point([100.0, 0.001], "right"),
            point([200.0, 0.2], "neither"),
            point([f64::NAN, 0.2], "none"),
        ];
        let svg = svg(&points, ["time", "error <%>"]);
        assert_eq!(svg.matches("<circle").count(), 3);
        assert!(svg.contains(">fast</text>") && svg.contains(">right</text>"));
        assert!(!svg.contains(">neither</text>") && svg.contains("neither &amp; more"));
        assert!(svg.contains(">10</text>") && svg.contains("error &lt;%&gt;"));
        let empty = super::svg(&[], ["time", "error"]);
        assert!(empty.contains("nothing to show"));
    }

    #[test]
    fn scales_have_round_ticks() {
        let scale = Scale {
            low: 0.8,
            high: 30.0,
        };
        assert_eq!(scale.ticks(), [1.0, 2.0, 5.0, 10.0, 20.0]);
        assert_eq!((scale.share(0.8), scale.share(30.0)), (0.0, 1.0));
        assert_eq!(
            [0.05, 3.0, 20_000.0, 5e6].map(number),
            ["0.05", "3", "20k", "5M"]
        );
    }
}
