//! The lights whose light in the air is marched.

use glam::DVec3;
use moment_shadows::{AirLight, SpotCone};
use serde::Serialize;

use crate::error::LabError;
use crate::light::LightView;
use crate::scene::Scene;
use crate::view::View;

/// A kind of light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Lamp {
    /// The viewpoint's sun.
    Sun,
    /// A spot that shines where the sun does, from above the scene's middle.
    Spot,
    /// A light in the scene's middle that shines to all sides.
    Point,
}

/// The cone of the spot, as full angles.
const CONE: SpotCone = SpotCone {
    inner: 1.0,
    outer: 1.3,
};

/// How far from the scene's middle the spot is, in parts of the scene's radius.
const SPOT: f64 = 0.8;

/// Where the range of a lamp begins and ends, in parts of the scene's radius.
const RANGE: [f64; 2] = [0.01, 3.0];

/// Texels around a face that filters read.
const GUARD: u32 = 4;

/// A view of a light, and texels around what it shows.
pub(super) type Face = (LightView, u32);

impl Lamp {
    /// `sun`, `spot` or `point`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Lamp::Sun => "sun",
            Lamp::Spot => "spot",
            Lamp::Point => "point",
        }
    }

    /// The light in the library's terms.
    pub(super) fn air_light(self) -> AirLight {
        match self {
            Lamp::Sun => AirLight::Sun,
            Lamp::Spot => AirLight::Spot,
            Lamp::Point => AirLight::Point,
        }
    }

    /// The cone, if it has one.
    pub(super) fn cone(self) -> Option<SpotCone> {
        (self == Lamp::Spot).then_some(CONE)
    }

    /// Where it is; nowhere for a sun.
    pub(super) fn position(self, scene: &Scene, view: &View) -> Option<DVec3> {
        let bounds = scene.bounds();
        match self {
            Lamp::Sun => None,
            Lamp::Spot => Some(bounds.centre() - SPOT * bounds.radius() * view.light_direction),
            Lamp::Point => {
                let height = 0.5 * (bounds.centre().y + bounds.max.y);
                Some(bounds.centre().with_y(height))
            }
        }
    }

    /// Its views, with maps of so many texels, of which a sun's leaves so many free around the casters.
    pub(super) fn views(
        self,
        scene: &Scene,
        view: &View,
        map: u32,
        margin: f64,
    ) -> Result<Vec<Face>, LabError> {
        let Some(position) = self.position(scene, view) else {
            return Ok(vec![(view.sun(scene, [map; 2], margin, false)?, 0)]);
        };
        let range = RANGE.map(|part| part * scene.bounds().radius());
        let towards = |direction: DVec3, angle: f64| {
            let within = f64::from(map - 2 * GUARD) / f64::from(map);
            let angle = 2.0 * ((0.5 * angle).tan() / within).atan();
            let face = LightView::spot(position, direction, angle, range[0], None, range, true)?;
            Ok::<_, LabError>((face, GUARD))
        };
        if self == Lamp::Spot {
            return Ok(vec![towards(view.light_direction, CONE.outer)?]);
        }
        let axes = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
        let quarter = core::f64::consts::FRAC_PI_2;
        axes.map(|axis| towards(axis, quarter)).collect()
    }
}
