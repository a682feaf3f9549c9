//! The kernels of patches, 3 to 129 texels wide, with the library's own normalised weights.

use moment_shadows::{Kernel, ValueError};

/// Texels on either side of the centre.
const RADII: [u32; 8] = [1, 2, 4, 8, 12, 16, 32, 64];

/// Kernels up to 9 texels wide, which come first. The reserves of float32 are made for those.
pub const NARROW: u32 = 6;

/// How many kernels there are.
pub const COUNT: u32 = 2 * RADII.len() as u32;

/// A Gaussian and a box of each radius, in this order.
pub fn kernels() -> Result<Vec<Kernel>, ValueError> {
    let pairs: Result<Vec<[Kernel; 2]>, ValueError> = RADII
        .into_iter()
        .map(|radius| {
            let equal = vec![1.0; 2 * radius as usize + 1];
            Ok([
                Kernel::gaussian(radius, 0.4 * radius as f32)?,
                Kernel::from_weights(&equal)?,
            ])
        })
        .collect();
    Ok(pairs?.into_iter().flatten().collect())
}

/// Kernels as the shader reads them: where the weights of each begin and how many there are, then all weights.
#[must_use]
pub fn table(kernels: &[Kernel]) -> Vec<f32> {
    let mut table = Vec::new();
    let mut first = 2 * kernels.len();
    for kernel in kernels {
        // Small whole numbers.
        table.extend([first as f32, kernel.weights().len() as f32]);
        first += kernel.weights().len();
    }
    for kernel in kernels {
        table.extend(kernel.weights());
    }
    table
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn weights_are_normalised_in_f32() {
        for kernel in kernels().unwrap() {
            let sum: f64 = kernel
                .weights()
                .iter()
                .map(|&weight| f64::from(weight))
                .sum();
            // The residue of rounding is in the largest weight, which is off by half a unit of its own last place.
            assert!((sum - 1.0).abs() <= 0.5 / f64::from(1 << 23), "{sum}");
        }
    }

    #[test]
    fn the_widest_kernel_has_129_weights_and_the_table_finds_them() {
        let kernels = kernels().unwrap();
        assert_eq!(kernels.len(), COUNT as usize);
        let table = table(&kernels);
        let last = COUNT as usize - 1;
        assert_eq!(table[2 * last + 1], 129.0);
        let first = table[2 * last] as usize;
        assert_eq!(table[first..], *kernels[last].weights());
    }
}
