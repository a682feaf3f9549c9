//! Where the camera stands and looks, in relation to the light.

use std::str::FromStr;

use glam::DVec3;

use crate::scene::Scene;
use crate::view::View;

/// What the camera looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// A numbered viewpoint.
    Numbered(u32),
    /// Almost towards the light.
    Towards,
    /// Almost away from it.
    Away,
    /// Straight along it, towards where it comes from.
    Into,
    /// Straight along it, the way it travels.
    Along,
}

/// A viewpoint whose light can be lowered.
#[derive(Clone, Copy, Debug, PartialEq, clap::Args)]
pub struct LookDesc {
    /// A numbered viewpoint, or how the camera looks: towards the light, away from it, straight into it, or straight along it.
    /// The light is that of the numbered viewpoint, of number 0 for the others.
    #[arg(
        long = "view",
        default_value = "0",
        value_name = "NUMBER|towards|away|into|along"
    )]
    pub look: Look,
    /// The light's height above the horizon in degrees, in place of the viewpoint's own.
    #[arg(long)]
    pub elevation: Option<f64>,
}

/// Angle between the camera's axis and the light that is almost along it, in radians.
const ASIDE: f64 = 0.3;

/// How far the camera is from the scene's middle, in parts of the scene's radius.
const AWAY: f64 = 1.7;

impl LookDesc {
    /// The viewpoint in a scene.
    #[must_use]
    pub fn view(&self, scene: &Scene) -> View {
        let number = match self.look {
            Look::Numbered(number) => number,
            _ => 0,
        };
        let mut view = View::numbered(scene, number);
        if let Some(elevation) = self.elevation {
            let flat = DVec3::new(view.light_direction.x, 0.0, view.light_direction.z);
            let (down, out) = elevation.to_radians().sin_cos();
            view.light_direction = flat.normalize_or(DVec3::Z) * out - DVec3::Y * down;
        }
        let light = view.light_direction;
        let forward = match self.look {
            Look::Numbered(_) => return view,
            Look::Towards => aside(-light),
            Look::Away => aside(light),
            Look::Into => -light,
            Look::Along => light,
        };
        let bounds = scene.bounds();
        let camera = &mut view.camera;
        match scene.stand {
            // Within: from where the stand is towards the light, from the scene's middle away from it.
            Some(stand) if forward.dot(light) > 0.0 => {
                camera.eye = stand.target.with_y(0.5 * (stand.target.y + bounds.max.y));
            }
            Some(stand) => camera.eye = stand.eye,
            None => {
                camera.eye = bounds.centre() - AWAY * bounds.radius() * forward;
                // Not below the ground.
                camera.eye.y = camera.eye.y.max(bounds.min.y + 0.05 * bounds.radius());
            }
        }
        camera.target = camera.eye + bounds.radius() * forward;
        camera.near = 0.005 * bounds.radius();
        view
    }
}

/// A direction, turned a little towards the horizon.
fn aside(direction: DVec3) -> DVec3 {
    let flat = DVec3::new(direction.x, 0.0, direction.z).normalize_or(DVec3::Z);
    let across = direction.cross(flat).normalize_or(DVec3::X);
    glam::DQuat::from_axis_angle(across, ASIDE) * direction
}

/// The words for what the camera looks at.
const WORDS: [(&str, Look); 4] = [
    ("towards", Look::Towards),
    ("away", Look::Away),
    ("into", Look::Into),
    ("along", Look::Along),
];

impl Look {
    /// A part of files' names.
    #[must_use]
    pub fn name(self) -> String {
        if let Look::Numbered(number) = self {
            return number.to_string();
        }
        let word = WORDS.iter().find(|(_, look)| *look == self);
        word.map_or(String::new(), |(word, _)| (*word).to_owned())
    }
}

impl FromStr for Look {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Some((_, look)) = WORDS.iter().find(|(word, _)| *word == text) {
            return Ok(*look);
        }
        text.parse().map(Look::Numbered).map_err(|_| {
            format!("'{text}' is no viewpoint; give a number, towards, away, into or along")
        })
    }
}
