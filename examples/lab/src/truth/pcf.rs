//! Brute-force percentage closer filtering: the truth for hard shadows that are filtered with a given kernel.
//!
//! Every sample under the kernel is compared with the depth of the receiver's *plane* at that very sample: on a tilted
//! receiver, a comparison with the fragment's own depth would count half of the receiver itself as its occluder. The
//! plane is that of the visible triangle, so a neighbouring triangle that stands in front of it, as on a concave
//! receiver, is an occluder; one that bends away behind it, as on a convex one, is not.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::light::{LightKind, LightView};

use super::kernel::{AxisTaps, TapPattern};
use super::surface::{DepthRounding, DepthSamples, SurfacePixels, TruthError};

/// Cosine between plane and ray below which no depth can be told from the plane; the receiver's own depth stands in.
const EDGE_ON: f64 = 1e-7;

/// Relative rounding of single precision.
const SINGLE: f64 = 1.0 / (1 << 24) as f64;

/// Single roundings from a vertex to a stored depth or a stored position: four products and three sums of the
/// transform, and one for interpolation.
const ROUNDINGS: f64 = 8.0;

/// Rasterisers snap vertices to a grid of 1/256 texel, so that a triangle is drawn up to half of that beside its place.
const SNAPPING: f64 = 0.5 / 256.0;

/// The shadow intensity of each pixel of `surface`, 1 = shadowed: the share of samples under the kernel, as the
/// filtered map weighs them, that lie in front of the receiver's plane. Pixels that are not covered, lie outside of the map or
/// behind the light get 0. A plane is taken to end at the far end of moment depth, as the map does, so texels without
/// a caster never shadow; receivers beyond it count as lying at it.
pub fn pcf(
    light: &LightView,
    depths: &DepthSamples,
    taps: &TapPattern,
    surface: &SurfacePixels,
) -> Result<Vec<f32>, TruthError> {
    let pixels = surface.pixels()?;
    let filter = Filter {
        light,
        depths,
        taps,
    };
    Ok((0..pixels)
        .into_par_iter()
        .map_init(
            || (AxisTaps::default(), AxisTaps::default()),
            |(columns, rows), pixel| {
                if !surface.covered[pixel] {
                    return 0.0;
                }
                let position = surface.position[pixel].map(f64::from);
                let normal = surface.normal[pixel].map(f64::from);
                let (position, normal) = (DVec3::from(position), DVec3::from(normal));
                filter.intensity(position, normal, columns, rows) as f32
            },
        )
        .collect())
}

struct Filter<'a> {
    light: &'a LightView,
    depths: &'a DepthSamples,
    taps: &'a TapPattern,
}

impl Filter<'_> {
    fn intensity(
        &self,
        position: DVec3,
        normal: DVec3,
        columns: &mut AxisTaps,
        rows: &mut AxisTaps,
    ) -> f64 {
        let inside = |uv: &DVec2| uv.cmpge(DVec2::ZERO).all() && uv.cmple(DVec2::ONE).all();
        let Some(uv) = self.light.uv(position).filter(inside) else {
            return 0.0;
        };
        let [width, height] = self.depths.size();
        self.taps.along_axis(uv.x, width, columns);
        self.taps.along_axis(uv.y, height, rows);
        let plane = ReceiverPlane::new(self.light, self.depths, position, normal, uv);
        let texel = DVec2::new(f64::from(width), f64::from(height)).recip();
        let positions = self.depths.positions();
        let mut sum = 0.0;
        for (y, row_weight) in rows.weights.iter().enumerate() {
            let y = rows.first + y;
            for (sample, &[sample_x, sample_y]) in positions.iter().enumerate() {
                let at = DVec2::new(columns.first as f64 + sample_x, y as f64 + sample_y) * texel;
                let stored = self
                    .depths
                    .row(y, sample, columns.first, columns.weights.len());
                sum += row_weight * plane.in_front(at, texel.x, stored, &columns.weights);
            }
        }
        (sum / positions.len() as f64).clamp(0.0, 1.0)
    }
}

/// The plane of a receiver as moment depth over the map.
struct ReceiverPlane {
    uv: DVec2,
    /// Gradient over uv of `depth` (parallel rays) or of `divisor`, which is 1 at the receiver (rays from a point).
    gradient: DVec2,
    /// Parallel rays: moment depth of the receiver. Rays from a point: of the light itself, ...
    base: f64,
    /// ... and what a divisor of 1 adds to it; 0 for parallel rays.
    reach: f64,
    /// By how much a sample must lie in front of the plane to be told from it.
    tolerance: f64,
}

