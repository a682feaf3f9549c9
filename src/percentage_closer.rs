//! The host side of the WGSL module `percentage_closer`.

use bytemuck::{Pod, Zeroable};

use crate::Kernel;

/// Vectors of four weights that hold the largest kernel.
const WEIGHT_VECTORS: usize = (2 * Kernel::LARGEST_RADIUS as usize + 1).div_ceil(4);

/// A separable kernel of percentage closer filtering: the uniform struct of the WGSL module `percentage_closer`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct PercentageCloserKernel {
    /// Texels on either side of the centre.
    pub radius: u32,
    /// Unused; keeps the WGSL layout.
    pub padding: [u32; 3],
    /// The weights, the same along both axes, followed by zeros.
    pub weights: [[f32; 4]; WEIGHT_VECTORS],
}

impl PercentageCloserKernel {
    /// The uniform struct of a kernel.
    #[must_use]
    pub fn new(kernel: &Kernel) -> Self {
        let mut flat = [0.0; 4 * WEIGHT_VECTORS];
        for (slot, &weight) in flat.iter_mut().zip(kernel.weights()) {
            *slot = weight;
        }
        Self {
            radius: kernel.radius(),
            padding: [0; 3],
            weights: bytemuck::cast(flat),
        }
    }
}
