//! A light as the host sees it: matrices and depth conventions in f64, so that they can serve as truth.

mod shape;
mod stored_depth;

use glam::{DMat4, DVec2, DVec3, DVec4};

use crate::error::LabError;

pub(crate) use shape::wrong_size;
pub use shape::{LightShape, USUAL_LIGHT_ANGLE};
pub use stored_depth::StoredDepth;

/// The two kinds of light that the host renders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightKind {
    /// Parallel rays, orthographic projection.
    Directional,
    /// Rays from a point within a cone, perspective projection.
    Spot,
}

/// What a directional light is fitted to besides its casters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalFit {
    /// Size of the map in texels; the margin is counted in its texels.
    pub map: [u32; 2],
    /// Texels between the outermost caster and each border of the map. At least the radius of the filter that will be
    /// used, so that what the filter finds beyond the border is the far end.
    pub margin: f64,
    /// Whether the near plane is stored as 1.
    pub reversed: bool,
}

/// A light as the host sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightView {
    /// From world space to the light's space, a rigid motion: the light looks along -z.
    pub view_from_world: DMat4,
    /// From the light's space to wgpu's clip space (x right, y up, z in `[0, 1]`, possibly reversed).
    pub clip_from_view: DMat4,
    /// How the depth texture stores depth.
    pub depth: StoredDepth,
    /// Distances along the light's axis that map to moment depth -1 and +1.
    pub range: [f64; 2],
}

/// The depth range for casters between two distances along the light's axis, first and last.
///
/// Receivers behind the range, the ground mostly, count as lying at its far end, where texels without a caster are too.
/// So they need no part of it, and a range that is fitted tightly is worth much: what a moment bias leaks is a share of
/// it. But a receiver has to lie behind the last caster for that to shadow it: 1/16 is 0.12 in moment depth, three times
/// the distance behind a single occluder at which the bound of 16-bit moments reaches 0.98.
pub(crate) fn range_of_casters([first, last]: [f64; 2]) -> [f64; 2] {
    let depth = last - first;
    // Rounding to f32 on the device must not push the first vertices through the near plane.
    [first - 1e-3 * depth, last + depth / 16.0]
}

impl LightView {
    /// A directional light that shines along `direction`, fitted tightly to the points `casters` (vertices or corners of
    /// boxes): its map covers them and a margin, both axes apart, so that texels need not be square. Distances along
    /// the axis start at 0 at the first caster and end a little behind the last one (1/16 of their depth, for receivers).
    pub fn directional_fitted(
        direction: DVec3,
        casters: &[DVec3],
        fit: DirectionalFit,
    ) -> Result<Self, LabError> {
        Self::directional_over(direction, casters, casters, fit)
    }

    /// A directional light as [`directional_fitted`](Self::directional_fitted) makes it, whose map covers other points than the casters
    /// along whose depth its distances run.
    pub fn directional_over(
        direction: DVec3,
        casters: &[DVec3],
        across: &[DVec3],
        fit: DirectionalFit,
    ) -> Result<Self, LabError> {
        let rotation = rotation_towards(direction)?;
        if casters.is_empty() || across.is_empty() {
            return Err(LabError::refused(
                "a directional light cannot be fitted: there are no casters; give at least one point",
            ));
        }
        let extent = |points: &[DVec3]| {
            let mut ends = [DVec3::INFINITY, DVec3::NEG_INFINITY];
            for (index, &point) in points.iter().enumerate() {
                let inside = rotation.transform_vector3(point);
                if !inside.is_finite() {
                    return Err(LabError::refused(format!(
                        "a directional light cannot be fitted: point {index} is {point}, which is not finite"
                    )));
                }
                ends = [ends[0].min(inside), ends[1].max(inside)];
            }
            Ok(ends)
        };
        let [depths, sides] = [extent(casters)?, extent(across)?];
        let [low, high] = [0, 1].map(|end| sides[end].truncate().extend(depths[end].z));
        // A single point or an edge-on plane still needs a volume.
        let diameter = (high - low).length();
        let smallest = (1e-3 * diameter).max(1e-6 * (1.0 + high.abs().max_element()));
        let centre = 0.5 * (low + high);
        let half = (0.5 * (high - low)).max(DVec3::splat(0.5 * smallest));
        let map = DVec2::new(f64::from(fit.map[0]), f64::from(fit.map[1]));
        let inner = map - 2.0 * fit.margin;
        if !(fit.margin >= 0.0 && inner.min_element() >= 1.0) {
            return Err(LabError::refused(format!(
                "a map of {}x{} texels has no room for a margin of {} texels on each side; choose a larger map or a smaller \
                 margin",
                fit.map[0], fit.map[1], fit.margin
            )));
        }
        let half_map = DVec2::new(half.x, half.y) * map / inner;
        let [near, far] = range_of_casters([0.0, 2.0 * half.z]);
        let nearest = centre.z + half.z - near;
        let depth = StoredDepth::Orthographic {
            near: 0.0,
            far: far - near,
            reversed: fit.reversed,
        };
        let origin = DVec3::new(centre.x, centre.y, nearest);
        Ok(Self {
            view_from_world: DMat4::from_translation(-origin) * rotation,
            clip_from_view: depth.clip_from_view(half_map.recip()),
            depth,
            range: [0.0, far - near],
        })
    }

