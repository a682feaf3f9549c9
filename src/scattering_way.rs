//! Which way of lighting the air has the least error, as measured.

use serde::{Deserialize, Serialize};

use crate::Resolution::{self, Full, Half, Quarter};
use AirLight::{Point, Spot, Sun};

/// A kind of light whose light in the air is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum AirLight {
    /// A light of one direction.
    Sun,
    /// A light with a position that shines into a cone.
    Spot,
    /// A light with a position that shines to all sides.
    Point,
}

/// A way of lighting the air.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ScatteringWay {
    /// Prefiltered scattering with six moments: the nodes `rectify_moments`, `integrate_scattering` and `composite_scattering`.
    Prefiltered,
    /// Marching with the filtered map: the node `march_scattering`, with `upsample_scattering` where that is not at full resolution.
    Marched {
        /// Steps of a ray.
        steps: u32,
        /// The part of the resolution that is marched.
        resolution: Resolution,
    },
}
type Row = (AirLight, bool, ScatteringWay, f64, f64);

const fn marched(steps: u32, resolution: Resolution) -> ScatteringWay {
    ScatteringWay::Marched { steps, resolution }
}

/// Light, whether its air is homogeneous, way, lookups of the filtered map per pixel, and mean absolute error as a part of the mean
/// radiance without shadows: of each light and medium the least error first. Recorded in `examples/lab/scattering_ways.json`; a test
/// holds both.
#[rustfmt::skip]
const RECORDED: [Row; 45] = [
    (Sun, true, marched(64, Full), 64.0, 0.0076),
    (Sun, true, ScatteringWay::Prefiltered, 2.0, 0.0091),
    (Sun, true, marched(32, Full), 32.0, 0.0141),
    (Sun, true, marched(32, Half), 8.0, 0.0154),
    (Sun, true, marched(32, Quarter), 2.0, 0.023),
    (Sun, true, marched(16, Half), 4.0, 0.0239),
    (Sun, true, marched(16, Full), 16.0, 0.0268),
    (Sun, true, marched(16, Quarter), 1.0, 0.031),
    (Sun, true, marched(8, Half), 2.0, 0.0384),
    (Sun, true, marched(8, Quarter), 0.5, 0.0447),
    (Sun, true, marched(8, Full), 8.0, 0.0476),
    (Sun, true, marched(4, Full), 4.0, 0.0812),
    (Sun, false, marched(64, Full), 64.0, 0.0082),
    (Sun, false, marched(32, Full), 32.0, 0.0154),
    (Sun, false, marched(32, Half), 8.0, 0.0155),
    (Sun, false, marched(32, Quarter), 2.0, 0.0199),
    (Sun, false, marched(16, Half), 4.0, 0.0248),
    (Sun, false, marched(16, Quarter), 1.0, 0.0286),
    (Sun, false, marched(16, Full), 16.0, 0.0294),
    (Sun, false, marched(8, Half), 2.0, 0.0405),
    (Sun, false, marched(8, Quarter), 0.5, 0.0434),
    (Sun, false, marched(8, Full), 8.0, 0.0519),
    (Sun, false, marched(4, Full), 4.0, 0.088),
    (Spot, false, marched(64, Full), 64.0, 0.0166),
    (Spot, false, marched(32, Full), 32.0, 0.0241),
    (Spot, false, marched(32, Half), 8.0, 0.0355),
    (Spot, false, marched(16, Full), 16.0, 0.0411),
    (Spot, false, marched(16, Half), 4.0, 0.0461),
    (Spot, false, marched(32, Quarter), 2.0, 0.0637),
    (Spot, false, marched(8, Half), 2.0, 0.0674),
    (Spot, false, marched(8, Full), 8.0, 0.0724),
    (Spot, false, marched(16, Quarter), 1.0, 0.0728),
    (Spot, false, marched(8, Quarter), 0.5, 0.0919),
    (Spot, false, marched(4, Full), 4.0, 0.1317),
    (Point, false, marched(64, Full), 64.0, 0.0061),
    (Point, false, marched(32, Full), 32.0, 0.0107),
    (Point, false, marched(32, Half), 8.0, 0.0195),
    (Point, false, marched(16, Full), 16.0, 0.02),
    (Point, false, marched(16, Half), 4.0, 0.0263),
    (Point, false, marched(32, Quarter), 2.0, 0.0312),
    (Point, false, marched(16, Quarter), 1.0, 0.0371),
    (Point, false, marched(8, Full), 8.0, 0.0374),
    (Point, false, marched(8, Half), 2.0, 0.041),
    (Point, false, marched(8, Quarter), 0.5, 0.05),
    (Point, false, marched(4, Full), 4.0, 0.0676),
];

impl ScatteringWay {
    /// The way with the least error for a light, in homogeneous air or in fog that thins with height, among those with at most so many
    /// lookups of the light's filtered map per pixel. `None` where none has so few.
    ///
    /// The order is that of `moment-shadows-lab march-error`: the mean over procedural scenes, on a software adapter. Prefiltered
    /// scattering resamples the map as well, whatever the picture's size.
    #[must_use]
    pub fn best(light: AirLight, homogeneous: bool, lookups: f64) -> Option<ScatteringWay> {
        let mut all = Self::by_error(light, homogeneous);
        all.find(|&(_, of_way, _)| of_way <= lookups)
            .map(|(way, ..)| way)
    }

    /// All that [`best`](Self::best) chooses among, the least error first, each with its lookups per pixel and its error as a part of the
    /// mean radiance without shadows.
    pub fn by_error(
        light: AirLight,
        homogeneous: bool,
    ) -> impl Iterator<Item = (ScatteringWay, f64, f64)> {
        let suits = move |row: &Row| row.0 == light && row.1 == homogeneous;
        let rows = RECORDED.into_iter().filter(suits);
        rows.map(|(_, _, way, lookups, error)| (way, lookups, error))
    }
}
