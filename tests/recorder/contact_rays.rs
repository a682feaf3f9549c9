//! Rays of shadows at contacts on the screen, against geometry in space: each goes straight towards the light, as far as the screen, the
//! distance from the camera and the length allow.

use bytemuck::{Pod, Zeroable};
use glam::dcamera::rh::proj::directx::{orthographic, perspective_infinite_reverse};
use glam::dcamera::rh::view::look_at_mat4;
use glam::{DMat4, DVec3};
use moment_shadows::{CameraView, ContactShadowParameters, ContactShadows, DepthRange, LightView};
use moment_shadows_lab::batch::Batch;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use crate::setup::gpu;

const SHADER: &str = "
import moment_shadows::shade::contact_shadow::{ContactShadowParameters, contact_shadow_place, contact_shadow_ray};

struct BatchInput {
    parameters: ContactShadowParameters,
    clip: vec4f,
}

struct BatchOutput {
    start: vec3f,
    reach: f32,
    end: vec3f,
    end_w: f32,
}

fn batch(input: BatchInput) -> BatchOutput {
    let ray = contact_shadow_ray(input.parameters, input.clip, vec2f(96.0, 64.0), 16.0);
    return BatchOutput(contact_shadow_place(ray, 0.0), ray.reach, contact_shadow_place(ray, 1.0), ray.end_w);
}
";

/// The screen of [`SHADER`].
const SIZE: [f64; 2] = [96.0, 64.0];

