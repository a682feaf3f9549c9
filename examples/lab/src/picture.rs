//! Pictures: saving without half-replaced files, grey values and differences in colour.

use std::fmt::Display;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use image::{ExtendedColorType, ImageFormat};
use moment_shadows_graph::command::Part;

use crate::error::LabError;

/// Why a picture or another result could not be saved.
fn unwritable(path: &Path, reason: impl Display) -> LabError {
    LabError::refused(format!("'{}' cannot be written: {reason}", path.display()))
}

/// Refuses values that do not make a picture of a size.
fn check_size(
    path: &Path,
    [width, height]: [u32; 2],
    channels: u64,
    values: usize,
) -> Result<(), LabError> {
    if u64::from(width) * u64::from(height) * channels == values as u64 {
        return Ok(());
    }
    let reason = format!("{values} values do not make a picture of {width}x{height}");
    Err(unwritable(path, reason))
}

/// Makes a folder with all that it lies in, unless it is there, and makes sure that files can be written into it.
pub fn create_folder(folder: &Path) -> Result<(), LabError> {
    std::fs::create_dir_all(folder).map_err(|error| unwritable(folder, error))?;
    check_file(&folder.join("any"))
}

/// Refuses a picture that could not be written when it is made: its ending is that of a format, and its folder takes files.
pub fn check_picture(path: &Path) -> Result<(), LabError> {
    format_of(path)?;
    check_file(path)
}

/// Refuses a file that could not be written when it is made.
pub fn check_file(path: &Path) -> Result<(), LabError> {
    part(path).map(drop)
}

/// The format that a picture's ending stands for.
fn format_of(path: &Path) -> Result<ImageFormat, LabError> {
    match ImageFormat::from_path(path) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => Ok(format),
        _ => Err(unwritable(
            path,
            "its ending is none of a picture's that can be written: .png, .jpg or .jpeg",
        )),
    }
}

/// The file that is being written, for [`remove_part`].
static PART: Mutex<Option<PathBuf>> = Mutex::new(None);

/// Removes the file that is being written, when the process is about to end.
pub fn remove_part() {
    if let Ok(mut part) = PART.lock()
        && let Some(path) = part.take()
    {
        // What is not there any more is complete.
        let _ = std::fs::remove_file(path);
    }
}

/// A file beside `path`, which goes unless it is kept.
fn part(path: &Path) -> Result<Part, LabError> {
    let part = Part::beside(path)?;
    if let Ok(mut known) = PART.lock() {
        *known = Some(part.path().to_owned());
    }
    Ok(part)
}

/// Writes a file beside `path` by `write` and renames it, so that `path` is either what it was or complete.
pub fn save_atomically(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> Result<(), LabError> {
    Ok(part(path)?.write(write)?.keep()?)
}

/// Saves red, green, blue and alpha (sRGB, a byte each, top row first) in the format that the path ends with. JPEG has no alpha.
pub fn save_rgba(path: &Path, width: u32, height: u32, rgba: &[u8]) -> Result<(), LabError> {
    check_size(path, [width, height], 4, rgba.len())?;
    let format = format_of(path)?;
    if format == ImageFormat::Png {
        return encode(
            path,
            format,
            rgba,
            [width, height],
            ExtendedColorType::Rgba8,
        );
    }
    let rgb: Vec<u8> = (rgba.chunks_exact(4))
        .flat_map(|pixel| [pixel[0], pixel[1], pixel[2]])
        .collect();
    encode(path, format, &rgb, [width, height], ExtendedColorType::Rgb8)
}

/// Saves one grey byte per pixel, top row first, in the format that the path ends with.
pub fn save_grey(path: &Path, width: u32, height: u32, grey: &[u8]) -> Result<(), LabError> {
    check_size(path, [width, height], 1, grey.len())?;
    encode(
        path,
        format_of(path)?,
        grey,
        [width, height],
        ExtendedColorType::L8,
    )
}

/// Pixels between panels.
const GAP: u32 = 4;

/// Saves pictures of one size (four bytes per pixel, alpha is dropped) side by side in rows of `columns`, as one PNG that is
/// small rather than quickly made.
pub fn save_panels(
    path: &Path,
    panels: &[Vec<u8>],
    [width, height]: [u32; 2],
    columns: u32,
) -> Result<(), LabError> {
    let columns = columns.max(1);
    let rows = (panels.len() as u32).div_ceil(columns);
    let side = |panel: u32, count: u32| count * panel + count.saturating_sub(1) * GAP;
    let [full_width, full_height] = [side(width, columns), side(height, rows)];
    let mut rgb = vec![255; (full_width * full_height * 3) as usize];
    for (number, panel) in (0..).zip(panels) {
        check_size(path, [width, height], 4, panel.len())?;
        let left = (number % columns) * (width + GAP);
        let top = (number / columns) * (height + GAP);
        for (y, row) in (top..).zip(panel.chunks_exact(4 * width as usize)) {
            let first = 3 * (y * full_width + left) as usize;
            let target = rgb[first..].chunks_exact_mut(3);
            for (target, pixel) in target.zip(row.chunks_exact(4)) {
                target.copy_from_slice(&pixel[..3]);
            }
        }
    }
    let mut png = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new_with_quality(
        &mut png,
        image::codecs::png::CompressionType::Best,
        image::codecs::png::FilterType::Adaptive,
    );
    let colour = ExtendedColorType::Rgb8;
    image::ImageEncoder::write_image(encoder, &rgb, full_width, full_height, colour)
        .map_err(|error| unwritable(path, error))?;
    save_atomically(path, |file| file.write_all(&png))
}

fn encode(
    path: &Path,
    format: ImageFormat,
    bytes: &[u8],
    [width, height]: [u32; 2],
    colour: ExtendedColorType,
) -> Result<(), LabError> {
    let mut encoded = Cursor::new(Vec::new());
    image::write_buffer_with_format(&mut encoded, bytes, width, height, colour, format)
        .map_err(|error| unwritable(path, error))?;
    save_atomically(path, |file| file.write_all(encoded.get_ref()))
}

/// Grey bytes of values in `[0, 1]`, linear (0.5 becomes 128); NaN becomes 0.
pub fn grey(values: &[f32]) -> Vec<u8> {
    values.iter().map(|&value| byte(value)).collect()
}

/// A picture of `found - truth`, both shadow intensities: white where they agree, red where `found` is too dark
/// (positive), blue where it is too light (negative). A difference of `full` or more has the full colour. NaN is black.
/// Four bytes per pixel.
pub fn signed_difference(found: &[f32], truth: &[f32], full: f32) -> Vec<u8> {
    found
        .iter()
        .zip(truth)
        .flat_map(|(found, truth)| {
            let difference = (found - truth) / full;
            let rest = byte(1.0 - difference.abs());
            if difference.is_nan() {
                [0, 0, 0, 255]
            } else if difference > 0.0 {
                [255, rest, rest, 255]
            } else {
                [rest, rest, 255, 255]
            }
        })
        .collect()
}

/// A value in `[0, 1]` as a byte.
fn byte(value: f32) -> u8 {
    // A float to integer cast saturates, and gives 0 for NaN.
    (value * 255.0 + 0.5) as u8
}
