//! The host side of the WGSL module `rectified_frame`.

use core::f64::consts::{PI, TAU};

use bytemuck::{Pod, Zeroable};
use glam::{DMat4, DVec3, DVec4};

use super::{inverse, singular};
use crate::ValueError;

/// The rectified coordinates of a camera and a directional light: the uniform struct of the WGSL module `rectified_frame`.
/// Made by [`RectifiedView::new`].
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct RectifiedFrame {
    /// The change of a pixel's direction per unit of x in normalised device coordinates.
    pub along_x: [f32; 3],
    /// The largest radius of the frustum.
    pub largest_radius: f32,
    /// The change of a pixel's direction per unit of y in normalised device coordinates.
    pub along_y: [f32; 3],
    /// The azimuth of the first row of a map, in radians.
    pub first_azimuth: f32,
    /// The direction at the middle of the picture.
    pub along_middle: [f32; 3],
    /// The azimuth of the last row less that of the first, in (0, 2 pi].
    pub azimuth_extent: f32,
    /// The linear function of clip coordinates (x, y, stored depth, 1) that divides directions.
    pub scene_w: [f32; 4],
    /// The smallest such divisor, at the far end.
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
    /// The uniform struct that shaders are given.
    pub frame: RectifiedFrame,
}

/// The margin by which bounds grow, so that coordinates in f32 stay inside: relative for radii, in radians for angles.
const MARGIN: f64 = 2e-6;

/// A direction this close to a side plane (the sine of the angle) counts as inside: too many rows are harmless.
const INSIDE: f64 = 1e-6;

impl RectifiedView {
    /// The frame of a perspective camera and a light that travels along `light_direction` (of any length). `clip_from_world`
    /// is by columns in wgpu's clip space, reversed and infinite depth included; `far` is the finite distance along the
    /// camera's axis up to which light is scattered, and at which sky counts as being.
    ///
    /// # Errors
    /// [`ValueError`], which names what is wrong.
    pub fn new(
        clip_from_world: &[[f64; 4]; 4],
        far: f64,
        light_direction: [f64; 3],
    ) -> Result<Self, ValueError> {
        let world_from_clip = inverse(DMat4::from_cols_array_2d(clip_from_world), "camera")?;
        if !(far > 0.0 && far.is_finite()) {
            let message = format!(
                "the far distance is {far}, but must be above 0 and finite: how far along the camera's axis light is scattered"
            );
            return Err(ValueError::new("far", message));
        }
        let light = super::light_direction(light_direction)?;
        // All view rays meet where clip x, y and w are 0.
        let [x, y, z, middle] = world_from_clip.to_cols_array_2d().map(DVec4::from);
        if z.w.abs() <= 1e-12 * z.truncate().length() || z.w == 0.0 {
            let message = "the camera is orthographic; rectified coordinates need view rays that meet in the camera: use a \
                           perspective camera, or march the scattering";
            return Err(ValueError::new("camera", message));
        }
        let camera = z.truncate() / z.w;
        let axes = axes_of(light);
        // A position less the camera's, times its homogeneous coordinate, is linear in x and y and independent of depth.
        let direction = |column: DVec4| {
            let scene = column.truncate() - column.w * camera;
            DVec3::from(axes.map(|axis| axis.dot(scene)))
        };
        let along = [direction(x), direction(y), direction(middle)];
        let normal = normalized(along[0].cross(along[1])).ok_or_else(|| singular("camera"))?;
        let farthest_w = normal.dot(along[2]).abs() / far;
        let bounds = Bounds::new(along.map(|vector| vector / farthest_w));
        let single = |value: f64| value as f32;
        let frame = RectifiedFrame {
            along_x: along[0].as_vec3().to_array(),
            largest_radius: single(bounds.radius),
            along_y: along[1].as_vec3().to_array(),
            first_azimuth: single(bounds.azimuth[0]),
            along_middle: along[2].as_vec3().to_array(),
            azimuth_extent: single(bounds.azimuth[1] - bounds.azimuth[0]),
            scene_w: [x.w, y.w, z.w, middle.w].map(single),
            farthest_w: single(farthest_w),
            smallest_inclination: single(bounds.inclination[0]),
            largest_inclination: single(bounds.inclination[1]),
            padding: 0.0,
        };
        let numbers: [f32; 20] = bytemuck::cast(frame);
        let normal = frame.farthest_w.is_normal() && frame.largest_radius.is_normal();
        if !(normal && numbers.iter().all(|number| number.is_finite())) {
            let message =
                "the frustum's size is beyond single precision; choose another unit of length";
            return Err(ValueError::new("frustum", message));
        }
        Ok(Self {
            camera: camera.to_array(),
            axes: axes.map(|axis| axis.to_array()),
            frame,
        })
    }
}

