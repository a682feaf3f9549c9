//! Brute-force percentage closer filtering: the truth for hard shadows that are filtered with a given kernel.
//!
//! Every sample under the kernel is compared with the depth of the receiver's *plane* at that very sample: on a tilted
//! receiver, a comparison with the fragment's own depth would count half of the receiver itself as its occluder. The
//! plane is that of the visible triangle, so a neighbouring triangle that stands in front of it, as on a concave
//! receiver, is an occluder; one that bends away behind it, as on a convex one, is not.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::error::LabError;
use crate::host::SurfacePixels;
use crate::light::{LightKind, LightView};

use super::kernel::{AxisTaps, TapPattern};
use super::surface::{DepthRounding, MomentDepths, pixels};

/// Cosine between plane and ray below which no depth can be told from the plane; the receiver's own depth stands in.
const EDGE_ON: f64 = 1e-7;

/// Relative rounding of single precision.
const SINGLE: f64 = 1.0 / (1 << 24) as f64;

/// Largest angle by which a unit normal turns when its components are rounded to half precision: sqrt(3) half units.
const NORMAL: f64 = 1.7321 / (1 << 12) as f64;

/// Single roundings from a vertex to a stored depth or a stored position: four products and three sums of the
/// transform, and one for interpolation.
const ROUNDINGS: f64 = 8.0;

/// Rasterisers snap vertices to a grid of 1/256 texel, so that a triangle is drawn up to half of that beside its place.
const SNAPPING: f64 = 0.5 / 256.0;

/// The shadow intensity of each pixel of `surface`, 1 = shadowed: the share of samples under the kernel, as the
/// filtered map weighs them, that lie in front of the receiver's plane. Pixels that are not covered, lie outside of
/// the map or behind the light get 0. A plane is taken to end at the far end of moment depth, as the map does, so
/// texels without a caster never shadow; receivers beyond it count as lying at it.
pub fn pcf(
    light: &LightView,
    depths: &MomentDepths,
    taps: &TapPattern,
    surface: &SurfacePixels,
) -> Result<Vec<f32>, LabError> {
    let pixels = pixels(surface)?;
    let filter = Filter {
        light,
        depths,
        taps,
        normal_error: NORMAL,
    };
    Ok((0..pixels)
        .into_par_iter()
        .map_init(Scratch::default, |scratch, pixel| {
            if !surface.covered[pixel] {
                return 0.0;
            }
            let position = surface.position[pixel].map(f64::from);
            let normal = surface.normal[pixel].map(f64::from);
            let (position, normal) = (DVec3::from(position), DVec3::from(normal));
            filter.intensity(position, normal, scratch) as f32
        })
        .collect())
}

/// A point of a surface and the unit normal of its plane, on either side, without rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver {
    /// In world space.
    pub position: DVec3,
    /// In world space.
    pub normal: DVec3,
}

/// Percentage closer filtering for points that are known without the rounding of a G-buffer.
pub fn pcf_at(
    light: &LightView,
    depths: &MomentDepths,
    taps: &TapPattern,
    receivers: &[Receiver],
) -> Vec<f32> {
    let filter = Filter {
        light,
        depths,
        taps,
        normal_error: 0.0,
    };
    receivers
        .par_iter()
        .map_init(Scratch::default, |scratch, receiver| {
            filter.intensity(receiver.position, receiver.normal, scratch) as f32
        })
        .collect()
}

/// Lists that are reused from pixel to pixel.
#[derive(Default)]
struct Scratch {
    columns: AxisTaps,
    rows: AxisTaps,
    /// The weight of the samples in front of the plane, per column.
    fronts: Vec<f64>,
}

struct Filter<'a> {
    light: &'a LightView,
    depths: &'a MomentDepths,
    taps: &'a TapPattern,
    /// Angle by which normals may be off.
    normal_error: f64,
}

