//! `contact_shadows`: a wall on a floor, of which all is known, through cameras and lights of every kind.

use glam::dcamera::rh::proj::directx::{orthographic, perspective, perspective_infinite_reverse};
use glam::dcamera::rh::view::look_at_mat4;
use glam::{DMat4, DVec2, DVec3};
use moment_shadows::{
    CameraView, ContactShadowParameters, ContactShadows, DepthRange, LightView, TextureFormat,
};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_lab::gpu::Gpu;

use crate::depth_map;
use crate::setup::{bind, capabilities, compiled, gpu};

const SIZE: [u32; 2] = [96, 64];

const GRAPH: &str = r#"{ "version": 2, "imports": [{ "name": "camera_depth" }],
  "nodes": [{ "name": "contact", "type": "contact_shadows", "properties": { "format": "r32float" } }],
  "edges": [{ "from": "camera_depth", "to": "contact.camera_depth" }],
  "outputs": [{ "name": "shadow_intensity", "from": "contact.shadow_intensity" }] }"#;

/// Half a wall's length, its height, and where it begins and ends along z.
const WALL: [f64; 4] = [0.5, 0.3, 0.0, 0.02];

const REACH: ContactShadows = ContactShadows {
    length: 0.2,
    thickness: 0.1,
};

/// How a camera projects.
#[derive(Clone, Copy, Debug)]
enum Lens {
    Reversed,
    Plain,
    Parallel,
    ParallelReversed,
}

const LENSES: [Lens; 4] = [
    Lens::Reversed,
    Lens::Plain,
    Lens::Parallel,
    Lens::ParallelReversed,
];

/// Where a camera stands and what it looks at.
type Pose = [DVec3; 2];

/// In front of the wall, to which its shadow falls.
const POSE: Pose = [DVec3::new(0.1, 0.5, 1.0), DVec3::new(0.0, 0.05, 0.0)];

fn camera(lens: Lens, [eye, target]: Pose) -> CameraView {
    let view = look_at_mat4(eye, target, DVec3::Y);
    let distance = eye.distance(target);
    let half = 0.4 * distance;
    let parallel = || orthographic(-1.5 * half, 1.5 * half, -half, half, 0.0, 4.0 * distance);
    let turned = DMat4::from_translation(DVec3::Z) * DMat4::from_scale(DVec3::new(1.0, 1.0, -1.0));
    let (clip, far_depth) = match lens {
        Lens::Reversed => (perspective_infinite_reverse(0.8, 1.5, 0.05 * distance), 0.0),
        Lens::Plain => (perspective(0.8, 1.5, 0.05 * distance, 20.0 * distance), 1.0),
        Lens::Parallel => (parallel(), 1.0),
        Lens::ParallelReversed => (turned * parallel(), 0.0),
    };
    CameraView {
        clip_from_world: (clip * view).to_cols_array_2d(),
        far_depth,
    }
}

/// What a camera sees of a wall at a place, or of the floor alone: a position, if any, for a place in clip space.
fn seen(camera: &CameraView, [x, y]: [f64; 2], wall: Option<DVec3>, floor: bool) -> Option<DVec3> {
    let scene = DMat4::from_cols_array_2d(&camera.clip_from_world).inverse();
    let at = |depth: f64| scene.project_point3(DVec3::new(x, y, depth));
    // Two places on the ray, the nearer one first.
    let [from, to] = match camera.far_depth {
        0.0 => [at(1.0), at(0.4)],
        _ => [at(0.0), at(0.4)],
    };
    let way = to - from;
    let mut nearest = f64::INFINITY;
    // Parallel rays may begin below it.
    if floor && way.y < 0.0 && from.y > 0.0 {
        nearest = -from.y / way.y;
    }
    if let Some(foot) = wall {
        let [half, height, back, front] = WALL;
        let (low, high) = (
            DVec3::new(-half, 0.0, back),
            DVec3::new(half, height, front),
        );
        let [one, other] = [low, high].map(|corner| (foot + corner - from) / way);
        let (enters, leaves) = (one.min(other).max_element(), one.max(other).min_element());
        if enters < leaves && enters > 0.0 {
            nearest = nearest.min(enters);
        }
    }
    nearest.is_finite().then(|| from + nearest * way)
}

