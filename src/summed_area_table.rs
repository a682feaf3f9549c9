//! Summed-area tables: what their integers mean, and how exact they are.

use core::fmt;

use serde::{Deserialize, Serialize};

use crate::constants::*;
use crate::{FourMomentsBias, Storage, ValueError};

/// What the integers of a summed-area table mean: the host side of the WGSL module `summed_area_encoding`.
///
/// A table holds channels in [0, 1] as the storage unorm16 has them, times a [`unit`](Self::unit), summed up modulo 2^32. The sum
/// over a rectangle is right as long as it covers at most [`largest_area`](Self::largest_area) texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(try_from = "Written")]
pub struct SummedAreaTable {
    source: Storage,
    largest_kernel: [u32; 2],
}

/// The table's form in files.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct Written {
    source: Storage,
    largest_kernel: [u32; 2],
}

/// The cost of rounding: `per_error` times the error of a channel and what f32 adds, but no less than `smallest`.
fn cost(error: f32, [per_error, of_f32, smallest]: [f32; 3]) -> f32 {
    per_error.mul_add(error, of_f32).max(smallest)
}

impl SummedAreaTable {
    /// The most texels that a kernel can cover: 65537 channels of 65535 units are just below 2^32. Tables of float maps keep
    /// to it, too, so that no table is less exact than 16 bits.
    pub const LARGEST_AREA: u32 = SUMMED_AREA_ENCODING_LARGEST_AREA;

    /// The table with the greatest error.
    pub(crate) const COARSEST: Self = Self {
        source: Storage::Unorm16,
        largest_kernel: [Self::LARGEST_AREA, 1],
    };

    /// The table of a map with this storage, for kernels up to this width and height in texels.
    pub fn new(source: Storage, largest_kernel: [u32; 2]) -> Result<Self, ValueError> {
        if !Storage::OF_FOUR_MOMENTS.contains(&source) {
            let message = format!(
                "no summed-area table is made of a map stored as {source}; one is of unorm16, float16 or float32"
            );
            return Err(ValueError::new("source", message));
        }
        let [width, height] = largest_kernel;
        let refused = |reason: String| {
            let message = format!("a largest kernel of {width}x{height} texels covers {reason}");
            Err(ValueError::new("largest_kernel", message))
        };
        if width == 0 || height == 0 {
            return refused("nothing; along each side there is at least 1".to_owned());
        }
        let most = Self::LARGEST_AREA;
        if u64::from(width) * u64::from(height) > u64::from(most) {
            let beside = width.min(most);
            return refused(format!(
                "more than the {most} whose sum 32 bits hold; next to a width of {beside} the height is at most {}, and a square \
                 has at most {} texels along each side",
                most / beside,
                most.isqrt()
            ));
        }
        Ok(Self {
            source,
            largest_kernel,
        })
    }

    /// The storage of the map that the table is made of.
    #[must_use]
    pub fn source(&self) -> Storage {
        self.source
    }

    /// The largest kernel in texels, in x and y.
    #[must_use]
    pub fn largest_kernel(&self) -> [u32; 2] {
        self.largest_kernel
    }

    /// The area of the largest kernel in texels.
    #[must_use]
    pub fn largest_area(&self) -> u32 {
        // At most `LARGEST_AREA`.
        self.largest_kernel[0] * self.largest_kernel[1]
    }

    /// The integer that a channel of 1 is: divide a sum by this and by the rectangle's area. It is 65535 for unorm16 maps, as
    /// in the maps themselves; for others floor((2^32 - 1) / largest area), less the bits that f32 would round.
    #[must_use]
    pub fn unit(&self) -> u32 {
        if self.source == Storage::Unorm16 {
            return SUMMED_AREA_ENCODING_UNIT_UNORM16 as u32;
        }
        let most = u32::MAX / self.largest_area();
        let rounded = 8_u32.saturating_sub(most.leading_zeros());
        most >> rounded << rounded
    }

    /// The largest error of a mean's channels, apart from that of f32: half a unit, and the rounding of the source's storage.
    #[must_use]
    pub fn error(&self) -> f32 {
        let is_half = self.source == Storage::Float16;
        0.5 / self.unit() as f32 + if is_half { 1.0 / 8192.0 } else { 0.0 }
    }

    /// The smallest safe moment bias for four moments on the real line: for a float32 map 1e-6 for kernels up to 27x27 texels
    /// and 2.8e-6 for 65x65; for a unorm16 map 3.8e-5, since the resolve rounded once; for a float16 map 6e-4.
    ///
    /// With the error e of a channel, alpha >= 4.88 e suffices to first order; arithmetic in f32 adds to it. The map is meant to
    /// come from a resolve: each blur in between rounds again.
    #[must_use]
    pub fn moment_bias(&self) -> FourMomentsBias {
        let of_bias = [
            SUMMED_AREA_ENCODING_BIAS_PER_ERROR,
            SUMMED_AREA_ENCODING_BIAS_OF_F32,
            SUMMED_AREA_ENCODING_SMALLEST_BIAS,
        ];
        FourMomentsBias {
            alpha: cost(self.error(), of_bias),
            second: 0.628,
            fourth: 0.628,
        }
    }

    /// The smallest safe moment bias for four moments on the depth interval (Hausdorff).
    #[must_use]
    pub fn hausdorff_moment_bias(&self) -> FourMomentsBias {
        FourMomentsBias {
            alpha: cost(self.error(), [6.14, 6e-7, 1.6e-6]),
            second: 0.6036,
            fourth: 0.4875,
        }
    }

    /// The smallest variance for two moments: what rounding can take away from it.
    #[must_use]
    pub fn smallest_variance(&self) -> f32 {
        let of_variance = [
            SUMMED_AREA_ENCODING_VARIANCE_PER_ERROR,
            SUMMED_AREA_ENCODING_VARIANCE_OF_F32,
            SUMMED_AREA_ENCODING_SMALLEST_VARIANCE,
        ];
        cost(self.error(), of_variance)
    }
}

impl TryFrom<Written> for SummedAreaTable {
    type Error = ValueError;

    fn try_from(written: Written) -> Result<Self, ValueError> {
        Self::new(written.source, written.largest_kernel)
    }
}

impl fmt::Display for SummedAreaTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [width, height] = self.largest_kernel;
        write!(
            f,
            "a summed-area table of {} for kernels up to {width}x{height}",
            self.source
        )
    }
}
