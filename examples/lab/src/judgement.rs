//! What a picture of shadow intensity is worth: compared with the truth, beside the exact bound on the same depths.

use glam::{DVec2, DVec3};
use moment_shadows::{LeakReduction, ReceiverBias};
use rayon::prelude::*;

use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::receiver_bias;
use crate::host::{SurfacePixels, read_depth_samples, read_gbuffer};
use crate::light::LightView;
use crate::metric::{Comparison, Excess, compare, excess};
use crate::truth::exact_bound::{Lookup, exact_bound};
use crate::truth::kernel::TapPattern;
use crate::truth::pcf::pcf;
use crate::truth::surface::{DepthRounding, MomentDepths};

/// The truth of a frame under a kernel, and the best that four moments can do.
pub struct Truth {
    /// Brute-force shadow intensity per pixel.
    pub truth: Vec<f32>,
    /// The exact lower bound per pixel, after the same receiver bias and leak reduction as the shader's.
    pub bound: Vec<f32>,
    /// Pixels whose surface faces the light.
    pub facing: Vec<bool>,
    /// The bound's own error.
    pub bound_error: Comparison,
}

/// A measured picture.
pub struct Judgement {
    /// Its error.
    pub error: Comparison,
    /// How much more that is than the exact bound's.
    pub excess: Excess,
}

impl Truth {
    /// Reads the frame back and computes both pictures. Takes seconds.
    pub fn of(gpu: &Gpu, frame: &Frame, file: &GraphFile) -> Result<Self, LabError> {
        let light = &frame.desc.light;
        let stored = read_depth_samples(gpu, &frame.light_map.texture)?;
        let rounding = match frame.desc.format {
            wgpu::TextureFormat::Depth16Unorm => DepthRounding::Unorm16,
            _ => DepthRounding::Float32,
        };
        let depths = MomentDepths::from_stored(light, &stored, rounding)?;
        let pixels = read_gbuffer(gpu, &frame.surface)?;
        let taps = file.kernel()?.map_or_else(TapPattern::unblurred, |kernel| {
            TapPattern::of_kernel(&kernel)
        });
        let truth = pcf(light, &depths, &taps, &pixels)?;
        let bias = receiver_bias(&frame.desc, file)?;
        let receivers = Receivers {
            light,
            map: frame.desc.map,
            bias,
        };
        let lookups = receivers.lookups(&pixels);
        let full_shadow = LeakReduction::DEFAULT.full_shadow;
        let bound: Vec<f32> = exact_bound(&depths, &taps, &lookups)
            .into_iter()
            .map(|bound| (bound / full_shadow).min(1.0))
            .collect();
        let facing = receivers.facing(&pixels);
        let bound_error = compare(&bound, &truth, &facing)?;
        Ok(Self {
            truth,
            bound,
            facing,
            bound_error,
        })
    }

    /// Judges a picture of shadow intensity.
    pub fn judge(&self, shadow: &[f32]) -> Result<Judgement, LabError> {
        let error = compare(shadow, &self.truth, &self.facing)?;
        Ok(Judgement {
            excess: excess(&error, &self.bound_error),
            error,
        })
    }
}

/// Fragments as the shader sees them, from positions and normals in f64.
struct Receivers<'a> {
    light: &'a LightView,
    map: [u32; 2],
    bias: ReceiverBias,
}

impl Receivers<'_> {
    fn facing(&self, pixels: &SurfacePixels) -> Vec<bool> {
        self.each(pixels, |position, normal| {
            normal.dot(self.light.towards_light(position)) > 0.0
        })
        .into_iter()
        .map(|facing| facing == Some(true))
        .collect()
    }

    fn lookups(&self, pixels: &SurfacePixels) -> Vec<Option<Lookup>> {
        self.each(pixels, |position, normal| self.lookup(position, normal))
            .into_iter()
            .map(Option::flatten)
            .collect()
    }

    fn each<T: Send>(
        &self,
        pixels: &SurfacePixels,
        of: impl Fn(DVec3, DVec3) -> T + Sync,
    ) -> Vec<Option<T>> {
        (0..pixels.covered.len())
            .into_par_iter()
            .map(|index| {
                let vector = |list: &[[f32; 3]]| DVec3::from(list[index].map(f64::from));
                pixels.covered[index].then(|| of(vector(&pixels.position), vector(&pixels.normal)))
            })
            .collect()
    }

    fn lookup(&self, position: DVec3, normal: DVec3) -> Option<Lookup> {
        let uv = self.light.uv(position)?;
        if uv.cmplt(DVec2::ZERO).any() || uv.cmpgt(DVec2::ONE).any() {
            return None;
        }
        let depth = self.light.moment_depth(position);
        // Steps of one texel along the receiver's plane.
        let steps = [
            DVec2::new(1.0 / f64::from(self.map[0]), 0.0),
            DVec2::new(0.0, 1.0 / f64::from(self.map[1])),
        ];
        let gradient = DVec2::from(steps.map(|step| {
            let (origin, direction) = self.light.ray(uv + step);
            let distance = (position - origin).dot(normal) / direction.dot(normal);
            self.light.moment_depth_of_distance(distance) - depth
        }));
        let length = gradient.length();
        let slope = if length.is_finite() { length } else { f64::MAX };
        let bias = (f64::from(self.bias.constant) + f64::from(self.bias.slope_scale) * slope)
            .min(f64::from(self.bias.maximum));
        Some(Lookup {
            uv: uv.to_array(),
            fragment_depth: (depth - bias).clamp(-1.0, 1.0),
        })
    }
}
