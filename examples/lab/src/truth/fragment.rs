//! The fragments of `shade_hard` in f64: where each pixel looks the map up, and at which depth.
//!
//! The shader knows a surface by the camera's depth alone, so its receiver bias differs from that of the triangle's own
//! normal along silhouettes and edges. The exact bound is evaluated at the shader's fragments, so that what lies between
//! the two is due to how moments are stored, and to nothing else.

use glam::{DVec2, DVec3, DVec4};
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
        let x = self.difference(pixel, 0, stored, &receiver);
        let y = self.difference(pixel, 1, stored, &receiver);
        let determinant = x.x * y.y - x.y * y.x;
        let scaled = DVec2::new(x.z * y.y - y.z * x.y, y.z * x.x - x.z * y.x);
        let gradient = if determinant.abs() < 1e-20 {
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

    /// Texels and moment depth to the neighbour along `axis` (0: x, 1: y) on the side that continues the surface;
    /// zero without such a neighbour.
    fn difference(&self, pixel: [i64; 2], axis: usize, stored: f64, receiver: &Receiver) -> DVec3 {
        let neighbour = |side: i64, steps: i64| {
            let mut at = pixel;
            at[axis] += side * steps;
            at
        };
        let error = |side: i64| {
            let at = neighbour(side, 1);
            let depth = self.stored(at);
            let usable = (0..self.size[axis]).contains(&at[axis])
                && depth != f64::from(self.parameters.far_depth);
            usable.then(|| (2.0 * depth - self.stored(neighbour(side, 2)) - stored).abs())
        };
        let side = match (error(-1), error(1)) {
            (None, None) => return DVec3::ZERO,
            (Some(before), Some(after)) if before < after => -1,
            (Some(_), None) => -1,
            _ => 1,
        };
        let mut step = DVec2::ZERO;
        step[axis] = side as f64;
        let step = DVec2::new(2.0, -2.0) * step / self.size();
        let (light, scene_w) = self.light(
            step.extend(self.stored(neighbour(side, 1)) - stored)
                .extend(0.0),
        );
        let across =
            (light.truncate().truncate() - receiver.uv * light.z) / (receiver.light_w + light.z);
        let along = (light.w - receiver.moment_depth * scene_w) / (receiver.scene_w + scene_w);
        (across * self.map).extend(along)
    }
}
