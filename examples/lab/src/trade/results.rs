//! What a trade finds, as it is written to `results.json`.

use moment_shadows::{Storage, Technique};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::axes::Cell;
use super::probe::ViewProbe;
use crate::cost::statistics::Distribution;
use crate::metric::{Comparison, ErrorFigures};

/// The version of the file's form.
pub const VERSION: u32 = 1;

/// Everything that was found.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Results {
    /// The form of this file: 1.
    pub version: u32,
    /// How it was found.
    pub setting: Setting,
    /// A scene each.
    pub scenes: Vec<SceneResults>,
    /// What other jobs than hard shadows have compared.
    pub jobs: Vec<JobResults>,
}

/// What a job has compared on a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JobResults {
    /// `soft` or `air`.
    pub job: String,
    /// The scene as it was named.
    pub scene: String,
    /// The reports of `soft-error` or `scattering-error`, as these write them.
    pub report: Value,
}

/// What is the same for all scenes. A trade that goes on where another stopped has the same.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Setting {
    /// The version of the library.
    pub library: String,
    /// What the command itself is, and what scenes hold: the beginning of the SHA-256 of its file, and of each scene's with its views.
    /// What another build or another file has given is not taken for this one's.
    pub of: Vec<String>,
    /// The adapter and its driver.
    pub adapter: String,
    /// What the device offers.
    pub profile: String,
    /// Whether times are of the processor, which stands in for a graphics device.
    pub is_software: bool,
    /// Width and height of pictures.
    pub picture: [u32; 2],
    /// Views per scene, and the number of the first.
    pub views: [u32; 2],
    /// Samples per texel of the depths that truths are made of.
    pub truth_samples: u32,
    /// Texels per side of the map that truths are made for; radii count in its texels.
    pub truth_map: u32,
    /// One surface in so many texels along either axis is judged.
    pub stride: u32,
    /// Rounds of times.
    pub rounds: u32,
    /// Whether scenes stand on a ground plane that the command adds.
    pub ground: bool,
    /// What is varied.
    pub axes: AxesSetting,
}

/// The values of each axis, as [`Axes`](super::axes::Axes) has them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AxesSetting {
    /// Texels per side of the light's map.
    pub maps: Vec<u32>,
    /// Radii in texels of the largest map.
    pub radii: Vec<u32>,
    /// Samples per texel.
    pub samples: Vec<u32>,
    /// Techniques with storages.
    pub candidates: Vec<String>,
}

/// What was found on a scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SceneResults {
    /// The scene as it was named.
    pub scene: String,
    /// Triangles, with those of a ground plane that was added.
    pub triangles: usize,
    /// What its views ask for.
    pub probes: Vec<ViewProbe>,
    /// Rows of what was measured.
    pub rows: Vec<Row>,
}

/// A technique in a storage with a map, a softness and a number of samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The combination.
    #[serde(flatten)]
    pub cell: Cell,
    /// The technique as tables name it, such as `evsm4 40/5`.
    pub name: String,
    /// The technique as graph files have it.
    pub technique: Technique,
    /// The storage of the map; none where the plain depth map is read.
    pub storage: Option<Storage>,
    /// Bits of a texel that is looked up, all planes.
    pub bits_per_texel: u32,
    /// Bytes of all textures and buffers of the graph's plan.
    pub bytes_resident: u64,
    /// Bytes that its passes move at least.
    pub bytes_moved: u64,
    /// What it takes.
    pub time: Time,
    /// What a compiler for RDNA 2 makes of the shader that shades with it, where the kept table has a row for it.
    pub isa: Option<Isa>,
    /// Errors, view by view.
    pub views: Vec<Errors>,
}

/// Times in units of a copy by a compute shader of 1,024 x 1,024 texels of 64 bits, in the same rounds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Time {
    /// All that is made of the light's map.
    pub map: Distribution,
    /// All that is done per pixel.
    pub pixels: Distribution,
    /// Both.
    pub total: Distribution,
}

/// The kept table's figures of a shader on Navi 21.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Isa {
    /// The compiler's estimate of cycles per wave when many waves share a unit.
    pub inverse_throughput: u64,
    /// Vector registers.
    pub vgprs: u64,
    /// Texture reads per pixel.
    pub texture: f64,
}

/// Mean absolute errors of shadow intensity, from 0 to 1; none where nothing was to be judged.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// The number of the view.
    pub view: u32,
    /// Over the picture's pixels that face the light: what a player sees.
    pub picture: Option<Figures>,
    /// Over those of them in penumbrae.
    pub penumbra: Option<Figures>,
    /// Over all surfaces on rays of the light that meet a caster, hidden ones too: what any camera could see.
    pub surfaces: Option<Figures>,
    /// Over those of them that face the light.
    pub facing_surfaces: Option<Figures>,
    /// Pixels that are NaN.
    pub nan: usize,
    /// The mean of FLIP over the picture that the shadows light, beside that of the truth; none in results of before it was there.
    #[serde(default)]
    pub flip: Option<f64>,
}

/// An error with its parts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// The mean absolute error: the sum of the next two.
    pub error: f64,
    /// The part of it that is too light.
    pub leaking: f64,
    /// The part of it that is too dark.
    pub too_dark: f64,
    /// 95 % have at most this error.
    pub percentile_95: f64,
}

impl Figures {
    fn of(figures: &ErrorFigures) -> Option<Self> {
        (figures.samples > 0).then_some(Self {
            error: figures.mean_absolute,
            leaking: figures.leaking,
            too_dark: figures.overdarkening,
            percentile_95: figures.percentile_95,
        })
    }
}

impl Errors {
    pub(super) fn of(view: u32, picture: &Comparison, surfaces: &[ErrorFigures; 2]) -> Self {
        Self {
            view,
            picture: Figures::of(&picture.facing),
            penumbra: Figures::of(&picture.penumbra),
            surfaces: Figures::of(&surfaces[0]),
            facing_surfaces: Figures::of(&surfaces[1]),
            nan: picture.nan_pixels,
            flip: None,
        }
    }
}

impl Row {
    /// The picture's error in each view that shows something that faces the light.
    #[must_use]
    pub fn errors(&self) -> Vec<f64> {
        let pictures = self.views.iter().filter_map(|view| view.picture);
        pictures.map(|picture| picture.error).collect()
    }

    /// The mean of these; none of none.
    #[must_use]
    pub fn error(&self) -> Option<f64> {
        mean(self.errors().into_iter())
    }

    /// The mean over views of the error over all surfaces.
    #[must_use]
    pub fn surface_error(&self) -> Option<f64> {
        mean(
            self.views
                .iter()
                .filter_map(|view| view.surfaces)
                .map(|it| it.error),
        )
    }

    /// The mean over views of FLIP.
    #[must_use]
    pub fn flip(&self) -> Option<f64> {
        mean(self.views.iter().filter_map(|view| view.flip))
    }

    /// The view with the largest error in the picture.
    #[must_use]
    pub fn worst_view(&self) -> Option<&Errors> {
        let error = |view: &&Errors| view.picture.map_or(0.0, |picture| picture.error);
        self.views
            .iter()
            .max_by(|one, other| error(one).total_cmp(&error(other)))
    }
}

/// The mean of some figures; none of none.
pub(crate) fn mean(figures: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = figures.fold((0.0, 0), |(sum, count), figure| (sum + figure, count + 1));
    (count > 0).then(|| sum / f64::from(count))
}
