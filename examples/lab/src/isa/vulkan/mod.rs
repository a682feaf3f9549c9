//! A Vulkan device that compiles shaders for a chip which need not be there.
//!
//! wgpu cannot open it: the driver's null device has no semaphores that can be shared. So this is Vulkan itself, in
//! unsafe code.

#![allow(unsafe_code)]

mod device;
mod executable;
mod pipeline;

pub(super) use device::NullDevice;
pub(super) use executable::Executable;

use crate::error::LabError;

/// Says which call failed.
fn refused(what: &'static str) -> impl Fn(ash::vk::Result) -> LabError {
    move |result| {
        let reason =
            format!("the driver says {result}; try the version of it that the table names");
        LabError::unsuitable(what, reason)
    }
}
