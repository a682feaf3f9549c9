//! What bytes alone say about time: no device moves them faster than its memory allows.
//!
//! Bytes over bandwidth is a lower bound for a graphics processor whose caches hold less than a pass touches. It is no
//! measurement: arithmetic, latency and texels that are read twice only add to it.

use core::fmt;
use core::str::FromStr;

use serde::Serialize;

/// A memory of a known bandwidth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Memory {
    /// Whose it is.
    pub name: String,
    /// Its bandwidth, in 10^9 bytes per second.
    pub gigabytes_per_second: f64,
}

/// The least time that moving some bytes takes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TimeBound {
    /// The memory's name.
    pub memory: String,
    /// The time.
    pub microseconds: f64,
}

impl Memory {
    /// Cards by their makers' figures: that of the lecture on moment shadow maps (Peters, GDC 2016), and those with the
    /// two chips that `moment-shadows-lab isa` compiles for, Vega 10 and Navi 21.
    #[must_use]
    pub fn known() -> Vec<Memory> {
        let cards = [
            ("GTX 970", 224.0),
            ("RX Vega 64", 484.0),
            ("RX 6900 XT", 512.0),
        ];
        let memory = |(name, gigabytes_per_second): (&str, f64)| Memory {
            name: name.to_owned(),
            gigabytes_per_second,
        };
        cards.map(memory).to_vec()
    }

    /// The least time that moving so many bytes takes.
    #[must_use]
    pub fn bound(&self, bytes: u64) -> TimeBound {
        TimeBound {
            memory: self.name.clone(),
            microseconds: bytes as f64 / (self.gigabytes_per_second * 1e3),
        }
    }
}

impl FromStr for Memory {
    type Err = String;

    /// `GB/S` or `GB/S:NAME`.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (number, name) = text.split_once(':').unwrap_or((text, ""));
        let gigabytes_per_second = number
            .trim()
            .parse()
            .ok()
            .filter(|bandwidth: &f64| bandwidth.is_finite() && *bandwidth > 0.0)
            .ok_or_else(|| {
                format!(
                    "'{text}' is no bandwidth; give gigabytes per second above 0, and a name after a colon if you like: 224:GTX 970"
                )
            })?;
        let name = match name.trim() {
            "" => format!("{gigabytes_per_second} GB/s"),
            name => name.to_owned(),
        };
        Ok(Self {
            name,
            gigabytes_per_second,
        })
    }
}

impl fmt::Display for Memory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {} GB/s", self.name, self.gigabytes_per_second)
    }
}
