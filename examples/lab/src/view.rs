//! Numbered viewpoints: where the camera stands and from where the sun shines, the same on every machine.

use std::f64::consts::TAU;

use glam::{DMat4, DVec2, DVec3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::error::LabError;
use crate::light::{DirectionalFit, LightView, StoredDepth, range_of_casters, rotation_towards};
use crate::scene::{Scene, Stand};

/// A perspective camera with reversed depth (1 at the near plane).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Position in world space.
    pub eye: DVec3,
    /// A point in the middle of the picture, different from `eye`.
    pub target: DVec3,
    /// Vertical angle of view, in radians.
    pub vertical_angle: f64,
    /// Width divided by height.
    pub aspect: f64,
    /// Distance of the near plane, above zero.
    pub near: f64,
    /// Distance of the far plane; `None` for an infinite one.
    pub far: Option<f64>,
}

impl Camera {
    /// From world space to the camera's space, which looks along -z.
    pub fn view_from_world(&self) -> Result<DMat4, LabError> {
        Ok(rotation_towards(self.target - self.eye)? * DMat4::from_translation(-self.eye))
    }

    /// From world space to wgpu's clip space, in f64.
    pub fn clip_from_world(&self) -> Result<DMat4, LabError> {
        let depth = StoredDepth::Perspective {
            near: self.near,
            far: self.far,
            reversed: true,
        };
        let scale = 1.0 / (0.5 * self.vertical_angle).tan();
        let clip_from_view = depth.clip_from_view(DVec2::new(scale / self.aspect, scale));
        Ok(clip_from_view * self.view_from_world()?)
    }

    /// How far along its axis a point lies.
    pub fn distance(&self, point: DVec3) -> f64 {
        (point - self.eye).dot((self.target - self.eye).normalize_or_zero())
    }

    /// The corners of what it sees between two distances along its axis.
    pub fn corners(&self, part: [f64; 2]) -> Result<Vec<DVec3>, LabError> {
        let world_from_view = self.view_from_world()?.inverse();
        let up = (0.5 * self.vertical_angle).tan();
        let sides = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]];
        let corners = part.into_iter().flat_map(|distance| {
            sides.map(|[x, y]| distance * DVec3::new(x * up * self.aspect, y * up, -1.0))
        });
        Ok(corners
            .map(|corner| world_from_view.transform_point3(corner))
            .collect())
    }

    /// [`clip_from_world`](Self::clip_from_world) by columns.
    pub fn clip_from_world_columns(&self) -> Result<[[f64; 4]; 4], LabError> {
        Ok(self.clip_from_world()?.to_cols_array_2d())
    }
}

/// A viewpoint with the direction of its light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The camera.
    pub camera: Camera,
    /// Unit vector along which the light shines.
    pub light_direction: DVec3,
}

/// The vertical angle of view of all viewpoints.
const VERTICAL_ANGLE: f64 = 0.7;
/// The shape of the pictures.
const ASPECT: f64 = 16.0 / 9.0;

