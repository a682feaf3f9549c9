//! The fragments of `shade_hard` in f64: where each pixel looks the map up, and at which depth.
//!
//! The shader knows a surface by the camera's depth alone, so its receiver bias differs from that of the triangle's own
//! normal along silhouettes and edges. The exact bound is evaluated at the shader's fragments, so that what lies between
//! the two is due to how moments are stored, and to nothing else.

use glam::{DVec2, DVec4};
use moment_shadows::ViewParameters;
use rayon::prelude::*;

use super::lookup::Lookup;
use crate::host::DepthSamples;

/// The lookups of `shade_hard` with `parameters` on the camera's depth (one sample per pixel) for a map of `map`
/// texels; `None` where a pixel shows nothing or lies outside of the map.
pub fn fragments(
    parameters: &ViewParameters,
    camera_depth: &DepthSamples,
    map: [u32; 2],
) -> Vec<Option<Lookup>> {
    let camera = Camera {
        parameters,
        depth: camera_depth,
        size: [
            i64::from(camera_depth.width),
            i64::from(camera_depth.height),
        ],
        map: DVec2::from_array(map.map(f64::from)),
    };
    (0..camera_depth.values.len())
        .into_par_iter()
        .map(|index| {
            let width = camera.size[0];
            camera.lookup([index as i64 % width, index as i64 / width])
        })
        .collect()
}

struct Camera<'a> {
    parameters: &'a ViewParameters,
    depth: &'a DepthSamples,
    size: [i64; 2],
    map: DVec2,
}

/// A pixel's surface as the light sees it, as in the shader.
struct Receiver {
    uv: DVec2,
    moment_depth: f64,
    light_w: f64,
    scene_w: f64,
}

impl Camera<'_> {
    /// Stored depth, that of the nearest pixel outside of the picture.
    fn stored(&self, [x, y]: [i64; 2]) -> f64 {
        let [width, height] = self.size;
        let index = y.clamp(0, height - 1) * width + x.clamp(0, width - 1);
        f64::from(self.depth.values[index as usize])
    }

    fn size(&self) -> DVec2 {
        DVec2::from_array(self.size.map(|length| length as f64))
    }

    /// Place times divisor, as the shader's matrix gives it, and the divisor of the moment depth.
    fn light(&self, clip: DVec4) -> (DVec4, f64) {
        let wide = |column: [f32; 4]| DVec4::from_array(column.map(f64::from));
        let columns = self.parameters.light_from_camera.map(wide);
        let light =
            columns[0] * clip.x + columns[1] * clip.y + columns[2] * clip.z + columns[3] * clip.w;
        (light, wide(self.parameters.scene_w_from_camera).dot(clip))
    }

    fn lookup(&self, pixel: [i64; 2]) -> Option<Lookup> {
        let stored = self.stored(pixel);
        if stored == f64::from(self.parameters.far_depth) {
            return None;
        }
        let at = (DVec2::from_array(pixel.map(|at| at as f64)) + 0.5) / self.size();
        let clip = DVec4::new(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, stored, 1.0);
        let (light, scene_w) = self.light(clip);
        let receiver = Receiver {
            uv: light.truncate().truncate() / light.z,
            moment_depth: light.w / scene_w,
            light_w: light.z,
            scene_w,
        };
        let uv = receiver.uv;
        let outside = uv.cmplt(DVec2::ZERO).any() || uv.cmpgt(DVec2::ONE).any();
        if receiver.light_w <= 0.0 || outside {
            return None;
        }
        // Changes of place, in texels, and of moment depth along x and y of the screen.
        let change = |coordinate: DVec4| {
            let (light, scene_w) = self.light(coordinate);
            let across = (light.truncate().truncate() - uv * light.z) / receiver.light_w;
            let along = (light.w - receiver.moment_depth * scene_w) / receiver.scene_w;
            (across * self.map).extend(along)
        };
        let along = change(DVec4::Z);
        let known = self.slope(pixel);
        let slope = known.unwrap_or_default();
        let x = change(DVec4::X) + slope.x * along;
        let y = change(DVec4::Y) - slope.y * along;
        let determinant = x.x * y.y - x.y * y.x;
        let scaled = DVec2::new(x.z * y.y - y.z * x.y, y.z * x.x - x.z * y.x);
        let gradient = if known.is_none() || determinant.abs() < 1e-20 {
            f64::INFINITY
        } else {
            scaled.length() / determinant.abs()
        };
        let rule = self.parameters.receiver_bias;
        let [constant, slope_scale, maximum] =
            [rule.constant, rule.slope_scale, rule.maximum].map(f64::from);
        let bias = (constant + slope_scale * gradient).clamp(0.0, maximum);
        let [root, slope] = [rule.step as u16, (rule.step >> 16) as u16]
            .map(|bits| f64::from(bits as i16) / 16383.5);
        let step = (root + slope * receiver.moment_depth.clamp(-1.0, 1.0)).powi(2);
        Some(Lookup {
            uv: uv.to_array(),
            fragment_depth: (receiver.moment_depth.min(1.0) - step - bias).clamp(-1.0, 1.0),
        })
    }

    /// How stored depth changes to the right and down, over half of the picture: on each axis towards the side whose pixels extrapolate to
    /// this one best. `None` where an axis has no neighbour that shows a surface.
    fn slope(&self, pixel: [i64; 2]) -> Option<DVec2> {
        let stored = self.stored(pixel);
        let change = |axis: usize| {
            let at = |steps: i64| {
                let mut at = pixel;
                at[axis] += steps;
                at
            };
            let miss = |side: i64| {
                let depth = self.stored(at(side));
                let usable = (0..self.size[axis]).contains(&at(side)[axis])
                    && depth != f64::from(self.parameters.far_depth);
                usable.then(|| (2.0 * depth - self.stored(at(2 * side)) - stored).abs())
            };
            match (miss(-1), miss(1)) {
                (None, None) => None,
                (Some(before), Some(after)) if before < after => Some(stored - self.stored(at(-1))),
                (Some(_), None) => Some(stored - self.stored(at(-1))),
                _ => Some(self.stored(at(1)) - stored),
            }
        };
        Some(0.5 * self.size() * DVec2::new(change(0)?, change(1)?))
    }
}
