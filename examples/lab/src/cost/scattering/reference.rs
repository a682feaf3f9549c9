//! What the nodes of single scattering have to give, in double precision.

use core::f64::consts::PI;

use glam::{DMat4, DVec3};
use half::f16;
use moment_shadows::{RectifiedFrame, RectifiedView};
use rayon::prelude::*;

use super::super::harness::largest;

/// Texels of float16 as numbers.
fn texel(bytes: &[u8], index: usize) -> [f64; 4] {
    [0, 1, 2, 3].map(|channel| {
        let start = 8 * index + 2 * channel;
        match bytes.get(start..start + 2) {
            Some(&[low, high]) => f16::from_le_bytes([low, high]).to_f64(),
            _ => f64::NAN,
        }
    })
}

/// The largest difference of a plane's prefix sums from those of the plane that was summed up, where rows have these
/// thicknesses per column.
#[must_use]
pub fn sums_error(found: &[u8], summed: &[u8], thicknesses: &[f64]) -> f64 {
    let columns = summed.len() / 8 / thicknesses.len().max(1);
    if found.len() != summed.len() {
        return f64::NAN;
    }
    let row_error = |row: usize| {
        let (mut sum, mut weight, mut error) = ([0.0; 4], 0.0, 0.0);
        for column in 0..columns {
            let of_column = (-thicknesses[row] * column as f64).exp();
            weight += of_column;
            let given = texel(summed, row * columns + column);
            let found = texel(found, row * columns + column);
            for channel in 0..4 {
                sum[channel] += of_column * given[channel];
                error = largest((found[channel] - sum[channel] / weight).abs(), error);
            }
        }
        error
    };
    let rows = (0..thicknesses.len()).into_par_iter().map(row_error);
    rows.reduce(|| 0.0, largest)
}

/// The optical thickness of a column of each row: that of the mean of the smallest and largest sine of the row's view rays.
#[must_use]
pub fn thicknesses(frame: &RectifiedFrame, extinction: f64, size: u32) -> Vec<f64> {
    let width = f64::from(frame.largest_radius) / f64::from(size);
    (0..size)
        .map(|row| extinction * width / mean_sine(frame, azimuth(frame, row, size)))
        .collect()
}

fn azimuth(frame: &RectifiedFrame, row: u32, rows: u32) -> f64 {
    let place = f64::from(row) / f64::from(rows - 1);
    f64::from(frame.first_azimuth) + place * f64::from(frame.azimuth_extent)
}

/// By how much more than the frustum is wide a frame may be, at either end, in radians.
const MARGIN: f64 = 4e-6;

/// The mean sine of two inclinations: among those at which a half plane of this azimuth crosses the side planes of the
/// frustum, and the ends of the frame, the two between which the frustum lies.
fn mean_sine(frame: &RectifiedFrame, azimuth: f64) -> f64 {
    let wide = |vector: [f32; 3]| DVec3::from_array(vector.map(f64::from));
    let [first, extent] = [frame.first_azimuth, frame.azimuth_extent].map(f64::from);
    let azimuth = azimuth.clamp(first + MARGIN, first + extent - MARGIN);
    let [x, y, middle] = [frame.along_x, frame.along_y, frame.along_middle].map(wide);
    let around = DVec3::new(azimuth.cos(), azimuth.sin(), 0.0);
    let sides = [(x, y), (-x, y), (y, x), (-y, x)].map(|(edge, along)| {
        let normal = (middle + edge).cross(along);
        normal * normal.dot(middle).signum()
    });
    let direction = |theta: f64| around * theta.sin() + DVec3::Z * theta.cos();
    let [low, high] = [frame.smallest_inclination, frame.largest_inclination].map(f64::from);
    let mut ends = vec![low, high];
    ends.extend(
        sides
            .map(|normal| (-normal.z).atan2(normal.dot(around)).rem_euclid(PI))
            .into_iter()
            .filter(|theta| (low..=high).contains(theta)),
    );
    ends.sort_by(f64::total_cmp);
    let seen = |pair: &&[f64]| {
        let between = direction(0.5 * (pair[0] + pair[1]));
        sides.iter().all(|side| side.dot(between) >= 0.0)
    };
    let seen: Vec<&[f64]> = ends.windows(2).filter(seen).collect();
    let (Some(first), Some(last)) = (seen.first(), seen.last()) else {
        return f64::NAN;
    };
    let range = [first[0], last[1]];
    let largest = if range[0] < 0.5 * PI && range[1] > 0.5 * PI {
        1.0
    } else {
        range[0].sin().max(range[1].sin())
    };
    0.5 * (range[0].sin().min(range[1].sin()) + largest)
}

/// A light's map with what is needed to resample it.
pub struct Resampled<'a> {
    /// Float16 texels of four moments.
    pub map: &'a [u8],
    /// Texels per side, of the map and of the rectified one.
    pub size: u32,
    /// From scene to the light's clip space.
    pub light: DMat4,
    /// The rectified coordinates.
    pub view: &'a RectifiedView,
}

