//! Whether `shade_hard` gives what it has to, in double precision and from the unfiltered depth map: what the technique makes of the
//! samples that its filter combines, or for tests on the plain depth map the share of them in front of the receiver's plane.

use moment_shadows::{MapEncoding, PcfTaps, Technique};

use super::harness::Difference;
use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::{read_intensity, shade_parameters};
use crate::host::read_depth_samples;
use crate::judgement::Unfiltered;
use crate::oracle::ideal::Ideal;
use crate::truth::fragment::fragments;
use crate::truth::kernel::TapPattern;
use crate::truth::lookup::at_each;

/// One pixel in so many is compared; a prime, so that they fall on all columns.
const STRIDE: usize = 61;

/// The most that the mean over these pixels may be off. Results jump where a distribution has few depths, so single
/// pixels say little: there the rounding of the map decides.
const TOLERANCE: f64 = 0.002;

/// The same for maps whose texels are rounded inwards: a quarter of the bias leaves its root, and what rounding makes of that, twice as large.
const TOLERANCE_INWARDS: f64 = 0.004;

/// The same for maps that are written once: half of 128 steps of a weight, which are 3 / 2 times as wide in the middle.
const TOLERANCE_ONCE: f64 = 1.5 / 256.0;

/// The same for tests on the plain depth map: the reference knows the planes of triangles, the shader those of the camera's depth.
const TOLERANCE_OF_PLANES: f64 = 0.01;

/// How far what a node wrote is from the reference, in the mean over some pixels. `encoding` is that of the map that it reads, if it
/// reads one. `None` for targets with several channels, and for techniques without a reference: taps that differ from pixel to
/// pixel, and layers that the device places.
pub(super) fn difference(
    gpu: &Gpu,
    frame: &Frame,
    file: &GraphFile,
    intensity: &wgpu::Texture,
    encoding: Option<&MapEncoding>,
) -> Result<Option<Difference>, LabError> {
    if intensity.format().components() != 1 {
        return Ok(None);
    }
    let Some(wanted) = reference(gpu, frame, file, encoding)? else {
        return Ok(None);
    };
    let full_shadow = shade_parameters(&frame.desc, file)?
        .leak_reduction
        .full_shadow;
    let found = read_intensity(gpu, intensity)?;
    let mut sum = 0.0;
    for (wanted, found) in wanted.iter().zip(found.iter().step_by(STRIDE)) {
        let wanted = (wanted / full_shadow).min(1.0);
        sum += f64::from((wanted - found).abs());
    }
    Ok(Some(Difference {
        error: sum / wanted.len() as f64,
        tolerance: match encoding {
            Some(map) if map.is_rounded_inwards() => TOLERANCE_INWARDS,
            Some(map) if map.storage().is_written_once() => TOLERANCE_ONCE,
            Some(_) => TOLERANCE,
            None => TOLERANCE_OF_PLANES,
        },
    }))
}

/// Shadow intensity at every [`STRIDE`]th pixel.
fn reference(
    gpu: &Gpu,
    frame: &Frame,
    file: &GraphFile,
    encoding: Option<&MapEncoding>,
) -> Result<Option<Vec<f32>>, LabError> {
    let mut unfiltered = Unfiltered::of(gpu, frame, file)?;
    let Some(encoding) = encoding else {
        let Some(taps) = file.technique().as_ref().and_then(taps) else {
            return Ok(None);
        };
        unfiltered.taps = taps;
        let picture = unfiltered.picture(gpu, frame)?;
        return Ok(Some(picture.shadow.into_iter().step_by(STRIDE).collect()));
    };
    // A map serves other techniques than that which it was made for, and knows the exponents.
    let technique = match file.technique() {
        Some(technique) if technique.name() != encoding.technique().name() => technique,
        _ => encoding.technique().clone(),
    };
    let Some(ideal) = Ideal::of_map(&technique, encoding) else {
        return Ok(None);
    };
    let parameters = shade_parameters(&frame.desc, file)?;
    let camera_depth = read_depth_samples(gpu, &frame.surface.depth)?;
    let lookups: Vec<_> = fragments(&parameters, &camera_depth, frame.desc.map)
        .into_iter()
        .step_by(STRIDE)
        .collect();
    let Unfiltered { depths, taps } = &unfiltered;
    Ok(Some(at_each(
        depths,
        taps,
        &lookups,
        |samples, weights, fragment_depth| ideal.shadow_intensity(samples, weights, fragment_depth),
    )))
}

/// What percentage-closer filtering weighs, where that is the same for all pixels.
fn taps(technique: &Technique) -> Option<TapPattern> {
    let Technique::Pcf(taps) = technique else {
        return None;
    };
    let equal = |radius: u32| vec![1.0; 2 * radius as usize + 1];
    let weights = match taps {
        PcfTaps::Box { radius } | PcfTaps::Hardware { radius, .. } => equal(*radius),
        PcfTaps::Gaussian { radius, sigma } => {
            let (radius, sigma) = (f64::from(*radius), f64::from(sigma.get()));
            let offsets = (0..=2 * radius as u32).map(|tap| f64::from(tap) - radius);
            offsets
                .map(|x| (-0.5 * (x / sigma).powi(2)).exp())
                .collect()
        }
        PcfTaps::Weights(weights) => weights.iter().map(|it| f64::from(it.get())).collect(),
        PcfTaps::Poisson { .. } => return None,
    };
    Some(TapPattern::of_weights(weights))
}
