//! What flickers in the air while a camera and a light move slowly.

mod chain;
mod change;
mod nearest;
mod path;
mod walk;

use core::fmt;

use serde::Serialize;

pub use chain::Chain;
pub use change::{Change, static_region};
pub use nearest::RectifyNearest;
pub use path::{FRAMES, Path};
use walk::Walk;

use crate::cost::table::columns as write_columns;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::scene::Scene;

/// A pixel is static while its true radiance, with shadows and without, changes by at most this from frame to frame, in parts of
/// the mean radiance without shadows. What an edge or a shaft passes changes by ten times that and more.
pub const STILL: f32 = 5e-3;

/// A pixel has to be static for this many frames before and after, too.
pub const WINDOW: usize = 1;

/// The largest change of filtered pictures, at most this part of that of unfiltered ones.
pub const GOAL: f64 = 1.0 / 3.0;

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, clap::Args)]
pub struct FlickerDesc {
    /// Frames from the beginning of the path on; all of it has 240.
    #[arg(long, default_value_t = FRAMES, value_parser = clap::value_parser!(u32).range(2..=10_000))]
    pub frames: u32,
    /// Texels per side of the light's map.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub map: u32,
    /// Columns of rectified maps.
    #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(2..=8192))]
    pub columns: u32,
    /// Rows of rectified maps.
    #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(2..=8192))]
    pub rows: u32,
    /// Width of the picture.
    #[arg(long, default_value_t = 320, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub width: u32,
    /// Height of the picture.
    #[arg(long, default_value_t = 180, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub height: u32,
    /// Texels per side of the map that the truth is marched through, much finer than the light's map.
    #[arg(long, default_value_t = 2048, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub truth_map: u32,
    /// Steps of the truth.
    #[arg(long, default_value_t = 256, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub steps: u32,
}

impl FlickerDesc {
    fn extent(&self) -> [u32; 2] {
        [self.columns, self.rows]
    }
}

/// What flickers by how much.
#[derive(Clone, Debug, Serialize)]
pub struct Flicker {
    /// The scene's name.
    pub scene: String,
    /// Frames.
    pub frames: u32,
    /// Texels per side of the light's map.
    pub map: u32,
    /// Columns and rows of rectified maps.
    pub extent: [u32; 2],
    /// Width and height of the picture.
    pub picture: [u32; 2],
    /// The part of all pixels of all pairs of frames that is static.
    pub region: f64,
    /// Change of the truth in the region.
    pub truth: Change,
    /// Change of each chain in the region.
    pub chains: Vec<(Chain, Change)>,
}

/// Radiance of all frames, in parts of the mean radiance without shadows, pixel by pixel.
struct Frames {
    truth: Vec<Vec<f32>>,
    unshadowed: Vec<Vec<f32>>,
    chains: Vec<Vec<Vec<f32>>>,
}

/// Draws a path through a scene and compares chains on it. `progress` is called after each frame.
pub fn flicker(
    gpu: &Gpu,
    scene: &Scene,
    desc: &FlickerDesc,
    mut progress: impl FnMut(),
) -> Result<Flicker, LabError> {
    let mut walk = Walk::new(gpu, scene, desc)?;
    let mut frames = Frames {
        truth: Vec::new(),
        unshadowed: Vec::new(),
        chains: vec![Vec::new(); Chain::ALL.len()],
    };
    let mut scale = None;
    for number in 0..desc.frames.max(2) {
        let seen = walk.see(number)?;
        // One scale for all frames: the unit must not flicker itself.
        let mean = seen.unshadowed.iter().sum::<f32>() / seen.unshadowed.len().max(1) as f32;
        let scale = *scale.get_or_insert(1.0 / mean.max(1e-30));
        let scaled = |values: Vec<f32>| values.into_iter().map(|it| scale * it).collect();
        frames.truth.push(scaled(seen.truth));
        frames.unshadowed.push(scaled(seen.unshadowed));
        for (found, pixels) in frames.chains.iter_mut().zip(seen.chains) {
            found.push(scaled(pixels));
        }
        progress();
    }
    Ok(Flicker::new(scene, desc, &frames))
}

impl Flicker {
    fn new(scene: &Scene, desc: &FlickerDesc, frames: &Frames) -> Self {
        let region = static_region([&frames.truth, &frames.unshadowed], STILL, WINDOW);
        let of = |pictures: &[Vec<f32>]| Change::of(pictures, &frames.truth, &region);
        let pixels: usize = region.iter().map(Vec::len).sum();
        let inside = region.iter().flatten().filter(|is_static| **is_static);
        Self {
            scene: scene.name.clone(),
            frames: desc.frames,
            map: desc.map,
            extent: desc.extent(),
            picture: [desc.width, desc.height],
            region: inside.count() as f64 / pixels.max(1) as f64,
            truth: of(&frames.truth),
            chains: Chain::ALL
                .into_iter()
                .zip(&frames.chains)
                .map(|(chain, pictures)| (chain, of(pictures)))
                .collect(),
        }
    }

    /// The change of a chain.
    #[must_use]
    pub fn change(&self, chain: Chain) -> Change {
        let found = self.chains.iter().find(|(other, _)| *other == chain);
        found.map_or(Change::default(), |(_, change)| *change)
    }

    /// The largest change of the example's chain as a part of that without filters.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.change(Chain::Filtered).largest / self.change(Chain::Unfiltered).largest
    }
}

impl fmt::Display for Flicker {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([columns, rows], [width, height], map) = (self.extent, self.picture, self.map);
        writeln!(
            f,
            "{}: {} frames of {width}x{height}, map {map}x{map}, rectified {columns}x{rows}; {:.1} % of pixels static",
            self.scene,
            self.frames,
            100.0 * self.region
        )?;
        let rows = self
            .chains
            .iter()
            .map(|(chain, change)| (chain.name(), change));
        let unfiltered = self.change(Chain::Unfiltered).largest;
        let cells = |(name, change): (&str, &Change)| {
            vec![
                ("change per frame", name.to_owned()),
                ("largest", format!("{:.5}", change.largest)),
                ("part", format!("{:.3}", change.largest / unfiltered)),
                ("1/1000", format!("{:.5}", change.thousandth)),
                ("mean", format!("{:.6}", change.mean)),
                ("less truth's", format!("{:.5}", change.largest_less_truth)),
            ]
        };
        let rows = [("truth", &self.truth)].into_iter().chain(rows);
        write_columns(f, &rows.map(cells).collect::<Vec<_>>())
    }
}