impl Resampled<'_> {
    /// The largest difference of a rectified map's planes, of every `stride`-th column.
    #[must_use]
    pub fn error(&self, planes: &[Vec<u8>], stride: u32) -> f64 {
        let bytes = 8 * self.size as usize * self.size as usize;
        let [odd, even] = planes else {
            return f64::NAN;
        };
        if odd.len() != bytes || even.len() != bytes {
            return f64::NAN;
        }
        let row_error = |row: u32| {
            (0..self.size)
                .step_by(stride as usize)
                .flat_map(|column| {
                    let expected = self.channels(column, row);
                    let index = row as usize * self.size as usize + column as usize;
                    let [odd, even] = [odd, even].map(|plane| texel(plane, index));
                    let found = [odd, even].concat();
                    let expected = expected.into_iter().flatten().zip(found);
                    expected.map(|(expected, found)| (found - expected).abs())
                })
                .fold(0.0, |error, next| largest(next, error))
        };
        let rows = (0..self.size).into_par_iter().map(row_error);
        rows.reduce(|| 0.0, largest)
    }

    /// Both texels of a ray: the channels of the moments of its occluders between the ends of the range times their weight, with
    /// what is not before the range in the odd ones' fourth channel, and their weight in that of the even ones. None where
    /// rounding decides whether an occluder lies between the ends.
    fn channels(&self, column: u32, row: u32) -> Option<[f64; 8]> {
        let frame = &self.view.frame;
        let size = f64::from(self.size);
        let radius = (f64::from(column) + 0.5) / size * f64::from(frame.largest_radius);
        let (sine, cosine) = azimuth(frame, row, self.size).sin_cos();
        let [first, second, along] = self.view.axes.map(DVec3::from_array);
        let place = DVec3::from_array(self.view.camera) + radius * (cosine * first + sine * second);
        let clip = self.light * place.extend(1.0);
        let depth_per_length = 2.0 * (self.light * along.extend(0.0)).z;
        let raw = self.moments(0.5 * (clip.x + 1.0) * size, 0.5 * (1.0 - clip.y) * size);
        let [low, high] = [frame.largest_inclination, frame.smallest_inclination].map(f64::from);
        let mut moments = [0.0; 6];
        let (mut inner, mut front) = (0.0, 0.0);
        for (depth, weight) in two_depths(raw) {
            let distance = (depth - (2.0 * clip.z - 1.0)) / depth_per_length;
            // The first column is that of view rays along the light.
            let inclination = if column == 0 { 0.0 } else { radius }.atan2(distance);
            let z = 2.0 * (inclination - low) / (high - low) - 1.0;
            // View rays are compared a twentieth of their depth nearer to the light: here occluders are moved the other way.
            let z = (z + 0.05) / 0.95;
            if (z.abs() - 1.0).abs() < UNCERTAIN {
                return None;
            }
            if z.abs() < 1.0 {
                inner += weight;
                for (power, moment) in (1..).zip(&mut moments) {
                    *moment += weight * z.powi(power);
                }
            } else if z < 0.0 {
                front += weight;
            }
        }
        let [a, b, c, d, e, f] = six_channels(moments, inner);
        Some([a, b, c, 1.0 - front, d, e, f, inner])
    }

    /// Three moments between four texels, whose middles lie at halves.
    fn moments(&self, x: f64, y: f64) -> [f64; 3] {
        let last = self.size as f64 - 1.0;
        let [x, y] = [x - 0.5, y - 0.5];
        let mut channels = [0.0; 4];
        for (dx, dy) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let [column, row] = [x.floor() + dx, y.floor() + dy];
            let weight = (1.0 - (x - column).abs()) * (1.0 - (y - row).abs());
            let [column, row] = [column, row].map(|place| place.clamp(0.0, last) as usize);
            let given = texel(self.map, row * self.size as usize + column);
            for channel in 0..4 {
                channels[channel] += weight * given[channel];
            }
        }
        three_moments(channels)
    }
}

/// The first three moments of what a centred float16 texel of four holds (Peters et al., JCGT 6(1) 2017, section 3).
fn three_moments([x, y, z, w]: [f64; 4]) -> [f64; 3] {
    let root = 3.0_f64.sqrt();
    [
        root * z - x / 3.0,
        (y + 0.5) / 8.0 + (w + 0.5),
        0.75 * (root * z - x),
    ]
}

/// Depths this close to an end of the range may be on either side of it in f32.
const UNCERTAIN: f64 = 1e-4;

/// The centred channels of six moments, odd ones first (Peters, GDC 2016), of occluders with a weight.
fn six_channels([b1, b2, b3, b4, b5, b6]: [f64; 6], weight: f64) -> [f64; 6] {
    [
        2.5 * b1 - 10.0 * b3 + 8.0 * b5,
        -1.8749986445 * b1 + 4.20757543111 * b3 - 1.83257678661 * b5,
        1.26583039016 * b1 - 1.47644882902 * b3 + 0.71061660238 * b5,
        4.0 * b2 - 4.0 * b4 - 0.5 * weight,
        9.0 * b2 - 24.0 * b4 + 16.0 * b6 - 0.5 * weight,
        -0.57759806484 * b2 + 4.61936647543 * b4 - 3.07953906655 * b6
            + (0.018888946 - 0.5) * weight,
    ]
}

/// The roots of the quadratic polynomial that is orthogonal to lower ones, with their weights.
fn two_depths([b1, b2, b3]: [f64; 3]) -> [(f64, f64); 2] {
    let variance = b2 - b1 * b1;
    // z^2 + p z + q with the mean 0, and with the mean 0 after multiplication by z.
    let p = (b1 * b2 - b3) / variance;
    let q = -b2 - p * b1;
    let root = (0.25 * p * p - q).max(0.0).sqrt();
    let [low, high] = [-0.5 * p - root, -0.5 * p + root];
    let of_high = (b1 - low) / (high - low);
    [(low, 1.0 - of_high), (high, of_high)]
}
