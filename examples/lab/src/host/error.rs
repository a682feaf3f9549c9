//! What can go wrong on the device.

use crate::gpu::{Gpu, GpuError};
use crate::light::LightError;

/// Why the host could not make or draw something.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HostError {
    /// The device itself failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A camera or light cannot be used.
    #[error(transparent)]
    Light(#[from] LightError),
    /// The device refused to create something.
    #[error("the device did not create {what}: {reason}")]
    Creation {
        /// What was asked for.
        what: String,
        /// What the device said.
        reason: String,
    },
    /// This number of samples is not possible.
    #[error(
        "{format:?} with {asked} samples per texel is not supported by this device; it supports {supported:?}"
    )]
    Samples {
        /// The depth format.
        format: wgpu::TextureFormat,
        /// The sample count that was asked for.
        asked: u32,
        /// The sample counts that are possible.
        supported: Vec<u32>,
    },
    /// The host renders light depth into two formats only.
    #[error("light depth cannot be rendered as {format:?}; use Depth32Float or Depth16Unorm")]
    Format {
        /// The format that was asked for.
        format: wgpu::TextureFormat,
    },
    /// The shadow intensities are not those of the surface.
    #[error(
        "the shadow intensity has {}x{} texels and the G-buffer {}x{}; render it at the G-buffer's size",
        shadow[0], shadow[1], surface[0], surface[1]
    )]
    ShadowSize {
        /// Width and height of the shadow intensity.
        shadow: [u32; 2],
        /// Width and height of the G-buffer.
        surface: [u32; 2],
    },
    /// A texture or buffer would be empty or larger than the device allows.
    #[error("{what} would have {asked} {unit}; this device allows 1 to {limit}")]
    Size {
        /// What was asked for.
        what: &'static str,
        /// How large it would be.
        asked: u64,
        /// In which unit.
        unit: &'static str,
        /// How large it may be.
        limit: u64,
    },
}

/// Runs `create` and turns what the device objects to into an error that names `what`.
pub(super) fn created<T>(
    gpu: &Gpu,
    what: &str,
    create: impl FnOnce() -> T,
) -> Result<T, HostError> {
    let memory = gpu.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let validation = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
    let result = create();
    let errors = [
        pollster::block_on(validation.pop()),
        pollster::block_on(memory.pop()),
    ];
    match errors.into_iter().flatten().next() {
        None => Ok(result),
        Some(error) => Err(HostError::Creation {
            what: what.to_owned(),
            reason: error.to_string(),
        }),
    }
}

/// Checks the size of a two-dimensional texture.
pub(super) fn check_size(gpu: &Gpu, what: &'static str, size: [u32; 2]) -> Result<(), HostError> {
    let limit = gpu.device.limits().max_texture_dimension_2d;
    for edge in size {
        if edge == 0 || edge > limit {
            return Err(HostError::Size {
                what,
                asked: u64::from(edge),
                unit: "texels along an edge",
                limit: u64::from(limit),
            });
        }
    }
    Ok(())
}