impl View {
    /// Viewpoint `number` of `scene`. Number 0 is a three-quarter view under a low sun from behind, so that shadows
    /// fall towards the viewer; in a scene with a stand it is that stand. The others vary both by a generator seeded
    /// with the number.
    pub fn numbered(scene: &Scene, number: u32) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(u64::from(number));
        match scene.stand {
            Some(stand) => Self::from_stand(scene, stand, number, &mut rng),
            None => Self::from_outside(scene, number, &mut rng),
        }
    }

    fn from_outside(scene: &Scene, number: u32, rng: &mut ChaCha8Rng) -> Self {
        let bounds = scene.bounds();
        let size = bounds.size();
        // Angles about y from +z towards +x. A wide thing is looked at, and lit, across its width.
        let front = if size.x >= size.z { 0.0 } else { 0.25 * TAU };
        let [azimuth, elevation, margin, sun_azimuth, sun_elevation] = if number == 0 {
            [front + 0.4, 0.34, 1.08, front + 2.4, 0.48]
        } else {
            [
                rng.random_range(0.0..TAU),
                rng.random_range(0.2..0.75),
                rng.random_range(0.9..1.3),
                rng.random_range(0.0..TAU),
                rng.random_range(0.35..1.1),
            ]
        };
        let light_direction = -spherical(sun_azimuth, sun_elevation);
        // The picture holds the scene and most of its shadow; tall things have shadows too long to show whole.
        let slope = DVec3::new(light_direction.x, 0.0, light_direction.z) / -light_direction.y;
        let points = scene.extremes().into_iter().flat_map(|at| {
            let height = at.y - bounds.min.y;
            [at, at - height * DVec3::Y + 0.8 * height * slope]
        });
        let outwards = spherical(azimuth, elevation);
        let eye = enclosing_eye(-outwards, margin, points);
        let distance = (eye - bounds.centre()).length().max(1e-6);
        Self::new(eye, eye - distance * outwards, light_direction)
    }

    fn from_stand(scene: &Scene, stand: Stand, number: u32, rng: &mut ChaCha8Rng) -> Self {
        if number == 0 {
            return Self::new(stand.eye, stand.target, stand.light_direction.normalize());
        }
        // Small steps aside stay within the scene; the view may go along it or back.
        let step = 0.04 * scene.bounds().radius();
        let mut jitter =
            || DVec3::from_array(std::array::from_fn(|_| rng.random_range(-step..step)));
        let eye = stand.eye + jitter() * DVec3::new(1.0, 0.8, 4.0);
        let target = stand.target + jitter();
        let light_direction = -spherical(rng.random_range(0.0..TAU), rng.random_range(0.45..1.2));
        Self::new(eye, target, light_direction)
    }

    fn new(eye: DVec3, target: DVec3, light_direction: DVec3) -> Self {
        Self {
            camera: Camera {
                eye,
                target,
                vertical_angle: VERTICAL_ANGLE,
                aspect: ASPECT,
                near: 0.01 * (target - eye).length(),
                far: None,
            },
            light_direction,
        }
    }

    /// This view from `eye` towards `target`, in the coordinates of the scene's file.
    pub fn seen_from(self, scene: &Scene, [eye, target]: [DVec3; 2]) -> Result<Self, LabError> {
        let [eye, target] = [eye - scene.origin, target - scene.origin];
        rotation_towards(target - eye)?;
        let mut view = Self::new(eye, target, self.light_direction);
        // What is far away may be looked at past what is near.
        let distance = (target - eye).length();
        view.camera.near = view
            .camera
            .near
            .min(1e-3 * scene.bounds().radius().max(1e-6 * distance));
        Ok(view)
    }

    /// The sun of this viewpoint, fitted to the scene's casters for a map of `map` texels with `margin` texels left
    /// free at each border.
    pub fn sun(
        &self,
        scene: &Scene,
        map: [u32; 2],
        margin: f64,
        reversed: bool,
    ) -> Result<LightView, LabError> {
        let casters = scene.extremes();
        LightView::directional_fitted(
            self.light_direction,
            &casters,
            DirectionalFit {
                map,
                margin,
                reversed,
            },
        )
    }

    /// A spot light from the same side, far enough that its cone of 40 degrees holds the casters. `near` is its near
    /// plane as a part of its distance; moment depth runs over the casters, as with [`sun`](Self::sun).
    pub fn spot(
        &self,
        scene: &Scene,
        near: f64,
        far: Option<f64>,
        reversed: bool,
    ) -> Result<LightView, LabError> {
        const ANGLE: f64 = 0.7;
        let bounds = scene.bounds();
        let radius = bounds.radius().max(1e-6);
        let distance = radius / (0.5 * ANGLE).sin();
        let position = bounds.centre() - distance * self.light_direction;
        let along = |caster: DVec3| (caster - position).dot(self.light_direction);
        let [first, last] = scene
            .extremes()
            .into_iter()
            .map(along)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[first, last], at| {
                [first.min(at), last.max(at)]
            });
        LightView::spot(
            position,
            self.light_direction,
            ANGLE,
            near * distance,
            far.map(|far| far * distance),
            range_of_casters([first, last.max(first + 1e-6 * distance)]),
            reversed,
        )
    }
}

/// The nearest eye that sees all `points` when it looks along the unit vector `forward`, with a `margin` that scales
/// the tangents of the view's edges.
fn enclosing_eye(forward: DVec3, margin: f64, points: impl Iterator<Item = DVec3>) -> DVec3 {
    let right = forward.cross(DVec3::Y).normalize_or(DVec3::X);
    let up = right.cross(forward);
    let tangent = (0.5 * VERTICAL_ANGLE).tan() / margin;
    // |x - eye_x| <= (z - eye_z) tangent bounds eye_x ± eye_z tangent from either side; likewise for y.
    let mut low = DVec2::NEG_INFINITY;
    let mut high = DVec2::INFINITY;
    let tangents = DVec2::new(tangent * ASPECT, tangent);
    for point in points {
        let across = DVec2::new(point.dot(right), point.dot(up));
        let reach = point.dot(forward) * tangents;
        low = low.max(across - reach);
        high = high.min(across + reach);
    }
    let middle = 0.5 * (low + high);
    let back = (0.5 * (high - low) / tangents).min_element();
    middle.x * right + middle.y * up + back * forward
}

/// The unit vector at an azimuth about y, from +z towards +x, and an elevation.
fn spherical(azimuth: f64, elevation: f64) -> DVec3 {
    let (sin, cos) = azimuth.sin_cos();
    let (up, out) = elevation.sin_cos();
    DVec3::new(sin * out, up, cos * out)
}
