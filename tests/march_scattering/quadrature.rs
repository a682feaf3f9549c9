//! Integrals in double precision, without any closed form.

/// The integral of a function by adaptive Simpson's rule, to a part of its value.
pub(crate) fn integral(f: &dyn Fn(f64) -> f64, from: f64, to: f64, relative: f64) -> f64 {
    // Panels first, so that a narrow peak between them is seen.
    const PANELS: usize = 64;
    let place = |panel: usize| from + (to - from) * panel as f64 / PANELS as f64;
    let panel = |panel: usize| {
        let [a, b] = [place(panel), place(panel + 1)];
        [a, 0.5 * (a + b), b].map(|x| (x, f(x)))
    };
    let panels: Vec<_> = (0..PANELS).map(panel).collect();
    let rough: f64 = panels.iter().map(|points| simpson(points).abs()).sum();
    let tolerance = relative * rough / PANELS as f64;
    panels
        .iter()
        .map(|points| refined(f, points, tolerance, 40))
        .sum()
}

fn simpson([a, m, b]: &[(f64, f64); 3]) -> f64 {
    (b.0 - a.0) / 6.0 * (a.1 + 4.0 * m.1 + b.1)
}

fn refined(f: &dyn Fn(f64) -> f64, points: &[(f64, f64); 3], tolerance: f64, depth: u32) -> f64 {
    let &[a, m, b] = points;
    let between = |a: (f64, f64), b: (f64, f64)| {
        let x = 0.5 * (a.0 + b.0);
        [a, (x, f(x)), b]
    };
    let (left, right) = (between(a, m), between(m, b));
    let (whole, halves) = (simpson(points), simpson(&left) + simpson(&right));
    if depth == 0 || (halves - whole).abs() <= 15.0 * tolerance {
        return halves + (halves - whole) / 15.0;
    }
    refined(f, &left, 0.5 * tolerance, depth - 1) + refined(f, &right, 0.5 * tolerance, depth - 1)
}
