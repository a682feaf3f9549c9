//! The rectified frame: there and back again, and all of the frustum within its bounds.

use core::f64::consts::{PI, TAU};

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, DVec4};
use moment_shadows::{Profile, RectifiedFrame, RectifiedView};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::cameras::{Lens, Pair, direction, looking, pair, random_pair};

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Input {
    frame: RectifiedFrame,
    device: [f32; 2],
    stored_depth: f32,
    padding: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Output {
    position: [f32; 3],
    depth: f32,
    coordinates: [f32; 3],
    inclination: f32,
    back: [f32; 3],
    padding: f32,
    again: [f32; 3],
    more_padding: f32,
    place: [f32; 2],
    ray: [f32; 2],
}

fn run(inputs: &[Input]) -> Vec<Output> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "frame.wgsl", include_str!("frame.wgsl"))
        .unwrap()
        .run(inputs)
        .unwrap()
}

fn view(pair: &Pair) -> RectifiedView {
    RectifiedView::new(&pair.clip_from_world, pair.far, pair.light)
        .unwrap_or_else(|error| panic!("{error}: {pair:?}"))
}

/// A point of the frustum; one in eight is on an edge of the picture, one in sixteen in the sky.
fn point(frame: RectifiedFrame, random: &mut ChaCha8Rng) -> Input {
    let mut device = [0, 1].map(|_| random.random_range(-1.0..=1.0_f32));
    if random.random_range(0..8) == 0 {
        device[random.random_range(0..2)] = if random.random() { 1.0 } else { -1.0 };
    }
    let stored_depth = match random.random_range(0..16) {
        0 => 0.0,
        1 => 1.0,
        _ => random.random_range(0.0..1.0),
    };
    Input {
        frame,
        device,
        stored_depth,
        padding: 0.0,
    }
}

fn wide<const N: usize>(values: [f32; N]) -> [f64; N] {
    values.map(f64::from)
}

/// The difference of two angles, whole turns apart or not.
fn turned(a: f64, b: f64) -> f64 {
    let difference = a - b;
    (difference - TAU * (difference / TAU).round()).abs()
}

/// Everything that holds of any point of any frustum: it is where the camera's matrix says, inside the bounds, and there and
/// back again within 1e-5.
fn judge(pair: &Pair, view: &RectifiedView, input: &Input, output: &Output) -> [f64; 2] {
    let context = || format!("{pair:?}\n{input:?}\n{output:?}");
    let values: [f32; 20] = bytemuck::cast(*output);
    assert!(
        values.iter().all(|value| value.is_finite()),
        "{}",
        context()
    );
    let [position, coordinates, back, again] = [
        wide(output.position),
        wide(output.coordinates),
        wide(output.back),
        wide(output.again),
    ];
    let position = DVec3::from_array(position);
    let distance = position.length();
    let [radius, azimuth, inclination] = coordinates;

    // Within the bounds, but for what f32 makes of a coordinate.
    let frame = &view.frame;
    let [low, high] = [frame.smallest_inclination, frame.largest_inclination].map(f64::from);
    assert!(
        radius <= f64::from(frame.largest_radius) * (1.0 + 1e-6),
        "{}",
        context()
    );
    assert!(
        (low - 1e-6..=high + 1e-6).contains(&inclination),
        "{}",
        context()
    );
    let [first, extent] = [frame.first_azimuth, frame.azimuth_extent].map(f64::from);
    let middle = turned(azimuth, first + 0.5 * extent);
    // Azimuths of points that are next to the axis are as uncertain as their radius.
    let slack = 1e-6 + 4e-7 * distance / radius.max(1e-30);
    assert!(
        middle <= 0.5 * extent + slack,
        "{} off by {}",
        context(),
        middle - 0.5 * extent
    );

    // The row and column that it is looked up at are its own: no row is flipped.
    let [ray_radius, ray_azimuth] = wide(output.ray);
    let apart = turned(ray_azimuth, azimuth);
    assert!(apart <= slack + 2e-6, "{}: {apart}", context());
    assert!(
        (ray_radius - radius).abs() <= 2e-6 * f64::from(frame.largest_radius),
        "{}",
        context()
    );
    // Depth falls with the inclination, and back.
    assert!(
        (f64::from(output.inclination) - inclination).abs() <= 3e-6,
        "{}",
        context()
    );

    // Rectified to Cartesian and back: where the radius says anything at all.
    let inner = radius > 1e-6 * distance;
    let rectified = if inner {
        [
            (again[0] - radius).abs() / radius,
            turned(again[1], azimuth),
            (again[2] - inclination).abs(),
        ]
        .into_iter()
        .fold(0.0, f64::max)
    } else {
        0.0
    };
    // And Cartesian to rectified: an inclination in f32 knows the distance along the light up to 1 / sin(theta).
    let sine = radius / distance.max(1e-30);
    let cartesian = if inner {
        (DVec3::from_array(back) - position).length() / distance * sine
    } else {
        0.0
    };
    [rectified, cartesian]
}

