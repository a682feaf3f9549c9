//! A point of a surface as its map sees it.

use bytemuck::{Pod, Zeroable};
use glam::{DMat2, DVec2};

use crate::light::LightView;
use crate::truth::pcf::Receiver;

/// Edge-on surfaces have no gradient; above this their bias is limited anyway, and f32 can square it.
const LARGEST_GRADIENT: f64 = 1e15;

/// A point of a surface, `Point` of the shader.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct MapPoint {
    /// The place in the map, from 0 to 1.
    pub uv: [f32; 2],
    /// Gradient of moment depth per texel of the map; no component is above 1e15.
    pub gradient: [f32; 2],
    /// Moment depth, not clamped.
    pub moment_depth: f32,
    /// Unused; keeps the WGSL layout.
    pub padding: f32,
}

impl MapPoint {
    /// The point at a place, with a gradient that may be infinite.
    #[must_use]
    pub fn new(uv: DVec2, moment_depth: f64, gradient: DVec2) -> Self {
        let limit = DVec2::splat(LARGEST_GRADIENT);
        let limited = if gradient.is_nan() {
            DVec2::new(LARGEST_GRADIENT, 0.0)
        } else {
            gradient.clamp(-limit, limit)
        };
        Self {
            uv: uv.as_vec2().to_array(),
            gradient: limited.as_vec2().to_array(),
            moment_depth: moment_depth as f32,
            padding: 0.0,
        }
    }

    /// The point of a receiver in front of a light with a map of `map` texels. Behind a spot light it lies at the map's corner.
    #[must_use]
    pub fn of_plane(light: &LightView, map: [u32; 2], receiver: &Receiver) -> Self {
        let size = DVec2::from_array(map.map(f64::from));
        let uv = light.uv(receiver.position).unwrap_or_default();
        let depth = light.moment_depth(receiver.position);
        // Two steps on the plane, of about a texel each.
        let [width, height] = light.texel_size(map);
        let (u, v) = receiver.normal.any_orthonormal_pair();
        let [across, along] = [u, v].map(|direction| {
            let at = receiver.position + direction * width.max(height);
            let moved = light.uv(at).unwrap_or_default();
            ((moved - uv) * size, light.moment_depth(at) - depth)
        });
        // The gradient g with dot(g, texels) = depth for both steps.
        let steps = DMat2::from_cols(across.0, along.0).transpose();
        let gradient = steps.inverse() * DVec2::new(across.1, along.1);
        Self::new(uv, depth, gradient)
    }
}
