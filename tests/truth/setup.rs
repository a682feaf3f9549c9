//! Lights, depth maps and surfaces to test with.

use glam::{DMat4, DVec2, DVec3};
use moment_shadows::Kernel;
use moment_shadows_lab::error::LabError;
use moment_shadows_lab::host::{DepthSamples, SurfacePixels};
use moment_shadows_lab::light::{LightView, StoredDepth};
use moment_shadows_lab::truth::kernel::{TapPattern, sample_positions};
use moment_shadows_lab::truth::surface::{DepthRounding, MomentDepths};

/// SplitMix64: numbers in [0, 1) that are the same everywhere.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let v = DVec3::from_array(std::array::from_fn(|_| self.between(-1.0, 1.0)));
            if v.length() > 0.1 && v.length() < 1.0 {
                return v.normalize();
            }
        }
    }
}

/// Parallel rays along -z over x and y in [-1, 1]; moment depth is -z - 1.
pub(crate) fn parallel_light() -> LightView {
    let depth = StoredDepth::Orthographic {
        near: 0.0,
        far: 2.0,
        reversed: false,
    };
    LightView {
        view_from_world: DMat4::IDENTITY,
        clip_from_view: depth.clip_from_view(DVec2::ONE),
        depth,
        range: [0.0, 2.0],
    }
}

pub(crate) fn spot_light(reversed: bool) -> LightView {
    LightView::spot(
        DVec3::new(1.0, 4.0, -2.0),
        DVec3::new(0.3, -1.0, 0.4),
        1.2,
        0.1,
        None,
        [1.0, 9.0],
        reversed,
    )
    .unwrap()
}

/// What the depth texture holds for something at a distance along the axis.
pub(crate) fn store(light: &LightView, distance: f64, rounding: DepthRounding) -> f32 {
    let clip = light.clip_from_view * DVec3::new(0.0, 0.0, -distance).extend(1.0);
    let stored = (clip.z / clip.w).clamp(0.0, 1.0);
    match rounding {
        DepthRounding::Float32 => stored as f32,
        DepthRounding::Unorm16 => ((stored * 65535.0).round() / 65535.0) as f32,
    }
}

/// A normal as a G-buffer of half floats holds it: 11 significant bits per component.
pub(crate) fn half_normal(normal: DVec3) -> DVec3 {
    DVec3::from_array(normal.to_array().map(|value: f64| {
        let quantum = (value.abs().max(1e-4).log2().floor() - 10.0).exp2();
        (value / quantum).round_ties_even() * quantum
    }))
}

/// A depth map whose samples are at the distances that `distance` gives for their uv.
pub(crate) fn depth_map(
    light: &LightView,
    size: [u32; 2],
    samples: u32,
    rounding: DepthRounding,
    mut distance: impl FnMut(DVec2) -> f64,
) -> MomentDepths {
    let mut stored = Vec::new();
    for y in 0..size[1] {
        for x in 0..size[0] {
            for [sample_x, sample_y] in sample_positions(samples).unwrap() {
                let uv = DVec2::new(
                    (f64::from(x) + sample_x) / f64::from(size[0]),
                    (f64::from(y) + sample_y) / f64::from(size[1]),
                );
                stored.push(store(light, distance(uv), rounding));
            }
        }
    }
    from_values(light, size, samples, rounding, stored).unwrap()
}

/// The depth map of the given stored values.
pub(crate) fn from_values(
    light: &LightView,
    [width, height]: [u32; 2],
    samples: u32,
    rounding: DepthRounding,
    values: Vec<f32>,
) -> Result<MomentDepths, LabError> {
    let stored = DepthSamples {
        width,
        height,
        samples,
        values,
    };
    MomentDepths::from_stored(light, &stored, rounding)
}

pub(crate) fn surface(points: &[(DVec3, DVec3)]) -> SurfacePixels {
    SurfacePixels {
        width: points.len() as u32,
        height: 1,
        position: points.iter().map(|(p, _)| p.as_vec3().to_array()).collect(),
        normal: points.iter().map(|(_, n)| n.as_vec3().to_array()).collect(),
        covered: vec![true; points.len()],
    }
}

pub(crate) fn gaussian() -> TapPattern {
    TapPattern::of_kernel(&Kernel::gaussian(4, 2.4).unwrap())
}

/// Where the light's ray through `uv` meets the plane, as a distance along the axis.
pub(crate) fn plane_distance(light: &LightView, uv: DVec2, point: DVec3, normal: DVec3) -> f64 {
    let (origin, direction) = light.ray(uv);
    normal.dot(point - origin) / normal.dot(direction)
}