/// The vector scaled to length 1; `None` if it is zero or not finite.
pub(super) fn normalized(vector: DVec3) -> Option<DVec3> {
    let largest = vector.abs().max_element();
    if !(largest > 0.0 && vector.is_finite()) {
        return None;
    }
    Some((vector / largest).normalize())
}

/// Right-handed axes, the last of which is `light`.
pub(super) fn axes_of(light: DVec3) -> [DVec3; 3] {
    // The axis of the scene that is least along the light.
    let smallest = light.abs().min_position();
    let other = DVec3::AXES[smallest];
    // Before it is normalised its length is at least sqrt(2 / 3).
    let first = (other - other.dot(light) * light).normalize();
    [first, light.cross(first), light]
}

/// The bounds of a frustum in rectified coordinates.
struct Bounds {
    radius: f64,
    azimuth: [f64; 2],
    inclination: [f64; 2],
}

impl Bounds {
    /// The bounds of the frustum whose far plane is spanned by the changes of position there along x and y, and their middle.
    fn new(along: [DVec3; 3]) -> Self {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[x, y]| x * along[0] + y * along[1] + along[2]);
        let edges = [0, 1, 2, 3].map(|index: usize| [corners[index], corners[(index + 1) % 4]]);
        let inside = [1.0, -1.0].map(|sign| {
            edges.iter().all(|&[from, to]| {
                let normal = from.cross(to);
                let inner = normal.dot(along[2]).signum();
                inner * sign * normal.z >= -INSIDE * normal.length()
            })
        });
        let radius = corners
            .map(|corner| corner.x.hypot(corner.y))
            .into_iter()
            .fold(0.0, f64::max);
        Self {
            radius: radius * (1.0 + MARGIN),
            azimuth: azimuths(&corners, along[2], inside),
            inclination: inclinations(&edges, inside),
        }
    }
}

fn azimuths(corners: &[DVec3; 4], middle: DVec3, inside: [bool; 2]) -> [f64; 2] {
    if inside[0] || inside[1] {
        return [0.0, TAU];
    }
    // Seen along the light the frustum is a wedge of less than half a turn that contains its middle.
    let about = middle.y.atan2(middle.x);
    let offsets = corners.map(|corner| {
        let offset = corner.y.atan2(corner.x) - about;
        offset - TAU * (offset / TAU).round()
    });
    let low = offsets.into_iter().fold(0.0, f64::min) - MARGIN;
    let high = offsets.into_iter().fold(0.0, f64::max) + MARGIN;
    [about + low, about + high]
}

fn inclinations(edges: &[[DVec3; 2]; 4], inside: [bool; 2]) -> [f64; 2] {
    let inclination = |point: DVec3| point.x.hypot(point.y).atan2(point.z);
    let mut low = if inside[0] { 0.0 } else { PI };
    let mut high = if inside[1] { PI } else { 0.0 };
    for &[from, to] in edges {
        let step = to - from;
        // Where the inclination is extremal on the line of the edge.
        let (along, square) = (from.dot(step), step.dot(step));
        let t = (from.z * along - step.z * from.dot(from)) / (step.z * along - from.z * square);
        let inner = (0.0..=1.0).contains(&t).then(|| from + t * step);
        for point in [Some(from), inner].into_iter().flatten() {
            low = inclination(point).min(low);
            high = inclination(point).max(high);
        }
    }
    [(low - MARGIN).max(0.0), (high + MARGIN).min(PI)]
}