    /// A spot light at `position` that shines along `direction` into a square pyramid of `full_angle` radians, with
    /// its near plane at distance `near` and its far plane at `far` (`None`: infinite). `range` gives the distances
    /// along the axis of moment depths -1 and +1.
    pub fn spot(
        position: DVec3,
        direction: DVec3,
        full_angle: f64,
        near: f64,
        far: Option<f64>,
        range: [f64; 2],
        reversed: bool,
    ) -> Result<Self, LabError> {
        if !position.is_finite() {
            let reason = format!("the light's position {position} is not finite");
            return Err(LabError::refused(reason));
        }
        let rotation = rotation_towards(direction)?;
        if !(full_angle > 0.0 && full_angle < std::f64::consts::PI) {
            return Err(LabError::refused(format!(
                "the spot light's full angle of {full_angle} radians must lie between 0 and pi, both excluded"
            )));
        }
        let interval = |what: &str, [near, far]: [f64; 2], finite: bool| {
            if near > 0.0 && near < far && near.is_finite() && (far.is_finite() || !finite) {
                Ok(())
            } else {
                Err(LabError::refused(format!(
                    "the light's {what} reaches from {near} to {far}; it must be finite, start above zero and end beyond its \
                     start"
                )))
            }
        };
        interval(
            "depth planes",
            [near, far.unwrap_or(f64::INFINITY)],
            far.is_some(),
        )?;
        interval("moment range", range, true)?;
        let depth = StoredDepth::Perspective {
            near,
            far,
            reversed,
        };
        let scale = 1.0 / (0.5 * full_angle).tan();
        Ok(Self {
            view_from_world: rotation * DMat4::from_translation(-position),
            clip_from_view: depth.clip_from_view(DVec2::splat(scale)),
            depth,
            range,
        })
    }

    /// This light with moment depth that ends at `distance` along its axis, if that is beyond its end: soft shadows need
    /// to know how far behind their casters receivers lie, which hard ones do not.
    #[must_use]
    pub fn reaching(mut self, distance: f64) -> Self {
        let [first, last] = self.range;
        if !(distance > last && distance.is_finite()) {
            return self;
        }
        self.range = [first, distance];
        if let StoredDepth::Orthographic { far, .. } = &mut self.depth {
            *far = distance;
            let scale = DVec2::new(self.clip_from_view.x_axis.x, self.clip_from_view.y_axis.y);
            self.clip_from_view = self.depth.clip_from_view(scale);
        }
        self
    }

    /// This light with a range that is so many times as long, at least once: with parallel rays by as much in front as behind, with
    /// rays from a point behind.
    #[must_use]
    pub fn with_range_times(mut self, times: f64) -> Self {
        let [first, last] = self.range;
        let longer = (times.max(1.0) - 1.0) * (last - first);
        if self.kind() == LightKind::Directional {
            let back = 0.5 * longer;
            self.view_from_world =
                DMat4::from_translation(DVec3::new(0.0, 0.0, -back)) * self.view_from_world;
        }
        self.reaching(last + longer)
    }

    /// The same parallel light with its map of `map` texels so many of them beside its place: shadows stay where they are, and texels
    /// lie elsewhere.
    #[must_use]
    pub fn slid(mut self, texels: DVec2, map: [u32; 2]) -> Self {
        let by = texels * DVec2::from_array(self.texel_size(map));
        self.view_from_world = DMat4::from_translation(by.extend(0.0)) * self.view_from_world;
        self
    }

    /// The kind of this light.
    pub fn kind(&self) -> LightKind {
        match self.depth {
            StoredDepth::Orthographic { .. } => LightKind::Directional,
            StoredDepth::Perspective { .. } => LightKind::Spot,
        }
    }

