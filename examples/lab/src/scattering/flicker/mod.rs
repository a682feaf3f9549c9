//! What flickers in the air while a camera and a light move slowly.

mod change;
mod nearest;
mod path;
mod walk;

use core::fmt;

use serde::Serialize;

pub use change::{Change, Place, static_region};
pub use nearest::RectifyNearest;
pub use path::{FRAMES, Path};
use walk::Walk;
pub use walk::chains;

use crate::cost::table::columns as write_columns;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::metric::{NO_PIXEL, percent};
use crate::picture::{grey, signed_difference};
use crate::scene::Scene;

/// A pixel is static while its true radiance, with shadows and without, changes by at most this from frame to frame, in parts of
/// the mean radiance without shadows. What an edge or a shaft passes changes by ten times that and more.
pub const STILL: f32 = 3e-3;

/// A pixel has to be static for this many frames before and after, too.
pub const WINDOW: usize = 1;

/// The largest change of filtered pictures, at most this part of that of unfiltered ones.
pub const GOAL: f64 = 1.0 / 3.0;

/// How bright the mean radiance without shadows is in pictures, where 1 is white.
const EXPOSURE: f32 = 0.5;

/// A change that pictures show in full colour.
const FULL_CHANGE: f32 = 0.05;

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, clap::Args)]
pub struct FlickerDesc {
    /// Frames from the beginning of the path on; all of it has 240.
    #[arg(long, default_value_t = FRAMES, value_parser = clap::value_parser!(u32).range(2..=10_000))]
    pub frames: u32,
    /// Texels per side of the light's map.
    #[arg(skip = 1024_u32)]
    pub map: u32,
    /// Columns of rectified maps.
    #[arg(skip = 512_u32)]
    pub columns: u32,
    /// Rows of rectified maps.
    #[arg(skip = 512_u32)]
    pub rows: u32,
    /// Width of the picture.
    #[arg(skip = 320_u32)]
    pub width: u32,
    /// Height of the picture.
    #[arg(skip = 180_u32)]
    pub height: u32,
    /// Texels per side of the map that the truth is marched through, much finer than the light's map.
    #[arg(skip = 2048_u32)]
    pub truth_map: u32,
    /// Steps of the truth.
    #[arg(skip = 256_u32)]
    pub steps: u32,
}

/// What flickers by how much.
#[derive(Clone, Debug, Serialize)]
pub struct Flicker {
    /// The scene's name.
    pub scene: String,
    /// Frames.
    pub frames: u32,
    /// Width of the picture.
    pub width: u32,
    /// The part of all pixels of all pairs of frames that is static.
    pub region: f64,
    /// Change of the truth in the region.
    pub truth: Change,
    /// Change of the chain with filters.
    pub filtered: Change,
    /// Change of the same that knows the picture's view rays.
    pub seen: Change,
    /// Change of the chain without filters.
    pub unfiltered: Change,
    /// Pictures of the two frames between which the chain with view rays changes most, and the change, row by row: of the truth, the
    /// filtered chain, that with view rays, and the unfiltered one. Of 4 bytes per pixel; empty where nothing is static.
    #[serde(skip)]
    pub pictures: Vec<Vec<u8>>,
}

/// Draws a path through a scene and compares both chains on it. `progress` is called after each frame.
pub fn flicker(
    gpu: &Gpu,
    scene: &Scene,
    desc: &FlickerDesc,
    mut progress: impl FnMut(),
) -> Result<Flicker, LabError> {
    let mut walk = Walk::new(gpu, scene, desc)?;
    // Radiance of all frames, in parts of the mean radiance without shadows, pixel by pixel.
    let mut series: [Vec<Vec<f32>>; 5] = Default::default();
    let mut scale = None;
    for number in 0..desc.frames.max(2) {
        let seen = walk.see(number)?;
        let unshadowed = &seen[1];
        // One scale for all frames: the unit must not flicker itself.
        let mean = unshadowed.iter().sum::<f32>() / unshadowed.len().max(1) as f32;
        let scale = *scale.get_or_insert(1.0 / mean.max(1e-30));
        for (frames, pixels) in series.iter_mut().zip(seen) {
            frames.push(pixels.into_iter().map(|it| scale * it).collect());
        }
        progress();
    }
    let [truth, unshadowed, filtered, seen_rays, unfiltered] = &series;
    let region = static_region([truth, unshadowed], STILL, WINDOW);
    let of = |pictures: &[Vec<f32>]| Change::of(pictures, truth, &region);
    let inside = region.iter().flatten().filter(|is_static| **is_static);
    Ok(Flicker {
        scene: scene.name.clone(),
        frames: desc.frames,
        width: desc.width,
        region: inside.count() as f64 / region.iter().flatten().count().max(1) as f64,
        truth: of(truth),
        filtered: of(filtered),
        seen: of(seen_rays),
        unfiltered: of(unfiltered),
        pictures: pictures_at(of(seen_rays).at, [truth, filtered, seen_rays, unfiltered]),
    })
}

/// Pictures of two frames of each series, and of the change.
fn pictures_at(at: Option<Place>, series: [&Vec<Vec<f32>>; 4]) -> Vec<Vec<u8>> {
    let Some(at) = at else {
        return Vec::new();
    };
    let shown = |frame: &Vec<f32>| -> Vec<u8> {
        let exposed: Vec<f32> = frame.iter().map(|it| (EXPOSURE * it).sqrt()).collect();
        let bytes = grey(&exposed).into_iter();
        bytes.flat_map(|byte| [byte, byte, byte, 255]).collect()
    };
    let row = |frames: &Vec<Vec<f32>>| {
        let [before, after] = [&frames[at.frame], &frames[at.frame + 1]];
        // What becomes brighter is blue, as too little shadow is.
        let change = signed_difference(before, after, FULL_CHANGE);
        [shown(before), shown(after), change]
    };
    series.into_iter().flat_map(row).collect()
}

impl Flicker {
    /// The largest change of the filtered chain, as in the example with what is known of the picture's view rays, as a part of that
    /// without filters.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.seen.largest / self.unfiltered.largest
    }

    /// Whether filtering does what is asked of it.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.ratio() <= GOAL
    }
}

impl fmt::Display for Flicker {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (scene, frames, static_part) = (&self.scene, self.frames, 100.0 * self.region);
        writeln!(
            f,
            "{scene}: {frames} frames; {static_part:.1} % of pixels static"
        )?;
        let rows = [
            ("truth", &self.truth),
            ("filtered", &self.filtered),
            ("and view rays", &self.seen),
            ("unfiltered", &self.unfiltered),
        ];
        let place = |at: Option<Place>| {
            let [width, pixel] = [self.width as usize, at.map_or(0, |it| it.pixel)];
            let [x, y] = [pixel % width, pixel / width];
            at.map_or(String::new(), |it| format!("{}, {x},{y}", it.frame))
        };
        let cells = |(name, change): (&str, &Change)| {
            let part = change.largest / self.unfiltered.largest;
            vec![
                ("percent per frame", name.to_owned()),
                ("largest", percent(change.largest, NO_PIXEL)),
                ("part", format!("{part:.3}")),
                ("1/1000", percent(change.thousandth, NO_PIXEL)),
                ("mean", percent(change.mean, NO_PIXEL)),
                ("less truth's", percent(change.largest_less_truth, NO_PIXEL)),
                ("frame, pixel", place(change.at)),
            ]
        };
        write_columns(f, &rows.map(cells))?;
        let verdict = if self.passed() { "ok" } else { "goal missed" };
        writeln!(
            f,
            "with view rays / unfiltered {:.3}  {verdict}",
            self.ratio()
        )
    }
}
