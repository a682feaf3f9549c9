//! What a step of arithmetic gives: WGSL leaves some of it to the implementation.

/// Which of the results that WGSL allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::export) enum Rule {
    /// The nearest f32 of each sum, product and quotient; `fma` is a product and a sum.
    Separate,
    /// As `Separate`, but `fma` is rounded once.
    Fused,
    /// Any within the accuracy that WGSL asks for, at random.
    Allowed,
}

/// The arithmetic of a run.
pub(in crate::export) struct Rounding {
    rule: Rule,
    state: u64,
}

impl Rounding {
    /// Arithmetic by a rule; `seed` begins what is at random.
    pub(in crate::export) fn new(rule: Rule, seed: u64) -> Self {
        Self {
            rule,
            state: seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1,
        }
    }

    /// A number from 0 to 1, by xorshift.
    fn random(&mut self) -> f64 {
        self.state ^= self.state << 13;
        self.state ^= self.state >> 7;
        self.state ^= self.state << 17;
        (self.state >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// An f32 beside the exact value: what rounding either way gives, as a fused or reordered sum may.
    fn either(&mut self, exact: f64) -> f32 {
        let nearest = exact as f32;
        if self.rule != Rule::Allowed || !nearest.is_finite() || f64::from(nearest) == exact {
            return nearest;
        }
        let other = if f64::from(nearest) < exact {
            nearest.next_up()
        } else {
            nearest.next_down()
        };
        if self.random() < 0.5 { nearest } else { other }
    }

    /// A value that may be off by so many units in the last place.
    pub(super) fn within(&mut self, exact: f64, units: f64) -> f32 {
        let nearest = (exact as f32).abs();
        let unit = f64::from(nearest.next_up()) - f64::from(nearest);
        self.near(exact, units * unit)
    }

    /// A value that may be off by `distance`.
    pub(super) fn near(&mut self, exact: f64, distance: f64) -> f32 {
        if self.rule != Rule::Allowed || !exact.is_finite() {
            return exact as f32;
        }
        (exact + distance * (2.0 * self.random() - 1.0)) as f32
    }

    pub(super) fn add(&mut self, a: f32, b: f32) -> f32 {
        self.either(f64::from(a) + f64::from(b))
    }

    pub(super) fn multiply(&mut self, a: f32, b: f32) -> f32 {
        self.either(f64::from(a) * f64::from(b))
    }

    pub(super) fn divide(&mut self, a: f32, b: f32) -> f32 {
        self.within(f64::from(a) / f64::from(b), 2.5)
    }

    pub(super) fn fma(&mut self, a: f32, b: f32, c: f32) -> f32 {
        let is_fused = match self.rule {
            Rule::Separate => false,
            Rule::Fused => true,
            Rule::Allowed => self.random() < 0.5,
        };
        match (is_fused, self.rule) {
            (true, Rule::Fused) => a.mul_add(b, c),
            (true, _) => self.either(f64::from(a) * f64::from(b) + f64::from(c)),
            (false, _) => {
                let product = self.multiply(a, b);
                self.add(product, c)
            }
        }
    }
}
