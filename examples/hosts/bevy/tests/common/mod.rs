//! Pictures as numbers.

// Each test file uses some of it.
#![allow(dead_code)]

use bevy::image::Image;
use moment_shadows_bevy::demo::{Look, Stage};

/// Width and height of pictures.
pub const SIZE: [u32; 2] = [480, 270];

/// A picture: red, green and blue of each pixel, from 0 to 255.
pub type Picture = Vec<f64>;

/// What the first camera sees, kept as a file, with the median time of a frame in milliseconds.
pub fn drawn(name: &str, look: &Look) -> (Picture, f64) {
    let mut stage = Stage::new(look, SIZE);
    let time = stage.frame_time(5).expect("a device that draws");
    let mut pictures = pictures(name, &mut stage);
    (pictures.swap_remove(0), time.as_secs_f64() * 1e3)
}

/// What each camera sees, kept as files.
pub fn pictures(name: &str, stage: &mut Stage) -> Vec<Picture> {
    let pictures = stage.pictures().expect("a picture");
    let numbered = pictures.into_iter().enumerate();
    let several = |number| match number {
        0 => name.to_owned(),
        _ => format!("{name}_{number}"),
    };
    let numbers = numbered.map(|(number, image)| kept(&several(number), image));
    numbers.collect()
}

fn kept(name: &str, image: Image) -> Picture {
    let pixels = image.try_into_dynamic().expect("a picture of 8 bits");
    let pixels = pixels.to_rgb8();
    let picture = pixels.into_raw().into_iter().map(f64::from).collect();
    keep(name, &picture);
    picture
}

/// Keeps a picture as a file.
pub fn keep(name: &str, picture: &Picture) {
    let pixels = picture.iter().map(|value| value.round() as u8).collect();
    let pixels =
        image::RgbImage::from_raw(SIZE[0], SIZE[1], pixels).expect("a picture of this size");
    let path = format!("{}/{name}.png", env!("CARGO_TARGET_TMPDIR"));
    pixels.save(path).expect("a folder that can be written");
}

/// The mean difference of two pictures, of 255.
pub fn difference(a: &Picture, b: &Picture) -> f64 {
    assert_eq!(a.len(), b.len());
    let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    apart.sum::<f64>() / a.len() as f64
}

/// The mean of a square of pixels around a place.
pub fn brightness(picture: &Picture, [x, y]: [usize; 2]) -> f64 {
    let row = |y: usize| &picture[3 * (y * SIZE[0] as usize + x - 2)..][..15];
    (y - 2..=y + 2).flat_map(row).sum::<f64>() / 75.0
}

/// A look whose shadows are those of a graph file of this folder.
pub fn filtered(graph: &str) -> Look {
    let path = format!("{}/graphs/{graph}.json", env!("CARGO_MANIFEST_DIR"));
    let graph = std::fs::read_to_string(path).expect("a graph file");
    Look {
        graph: Some(graph),
        ..Look::default()
    }
}

/// The same kernel on the same map by Bevy's percentage-closer filter, with a bias along the light alone: the truth. Bevy's own
/// bias moves surfaces along their normals, which moves shadows.
pub fn truth(look: &Look) -> Look {
    Look {
        graph: None,
        bias: [0.35, 0.0],
        spot_bias: [0.08, 0.0],
        ..look.clone()
    }
}

/// The radiance that a picture encodes as sRGB, from 0 to 1.
pub fn radiance(picture: &Picture) -> Picture {
    let linear = |value: &f64| match value / 255.0 {
        dark if dark <= 0.04045 => dark / 12.92,
        bright => ((bright + 0.055) / 1.055).powf(2.4),
    };
    picture.iter().map(linear).collect()
}