impl Filter<'_> {
    fn intensity(&self, position: DVec3, normal: DVec3, scratch: &mut Scratch) -> f64 {
        let inside = |uv: &DVec2| uv.cmpge(DVec2::ZERO).all() && uv.cmple(DVec2::ONE).all();
        let Some(uv) = self.light.uv(position).filter(inside) else {
            return 0.0;
        };
        let Scratch {
            columns,
            rows,
            fronts,
        } = scratch;
        let [width, height] = self.depths.size();
        self.taps.along_axis(uv.x, width, columns);
        self.taps.along_axis(uv.y, height, rows);
        let extent = DVec2::new(columns.weights.len() as f64, rows.weights.len() as f64);
        let plane = ReceiverPlane::new(self, position, normal, uv, extent);
        let texel = DVec2::new(f64::from(width), f64::from(height)).recip();
        let positions = self.depths.positions();
        fronts.clear();
        fronts.resize(columns.weights.len(), 0.0);
        for (y, row_weight) in rows.weights.iter().enumerate() {
            let y = rows.first + y;
            let weight = row_weight / positions.len() as f64;
            for (sample, &[sample_x, sample_y]) in positions.iter().enumerate() {
                let at = DVec2::new(columns.first as f64 + sample_x, y as f64 + sample_y) * texel;
                let stored = self.depths.row(y, sample, columns.first, fronts.len());
                plane.add_fronts(at, texel.x, stored, weight, fronts);
            }
        }
        let sum: f64 = fronts
            .iter()
            .zip(&columns.weights)
            .map(|(f, w)| f * w)
            .sum();
        sum.clamp(0.0, 1.0)
    }
}

/// The plane of a receiver as moment depth over the map.
///
/// For parallel rays its depth is a linear function of uv. For rays from a point its distance is the receiver's over a
/// linear function, the divisor. Errors of what is compared are nearly constant in that linear quantity.
struct ReceiverPlane {
    uv: DVec2,
    /// Gradient over uv of the depth (parallel rays) or of the divisor, which is 1 at the receiver (rays from a point).
    gradient: DVec2,
    /// Parallel rays: moment depth of the receiver. Rays from a point: that of the light itself, ...
    base: f64,
    /// ... and what a divisor of 1 adds to it; 0 for parallel rays.
    reach: f64,
    /// By how much a sample must lie in front of the plane to be told from it, in depth or divisor.
    tolerance: f64,
}

impl ReceiverPlane {
    /// The plane through `position` with `normal`, which projects to `uv`, for taps over `extent` texels.
    fn new(filter: &Filter<'_>, position: DVec3, normal: DVec3, uv: DVec2, extent: DVec2) -> Self {
        let Filter { light, depths, .. } = *filter;
        let normal = light
            .view_from_world
            .transform_vector3(normal)
            .normalize_or_zero();
        let view = light.view_from_world.transform_point3(position);
        let distance = -view.z;
        // x and y in view space per u and v: at any distance for parallel rays, at distance 1 for rays from a point.
        let per_uv = DVec2::new(
            2.0 / light.clip_from_view.x_axis.x,
            -2.0 / light.clip_from_view.y_axis.y,
        );
        let parallel = light.kind() == LightKind::Directional;
        let ray = if parallel {
            DVec3::NEG_Z
        } else {
            view / distance
        };
        let slope = normal.dot(ray);
        let cosine = slope.abs() / ray.length();
        let edge_on = cosine < EDGE_ON || !cosine.is_finite();
        // Where n.p = c meets the ray at distance d along the axis:
        //   parallel rays      d = d0 - (n.xy . (xy - xy0)) / (n . ray)
        //   rays from a point  d = d0 / r,   r = 1 + n.xy . (xy - xy0) / (n . ray)   with xy at distance 1.
        let gradient = if edge_on {
            DVec2::ZERO
        } else {
            DVec2::new(normal.x, normal.y) / slope * per_uv
        };
        let size = DVec2::from_array(depths.size().map(f64::from));
        let snapped = SNAPPING * (gradient / size).abs().element_sum();
        // A rounded position moves the plane along its normal: by 1 / slope of that along the axis. A rounded normal
        // turns it about the position, and where the ray meets it moves most at the tap that is farthest.
        let moved = ROUNDINGS * SINGLE * position.abs().max_element() / slope.abs();
        let farthest = 0.5 * (extent / size * per_uv).length();
        let turned = filter.normal_error * farthest * ray.length() / (slope * slope);
        let (moved, turned) = if edge_on { (0.0, 0.0) } else { (moved, turned) };
        let stored = stored_interval(light, depths.rounding(), distance);
        let depth = light.moment_depth_of_distance(distance);
        if parallel {
            let per_distance = 2.0 / (light.range[1] - light.range[0]);
            let stored = stored.map(|end| (end - distance).abs());
            Self {
                uv,
                gradient: -gradient * per_distance,
                base: depth,
                reach: 0.0,
                tolerance: (snapped + moved + turned + stored[0].max(stored[1])) * per_distance,
            }
        } else {
            let base = light.moment_depth_of_distance(0.0);
            let stored = stored.map(|end| (distance / end - 1.0).abs());
            Self {
                uv,
                gradient,
                base,
                reach: depth - base,
                tolerance: snapped + moved / distance + turned + stored[0].max(stored[1]),
            }
        }
    }

