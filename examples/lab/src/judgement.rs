//! What a picture of shadow intensity is worth: compared with the truth, beside the exact bound on the same depths.

use glam::DVec3;
use moment_shadows::Storage;
use rayon::prelude::*;

use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::shade_parameters;
use crate::host::{SurfacePixels, read_depth_samples, read_gbuffer};
use crate::light::LightView;
use crate::metric::{Comparison, Excess, compare, excess};
use crate::truth::exact_bound::{biased_bound, exact_bound};
use crate::truth::fragment::fragments;
use crate::truth::kernel::TapPattern;
use crate::truth::lookup::Lookup;
use crate::truth::pcf::pcf;
use crate::truth::surface::{DepthRounding, MomentDepths};

/// The truth of a frame under a kernel, and the best that four moments can do.
pub struct Truth {
    /// Brute-force shadow intensity per pixel.
    pub truth: Vec<f32>,
    /// The exact lower bound per pixel, at the shader's own fragments and after the same leak reduction.
    pub bound: Vec<f32>,
    /// Pixels whose surface faces the light.
    pub facing: Vec<bool>,
    /// The bound's own error.
    pub bound_error: Comparison,
    depths: MomentDepths,
    taps: TapPattern,
    lookups: Vec<Option<Lookup>>,
    full_shadow: f32,
}

/// A measured picture.
pub struct Judgement {
    /// Its error.
    pub error: Comparison,
    /// How much more that is than the exact bound's.
    pub excess: Excess,
}

/// What truths for a graph on a frame are computed from: the unfiltered map of the light, and the graph's kernel.
pub struct Unfiltered {
    /// All samples of the depth map.
    pub depths: MomentDepths,
    /// What the filtered map combines of them.
    pub taps: TapPattern,
}

/// Brute-force shadow intensity of a picture.
pub struct PictureTruth {
    /// Shadow intensity per pixel.
    pub shadow: Vec<f32>,
    /// Pixels whose surface faces the light.
    pub facing: Vec<bool>,
}

impl Unfiltered {
    /// Reads the light's map of a frame back.
    pub fn of(gpu: &Gpu, frame: &Frame, file: &GraphFile) -> Result<Self, LabError> {
        let light = &frame.desc.light;
        let stored = read_depth_samples(gpu, &frame.light_map.texture)?;
        let rounding = match frame.desc.format {
            wgpu::TextureFormat::Depth16Unorm => DepthRounding::Unorm16,
            _ => DepthRounding::Float32,
        };
        Ok(Self {
            depths: MomentDepths::from_stored(light, &stored, rounding)?,
            taps: file.kernel()?.map_or_else(TapPattern::unblurred, |kernel| {
                TapPattern::of_kernel(&kernel)
            }),
        })
    }

    /// The truth of what the frame's camera sees.
    pub fn picture(&self, gpu: &Gpu, frame: &Frame) -> Result<PictureTruth, LabError> {
        let light = &frame.desc.light;
        let pixels = read_gbuffer(gpu, &frame.surface)?;
        Ok(PictureTruth {
            shadow: pcf(light, &self.depths, &self.taps, &pixels)?,
            facing: facing(light, &pixels),
        })
    }
}

impl Truth {
    /// Reads the frame back and computes both pictures. Takes seconds.
    pub fn of(gpu: &Gpu, frame: &Frame, file: &GraphFile) -> Result<Self, LabError> {
        let unfiltered = Unfiltered::of(gpu, frame, file)?;
        let picture = unfiltered.picture(gpu, frame)?;
        let Unfiltered { depths, taps } = unfiltered;
        let camera_depth = read_depth_samples(gpu, &frame.surface.depth)?;
        let parameters = shade_parameters(&frame.desc, file)?;
        let lookups = fragments(&parameters, &camera_depth, frame.desc.map);
        let full_shadow = parameters.leak_reduction.full_shadow;
        let bound: Vec<f32> = exact_bound(&depths, &taps, &lookups)
            .into_iter()
            .map(|bound| (bound / full_shadow).min(1.0))
            .collect();
        let bound_error = compare(&bound, &picture.shadow, &picture.facing)?;
        Ok(Self {
            truth: picture.shadow,
            bound,
            facing: picture.facing,
            bound_error,
            depths,
            taps,
            lookups,
            full_shadow,
        })
    }

    /// The exact lower bound per pixel of the moments that `storage` biases: what the shader would give if it stored and
    /// computed without rounding.
    pub fn biased_bound(&self, storage: Storage) -> Vec<f32> {
        let bias = storage.moment_bias();
        biased_bound(&self.depths, &self.taps, &self.lookups, bias)
            .into_iter()
            .map(|bound| (bound / self.full_shadow).min(1.0))
            .collect()
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

/// Which pixels show a surface that faces the light.
pub(crate) fn facing(light: &LightView, pixels: &SurfacePixels) -> Vec<bool> {
    let vector = |value: [f32; 3]| DVec3::from(value.map(f64::from));
    (0..pixels.covered.len())
        .into_par_iter()
        .map(|index| {
            let position = vector(pixels.position[index]);
            let normal = vector(pixels.normal[index]);
            pixels.covered[index] && normal.dot(light.towards_light(position)) > 0.0
        })
        .collect()
}