/// Every pixel's surface, where its first sample lies, and its stored depth.
fn surfaces(camera: &CameraView, place: [f64; 2], wall: Option<DVec3>) -> Vec<Option<DVec3>> {
    let [width, height] = SIZE.map(f64::from);
    let pixels = (0..SIZE[1])
        .flat_map(|y| (0..SIZE[0]).map(move |x| DVec2::new(f64::from(x), f64::from(y))));
    pixels
        .map(|pixel| {
            let [u, v] = [(pixel.x + place[0]) / width, (pixel.y + place[1]) / height];
            seen(camera, [2.0 * u - 1.0, 1.0 - 2.0 * v], wall, true)
        })
        .collect()
}

fn stored(camera: &CameraView, surface: &Option<DVec3>) -> f32 {
    let clip = DMat4::from_cols_array_2d(&camera.clip_from_world);
    surface.map_or(camera.far_depth, |at| clip.project_point3(at).z as f32)
}

/// A sun at an elevation in degrees, in front of the camera or anywhere around the wall.
fn sun(elevation: f64, azimuth: f64) -> (DVec3, LightView) {
    let (sin, cos) = elevation.to_radians().sin_cos();
    let (aside, back) = azimuth.to_radians().sin_cos();
    let towards = DVec3::new(cos * aside, sin, -cos * back);
    let view = look_at_mat4(10.0 * towards, DVec3::ZERO, DVec3::new(0.1, 0.2, 1.0));
    let clip = orthographic(-2.0, 2.0, -2.0, 2.0, 0.0, 20.0) * view;
    (towards, LightView::orthographic(clip.to_cols_array_2d()))
}

/// The shadow of pixels with these stored depths.
fn march(
    gpu: &Gpu,
    depths: &[f32],
    parameters: &ContactShadowParameters,
    (format, samples): (TextureFormat, u32),
) -> Vec<f32> {
    let desc = TextureDesc {
        samples,
        ..TextureDesc::new(format, SIZE)
    };
    let texture = depth_map::texture(gpu, desc.wgpu_format(), SIZE, 1, samples);
    // Of several samples all but the first are nearer, or farther.
    let other = |depth: &f32| if *depth > 0.5 { 0.1 } else { 0.9 };
    let all: Vec<f32> = depths
        .iter()
        .flat_map(|depth| {
            (0..samples).map(move |sample| if sample == 0 { *depth } else { other(depth) })
        })
        .collect();
    depth_map::draw(gpu, &texture, 0, &all);
    let plan = compiled(GRAPH, &capabilities(gpu), &[("camera_depth", desc)]);
    let mut block = plan.parameters.initial();
    let layout = &plan.parameters;
    layout.write(&mut block, "contact", 0, parameters).unwrap();
    let bound = bind(
        gpu,
        plan,
        &[("camera_depth", ImportedResource::from(&texture))],
        &block,
    );
    bound.run(gpu);
    let shadow = bound.read_floats(gpu, "shadow_intensity", 0);
    assert!(
        shadow
            .iter()
            .all(|intensity| (0.0..=1.0).contains(intensity))
    );
    shadow
}

const SINGLE: (TextureFormat, u32) = (TextureFormat::Depth32Float, 1);

/// The shadow of the wall at a place in a picture of a camera.
fn of_wall(
    gpu: &Gpu,
    camera: &CameraView,
    light: &LightView,
    foot: DVec3,
) -> (Vec<Option<DVec3>>, Vec<f32>) {
    let surfaces = surfaces(camera, [0.5; 2], Some(foot));
    let depths: Vec<f32> = surfaces
        .iter()
        .map(|surface| stored(camera, surface))
        .collect();
    let parameters = ContactShadowParameters::new(camera, light, REACH).unwrap();
    let shadow = march(gpu, &depths, &parameters, SINGLE);
    (surfaces, shadow)
}

/// Checks a picture of the wall, whose shadow falls straight to its front: how far rays from the floor go until they meet it.
#[track_caller]
fn check_wall(surfaces: &[Option<DVec3>], shadow: &[f32], elevation: f64, foot: DVec3) {
    let [half, height, _, front] = WALL;
    let mut counts = [0; 2];
    for (surface, &intensity) in surfaces.iter().zip(shadow) {
        let Some(at) = surface.map(|at| at - foot) else {
            assert_eq!(intensity, 0.0, "the sky");
            continue;
        };
        let on_floor = at.y.abs() < 1e-6 && at.z > front && at.x.abs() < 0.8 * half;
        let (sin, cos) = elevation.to_radians().sin_cos();
        let ray = (at.z - front) / cos;
        if !on_floor || ray * sin > 0.9 * height {
            continue;
        }
        // A pixel is at most 2 cm deep on the floor; next to the wall a ray is shorter than that. A hit is found up to a step later,
        // a pixel that is up to an eighth of the length, and shadows fade from three quarters on.
        if (0.02..0.6 * REACH.length).contains(&ray) {
            counts[0] += 1;
            assert_eq!(intensity, 1.0, "{at}, elevation {elevation}");
        }
        if ray > 1.1 * REACH.length {
            counts[1] += 1;
            assert_eq!(intensity, 0.0, "{at}, elevation {elevation}");
        }
    }
    assert!(counts[0] > 100 && counts[1] > 100, "{counts:?}");
}

