//! Shadows seen from afar: the truth over the whole of each pixel, and how a picture flickers while the camera moves.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::host::{SurfacePixels, read_gbuffer};
use crate::judgement::Unfiltered;
use crate::light::LightView;
use crate::scene::Scene;
use crate::truth::pcf::pcf;

/// Places per pixel along each side at which the truth is evaluated.
pub const PLACES: u32 = 8;

/// Cosine between the normals of one surface within a pixel: 25 degrees.
const ONE_SURFACE: f64 = 0.9;

/// What a pixel should show.
pub struct PixelTruth {
    /// Brute-force shadow intensity under the kernel, averaged over each pixel.
    pub truth: Vec<f32>,
    /// Pixels that show one surface, which faces the light within its map: others have no one shadow intensity.
    pub judged: Vec<bool>,
    /// How many texels of the map the longer axis of each pixel covers; 0 where that is unknown.
    pub texels: Vec<f64>,
}

impl PixelTruth {
    /// Draws the frame with [`PLACES`] times the pixels along each side, and averages the truth there.
    pub fn of(
        gpu: &Gpu,
        scene: &Scene,
        desc: FrameDesc,
        file: &GraphFile,
    ) -> Result<Self, LabError> {
        let fine = Frame::draw(
            gpu,
            scene,
            FrameDesc {
                picture: desc.picture.map(|side| side * PLACES),
                ..desc
            },
        )?;
        let Unfiltered { depths, taps } = Unfiltered::of(gpu, &fine, file)?;
        let surface = read_gbuffer(gpu, &fine.surface)?;
        let intensities = pcf(&desc.light, &depths, &taps, &surface)?;
        let [width, height] = desc.picture;
        let pixels: Vec<Pixel> = (0..height)
            .into_par_iter()
            .flat_map_iter(|y| (0..width).map(move |x| [x, y]))
            .map(|place| Pixel::of(place, width, &surface, &intensities, &desc))
            .collect();
        Ok(Self {
            truth: pixels.iter().map(|pixel| pixel.truth).collect(),
            judged: pixels.iter().map(|pixel| pixel.judged).collect(),
            texels: pixels.iter().map(|pixel| pixel.texels).collect(),
        })
    }
}

#[derive(Clone, Copy, Default)]
struct Pixel {
    truth: f32,
    judged: bool,
    texels: f64,
}

impl Pixel {
    fn of(
        [x, y]: [u32; 2],
        width: u32,
        surface: &SurfacePixels,
        intensities: &[f32],
        desc: &FrameDesc,
    ) -> Self {
        let index = |column: u32, row: u32| {
            ((y * PLACES + row) * (width * PLACES) + x * PLACES + column) as usize
        };
        let normal = |index: usize| DVec3::from(surface.normal[index].map(f64::from));
        let middle = index(PLACES / 2, PLACES / 2);
        let mut sum = 0.0;
        for row in 0..PLACES {
            for column in 0..PLACES {
                let place = index(column, row);
                let alike = normal(place).dot(normal(middle)) > ONE_SURFACE;
                if !(alike && is_lit_side(surface, place, &desc.light)) {
                    return Self::default();
                }
                sum += f64::from(intensities[place]);
            }
        }
        let last = PLACES - 1;
        let uv = |column, row| {
            let position = DVec3::from(surface.position[index(column, row)].map(f64::from));
            desc.light.uv(position)
        };
        // From the first place to the last it is less than a pixel by one place.
        let texels = match (uv(0, 0), uv(last, 0), uv(0, last)) {
            (Some(corner), Some(right), Some(below)) => {
                let map = DVec2::new(f64::from(desc.map[0]), f64::from(desc.map[1]));
                let axis = |end: DVec2| (end - corner) * map * f64::from(PLACES) / f64::from(last);
                longer_axis(axis(right), axis(below))
            }
            _ => 0.0,
        };
        Self {
            truth: (sum / f64::from(PLACES * PLACES)) as f32,
            judged: true,
            texels,
        }
    }
}

/// Whether a place shows a surface that faces the light within its map.
fn is_lit_side(surface: &SurfacePixels, index: usize, light: &LightView) -> bool {
    let position = DVec3::from(surface.position[index].map(f64::from));
    let normal = DVec3::from(surface.normal[index].map(f64::from));
    let inside = |uv: DVec2| uv.cmpge(DVec2::ZERO).all() && uv.cmple(DVec2::ONE).all();
    surface.covered[index]
        && normal.dot(light.towards_light(position)) > 0.0
        && light.uv(position).is_some_and(inside)
}

/// The larger singular value of the matrix with these columns.
fn longer_axis(right: DVec2, below: DVec2) -> f64 {
    let half_sum = 0.5 * (right.length_squared() + below.length_squared());
    let area = right.perp_dot(below);
    (half_sum + (half_sum * half_sum - area * area).max(0.0).sqrt()).sqrt()
}

/// Mean of |next - 2 now + before| over the frames of a film, at pixels that `judged` keeps in all three: what changes
/// evenly cancels, what comes and goes from frame to frame remains.
#[derive(Clone, Debug, Default)]
pub struct Flicker {
    /// The last two frames with the pixels that count in them.
    frames: Vec<(Vec<f32>, Vec<bool>)>,
    sum: f64,
    count: u64,
}

impl Flicker {
    /// Adds a frame.
    pub fn add(&mut self, shadow: Vec<f32>, judged: Vec<bool>) {
        if let [before, now] = self.frames.as_slice() {
            for index in 0..shadow.len() {
                let counts = judged[index] && now.1[index] && before.1[index];
                if counts {
                    let change = f64::from(shadow[index]) - 2.0 * f64::from(now.0[index])
                        + f64::from(before.0[index]);
                    self.sum += change.abs();
                    self.count += 1;
                }
            }
            self.frames.remove(0);
        }
        self.frames.push((shadow, judged));
    }

    /// The mean; 0 for a film of less than three frames.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.sum / self.count.max(1) as f64
    }
}

/// Pixels of a drawn frame that show a surface which faces the light within its map.
pub fn lit_pixels(gpu: &Gpu, frame: &Frame) -> Result<Vec<bool>, LabError> {
    let surface = read_gbuffer(gpu, &frame.surface)?;
    Ok((0..surface.covered.len())
        .into_par_iter()
        .map(|index| is_lit_side(&surface, index, &frame.desc.light))
        .collect())
}