#[test]
fn a_million_cameras_and_lights_go_there_and_back_within_bounds() {
    const PAIRS: usize = 1_000_000;
    let mut random = ChaCha8Rng::seed_from_u64(2026);
    let mut largest = [0.0; 2];
    for _ in 0..10 {
        let pairs: Vec<(Pair, RectifiedView)> = (0..PAIRS / 10)
            .map(|_| random_pair(&mut random))
            .map(|pair| (pair, view(&pair)))
            .collect();
        let inputs: Vec<Input> = pairs
            .iter()
            .map(|(_, view)| point(view.frame, &mut random))
            .collect();
        for (((pair, view), input), output) in pairs.iter().zip(&inputs).zip(run(&inputs)) {
            let errors = judge(pair, view, input, &output);
            for (largest, error) in largest.iter_mut().zip(errors) {
                *largest = error.max(*largest);
            }
        }
    }
    println!(
        "there and back: coordinates {:.1e}, positions {:.1e}",
        largest[0], largest[1]
    );
    assert!(largest.iter().all(|&error| error <= 1e-5), "{largest:?}");
}

#[test]
fn every_point_of_a_frustum_lies_within_its_bounds_and_bounds_are_tight() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    for _ in 0..400 {
        let pair = random_pair(&mut random);
        let view = view(&pair);
        // A grid over the picture, borders included, at the far end.
        let inputs: Vec<Input> = (0..33 * 33)
            .map(|index| Input {
                frame: view.frame,
                device: [index % 33, index / 33].map(|step| step as f32 / 16.0 - 1.0),
                stored_depth: if pair.world_from_clip.col(2).w > 0.0 {
                    0.0
                } else {
                    1.0
                },
                padding: 0.0,
            })
            .collect();
        let mut extremes = [0.0, PI, 0.0_f64];
        for (input, output) in inputs.iter().zip(run(&inputs)) {
            judge(&pair, &view, input, &output);
            let [radius, _, inclination] = wide(output.coordinates);
            extremes[0] = radius.max(extremes[0]);
            extremes[1] = inclination.min(extremes[1]);
            extremes[2] = inclination.max(extremes[2]);
        }
        let frame = &view.frame;
        let far = pair.far.min(distance_of_far_plane(&pair));
        // The grid has the corners; a camera's own far plane may come before.
        assert!(extremes[0] <= f64::from(frame.largest_radius) * (1.0 + 1e-6));
        if far == pair.far {
            assert!(
                extremes[0] >= f64::from(frame.largest_radius) * (1.0 - 1e-5),
                "{pair:?}"
            );
        }
        // And a step of it is at most an eighth of a radian at the widest field of view.
        assert!(
            extremes[1] <= f64::from(frame.smallest_inclination) + 0.13,
            "{pair:?}"
        );
        assert!(
            extremes[2] >= f64::from(frame.largest_inclination) - 0.13,
            "{pair:?}"
        );
    }
}

fn distance_of_far_plane(pair: &Pair) -> f64 {
    let at = |depth: f64| {
        let point = pair.world_from_clip * DVec4::new(0.0, 0.0, depth, 1.0);
        1.0 / point.w.max(1e-300)
    };
    at(0.0).max(at(1.0))
}

#[test]
fn ten_thousand_directions_give_no_nan_and_no_flipped_row() {
    let mut random = ChaCha8Rng::seed_from_u64(12);
    let lens = Lens {
        field_of_view: 1.2,
        aspect: 16.0 / 9.0,
        near: 0.1,
        far: None,
    };
    let axes = [
        DVec3::X,
        DVec3::Y,
        DVec3::Z,
        DVec3::NEG_X,
        DVec3::NEG_Y,
        DVec3::NEG_Z,
    ];
    let mut directions = axes.to_vec();
    directions.extend((0..94).map(|_| direction(&mut random)));
    let mut pairs = Vec::new();
    for &forward in &directions {
        for &light in &directions {
            let roll = random.random_range(0.0..6.3);
            pairs.push(pair(
                DVec3::new(1.0, 2.0, 3.0),
                looking(forward, roll),
                lens,
                60.0,
                light,
            ));
        }
    }
    assert_eq!(pairs.len(), 10_000);
    let views: Vec<RectifiedView> = pairs.iter().map(view).collect();
    for _ in 0..8 {
        let inputs: Vec<Input> = views
            .iter()
            .map(|view| point(view.frame, &mut random))
            .collect();
        for (((pair, view), input), output) in
            pairs.iter().zip(&views).zip(&inputs).zip(run(&inputs))
        {
            judge(pair, view, input, &output);
        }
    }
}

