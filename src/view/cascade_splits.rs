//! Where the cascades of a sun end.

use crate::ValueError;
use crate::value_error::check;

/// Where the cascades of a sun end, between the nearest and the farthest distance.
#[derive(Clone, Debug, PartialEq)]
pub enum CascadeSplits {
    /// So many cascades, between two ways to divide: 0 is uniform, all cascades are equally long; 1 is logarithmic, each is longer than the one
    /// before by the same factor, so that texels grow with the distance (Zhang et al., "Parallel-Split Shadow Maps", VRCIA 2006,
    /// call the middle, 0.5, practical).
    Blend {
        /// The number of cascades, 1 to [`CascadeSplits::MOST`].
        count: u32,
        /// The weight of the logarithmic way, 0 to 1.
        logarithmic: f64,
    },
    /// At these distances, ascending, one less than there are cascades.
    Given(Vec<f64>),
}

impl CascadeSplits {
    /// The largest number of cascades.
    pub const MOST: u32 = 256;

    /// The distances from the nearest to the farthest, one more than there are cascades.
    pub(super) fn ends(&self, near: f64, far: f64) -> Result<Vec<f64>, ValueError> {
        let inner: Vec<f64> = match *self {
            Self::Blend { count, logarithmic } => {
                let valid = (1..=Self::MOST).contains(&count);
                check(valid, "cascades", "count", count, "1 to 256")?;
                let valid = (0.0..=1.0).contains(&logarithmic);
                check(valid, "cascades", "logarithmic", logarithmic, "0 to 1")?;
                let valid = logarithmic == 0.0 || near > 0.0;
                let range = "above 0, unless cascades are divided uniformly";
                check(valid, "cascades", "near", near, range)?;
                let end = |index| {
                    let part = f64::from(index) / f64::from(count);
                    let uniform = near + (far - near) * part;
                    if logarithmic == 0.0 {
                        return uniform;
                    }
                    uniform + logarithmic * (near * (far / near).powf(part) - uniform)
                };
                (1..count).map(end).collect()
            }
            Self::Given(ref inner) => inner.clone(),
        };
        let mut ends = vec![near];
        ends.extend(inner);
        ends.push(far);
        // False for what is no number.
        if ends.len() <= Self::MOST as usize + 1 && ends.is_sorted_by(|a, b| a < b) {
            return Ok(ends);
        }
        let message = format!(
            "cascades cannot end at {ends:?}: give at most {} distances, ascending, between the nearest and the farthest one",
            Self::MOST - 1
        );
        Err(ValueError::new("splits", message))
    }
}
