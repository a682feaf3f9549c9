//! How different two pictures look to an observer who flips between them: FLIP (Andersson and others, "FLIP: A Difference Evaluator for
//! Alternating Images", HPG 2020), by its authors' code.

use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8};

use crate::error::LabError;
use crate::truth::check_length;

/// The mean over all pixels of FLIP's error, from 0 to 1, between two pictures of sRGB bytes with alpha, which counts for nothing. The
/// observer sees 67 pixels per degree, as FLIP has it where nothing else is said.
pub fn flip([width, height]: [u32; 2], truth: &[u8], found: &[u8]) -> Result<f64, LabError> {
    let pixels = width as usize * height as usize;
    let image = |what: &str, rgba: &[u8]| {
        check_length(what, rgba.len(), 4 * pixels)?;
        let rgb = rgba.chunks_exact(4).flat_map(|pixel| &pixel[..3]).copied();
        Ok::<_, LabError>(FlipImageRgb8::with_data(
            width,
            height,
            &Vec::from_iter(rgb),
        ))
    };
    let [truth, found] = [
        image("the true picture", truth)?,
        image("the picture", found)?,
    ];
    let errors = nv_flip::flip(truth, found, DEFAULT_PIXELS_PER_DEGREE).to_vec();
    let sum: f64 = errors.iter().copied().map(f64::from).sum();
    Ok(sum / pixels.max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [96, 64];

    /// A grey picture whose pixels are of one of two levels.
    fn picture(is_dark: impl Fn(u32, u32) -> bool, levels: [u8; 2]) -> Vec<u8> {
        let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
        pixels
            .flat_map(|(x, y)| {
                let level = levels[usize::from(is_dark(x, y))];
                [level, level, level, 255]
            })
            .collect()
    }

    /// What no observer tells apart is no difference: the same share of pixels that differ counts for less the finer it is spread.
    #[test]
    fn it_sees_a_patch_and_hardly_fine_stripes() -> Result<(), LabError> {
        let plain = picture(|_, _| false, [180, 0]);
        let patch = picture(|x, _| x < 48, [170, 190]);
        let stripes = picture(|x, _| x % 2 == 0, [170, 190]);
        assert_eq!(flip(SIZE, &plain, &plain)?, 0.0);
        let [patch, stripes] = [flip(SIZE, &plain, &patch)?, flip(SIZE, &plain, &stripes)?];
        assert!(patch > 0.02 && patch < 0.5, "{patch}");
        assert!(stripes < 0.5 * patch, "{stripes} {patch}");
        Ok(())
    }

    #[test]
    fn a_picture_of_another_size_is_refused() {
        assert!(flip(SIZE, &[0; 16], &[0; 16]).is_err());
    }
}
