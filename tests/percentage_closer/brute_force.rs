//! Percentage closer filtering in f64, tap by tap.

use moment_shadows::{DepthConversion, DepthRange};
use rand::RngExt as _;
use rand_chacha::ChaCha8Rng;

use crate::device::Query;

/// Differences of depth below which single precision may decide either way: some roundings of values up to 2.
const TIE: f64 = 2e-6;

/// How a map stores depth.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Convention {
    Orthographic {
        reversed: bool,
    },
    /// With an infinite far plane where `far` is infinite.
    Perspective {
        far: f64,
        reversed: bool,
    },
    Linear,
}

impl Convention {
    pub(crate) const ALL: [Convention; 7] = [
        Convention::Orthographic { reversed: false },
        Convention::Orthographic { reversed: true },
        Convention::Perspective {
            far: 12.0,
            reversed: false,
        },
        Convention::Perspective {
            far: 12.0,
            reversed: true,
        },
        Convention::Perspective {
            far: f64::INFINITY,
            reversed: false,
        },
        Convention::Perspective {
            far: f64::INFINITY,
            reversed: true,
        },
        Convention::Linear,
    ];

    /// The near plane of the perspective ones.
    pub(crate) const NEAR: f64 = 0.5;

    /// The distances of moment depth -1 and 1.
    pub(crate) fn range(self) -> DepthRange {
        match self {
            Convention::Orthographic { .. } => DepthRange {
                near: 0.0,
                far: 1.0,
            },
            Convention::Perspective { .. } => DepthRange {
                near: 1.0,
                far: 9.0,
            },
            // Depth textures hold no more than 1.
            Convention::Linear => DepthRange {
                near: 0.25,
                far: 0.75,
            },
        }
    }

    pub(crate) fn conversion(self) -> DepthConversion {
        let range = self.range();
        match self {
            Convention::Orthographic { reversed: false } => DepthConversion::orthographic(),
            Convention::Orthographic { reversed: true } => {
                DepthConversion::orthographic().reversed()
            }
            Convention::Perspective {
                far,
                reversed: false,
            } => DepthConversion::perspective(Self::NEAR, far, range).unwrap(),
            Convention::Perspective {
                far,
                reversed: true,
            } => DepthConversion::perspective(Self::NEAR, far, range)
                .unwrap()
                .reversed(),
            Convention::Linear => DepthConversion::linear(range).unwrap(),
        }
    }

    /// What texels without a caster hold.
    fn cleared(self) -> f32 {
        if self.reversed() { 0.0 } else { 1.0 }
    }

    /// Whether stored depth falls away from the light.
    pub(crate) fn reversed(self) -> bool {
        matches!(
            self,
            Convention::Orthographic { reversed: true }
                | Convention::Perspective { reversed: true, .. }
        )
    }

    fn distance(self, moment_depth: f64) -> f64 {
        let DepthRange { near, far } = self.range();
        near + (far - near) * 0.5 * (moment_depth + 1.0)
    }

    /// What the map stores for a moment depth.
    pub(crate) fn store(self, moment_depth: f64) -> f64 {
        let t = self.distance(moment_depth);
        match self {
            Convention::Orthographic { reversed } => {
                if reversed {
                    1.0 - t
                } else {
                    t
                }
            }
            Convention::Perspective { far, reversed } => {
                let near = Self::NEAR;
                let reverse = (near / t - near / far) / (1.0 - near / far);
                if reversed { reverse } else { 1.0 - reverse }
            }
            Convention::Linear => t,
        }
    }

    /// The moment depth that a map stores.
    pub(crate) fn moment_depth(self, stored: f64) -> f64 {
        let t = match self {
            Convention::Orthographic { reversed } => {
                if reversed {
                    1.0 - stored
                } else {
                    stored
                }
            }
            Convention::Perspective { far, reversed } => {
                let near = Self::NEAR;
                let reverse = if reversed { stored } else { 1.0 - stored };
                near / (reverse * (1.0 - near / far) + near / far)
            }
            Convention::Linear => stored,
        };
        let DepthRange { near, far } = self.range();
        (((2.0 * t - near - far) / (far - near)).clamp(-1.0, 1.0)).min(1.0)
    }
}

