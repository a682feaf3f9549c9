//! The host side of the WGSL module `rectified_frame`.

use core::f64::consts::{PI, TAU};

use bytemuck::{Pod, Zeroable};

use crate::matrix::{Vector, combine, cross, dot, invert, length, normalized, wide};

/// The rectified coordinates of a camera and a directional light: the uniform struct of the WGSL module `rectified_frame`.
/// Made by [`RectifiedView::new`].
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct RectifiedFrame {
    /// What the direction of a pixel changes by per unit of x in normalised device coordinates.
    pub along_x: [f32; 3],
    /// The largest radius of the frustum.
    pub largest_radius: f32,
    /// The same per unit of y.
    pub along_y: [f32; 3],
    /// The azimuth of the first row of a map, in radians.
    pub first_azimuth: f32,
    /// The direction at the middle of the picture.
    pub along_middle: [f32; 3],
    /// The azimuth of the last row less that of the first, in (0, 2 pi].
    pub azimuth_extent: f32,
    /// The linear function of clip coordinates (x, y, stored depth, 1) that divides directions.
    pub scene_w: [f32; 4],
    /// The smallest such divisor: that of the far end.
    pub farthest_w: f32,
    /// The inclination of depth 1 in radians, at least 0.
    pub smallest_inclination: f32,
    /// The inclination of depth -1 in radians, at most pi.
    pub largest_inclination: f32,
    /// Unused; keeps the WGSL layout.
    pub padding: f32,
}

/// A camera and a directional light, from which a frame and what lights it up are derived in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RectifiedView {
    /// The camera's position in the scene.
    pub camera: [f64; 3],
    /// The frame's axes in the scene, orthonormal and right-handed; the last is the direction in which light travels.
    pub axes: [[f64; 3]; 3],
    /// What shaders are given.
    pub frame: RectifiedFrame,
}

/// A camera or a light that has no rectified coordinates.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RectifiedFrameError {
    /// The camera's matrix cannot be inverted.
    #[error(
        "the camera's clip_from_world is singular or not finite; it has to be an invertible projection of the scene"
    )]
    SingularCamera,
    /// The camera's view rays are parallel.
    #[error(
        "the camera is orthographic; rectified coordinates need view rays that meet in the camera: use a perspective camera, \
         or march the scattering"
    )]
    OrthographicCamera,
    /// The frustum has no length.
    #[error(
        "the far distance is {far}, but must be above 0 and finite: how far along the camera's axis light is scattered"
    )]
    FarDistance {
        /// What was given.
        far: f64,
    },
    /// The light has no direction.
    #[error(
        "the light's direction is ({}, {}, {}), but must be finite and not zero: where light travels to",
        direction[0], direction[1], direction[2]
    )]
    LightDirection {
        /// What was given.
        direction: [f64; 3],
    },
    /// A number of the frame does not fit into single precision.
    #[error("the frustum's size is beyond single precision; choose another unit of length")]
    Size,
}

/// By how much bounds grow, so that coordinates in f32 stay inside: relative for radii, in radians for angles.
const MARGIN: f64 = 2e-6;

/// A direction this close to a side plane (the sine of the angle) counts as inside: too many rows are harmless.
const INSIDE: f64 = 1e-6;

impl RectifiedView {
    /// The frame of a perspective camera and a light that travels along `light_direction` (of any length). `clip_from_world`
    /// is by columns in wgpu's clip space, reversed and infinite depth included; `far` is the finite distance along the
    /// camera's axis up to which light is scattered, which sky is then at.
    ///
    /// # Errors
    /// [`RectifiedFrameError`], which names what is wrong.
    pub fn new(
        clip_from_world: &[[f32; 4]; 4],
        far: f64,
        light_direction: [f64; 3],
    ) -> Result<Self, RectifiedFrameError> {
        let world_from_clip =
            invert(&wide(clip_from_world)).ok_or(RectifiedFrameError::SingularCamera)?;
        if !(far > 0.0 && far.is_finite()) {
            return Err(RectifiedFrameError::FarDistance { far });
        }
        let light = normalized(light_direction).ok_or(RectifiedFrameError::LightDirection {
            direction: light_direction,
        })?;
        // All view rays meet where clip x, y and w are 0.
        let [x, y, z, middle] = world_from_clip;
        let scale = length([z[0], z[1], z[2]]);
        if z[3].abs() <= 1e-12 * scale || z[3] == 0.0 {
            return Err(RectifiedFrameError::OrthographicCamera);
        }
        let camera = [0, 1, 2].map(|axis: usize| z[axis] / z[3]);
        let axes = axes_of(light);
        // A position less the camera's, times its homogeneous coordinate, is linear in x and y and independent of depth.
        let direction = |column: [f64; 4]| -> Vector {
            let scene = [0, 1, 2].map(|axis: usize| column[axis] - column[3] * camera[axis]);
            axes.map(|axis| dot(axis, scene))
        };
        let along = [direction(x), direction(y), direction(middle)];
        let normal =
            normalized(cross(along[0], along[1])).ok_or(RectifiedFrameError::SingularCamera)?;
        let farthest_w = dot(normal, along[2]).abs() / far;
        let bounds = Bounds::new(along.map(|vector| vector.map(|value| value / farthest_w)));
        let single = |value: f64| value as f32;
        let frame = RectifiedFrame {
            along_x: along[0].map(single),
            largest_radius: single(bounds.radius),
            along_y: along[1].map(single),
            first_azimuth: single(bounds.azimuth[0]),
            along_middle: along[2].map(single),
            azimuth_extent: single(bounds.azimuth[1] - bounds.azimuth[0]),
            scene_w: [x[3], y[3], z[3], middle[3]].map(single),
            farthest_w: single(farthest_w),
            smallest_inclination: single(bounds.inclination[0]),
            largest_inclination: single(bounds.inclination[1]),
            padding: 0.0,
        };
        let numbers: [f32; 20] = bytemuck::cast(frame);
        let normal = frame.farthest_w.is_normal() && frame.largest_radius.is_normal();
        if !(normal && numbers.iter().all(|number| number.is_finite())) {
            return Err(RectifiedFrameError::Size);
        }
        Ok(Self {
            camera,
            axes,
            frame,
        })
    }
}

