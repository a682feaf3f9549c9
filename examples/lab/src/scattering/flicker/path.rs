//! A slow path of a camera and a light.

use core::f64::consts::TAU;

use glam::DVec3;

use crate::scene::Scene;
use crate::view::View;

/// Frames of the whole path, at whose end everything is back where it began.
pub const FRAMES: u32 = 240;

/// How far the camera moves to either side, in parts of the scene's radius.
const SWAY: f64 = 0.01;

/// How far the light turns to either side, in radians.
const TURN: f64 = 0.01;

/// A closed path about a scene's first viewpoint.
#[derive(Clone, Copy, Debug)]
pub struct Path {
    start: View,
    radius: f64,
}

impl Path {
    /// Through a scene.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        Self {
            start: View::numbered(scene, 0),
            radius: scene.bounds().radius(),
        }
    }

    /// The viewpoint of a frame. The camera draws an eight across its axis and keeps its target in the middle; the light turns
    /// to and fro about the vertical.
    #[must_use]
    pub fn view(&self, frame: u32) -> View {
        let turn = TAU * f64::from(frame) / f64::from(FRAMES);
        let mut view = self.start;
        let axis = (view.camera.target - view.camera.eye).normalize_or(DVec3::NEG_Z);
        let side = axis.cross(DVec3::Y).normalize_or(DVec3::X);
        let up = side.cross(axis);
        view.camera.eye += SWAY * self.radius * (turn.sin() * side + 0.5 * (2.0 * turn).sin() * up);
        let about = glam::DQuat::from_rotation_y(TURN * (turn + 1.0).sin());
        view.light_direction = about * view.light_direction;
        view
    }
}