#[test]
fn a_pixel_is_where_the_matrix_says() {
    let mut random = ChaCha8Rng::seed_from_u64(13);
    let pairs: Vec<Pair> = (0..2000).map(|_| random_pair(&mut random)).collect();
    let views: Vec<RectifiedView> = pairs.iter().map(view).collect();
    let inputs: Vec<Input> = views
        .iter()
        .map(|view| point(view.frame, &mut random))
        .collect();
    for (((pair, view), input), output) in pairs.iter().zip(&views).zip(&inputs).zip(run(&inputs)) {
        let [x, y] = input.device.map(f64::from);
        let clip = DVec4::new(x, y, f64::from(input.stored_depth), 1.0);
        let scene = pair.world_from_clip * clip;
        let camera = DVec3::from_array(view.camera);
        let mut offset = scene.truncate() - scene.w * camera;
        offset /= scene.w.max(f64::from(view.frame.farthest_w));
        let rotated = view.axes.map(|axis| DVec3::from_array(axis).dot(offset));
        let error =
            (DVec3::from_array(wide(output.position)) - DVec3::from_array(rotated)).length();
        // Forward depth in f32 is a difference of numbers that far exceed it, by the ratio of its planes.
        let w = scene.w.max(f64::from(view.frame.farthest_w));
        let largest = view
            .frame
            .scene_w
            .map(|value| f64::from(value.abs()))
            .into_iter()
            .fold(0.0, f64::max);
        let tolerance = 1e-6 + 4e-7 * largest / w;
        assert!(
            error <= tolerance * offset.length(),
            "{pair:?} {input:?}: {error}"
        );
    }
}

#[test]
fn a_camera_that_looks_along_the_light_has_all_azimuths() {
    let lens = Lens {
        field_of_view: 1.0,
        aspect: 1.5,
        near: 0.1,
        far: Some(100.0),
    };
    let of = |forward: DVec3, light: DVec3| {
        view(&pair(DVec3::ZERO, looking(forward, 0.3), lens, 50.0, light)).frame
    };
    let along = of(DVec3::Y, DVec3::Y);
    assert_eq!(
        (along.azimuth_extent, along.smallest_inclination),
        (TAU as f32, 0.0)
    );
    assert!(along.largest_inclination < 1.0);
    let against = of(DVec3::Y, DVec3::NEG_Y);
    assert_eq!(
        (against.azimuth_extent, against.largest_inclination),
        (TAU as f32, PI as f32)
    );
    assert!(against.smallest_inclination > 2.0);
    // Across the light there is a wedge, and both axes are far outside.
    let across = of(DVec3::Y, DVec3::X);
    assert!(across.azimuth_extent < 1.8 && across.smallest_inclination > 0.5);
    assert!(across.largest_inclination < 2.7);
}

#[test]
fn azimuths_outside_of_the_frame_take_its_nearer_end() {
    const SHADER: &str = "
import moment_shadows::air::rectified_frame::{RectifiedFrame, rectified_frame_place};
alias BatchInput = vec2f;
alias BatchOutput = f32;
fn batch(input: vec2f) -> f32 {
    var frame: RectifiedFrame;
    frame.largest_radius = 1.0;
    frame.first_azimuth = 3.0;
    frame.azimuth_extent = input.y;
    return rectified_frame_place(frame, vec3f(0.5, input.x, 1.0)).y;
}
";
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let batch = Batch::<[f32; 2], f32>::new(&gpu, "azimuths.wgsl", SHADER).unwrap();
    // The interval from 3 to 4 leaves 5.28 of a turn; azimuths come in [-pi, pi].
    let cases = [
        (2.9, 0.0),
        (3.1, 0.1),
        (-2.4, 0.883_185),
        (-2.2, 1.0),
        (0.0, 1.0),
        (0.8, 0.0),
    ];
    let inputs = cases.map(|(azimuth, _)| [azimuth, 1.0]);
    for ((azimuth, expected), found) in cases.into_iter().zip(batch.run(&inputs).unwrap()) {
        assert!(
            (found - expected).abs() <= 1e-5,
            "{azimuth}: {found}, not {expected}"
        );
    }
}
