//! Where views of a scene stand and what lights them: numbered, or from a file beside the scene.

use std::path::{Path, PathBuf};

use glam::DVec3;
use serde::Deserialize;

use crate::error::LabError;
use crate::light::{DirectionalFit, LightView};
use crate::scene::Scene;
use crate::view::{Camera, View};

/// The ending of a file of views beside a scene: of `garden.glb` it is `garden.views.json`.
pub const ENDING: &str = "views.json";

/// How a scene is seen and lit, as its owner says: a file of JSON beside it. Places and lengths are in the coordinates of the scene's
/// file.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneSetup {
    /// Whether a ground plane is added at the scene's lowest point. By default it is.
    #[serde(default = "yes")]
    pub ground: bool,
    /// The views, at least one.
    pub views: Vec<GivenView>,
}

fn yes() -> bool {
    true
}

/// A camera and a light.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GivenView {
    /// Where the camera stands.
    pub eye: [f64; 3],
    /// What it looks at.
    pub target: [f64; 3],
    /// Its vertical angle of view in radians. By default 0.7.
    pub vertical_angle: Option<f64>,
    /// The light.
    pub light: GivenLight,
}

/// A light.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "lowercase", tag = "type")]
pub enum GivenLight {
    /// A sun, whose map is fitted to the casters.
    Sun {
        /// Along which it shines, of any length but zero.
        direction: [f64; 3],
        /// The distances along the camera's axis at which cascades end, ascending from above 0. Each has a map of its own, fitted to the
        /// part of the camera's view that it is for, and is judged as a view of its own, by the pixels in that part.
        #[serde(default)]
        cascades: Vec<f64>,
    },
    /// A spot light with a square map.
    Spot {
        /// Where it is.
        position: [f64; 3],
        /// Along which it shines, of any length but zero.
        direction: [f64; 3],
        /// The full angle of its map in radians, above 0 and below pi.
        angle: f64,
        /// Distances of its near and far plane, between which moment depth runs.
        range: [f64; 2],
    },
}

/// A view that is to be judged.
#[derive(Clone, Debug, PartialEq)]
pub enum ViewSetup {
    /// One of the numbered views.
    Numbered(u32),
    /// One that the scene's owner gives.
    Given {
        /// What is given.
        view: GivenView,
        /// Distances along the camera's axis between which pixels are judged, where the light has cascades.
        part: Option<[f64; 2]>,
    },
}

impl SceneSetup {
    /// The file beside a scene, if there is one: what it says, or what is wrong with it.
    pub fn beside(scene: &str) -> Result<Option<Self>, LabError> {
        let path = path_beside(scene);
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(LabError::unsuitable(path.display(), error)),
        };
        let setup: Self = serde_json::from_str(&text).map_err(|error| {
            LabError::unsuitable(
                path.display(),
                format!("this is no description of views: {error}"),
            )
        })?;
        let wrong = |reason| Err(LabError::unsuitable(path.display(), reason));
        let ascends = |view: &GivenView| {
            let ends = [&[0.0], view.light.cascades()].concat();
            ends.iter().all(|end| end.is_finite()) && ends.is_sorted_by(|one, other| one < other)
        };
        match setup.views.iter().position(|view| !ascends(view)) {
            _ if setup.views.is_empty() => wrong("it has no view; give at least one".to_owned()),
            Some(view) => wrong(format!(
                "cascades of view {view} end at {:?}; give distances that ascend from above 0",
                setup.views[view].light.cascades()
            )),
            None => Ok(Some(setup)),
        }
    }

    /// What is judged: every view, or each cascade of it.
    pub(super) fn judged(self) -> Vec<ViewSetup> {
        let parts = |view: GivenView| {
            let ends = [&[0.0], view.light.cascades()].concat();
            let mut parts: Vec<_> = ends
                .windows(2)
                .map(|ends| Some([ends[0], ends[1]]))
                .collect();
            if parts.is_empty() {
                parts.push(None);
            }
            parts.into_iter().map(move |part| ViewSetup::Given {
                view: view.clone(),
                part,
            })
        };
        self.views.into_iter().flat_map(parts).collect()
    }
}

impl GivenLight {
    /// Where its cascades end; none of a light with one map.
    fn cascades(&self) -> &[f64] {
        match self {
            Self::Sun { cascades, .. } => cascades,
            Self::Spot { .. } => &[],
        }
    }
}

/// Where the views of a scene would be.
pub(crate) fn path_beside(scene: &str) -> PathBuf {
    Path::new(scene).with_extension(ENDING)
}

impl ViewSetup {
    /// The camera.
    pub(super) fn camera(&self, scene: &Scene) -> Result<Camera, LabError> {
        match self {
            Self::Numbered(number) => Ok(View::numbered(scene, *number).camera),
            Self::Given { view, .. } => {
                let [eye, target] = [view.eye, view.target].map(DVec3::from_array);
                let seen = View::numbered(scene, 0).seen_from(scene, [eye, target])?;
                let mut camera = seen.camera;
                camera.vertical_angle = view.vertical_angle.unwrap_or(camera.vertical_angle);
                if !(camera.vertical_angle > 0.0 && camera.vertical_angle < std::f64::consts::PI) {
                    return Err(LabError::refused(format!(
                        "a camera's vertical angle is between 0 and pi radians, not {}",
                        camera.vertical_angle
                    )));
                }
                Ok(camera)
            }
        }
    }

    /// Distances along the camera's axis between which pixels are judged, if not all are.
    pub(super) fn part(&self) -> Option<[f64; 2]> {
        match self {
            Self::Numbered(_) => None,
            Self::Given { part, .. } => *part,
        }
    }

    /// The light, with a map of this size whose borders keep so many texels free if it is fitted, to the casters or to its part of what
    /// the camera sees.
    pub(super) fn light(
        &self,
        scene: &Scene,
        camera: &Camera,
        (map, margin): ([u32; 2], f64),
    ) -> Result<LightView, LabError> {
        let view = match self {
            Self::Numbered(number) => {
                return View::numbered(scene, *number).sun(scene, map, margin, false);
            }
            Self::Given { view, .. } => view,
        };
        match view.light {
            GivenLight::Sun { direction, .. } => {
                let casters = scene.extremes();
                let seen = self.part().map(|part| camera.corners(part)).transpose()?;
                let fit = DirectionalFit {
                    map,
                    margin,
                    reversed: false,
                };
                let direction = DVec3::from_array(direction);
                let across = seen.as_ref().map_or(&casters[..], |corners| &corners[..]);
                LightView::directional_over(direction, &casters, across, fit)
            }
            GivenLight::Spot {
                position,
                direction,
                angle,
                range: [near, far],
            } => LightView::spot(
                DVec3::from_array(position) - scene.origin,
                DVec3::from_array(direction),
                angle,
                near,
                Some(far),
                [near, far],
                false,
            ),
        }
    }
}