/// The part of its first distance to which a ray may come near the camera.
const NEAREST: f64 = 1.0 / 16.0;

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Input {
    parameters: ContactShadowParameters,
    clip: [f32; 4],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Output {
    start: [f32; 3],
    reach: f32,
    end: [f32; 3],
    end_w: f32,
}

/// A ray in space.
struct Ray {
    clip_from_world: DMat4,
    start: DVec3,
    towards: DVec3,
    /// How far it goes at most: to the light, or the length of such shadows.
    full: f64,
    length: f64,
}

/// What ends a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
enum End {
    Length,
    Camera,
    /// The screen's left, right, bottom and top.
    Edge(usize),
}

impl Ray {
    fn at(&self, distance: f64) -> DVec3 {
        self.start + distance * self.towards
    }

    /// The homogeneous coordinate at a position, as a part of that at the start.
    fn part_of_w(&self, position: DVec3) -> f64 {
        let w = |at: DVec3| (self.clip_from_world * at.extend(1.0)).w;
        w(position) / w(self.start)
    }

    /// Why the ray does not go so far, if it does not.
    fn ended(&self, distance: f64) -> Option<End> {
        let clip = self.clip_from_world * self.at(distance).extend(1.0);
        let inside = [
            clip.w + clip.x,
            clip.w - clip.x,
            clip.w + clip.y,
            clip.w - clip.y,
        ];
        if distance > self.full {
            return Some(End::Length);
        }
        if self.part_of_w(self.at(distance)) < NEAREST {
            return Some(End::Camera);
        }
        inside.iter().position(|&edge| edge < 0.0).map(End::Edge)
    }
}

/// The position that a place on the screen and its stored depth stand for.
fn position(clip_from_world: DMat4, [x, y, depth]: [f32; 3]) -> DVec3 {
    let [u, v] = [f64::from(x) / SIZE[0], f64::from(y) / SIZE[1]];
    let device = DVec3::new(2.0 * u - 1.0, 1.0 - 2.0 * v, depth.into());
    clip_from_world.inverse().project_point3(device)
}

/// A surface anywhere on the screen, and a sun or a lamp: around the scene, or as near to the camera as its lens is.
fn random(random: &mut ChaCha8Rng, index: usize) -> (Ray, Input) {
    let eye = DVec3::new(0.1, 0.5, 1.0);
    let view = look_at_mat4(eye, DVec3::new(0.0, 0.05, 0.0), DVec3::Y);
    let (lens, depths, far_depth) = match index % 3 {
        0 => (orthographic(-0.9, 0.9, -0.6, 0.6, 0.0, 4.0), 0.1..0.9, 1.0),
        _ => (perspective_infinite_reverse(0.8, 1.5, 0.05), 0.02..0.1, 0.0),
    };
    let clip_from_world = lens * view;
    let mut within = |half: f64| random.random_range(-half..half);
    let [x, y, part] = [within(0.95), within(0.95), 0.5 + within(0.5)];
    let depth = depths.start + part * (depths.end - depths.start);
    let clip = [x as f32, y as f32, depth as f32, 1.0];
    let device = DVec3::new(clip[0].into(), clip[1].into(), clip[2].into());
    let start = clip_from_world.inverse().project_point3(device);
    let half = if index.is_multiple_of(2) { 2.0 } else { 0.05 };
    let away = DVec3::new(within(half), within(half), within(half));
    let length = [0.1, 1.0, 10.0][index / 6 % 3];
    let (towards, distance, light) = if (index / 18).is_multiple_of(2) {
        let towards = away.normalize();
        let from_world = look_at_mat4(10.0 * towards, DVec3::ZERO, DVec3::new(0.1, 0.2, 1.0));
        let clip = orthographic(-2.0, 2.0, -2.0, 2.0, 0.0, 20.0) * from_world;
        let light = LightView::orthographic(clip.to_cols_array_2d());
        (towards, f64::INFINITY, light)
    } else {
        let lamp = eye + away;
        let range = DepthRange {
            near: 0.1,
            far: 9.0,
        };
        let from_world = look_at_mat4(lamp, DVec3::new(0.03, -0.4, -0.2), DVec3::X);
        let clip = perspective_infinite_reverse(1.0, 1.0, 0.01) * from_world;
        let light = LightView::perspective(clip.to_cols_array_2d(), 0.01, f64::INFINITY, range);
        let way = lamp - start;
        (way.normalize(), way.length(), light)
    };
    let camera = CameraView {
        clip_from_world: clip_from_world.to_cols_array_2d(),
        far_depth,
    };
    let contact = ContactShadows {
        length,
        thickness: 0.1,
    };
    let parameters = ContactShadowParameters::new(&camera, &light, contact).unwrap();
    let ray = Ray {
        clip_from_world,
        start,
        towards,
        full: distance.min(length),
        length,
    };
    (ray, Input { parameters, clip })
}

#[test]
fn a_ray_goes_straight_towards_the_light_until_something_ends_it() {
    let gpu = gpu();
    let mut source = ChaCha8Rng::seed_from_u64(73);
    let cases: Vec<(Ray, Input)> = (0..3600).map(|index| random(&mut source, index)).collect();
    let inputs: Vec<Input> = cases.iter().map(|case| case.1).collect();
    let shader = Batch::new(&gpu, "contact_rays.wgsl", SHADER).unwrap();
    let outputs: Vec<Output> = shader.run(&inputs).unwrap();
    let mut ends = Vec::new();
    for ((ray, _), found) in cases.iter().zip(outputs) {
        let start = position(ray.clip_from_world, found.start);
        assert!(start.distance(ray.start) < 1e-4, "{found:?}");
        // In single precision, of which a light next to the camera leaves some digits less.
        let end = position(ray.clip_from_world, found.end);
        let along = (end - ray.start).dot(ray.towards);
        let aside = end.distance(ray.at(along));
        assert!(aside < 1e-3 * along + 1e-4, "{aside} of {along}: {found:?}");
        let reach = f64::from(found.reach) * ray.length;
        assert!(
            (reach - along).abs() < 1e-3 * along + 1e-4,
            "{reach} {along}"
        );
        let w = ray.part_of_w(end);
        assert!(
            (f64::from(found.end_w) / w - 1.0).abs() < 1e-2,
            "{found:?} {w}"
        );
        // Nothing ends it before, and something does just behind.
        let (before, behind) = (0.998 * along - 2e-4, 1.002 * along + 2e-4);
        assert_eq!(ray.ended(before.max(0.0)), None, "{along}: {found:?}");
        let end = ray.ended(behind);
        assert!(end.is_some(), "{along}: {found:?}");
        ends.extend(end);
    }
    let edges = (0..4).map(End::Edge);
    for end in edges.chain([End::Length, End::Camera]) {
        let count = ends.iter().filter(|other| **other == end).count();
        println!("{count} rays end for {end:?}");
        assert!(count > 20, "{end:?}: {count}");
    }
}