impl ReceiverPlane {
    fn new(
        light: &LightView,
        depths: &DepthSamples,
        position: DVec3,
        normal: DVec3,
        uv: DVec2,
    ) -> Self {
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
        let (ray, parallel) = match light.kind() {
            LightKind::Directional => (DVec3::NEG_Z, true),
            LightKind::Spot => (view / distance, false),
        };
        let slope = normal.dot(ray);
        let cosine = slope.abs() / ray.length();
        let edge_on = cosine < EDGE_ON || !cosine.is_finite();
        // Where n.p = c meets the ray at distance d along the axis:
        //   parallel rays      d = d0 + (n.xy . (xy - xy0)) / -(n . ray)
        //   rays from a point  d = d0 / r,   r = 1 + n.xy . (xy - xy0) / (n . ray)   with xy at distance 1.
        let gradient = if edge_on {
            DVec2::ZERO
        } else {
            DVec2::new(normal.x, normal.y) / slope * per_uv
        };
        let depth = light.moment_depth_of_distance(distance);
        let per_distance =
            light.moment_depth_of_distance(1.0) - light.moment_depth_of_distance(0.0);
        let (base, reach, gradient) = if parallel {
            (depth, 0.0, -gradient * per_distance)
        } else {
            let base = light.moment_depth_of_distance(0.0);
            (base, depth - base, gradient)
        };
        let depth_gradient = if parallel { gradient } else { gradient * reach };
        let [width, height] = depths.size().map(f64::from);
        let snapped = SNAPPING * (depth_gradient.x.abs() / width + depth_gradient.y.abs() / height);
        // A rounded position moves the plane along its normal, and its depth by that over the cosine.
        let lifted = if edge_on {
            0.0
        } else {
            ROUNDINGS * SINGLE * position.abs().max_element() * per_distance / slope.abs()
        };
        Self {
            uv,
            gradient,
            base,
            reach,
            tolerance: stored_rounding(light, depths.rounding(), distance) * per_distance
                + snapped
                + lifted,
        }
    }

    /// The weight of those of the `stored` samples, one texel of width `step` apart from `first` on, that lie in front of
    /// the plane.
    fn in_front(&self, first: DVec2, step: f64, stored: &[f64], weights: &[f64]) -> f64 {
        let start = self.gradient.dot(first - self.uv);
        let step = self.gradient.x * step;
        let samples = stored.iter().zip(weights).enumerate();
        let weigh = |depth: f64, stored: f64, weight: f64| {
            let front = stored < depth.min(1.0) - self.tolerance;
            if front { weight } else { 0.0 }
        };
        if self.reach == 0.0 {
            samples
                .map(|(i, (&stored, &weight))| {
                    weigh(self.base + start + step * i as f64, stored, weight)
                })
                .sum()
        } else {
            samples
                .map(|(i, (&stored, &weight))| {
                    let divisor = 1.0 + start + step * i as f64;
                    // A ray that the plane has turned away from never meets it: the plane lies beyond the far end.
                    let depth = if divisor > 0.0 {
                        self.base + self.reach / divisor
                    } else {
                        1.0
                    };
                    weigh(depth, stored, weight)
                })
                .sum()
        }
    }
}

/// The error in distance along the axis of a depth that was stored for a surface at `distance`.
fn stored_rounding(light: &LightView, rounding: DepthRounding, distance: f64) -> f64 {
    let clip = light.clip_from_view * DVec3::new(0.0, 0.0, -distance).extend(1.0);
    let stored = (clip.z / clip.w).clamp(0.0, 1.0);
    // Parallel rays are transformed with an error relative to the whole range; a perspective depth is a quotient, whose
    // error is relative to itself.
    let magnitude = match light.kind() {
        LightKind::Directional => 1.0,
        LightKind::Spot => stored,
    };
    let storage = match rounding {
        DepthRounding::Float32 => 0.0,
        DepthRounding::Unorm16 => 0.5 / 65535.0,
    };
    let error = ROUNDINGS * SINGLE * magnitude + storage;
    let [low, high] =
        [stored - error, stored + error].map(|stored| light.depth.distance(stored.clamp(0.0, 1.0)));
    // At an infinite far plane there is nothing behind that could be told apart.
    if low.is_finite() && high.is_finite() {
        (high - low).abs()
    } else {
        (light.range[1] - light.range[0]).abs()
    }
}
