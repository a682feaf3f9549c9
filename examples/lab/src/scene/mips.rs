//! Mips of a base colour.

use super::Image;

/// The image and all its mips, down to a single texel.
pub(crate) fn mips(image: &Image) -> Vec<Image> {
    let mut finest = image.clone();
    let mut mips = Vec::new();
    while [finest.width, finest.height] != [1, 1] {
        let coarser = halved(&finest);
        mips.push(std::mem::replace(&mut finest, coarser));
    }
    mips.push(finest);
    mips
}

/// The next mip: means of 2x2 texels, of the bytes as they are, which is near enough for a base colour.
fn halved(image: &Image) -> Image {
    let [width, height] = [image.width, image.height];
    let smaller = [(width / 2).max(1), (height / 2).max(1)];
    let mut rgba = Vec::with_capacity((smaller[0] * smaller[1] * 4) as usize);
    for y in 0..smaller[1] {
        for x in 0..smaller[0] {
            for channel in 0..4 {
                let texel = |dx: u32, dy: u32| {
                    let x = (2 * x + dx).min(width - 1);
                    let y = (2 * y + dy).min(height - 1);
                    u32::from(image.rgba[((y * width + x) * 4 + channel) as usize])
                };
                let sum = texel(0, 0) + texel(1, 0) + texel(0, 1) + texel(1, 1);
                rgba.push(((sum + 2) / 4) as u8);
            }
        }
    }
    Image {
        width: smaller[0],
        height: smaller[1],
        rgba,
    }
}
