//! Whether techniques rank as published: four moments below exponential variance below variance (Peters and Klein, "Moment
//! Shadow Mapping", i3D 2015, figures 1 and 6).

use core::fmt;

use moment_shadows::{Storage, Technique};
use serde::Serialize;

use super::ErrorRow;

/// The ranks at 64 bits per texel on one scene with one kernel. Mean absolute errors over all surfaces.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ordering {
    /// The scene's name.
    pub scene: String,
    /// Of the Gaussian, in texels.
    pub radius: u32,
    /// Four moments in 16 bits each.
    pub hamburger4: f64,
    /// Exponential variance, the better of one warp in single and both in half precision.
    pub evsm: f64,
    /// Variance in single precision.
    pub vsm: f64,
}

impl Ordering {
    /// Whether the published ranks hold.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.hamburger4 < self.evsm && self.evsm < self.vsm
    }
}

/// The ranks on each scene with each kernel of which all of the techniques were measured.
#[must_use]
pub fn orderings(rows: &[ErrorRow]) -> Vec<Ordering> {
    let same = |a: &ErrorRow, b: &ErrorRow| a.scene == b.scene && a.radius == b.radius;
    rows.chunk_by(same).filter_map(ordering).collect()
}

fn ordering(rows: &[ErrorRow]) -> Option<Ordering> {
    let first = rows.first()?;
    let least = |of: fn(&Technique, Storage) -> bool| {
        let measured = rows.iter().filter(|row| {
            let storage = row.errors.storage;
            storage.is_some_and(|storage| of(&row.errors.technique, storage))
        });
        measured
            .map(|row| row.errors.surfaces.shading.mean_absolute)
            .reduce(f64::min)
    };
    Some(Ordering {
        scene: first.scene.clone(),
        radius: first.radius,
        hamburger4: least(|technique, storage| {
            *technique == Technique::Hamburger4 && storage == Storage::Unorm16
        })?,
        evsm: least(|technique, storage| match technique {
            Technique::Evsm2 { .. } => storage == Storage::Float32,
            Technique::Evsm4 { .. } => storage == Storage::Float16,
            _ => false,
        })?,
        vsm: least(|technique, storage| {
            *technique == Technique::Vsm && storage == Storage::Float32
        })?,
    })
}

impl fmt::Display for Ordering {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = |less: bool| if less { "<" } else { ">=" };
        write!(
            f,
            "64 bits, {}, radius {}: hamburger4 {:.3} {} evsm {:.3} {} vsm {:.3}: {}",
            self.scene,
            self.radius,
            100.0 * self.hamburger4,
            sign(self.hamburger4 < self.evsm),
            100.0 * self.evsm,
            sign(self.evsm < self.vsm),
            100.0 * self.vsm,
            if self.holds() {
                "as published"
            } else {
                "not as published"
            }
        )
    }
}
