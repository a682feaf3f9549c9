//! The moment biases that the papers give, for comparison with the library's.

/// A moment bias `b + alpha (target - b)` as it was published.
#[derive(Clone, Debug, PartialEq)]
pub struct PublishedBias {
    /// What it is for.
    pub name: &'static str,
    /// Where it was published.
    pub source: &'static str,
    /// The least and the greatest depth.
    pub interval: [f64; 2],
    /// The step.
    pub alpha: f64,
    /// b*, the moments towards which the step goes.
    pub target: Vec<f64>,
}

/// All of them.
#[must_use]
pub fn published_biases() -> Vec<PublishedBias> {
    let unit = [0.0, 1.0];
    let signed = [-1.0, 1.0];
    let half = |count: usize| vec![0.5; count];
    // A share of the uniform distribution, whose moments are 1/2, 1/3, ..; the rest at both ends.
    let uniform = |count: i32, share: f64| -> Vec<f64> {
        (1..=count)
            .map(|j| (1.0 - share) * 0.5 + share / f64::from(j + 1))
            .collect()
    };
    let even = |beta: f64| vec![0.0, beta, 0.0, beta];
    let bias = |name, source, interval, alpha, target| PublishedBias {
        name,
        source,
        interval,
        alpha,
        target,
    };
    let first = "Peters & Klein, i3D 2015";
    let supplement = "Peters et al., supplement of \"Beyond Hard Shadows\", i3D 2016";
    let improved = "Peters et al., JCGT 6(1) 2017";
    vec![
        bias("4 moments, f32", first, unit, 2e-6, half(4)),
        bias("4 moments, unorm16", first, unit, 3e-5, half(4)),
        bias(
            "4 moments, unorm16, clamped depth",
            supplement,
            unit,
            3e-5,
            uniform(4, 0.2),
        ),
        bias(
            "6 moments, unorm10",
            supplement,
            unit,
            4e-3,
            uniform(6, 0.5),
        ),
        bias(
            "4 moments, unorm16",
            "Peters, GDC 2016",
            signed,
            6e-5,
            even(0.63),
        ),
        bias("4 moments, f32", improved, signed, 3e-7, even(0.375)),
        bias("4 moments, unorm16", improved, signed, 6e-5, even(0.628)),
    ]
}