/// A map's layer in moment depth.
pub(crate) struct Layer {
    pub(crate) width: u32,
    pub(crate) depths: Vec<f64>,
}

impl Layer {
    pub(crate) fn new(size: [u32; 2], convention: Convention, stored: &[f32]) -> Self {
        assert_eq!(stored.len() as u32, size[0] * size[1]);
        Self {
            width: size[0],
            depths: stored
                .iter()
                .map(|&depth| convention.moment_depth(f64::from(depth)))
                .collect(),
        }
    }
}

/// Random stored depths, and texels without a caster.
pub(crate) fn random_depths(
    random: &mut ChaCha8Rng,
    size: [u32; 2],
    convention: Convention,
) -> Vec<f32> {
    (0..size[0] * size[1])
        .map(|_| {
            if random.random::<f64>() < 0.2 {
                convention.cleared()
            } else {
                convention.store(random.random_range(-1.0..0.99)) as f32
            }
        })
        .collect()
}

/// The lowest and the highest intensity that roundings may give to a query with the given weights along either axis.
pub(crate) fn intensity(
    layer: &Layer,
    query: &Query,
    weights: &[f64],
    interpolated: bool,
) -> [f64; 2] {
    let [origin, extent] = [query.region.origin, query.region.extent];
    let taps = [0, 1].map(|axis| {
        axis_taps(
            f64::from(query.uv[axis]),
            extent[axis],
            weights,
            interpolated,
        )
    });
    let mut sums = [0.0; 2];
    for &(y, row) in &taps[1] {
        for &(x, column) in &taps[0] {
            let depth = layer.depths[((origin[1] + y) * layer.width + origin[0] + x) as usize];
            let plane = plane_depth(query, [x, y]);
            for (sum, tie) in sums.iter_mut().zip([-TIE, TIE]) {
                if depth < plane + tie {
                    *sum += row * column;
                }
            }
        }
    }
    sums
}

/// Texels of a region along one axis and their weights, which sum to 1.
fn axis_taps(uv: f64, extent: u32, weights: &[f64], interpolated: bool) -> Vec<(u32, f64)> {
    let total: f64 = weights.iter().sum();
    let last = i64::from(extent) - 1;
    let place = uv.clamp(0.0, 1.0) * f64::from(extent);
    let centres = if interpolated {
        // Where a filtered map is looked up: the next two of its texels, of which it repeats the last.
        let low = (place - 0.5).floor();
        let fraction = place - 0.5 - low;
        vec![(low as i64, 1.0 - fraction), (low as i64 + 1, fraction)]
    } else {
        vec![(place.floor() as i64, 1.0)]
    };
    let radius = (weights.len() / 2) as i64;
    let mut taps = Vec::new();
    for (centre, share) in centres {
        let centre = centre.clamp(0, last);
        for (offset, weight) in (-radius..).zip(weights) {
            let texel = (centre + offset).clamp(0, last);
            taps.push((texel as u32, share * weight / total));
        }
    }
    taps
}

/// The plane of a query at the centre of a texel of its region.
fn plane_depth(query: &Query, texel: [u32; 2]) -> f64 {
    let rise: f64 = (0..2)
        .map(|axis| {
            let place =
                f64::from(query.uv[axis]).clamp(0.0, 1.0) * f64::from(query.region.extent[axis]);
            f64::from(query.gradient[axis]) * (f64::from(texel[axis]) + 0.5 - place)
        })
        .sum();
    let light = f64::from(query.light_depth);
    let depth = f64::from(query.depth);
    // The distance from the light is the receiver's over a linear function.
    let reach = depth - light;
    let divisor = 1.0 - rise / reach;
    let bias = f64::from(query.bias);
    let plane = if divisor <= 0.0 {
        1.0
    } else if light < -1e20 {
        depth - bias + rise
    } else {
        // The bias shrinks all distances alike.
        light + (reach - bias) / divisor
    };
    plane.min(1.0)
}