    /// Adds `weight` to each of `fronts` whose sample of `stored` lies in front of the plane. The samples are one
    /// texel of width `step` apart from `first` on.
    fn add_fronts(&self, first: DVec2, step: f64, stored: &[f64], weight: f64, fronts: &mut [f64]) {
        let start = self.gradient.dot(first - self.uv);
        let step = self.gradient.x * step;
        let samples = fronts.iter_mut().zip(stored).enumerate();
        // The plane ends at the far end of depth, which texels without a caster hold.
        if self.reach == 0.0 {
            let start = self.base + start - self.tolerance;
            let end = 1.0 - self.tolerance;
            for (i, (front, &stored)) in samples {
                let plane = start + step * f64::from(i as u32);
                let plane = if plane < end { plane } else { end };
                *front += if stored < plane { weight } else { 0.0 };
            }
        } else {
            // Some errors are relative to the divisor.
            let scale = 1.0 + self.tolerance;
            let start = (1.0 + start) * scale + self.tolerance;
            let step = step * scale;
            for (i, (front, &stored)) in samples {
                let divisor = start + step * f64::from(i as u32);
                // A ray that the plane has turned away from never meets it: the plane lies beyond the far end.
                let plane = self.base + self.reach / divisor;
                let plane = if divisor > 0.0 && plane < 1.0 {
                    plane
                } else {
                    1.0
                };
                *front += if stored < plane { weight } else { 0.0 };
            }
        }
    }
}

/// The distances along the axis between which a surface may be stored that is at `distance`.
fn stored_interval(light: &LightView, rounding: DepthRounding, distance: f64) -> [f64; 2] {
    let clip = light.clip_from_view * DVec3::new(0.0, 0.0, -distance).extend(1.0);
    let stored = clip.z / clip.w;
    // Parallel rays are transformed with an error relative to the whole range; a perspective depth is a quotient, whose
    // error is relative to itself.
    let magnitude = match light.kind() {
        LightKind::Directional => 1.0,
        LightKind::Spot => stored.abs(),
    };
    let storage = match rounding {
        DepthRounding::Float32 => 0.0,
        DepthRounding::Unorm16 => 0.5 / 65535.0,
    };
    let error = ROUNDINGS * SINGLE * magnitude + storage;
    // Beyond 0 and 1 the conversion goes on as it should, except past infinity.
    [stored - error, stored + error].map(|stored| {
        let distance = light.depth.distance(stored);
        if distance > 0.0 {
            distance
        } else {
            f64::INFINITY
        }
    })
}
