//! How wide penumbrae are: measured on a picture, and as geometry has them behind a straight edge.

use glam::DVec3;

use crate::host::SurfacePixels;
use crate::light::{LightKind, LightShape, LightView};
use crate::scene::{EDGE_HEIGHTS, edge_strip};

/// The shadow intensities between which a width is measured.
pub const LEVELS: [f64; 2] = [0.1, 0.9];

/// The part of a board's edge, around its middle, whose shadow is measured: beside it the next board shows.
const MIDDLE: f64 = 0.4;

/// Pixels of the ground lie at most this high.
const GROUND: f32 = 1e-4;

/// Where the profile of a straight edge begins and ends along x: it holds no other shadow's edge.
const SPAN: [f64; 2] = [-1.2, 3.5];

/// Shadow intensity across a penumbra.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    /// Places, ascending, with the mean intensity around each.
    points: Vec<(f64, f64)>,
}

impl Profile {
    /// The profile of points (place, intensity) in any order: the means of all points within intervals of length `bin`, which
    /// is short beside the penumbra.
    pub fn of(points: impl IntoIterator<Item = (f64, f64)>, bin: f64) -> Self {
        let mut bins = std::collections::BTreeMap::<i64, (f64, f64, f64)>::new();
        for (place, intensity) in points {
            let (places, intensities, count) =
                bins.entry((place / bin).floor() as i64).or_default();
            *places += place;
            *intensities += intensity;
            *count += 1.0;
        }
        Self {
            points: bins
                .into_values()
                .map(|(places, intensities, count)| (places / count, intensities / count))
                .collect(),
        }
    }

    /// The profile of board `number` of the scene of straight edges in a picture of shadow intensity, along x.
    #[must_use]
    pub fn of_edge(pixels: &SurfacePixels, shadow: &[f32], number: usize, bin: f64) -> Self {
        let [low, high] = edge_strip(number);
        let (middle, reach) = (0.5 * (low + high), 0.5 * MIDDLE * (high - low));
        let of_pixel = |(position, &intensity): (&[f32; 3], &f32)| {
            let [x, y, z] = *position;
            let [x, z] = [x, z].map(f64::from);
            let inside = (z - middle).abs() < reach && x > SPAN[0] && x < SPAN[1];
            (y.abs() < GROUND && inside).then(|| (x, f64::from(intensity)))
        };
        let covered = pixels.position.iter().zip(shadow).zip(&pixels.covered);
        Self::of(
            covered
                .filter(|(_, covered)| **covered)
                .filter_map(|(pixel, _)| of_pixel(pixel)),
            bin,
        )
    }

    /// Width of the penumbra between [`LEVELS`], in the unit of the places: the length over which it is darker than the lower
    /// less that over which it is darker than the upper one, so that noise and steps even out. `None` if the profile does
    /// not lead from light to shadow.
    #[must_use]
    pub fn width(&self) -> Option<f64> {
        let ends = [self.points.first()?.1, self.points.last()?.1];
        let [least, most] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        (least < LEVELS[0] && most > LEVELS[1])
            .then(|| self.length_above(LEVELS[0]) - self.length_above(LEVELS[1]))
    }

    /// The length over which the intensity, interpolated, is above a level.
    fn length_above(&self, level: f64) -> f64 {
        self.points
            .windows(2)
            .map(|pair| {
                let [(from, first), (to, second)] = [pair[0], pair[1]];
                let [low, high] = [first.min(second), first.max(second)];
                let part = if low >= level {
                    1.0
                } else if high <= level {
                    0.0
                } else {
                    (high - level) / (high - low)
                };
                part * (to - from)
            })
            .sum()
    }
}

/// Shadow intensity on the ground at `place` (y = 0) below a half-plane at `height` that covers x below 0: the share of the
/// light that it hides.
#[must_use]
pub fn edge_intensity(light: &LightView, shape: LightShape, height: f64, place: DVec3) -> f64 {
    let world_from_view = light.view_from_world.inverse();
    let vector = |axis| world_from_view.transform_vector3(axis);
    let base = match light.kind() {
        LightKind::Directional => vector(DVec3::Z),
        LightKind::Spot => world_from_view.transform_point3(DVec3::ZERO) - place,
    };
    // The ray along t crosses the half-plane's height at x = place.x + t.x height / t.y.
    let crossing = |t: DVec3| place.x * t.y + t.x * height;
    let [width, tall] = shape.extent();
    let right = 0.5 * width * crossing(vector(DVec3::X));
    let up = 0.5 * tall * crossing(vector(DVec3::Y));
    let middle = crossing(base);
    if right == 0.0 && up == 0.0 {
        return if middle < 0.0 { 1.0 } else { 0.0 };
    }
    if shape.is_round() {
        disk_below(-middle / right.hypot(up))
    } else {
        square_below(-middle, right.abs(), up.abs())
    }
}