/// Right-handed axes, the last of which is `light`.
fn axes_of(light: Vector) -> [Vector; 3] {
    // Of the scene's axes the one that is least along the light.
    let smallest = [0, 1, 2]
        .into_iter()
        .min_by(|&a: &usize, &b: &usize| light[a].abs().total_cmp(&light[b].abs()))
        .unwrap_or(0);
    let mut other = [0.0; 3];
    other[smallest] = 1.0;
    let along = dot(other, light);
    let first = [0, 1, 2].map(|axis: usize| other[axis] - along * light[axis]);
    // Its length is at least sqrt(2 / 3).
    let first = first.map(|value| value / length(first));
    [first, cross(light, first), light]
}

/// The bounds of a frustum in rectified coordinates.
struct Bounds {
    radius: f64,
    azimuth: [f64; 2],
    inclination: [f64; 2],
}

impl Bounds {
    /// Of the frustum whose far plane is spanned by what positions there change by along x and y, and their middle.
    fn new(along: [Vector; 3]) -> Self {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[x, y]| combine([x, y, 1.0], along));
        let edges = [0, 1, 2, 3].map(|index: usize| [corners[index], corners[(index + 1) % 4]]);
        let inside = [1.0, -1.0].map(|sign| {
            edges.iter().all(|&[from, to]| {
                let normal = cross(from, to);
                let inner = dot(normal, along[2]).signum();
                inner * sign * normal[2] >= -INSIDE * length(normal)
            })
        });
        let radius = corners
            .map(|[x, y, _]| x.hypot(y))
            .into_iter()
            .fold(0.0, f64::max);
        Self {
            radius: radius * (1.0 + MARGIN),
            azimuth: azimuths(&corners, along[2], inside),
            inclination: inclinations(&edges, inside),
        }
    }
}

fn azimuths(corners: &[Vector; 4], middle: Vector, inside: [bool; 2]) -> [f64; 2] {
    if inside[0] || inside[1] {
        return [0.0, TAU];
    }
    // Seen along the light the frustum is a wedge of less than half a turn that contains its middle.
    let about = middle[1].atan2(middle[0]);
    let offsets = corners.map(|[x, y, _]| {
        let offset = y.atan2(x) - about;
        offset - TAU * (offset / TAU).round()
    });
    let low = offsets.into_iter().fold(0.0, f64::min) - MARGIN;
    let high = offsets.into_iter().fold(0.0, f64::max) + MARGIN;
    [about + low, about + high]
}

fn inclinations(edges: &[[Vector; 2]; 4], inside: [bool; 2]) -> [f64; 2] {
    let inclination = |[x, y, z]: Vector| x.hypot(y).atan2(z);
    let mut low = PI;
    let mut high = 0.0;
    for &[from, to] in edges {
        let step = [0, 1, 2].map(|axis: usize| to[axis] - from[axis]);
        // Where the inclination is extremal on the line of the edge.
        let (along, square) = (dot(from, step), dot(step, step));
        let t =
            (from[2] * along - step[2] * dot(from, from)) / (step[2] * along - from[2] * square);
        let inner = (0.0..=1.0)
            .contains(&t)
            .then(|| combine([1.0, t, 0.0], [from, step, step]));
        for point in [Some(from), inner].into_iter().flatten() {
            low = inclination(point).min(low);
            high = inclination(point).max(high);
        }
    }
    [
        if inside[0] {
            0.0
        } else {
            (low - MARGIN).max(0.0)
        },
        if inside[1] {
            PI
        } else {
            (high + MARGIN).min(PI)
        },
    ]
}
