//! The light that soft shadows are judged under.

use std::str::FromStr;

use glam::DVec3;
use serde::Serialize;

use crate::error::LabError;
use crate::light::{LightKind, LightShape, LightView, wrong_size};
use crate::scene::Scene;
use crate::view::View;

/// What kind of area light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum SoftLightChoice {
    /// A sun of an angular diameter.
    Directional,
    /// A disk that shines into a cone.
    Spot,
    /// A rectangle that does.
    Rectangle,
}

/// A size as a command line has it: one number, or two with an x between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSize(pub [f64; 2]);

/// The angle under which a directional light is seen by default, in degrees.
const ANGLE: f64 = 3.0;

/// Width and height of a rectangle by default, in parts of its distance from the scene's middle; a disk has the first.
const PARTS: [f64; 2] = [0.08, 0.03];

/// The distance of a spot light's near plane, as a part of its distance to the scene.
const SPOT_NEAR: f64 = 0.05;

/// Receivers farther behind the casters than so many times the diameter of all casters do not stretch the light's range.
const FARTHEST: f64 = 2.0;

impl SoftLightChoice {
    /// `directional`, `spot` or `rectangle`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Directional => "directional",
            Self::Spot => "spot",
            Self::Rectangle => "rectangle",
        }
    }

    /// The light of a viewpoint, with the size that is given: degrees for a directional light, scene units for the others; two
    /// of them for a rectangle, which is a square with one. Its range reaches from the first caster to where the last one's
    /// shadow falls on the ground. The map of a directional light leaves room for the widest penumbra, at least `margin`
    /// texels.
    pub fn light(
        self,
        scene: &Scene,
        view: &View,
        map: [u32; 2],
        margin: f64,
        size: Option<LightSize>,
    ) -> Result<(LightView, LightShape), LabError> {
        match self {
            Self::Directional => {
                let degrees = one(size, "angular diameter")?.unwrap_or(ANGLE);
                let shape = LightShape::Directional {
                    angular_diameter: degrees.to_radians(),
                };
                shape.check(LightKind::Directional)?;
                let light = view.sun(scene, map, margin, false)?;
                let reach = reach(scene, &light);
                let margin = margin.max(widest(&light.reaching(reach), shape, map));
                let light = view.sun(scene, map, margin, false)?;
                Ok((light.reaching(reach), shape))
            }
            Self::Spot | Self::Rectangle => {
                // Stored the other way round, depth loses its digits to the hyperbola: receivers shadow themselves.
                let light = view.spot(scene, SPOT_NEAR, None, true)?;
                let light = light.reaching(reach(scene, &light));
                let distance = light.distance(scene.bounds().centre());
                let usual = PARTS.map(|part| part * distance);
                let shape = match self {
                    Self::Rectangle => LightShape::Rectangle {
                        size: size.map_or(usual, |LightSize(size)| size),
                    },
                    _ => LightShape::Disk {
                        diameter: one(size, "diameter")?.unwrap_or(usual[0]),
                    },
                };
                shape.check(light.kind())?;
                Ok((light, shape))
            }
        }
    }
}

/// The only number of a size.
fn one(size: Option<LightSize>, what: &'static str) -> Result<Option<f64>, LabError> {
    match size {
        None => Ok(None),
        Some(LightSize([width, height])) if width == height || width.is_nan() => Ok(Some(width)),
        Some(LightSize([_, height])) => Err(wrong_size(
            what,
            height,
            "a single number: only rectangles have two",
        )),
    }
}

/// How far along the light's axis the shadows of casters fall on the ground.
fn reach(scene: &Scene, light: &LightView) -> f64 {
    let last = light.range[1];
    let Some(ground) = scene.ground else {
        return last;
    };
    let on_ground = |caster: DVec3| {
        let towards = match light.kind() {
            LightKind::Directional => light.towards_light(caster),
            LightKind::Spot => light.view_from_world.inverse().w_axis.truncate() - caster,
        };
        let along = (caster.y - ground) / towards.y;
        // Where the light comes from below, nothing falls on the ground.
        let falls = towards.y > 0.0 && along.is_finite();
        falls.then(|| light.distance(caster - along * towards))
    };
    let farthest = last + FARTHEST * 2.0 * scene.bounds().radius();
    let reached = scene.casters().filter_map(on_ground);
    reached.fold(last, f64::max).min(farthest)
}

/// Half the widest penumbra in a map of a directional light, in texels; at most an eighth of the map.
fn widest(light: &LightView, shape: LightShape, map: [u32; 2]) -> f64 {
    let [first, last] = light.range;
    let texel = light.texel_size(map);
    let half = shape.extent()[0] * 0.5 * (last - first);
    let texels = (half / texel[0]).max(half / texel[1]);
    // The margin makes texels larger, so that a little less would do.
    texels.ceil().min(f64::from(map[0].min(map[1])) / 8.0)
}

impl FromStr for LightSize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.trim().parse::<f64>().ok();
        let sides = match text.split_once(['x', 'X']) {
            Some((width, height)) => number(width).zip(number(height)),
            None => number(text).map(|size| (size, size)),
        };
        let sides = sides.map(|(width, height)| Self([width, height]));
        sides.ok_or_else(|| format!("'{text}' is no size; give a number, or two as in 1.2x0.6"))
    }
}