/// Width on the ground, along x, between [`LEVELS`] of [`edge_intensity`] at `z`.
#[must_use]
pub fn edge_width(light: &LightView, shape: LightShape, height: f64, z: f64) -> f64 {
    let crossing = |level: f64| {
        let [mut low, mut high] = [-1e3, 1e3];
        for _ in 0..80 {
            let x = 0.5 * (low + high);
            if edge_intensity(light, shape, height, DVec3::new(x, 0.0, z)) > level {
                low = x;
            } else {
                high = x;
            }
        }
        0.5 * (low + high)
    };
    crossing(LEVELS[0]) - crossing(LEVELS[1])
}

/// The widths below each board of the scene of straight edges, at the middle of its edge.
#[must_use]
pub fn edge_widths(light: &LightView, shape: LightShape) -> [f64; EDGE_HEIGHTS.len()] {
    std::array::from_fn(|number| {
        let [low, high] = edge_strip(number);
        edge_width(light, shape, EDGE_HEIGHTS[number], 0.5 * (low + high))
    })
}

/// The share of the unit disk with x below `end`.
fn disk_below(end: f64) -> f64 {
    let x = end.clamp(-1.0, 1.0);
    0.5 + (x * (1.0 - x * x).sqrt() + x.asin()) / std::f64::consts::PI
}

/// The share of the square from -1 to 1 where `a x + b y` is below `end`; a and b are not negative, and not both 0.
fn square_below(end: f64, a: f64, b: f64) -> f64 {
    let [narrow, wide] = [a.min(b), a.max(b)];
    if narrow < 1e-12 * wide {
        return (0.5 + 0.5 * end / wide).clamp(0.0, 1.0);
    }
    // The convolution of two boxes, integrated: second differences of the square of what is above zero.
    let square = |x: f64| x.max(0.0).powi(2);
    let sum = square(end + a + b) - square(end + a - b) - square(end - a + b) + square(end - a - b);
    (sum / (8.0 * a * b)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_disks_and_squares_are_those_of_geometry() {
        for (end, share) in [(-2.0, 0.0), (-1.0, 0.0), (0.0, 0.5), (1.0, 1.0)] {
            assert!((disk_below(end) - share).abs() < 1e-12, "{end}");
        }
        // A tenth of a disk is cut off at 0.687 of its radius.
        assert!((disk_below(0.687) - 0.9).abs() < 1e-3);
        // A corner with sides of 1/2 and 1 of a square with sides of 2.
        assert!((square_below(-2.0, 2.0, 1.0) - 0.0625).abs() < 1e-12);
        assert!((square_below(0.5, 0.0, 1.0) - 0.75).abs() < 1e-12);
        assert!((square_below(0.5, 1e-9, 1.0) - 0.75).abs() < 1e-6);
    }

    #[test]
    fn widths_of_ramps_are_found_in_any_order_and_noise() {
        let ramp = |x: f64| (0.5 - x / 2.0).clamp(0.0, 1.0);
        // The ramp is 2 wide; between the levels 0.8 of that. Noise of 0.04 moves either end by up to 0.08.
        for (noise, tolerance) in [(0.0, 1e-3), (0.04, 0.16)] {
            let mut points: Vec<(f64, f64)> = (-300..300)
                .map(|step| f64::from(step) / 100.0)
                .map(|x| (x, (ramp(x) + noise * (40.0 * x).sin()).clamp(0.0, 1.0)))
                .collect();
            points.reverse();
            let width = Profile::of(points, 0.05).width();
            assert!(
                width.is_some_and(|width| (width - 1.6).abs() < tolerance),
                "{width:?}"
            );
        }
        assert_eq!(Profile::of([(0.0, 0.2), (1.0, 0.9)], 0.1).width(), None);
        assert_eq!(Profile::default().width(), None);
    }
}
