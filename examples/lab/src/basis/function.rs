//! The functions of depth.

use core::f64::consts::PI;
use core::fmt;

/// A function of depth whose expectation is a generalised moment.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Function {
    /// z^n.
    Power(u32),
    /// sin(2 pi k z).
    Sine(u32),
    /// cos(2 pi k z).
    Cosine(u32),
    /// e^(c z).
    Exponential(f64),
    /// The square root of z, for depths that are not negative.
    Root,
}

impl Function {
    /// Its value at depth `z`.
    #[must_use]
    pub fn at(self, z: f64) -> f64 {
        match self {
            Function::Power(n) => z.powi(n as i32),
            Function::Sine(k) => (2.0 * PI * f64::from(k) * z).sin(),
            Function::Cosine(k) => (2.0 * PI * f64::from(k) * z).cos(),
            Function::Exponential(c) => (c * z).exp(),
            Function::Root => z.max(0.0).sqrt(),
        }
    }
}

impl fmt::Display for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Function::Power(1) => write!(f, "z"),
            Function::Power(n) => write!(f, "z^{n}"),
            Function::Sine(k) => write!(f, "sin {}pi z", 2 * k),
            Function::Cosine(k) => write!(f, "cos {}pi z", 2 * k),
            Function::Exponential(c) => write!(f, "e^{c}z"),
            Function::Root => write!(f, "sqrt z"),
        }
    }
}

/// Functions on an interval of depth.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis {
    /// The functions, without the constant one, which every distribution has.
    pub functions: Vec<Function>,
    /// The least and the greatest depth.
    pub interval: [f64; 2],
}

impl Basis {
    /// z, .., z^count.
    #[must_use]
    pub fn powers(count: u32, interval: [f64; 2]) -> Self {
        Self {
            functions: (1..=count).map(Function::Power).collect(),
            interval,
        }
    }

    /// sin and cos of 2 pi z and of 4 pi z on [0, 1], the best of the i3D 2015 paper's candidates.
    #[must_use]
    pub fn trigonometric() -> Self {
        Self {
            functions: vec![
                Function::Sine(1),
                Function::Cosine(1),
                Function::Sine(2),
                Function::Cosine(2),
            ],
            interval: [0.0, 1.0],
        }
    }

    /// 1 and the value of each function at depth `z`.
    pub fn row(&self, z: f64) -> impl Iterator<Item = f64> {
        core::iter::once(1.0).chain(self.functions.iter().map(move |function| function.at(z)))
    }

    /// The expectations of the functions under surfaces as (depth, weight), whose weights are scaled to sum to 1.
    #[must_use]
    pub fn moments(&self, atoms: &[(f64, f64)]) -> Vec<f64> {
        let total: f64 = atoms.iter().map(|atom| atom.1).sum();
        self.functions
            .iter()
            .map(|function| {
                let sum: f64 = atoms
                    .iter()
                    .map(|&(z, weight)| weight * function.at(z))
                    .sum();
                sum / total
            })
            .collect()
    }
}

impl fmt::Display for Basis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, function) in self.functions.iter().enumerate() {
            let comma = if index == 0 { "" } else { ", " };
            write!(f, "{comma}{function}")?;
        }
        Ok(())
    }
}
