//! Mips of a base colour: the device samples them, and truths read the very same bytes.

use super::Image;

/// One mip of an image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Mip {
    /// Width and height in texels.
    pub(crate) size: [u32; 2],
    /// Texels as in [`Image::rgba`].
    pub(crate) rgba: Vec<u8>,
}

/// The image and all its mips, down to a single texel.
pub(crate) fn mips(image: &Image) -> Vec<Mip> {
    let mut finest = Mip {
        size: [image.width, image.height],
        rgba: image.rgba.clone(),
    };
    let mut mips = Vec::new();
    while finest.size != [1, 1] {
        let coarser = halved(&finest);
        mips.push(std::mem::replace(&mut finest, coarser));
    }
    mips.push(finest);
    mips
}

/// The next mip: means of 2x2 texels, of the bytes as they are, which is near enough for a base colour.
fn halved(Mip { size, rgba }: &Mip) -> Mip {
    let [width, height] = *size;
    let smaller = [(width / 2).max(1), (height / 2).max(1)];
    let mut result = Vec::with_capacity((smaller[0] * smaller[1] * 4) as usize);
    for y in 0..smaller[1] {
        for x in 0..smaller[0] {
            for channel in 0..4 {
                let texel = |dx: u32, dy: u32| {
                    let x = (2 * x + dx).min(width - 1);
                    let y = (2 * y + dy).min(height - 1);
                    u32::from(rgba[((y * width + x) * 4 + channel) as usize])
                };
                let sum = texel(0, 0) + texel(1, 0) + texel(0, 1) + texel(1, 1);
                result.push(((sum + 2) / 4) as u8);
            }
        }
    }
    Mip {
        size: smaller,
        rgba: result,
    }
}