#[test]
fn a_wall_is_dark_at_its_foot_through_every_lens() {
    let gpu = gpu();
    for lens in LENSES {
        for elevation in [30.0, 50.0] {
            let (_, light) = sun(elevation, 0.0);
            let (surfaces, shadow) = of_wall(&gpu, &camera(lens, POSE), &light, DVec3::ZERO);
            check_wall(&surfaces, &shadow, elevation, DVec3::ZERO);
        }
    }
}

#[test]
fn a_plane_casts_no_shadow_on_itself_at_any_angle_and_distance() {
    let gpu = gpu();
    for lens in LENSES {
        for (slope, step) in (0..=85).step_by(17).zip(0..) {
            for distance in [0.3, 3.0, 30.0] {
                // The camera sees the floor steeply, and at a grazing angle.
                for height in [0.9, 0.25, 0.06] {
                    let eye = distance * DVec3::new(0.2, height, 1.0);
                    let camera = camera(lens, [eye, DVec3::ZERO]);
                    let (_, light) = sun(90.0 - f64::from(slope), 77.0 * f64::from(step));
                    let surfaces = surfaces(&camera, [0.5; 2], None);
                    let depths: Vec<f32> = surfaces.iter().map(|it| stored(&camera, it)).collect();
                    let reach = ContactShadows {
                        length: 0.1 * distance,
                        thickness: 0.05 * distance,
                    };
                    let parameters = ContactShadowParameters::new(&camera, &light, reach).unwrap();
                    for format in [TextureFormat::Depth32Float, TextureFormat::Depth16Unorm] {
                        let shadow = march(&gpu, &depths, &parameters, (format, 1));
                        let dark = shadow.iter().filter(|intensity| **intensity > 0.0).count();
                        assert_eq!(
                            dark, 0,
                            "{lens:?}, slope {slope}, distance {distance}, height {height}, {format}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn every_format_and_number_of_samples_gives_the_same() {
    let gpu = Gpu::open(moment_shadows::Profile::NativeAdapter).unwrap();
    let places = [(1, [0.5, 0.5]), (4, [0.375, 0.125])];
    for lens in LENSES {
        let camera = camera(lens, POSE);
        let (_, light) = sun(40.0, 20.0);
        let parameters = ContactShadowParameters::new(&camera, &light, REACH).unwrap();
        for (samples, place) in places {
            let surfaces = surfaces(&camera, place, Some(DVec3::ZERO));
            let depths: Vec<f32> = surfaces
                .iter()
                .map(|surface| stored(&camera, surface))
                .collect();
            let expected = march(&gpu, &depths, &parameters, (SINGLE.0, samples));
            assert!(
                expected
                    .iter()
                    .filter(|intensity| **intensity == 1.0)
                    .count()
                    > 100
            );
            for format in [TextureFormat::Depth24Plus, TextureFormat::Depth16Unorm] {
                let found = march(&gpu, &depths, &parameters, (format, samples));
                let differ = found
                    .iter()
                    .zip(&expected)
                    .filter(|(a, b)| (**a - **b).abs() > 0.1)
                    .count();
                // Edges of the shadow may lie a pixel beside, as the bias is larger.
                println!("{lens:?}, {format}, {samples} samples: {differ} differ");
                assert!(
                    differ <= 40,
                    "{lens:?}, {format}, {samples} samples: {differ}"
                );
            }
        }
    }
}

#[test]
fn far_from_the_origin_shadows_are_the_same() {
    let gpu = gpu();
    for lens in [Lens::Reversed, Lens::Parallel] {
        let (_, light) = sun(40.0, 0.0);
        let near = camera(lens, POSE);
        let depths: Vec<f32> = surfaces(&near, [0.5; 2], Some(DVec3::ZERO))
            .iter()
            .map(|it| stored(&near, it))
            .collect();
        let there = DVec3::new(3e5, 0.0, -7e5);
        let moved = |clip: [[f64; 4]; 4]| {
            (DMat4::from_cols_array_2d(&clip) * DMat4::from_translation(-there)).to_cols_array_2d()
        };
        let far = CameraView {
            clip_from_world: moved(near.clip_from_world),
            ..near
        };
        let far_light = LightView {
            clip_from_world: moved(light.clip_from_world),
            ..light
        };
        let [here, there] = [(near, light), (far, far_light)].map(|(camera, light)| {
            march(
                &gpu,
                &depths,
                &ContactShadowParameters::new(&camera, &light, REACH).unwrap(),
                SINGLE,
            )
        });
        let differ = here
            .iter()
            .zip(&there)
            .filter(|(a, b)| (**a - **b).abs() > 1e-3)
            .count();
        assert!(differ <= 2, "{lens:?}: {differ}");
        assert!(here.iter().filter(|intensity| **intensity == 1.0).count() > 100);
    }
}

#[test]
fn a_lamp_casts_the_shadow_of_its_place() {
    let gpu = gpu();
    let range = DepthRange {
        near: 0.1,
        far: 9.0,
    };
    for lens in LENSES {
        let camera = camera(lens, POSE);
        // So far away, or rays leave the wall before they end: elsewhere they are not parallel to those of a sun.
        let (towards, sun) = sun(40.0, 0.0);
        let lamp = |distance: f64| {
            let view = look_at_mat4(distance * towards, DVec3::ZERO, DVec3::Y);
            let clip = perspective_infinite_reverse(1.0, 1.0, 0.1) * view;
            LightView::perspective(clip.to_cols_array_2d(), 0.1, f64::INFINITY, range)
        };
        let (_, expected) = of_wall(&gpu, &camera, &sun, DVec3::ZERO);
        let (_, found) = of_wall(&gpu, &camera, &lamp(1e4), DVec3::ZERO);
        let differ = found
            .iter()
            .zip(&expected)
            .filter(|(a, b)| (**a - **b).abs() > 0.01)
            .count();
        assert!(differ <= 6, "{lens:?}: {differ}");
        // A lamp in front of the wall, nearer to the floor than rays are long: they end there.
        let before = DVec3::new(0.0, 0.05, 0.3);
        let view = look_at_mat4(before, DVec3::new(0.0, 0.0, 0.31), DVec3::X);
        let clip = perspective_infinite_reverse(1.0, 1.0, 0.01) * view;
        let light = LightView::perspective(clip.to_cols_array_2d(), 0.01, f64::INFINITY, range);
        let (surfaces, shadow) = of_wall(&gpu, &camera, &light, DVec3::ZERO);
        let on_floor = |at: &Option<DVec3>| at.is_some_and(|at| at.y.abs() < 1e-6 && at.z > 0.03);
        let dark = surfaces
            .iter()
            .zip(&shadow)
            .filter(|(at, intensity)| on_floor(at) && **intensity > 0.0)
            .count();
        assert_eq!(dark, 0, "{lens:?}");
    }
}

#[test]
fn what_is_no_number_or_out_of_range_stays_within_0_and_1() {
    let gpu = gpu();
    let mut depths: Vec<f32> = (0..SIZE[0] * SIZE[1])
        .map(|index| (index as f32 * 0.618).fract())
        .collect();
    for (index, depth) in depths
        .iter_mut()
        .enumerate()
        .filter(|(index, _)| index % 7 == 0)
    {
        *depth = [0.0, 1.0, 1e-38, 1.0 - 6e-8][index / 7 % 4];
    }
    let range = DepthRange {
        near: 0.1,
        far: 9.0,
    };
    for lens in LENSES {
        // Behind the camera, in front of it and in its place, through a lens that turns everything that is far into much.
        for lamp in [POSE[0], 2.0 * POSE[0], -POSE[0], POSE[1]] {
            let camera = camera(lens, POSE);
            let view = look_at_mat4(
                lamp + DVec3::new(0.0, 1e-9, 0.0),
                DVec3::new(0.01, 0.3, -0.2),
                DVec3::X,
            );
            let clip = perspective_infinite_reverse(1.0, 1.0, 0.01) * view;
            let light = LightView::perspective(clip.to_cols_array_2d(), 0.01, f64::INFINITY, range);
            for reach in [1e-30, 1e-3, 1.0, 1e18] {
                let reach = ContactShadows {
                    length: reach,
                    thickness: reach,
                };
                let parameters = ContactShadowParameters::new(&camera, &light, reach).unwrap();
                // It checks what it reads.
                march(&gpu, &depths, &parameters, SINGLE);
            }
        }
    }
}
