//! The format of moment-problem vectors: exact truths for explicit mixtures, as JSON.

use std::path::Path;
use std::str::FromStr;

use dashu::rational::RBig;
use serde::Deserialize;

use crate::error::LabError;

/// Bounds of shadow intensity; absent where the rounded input is not a moment vector.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
pub struct Bounds {
    /// inf S(z < depth).
    pub lower: Option<f64>,
    /// sup S(z <= depth).
    pub upper: Option<f64>,
}

impl Bounds {
    /// [lower, upper] if both are given.
    #[must_use]
    pub fn both(self) -> Option<[f64; 2]> {
        Some([self.lower?, self.upper?])
    }
}

/// An explicit mixture with its moments and the bounds at a fragment depth.
#[derive(Clone, Debug, Deserialize)]
pub struct Vector {
    /// A unique name.
    pub id: String,
    /// The regime that the vector stands for.
    pub class: String,
    /// The number of moments.
    pub m: usize,
    /// The least and the greatest depth, for the Hausdorff bounds.
    #[serde(default = "signed_depth")]
    pub interval: [f64; 2],
    /// b_1..b_m as rationals "p/q".
    pub moments: Vec<String>,
    /// The nearest f32 of each.
    pub moments_f32: Vec<f64>,
    /// The fragment's moment depth, exact in f32.
    pub depth: f64,
    /// Bounds over distributions on the real line, for the exact moments.
    pub hamburger: Option<Bounds>,
    /// Bounds over distributions on the depth interval.
    pub hausdorff: Option<Bounds>,
    /// Solver inputs after a moment bias, by storage.
    pub biased: Vec<Biased>,
}

/// The interval of moment depth.
fn signed_depth() -> [f64; 2] {
    [-1.0, 1.0]
}

/// A solver's input in f32 and the exact bounds for exactly this input.
#[derive(Clone, Debug, Deserialize)]
pub struct Biased {
    /// The storage that the bias is meant for.
    #[serde(rename = "for")]
    pub storage: String,
    /// How the fragment depth was chosen.
    pub depth_kind: String,
    /// The fragment's moment depth, exact in f32.
    pub depth: f64,
    /// The moment bias that was applied.
    pub alpha: f64,
    /// The biased moments as bits of f32, "0x3f800000".
    pub input_hex: Vec<String>,
    /// Bounds over distributions on the real line.
    pub hamburger: Option<Bounds>,
    /// Bounds over distributions on the depth interval.
    pub hausdorff: Option<Bounds>,
    /// Componentwise condition number of [lower, upper].
    pub sens: Option<[Option<f64>; 2]>,
    /// Suggested tolerance of [lower, upper].
    pub tol: Option<[Option<f64>; 2]>,
}

impl Biased {
    /// The biased moments, or what is wrong with their text.
    pub fn input(&self) -> Result<Vec<f32>, String> {
        self.input_hex
            .iter()
            .map(|text| {
                text.strip_prefix("0x")
                    .and_then(|digits| u32::from_str_radix(digits, 16).ok())
                    .map(f32::from_bits)
                    .filter(|value| value.is_finite())
                    .ok_or_else(|| {
                        format!(
                            "input_hex '{text}' is not the bits of a finite f32, such as 0x3f800000"
                        )
                    })
            })
            .collect()
    }
}

/// Reads and checks a file. Errors name what is wrong with it, or which of its vectors is wrong and how.
pub fn read(file: &Path) -> Result<Vec<Vector>, LabError> {
    #[derive(Deserialize)]
    struct Top {
        vectors: Vec<serde_json::Value>,
    }
    let path = file.display().to_string();
    let text = std::fs::read_to_string(file)
        .map_err(|error| LabError::unsuitable(&path, format!("it cannot be read: {error}")))?;
    let top: Top = serde_json::from_str(&text).map_err(|error| {
        let reason = format!("it is no file of moment-problem vectors: {error}");
        LabError::unsuitable(&path, reason)
    })?;
    let vectors = top.vectors.into_iter().enumerate();
    let read = |(index, value): (usize, serde_json::Value)| {
        let id = value["id"].as_str().unwrap_or("without id").to_owned();
        let read = Vector::deserialize(value).map_err(|error| error.to_string());
        read.and_then(checked).map_err(|reason| {
            LabError::unsuitable(format!("{path}, vector {index} ('{id}')"), reason)
        })
    };
    vectors.map(read).collect()
}

fn checked(vector: Vector) -> Result<Vector, String> {
    let m = vector.m;
    if m == 0 || !m.is_multiple_of(2) {
        return Err(format!("m is {m}; it must be even and positive"));
    }
    for (name, length) in [
        ("moments", vector.moments.len()),
        ("moments_f32", vector.moments_f32.len()),
    ] {
        if length != m {
            return Err(format!("{name} has {length} entries; m is {m}"));
        }
    }
    if let Some(text) = vector
        .moments
        .iter()
        .find(|text| RBig::from_str(text).is_err())
    {
        return Err(format!("moment '{text}' is not a rational such as -3/4"));
    }
    if let Some(depth) = core::iter::once(vector.depth)
        .chain(vector.biased.iter().map(|record| record.depth))
        .find(|&depth| f64::from(depth as f32) != depth)
    {
        return Err(format!("depth {depth} is not exact in f32"));
    }
    for (index, record) in vector.biased.iter().enumerate() {
        let input = record
            .input()
            .map_err(|reason| format!("biased[{index}]: {reason}"))?;
        if input.len() != m {
            return Err(format!(
                "biased[{index}]: input_hex has {} entries; m is {m}",
                input.len()
            ));
        }
        // The shader's guards are multiples of alpha.
        if !(record.alpha > 0.0 && record.alpha < 1.0) {
            return Err(format!(
                "biased[{index}]: alpha is {}; it must lie between 0 and 1",
                record.alpha
            ));
        }
    }
    Ok(vector)
}