    /// The matrix from world space to clip space.
    pub fn clip_from_world(&self) -> DMat4 {
        self.clip_from_view * self.view_from_world
    }

    /// Where `world` lies in the map: (0, 0) at its top left corner, (1, 1) at its bottom right one, outside of that
    /// interval beside the map. `None` behind a spot light.
    pub fn uv(&self, world: DVec3) -> Option<DVec2> {
        let clip = self.clip_from_world() * world.extend(1.0);
        (clip.w > 0.0).then(|| DVec2::new(0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w))
    }

    /// Distance of `world` from the light's origin along its axis.
    pub fn distance(&self, world: DVec3) -> f64 {
        -self.view_from_world.transform_point3(world).z
    }

    /// The moment depth of a distance along the axis: linear, not clamped.
    pub fn moment_depth_of_distance(&self, distance: f64) -> f64 {
        let [near, far] = self.range;
        2.0 * (distance - near) / (far - near) - 1.0
    }

    /// The moment depth of `world`: linear along the light's axis, -1 at `range[0]`, +1 at `range[1]`, not clamped.
    pub fn moment_depth(&self, world: DVec3) -> f64 {
        self.moment_depth_of_distance(self.distance(world))
    }

    /// The moment depth of what a depth texture stores, clamped to `[-1, 1]`. NaN counts as the far end: no caster.
    pub fn moment_depth_of_stored(&self, stored: f64) -> f64 {
        let distance = self.depth.distance(stored.clamp(0.0, 1.0));
        let depth = self.moment_depth_of_distance(distance);
        if depth.is_nan() {
            1.0
        } else {
            depth.clamp(-1.0, 1.0)
        }
    }

    /// The light's ray through `uv` of the map: `origin + t * direction` lies at distance `t` along the axis. For a
    /// directional light the origin lies in the plane of distance 0, which is its near plane, and the direction has
    /// length 1; for a spot light the origin is its position, and the direction is longer off the axis.
    pub fn ray(&self, uv: DVec2) -> (DVec3, DVec3) {
        let x = (2.0 * uv.x - 1.0) / self.clip_from_view.x_axis.x;
        let y = (1.0 - 2.0 * uv.y) / self.clip_from_view.y_axis.y;
        let world_from_view = self.view_from_world.inverse();
        let (origin, direction) = match self.kind() {
            LightKind::Directional => (DVec3::new(x, y, 0.0), DVec3::NEG_Z),
            LightKind::Spot => (DVec3::ZERO, DVec3::new(x, y, -1.0)),
        };
        (
            world_from_view.transform_point3(origin),
            world_from_view.transform_vector3(direction),
        )
    }

    /// Unit vector from `world` towards the light.
    pub fn towards_light(&self, world: DVec3) -> DVec3 {
        let world_from_view = self.view_from_world.inverse();
        match self.kind() {
            LightKind::Directional => world_from_view.transform_vector3(DVec3::Z).normalize(),
            LightKind::Spot => {
                (world_from_view.transform_point3(DVec3::ZERO) - world).normalize_or_zero()
            }
        }
    }

    /// Width and height of a texel of a map of `map` texels, in scene units: anywhere for a directional light, at
    /// distance 1 along the axis for a spot light.
    pub fn texel_size(&self, map: [u32; 2]) -> [f64; 2] {
        [
            2.0 / (self.clip_from_view.x_axis.x * f64::from(map[0])),
            2.0 / (self.clip_from_view.y_axis.y * f64::from(map[1])),
        ]
    }
}

/// The rotation after which `direction` is -z and x is horizontal.
pub(crate) fn rotation_towards(direction: DVec3) -> Result<DMat4, LabError> {
    let forward = direction.try_normalize().ok_or_else(|| {
        LabError::refused(format!(
            "the light's direction {direction} cannot be normalised; give a finite, non-zero direction"
        ))
    })?;
    // Straight up or down any horizontal x will do.
    let right = forward
        .cross(DVec3::Y)
        .try_normalize()
        .filter(|_| forward.y.abs() < 1.0 - 1e-9)
        .unwrap_or(DVec3::X);
    let up = right.cross(forward).normalize();
    let right = forward.cross(up);
    Ok(DMat4::from_cols(
        right.extend(0.0),
        up.extend(0.0),
        (-forward).extend(0.0),
        DVec4::W,
    )
    .transpose())
}
