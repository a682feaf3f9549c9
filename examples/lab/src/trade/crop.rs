//! The part of a picture where a technique errs most, enlarged.

use data_encoding::BASE64;
use image::{ExtendedColorType, ImageEncoder};
use serde::{Deserialize, Serialize};

use crate::error::LabError;
use crate::picture::{grey, signed_difference};

/// Width and height of a crop, in pixels.
pub(crate) const SIZE: [u32; 2] = [96, 72];

/// Truth, estimate and their difference side by side, as a PNG.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Crop {
    /// The number of the view.
    pub view: u32,
    /// Column and row of the crop's corner in the picture.
    pub corner: [u32; 2],
    /// The mean absolute error within it.
    pub error: f64,
    /// The file in base 64.
    pub png: String,
}

impl Crop {
    /// The part of a picture of a width with the largest error over pixels that are judged, such as those that face the light. A
    /// difference of the shadow intensity `full` has the full colour.
    pub fn of(
        (view, width): (u32, u32),
        [estimate, truth]: [&[f32]; 2],
        judged: &[bool],
        full: f32,
    ) -> Result<Self, LabError> {
        let height = truth.len() as u32 / width.max(1);
        let size = [SIZE[0].min(width), SIZE[1].min(height)];
        let error = |x: u32, y: u32| {
            let at = (y * width + x) as usize;
            f64::from((estimate[at] - truth[at]).abs()) * f64::from(u8::from(judged[at]))
        };
        let mut best = ([0; 2], f64::NEG_INFINITY);
        // Corners on a grid of a quarter of the size are close enough to the worst.
        for top in steps(height, size[1]) {
            for left in steps(width, size[0]) {
                let rows =
                    (top..top + size[1]).flat_map(|y| (left..left + size[0]).map(move |x| (x, y)));
                let sum: f64 = rows.map(|(x, y)| error(x, y)).sum();
                if sum > best.1 {
                    best = ([left, top], sum);
                }
            }
        }
        let (corner, sum) = best;
        let cut = |picture: &[f32]| -> Vec<f32> {
            let row = |y: u32| {
                let start = (y * width + corner[0]) as usize;
                &picture[start..start + size[0] as usize]
            };
            (corner[1]..corner[1] + size[1])
                .flat_map(row)
                .copied()
                .collect()
        };
        let (estimate, truth) = (cut(estimate), cut(truth));
        let shown = |shadow: &[f32]| -> Vec<[u8; 3]> {
            let light: Vec<f32> = shadow.iter().map(|intensity| 1.0 - intensity).collect();
            grey(&light).into_iter().map(|level| [level; 3]).collect()
        };
        let difference = signed_difference(&estimate, &truth, full);
        let difference = difference
            .chunks_exact(4)
            .map(|pixel| [pixel[0], pixel[1], pixel[2]]);
        let panels = [shown(&truth), shown(&estimate), difference.collect()];
        Ok(Self {
            view,
            corner,
            error: sum / f64::from(size[0] * size[1]),
            png: BASE64.encode(&png(&panels, size)?),
        })
    }
}

/// Where a window can begin along an axis.
fn steps(length: u32, size: u32) -> impl Iterator<Item = u32> {
    (0..=length - size).step_by((size / 4).max(1) as usize)
}

fn png(panels: &[Vec<[u8; 3]>; 3], [width, height]: [u32; 2]) -> Result<Vec<u8>, LabError> {
    let row = |y: usize| {
        let span = y * width as usize..(y + 1) * width as usize;
        panels
            .iter()
            .flat_map(move |panel| panel[span.clone()].as_flattened())
    };
    let rgb: Vec<u8> = (0..height as usize).flat_map(row).copied().collect();
    let mut png = Vec::new();
    image::codecs::png::PngEncoder::new(&mut png)
        .write_image(&rgb, 3 * width, height, ExtendedColorType::Rgb8)
        .map_err(|error| LabError::refused(format!("a crop cannot be encoded: {error}")))?;
    Ok(png)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_part_is_cut_out() -> Result<(), LabError> {
        let (width, height) = (320, 180);
        let truth = vec![0.0_f32; width * height];
        let mut estimate = truth.clone();
        // A wrong patch, and a larger one that does not face the light.
        let mut facing = vec![true; truth.len()];
        for y in 100..120 {
            for x in 200..230 {
                estimate[y * width + x] = 1.0;
            }
        }
        for y in 0..60 {
            for x in 0..60 {
                estimate[y * width + x] = 1.0;
                facing[y * width + x] = false;
            }
        }
        let crop = Crop::of((3, width as u32), [&estimate, &truth], &facing, 0.5)?;
        let [left, top] = crop.corner;
        assert!(
            left <= 200 && left + 96 >= 230 && top <= 100 && top + 72 >= 120,
            "{crop:?}"
        );
        assert!(
            (crop.error - 600.0 / (96.0 * 72.0)).abs() < 1e-9,
            "{}",
            crop.error
        );
        Ok(())
    }
}
