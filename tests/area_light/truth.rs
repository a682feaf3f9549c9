//! The sampled light against what geometry says, and against the unfiltered depth map.

use glam::{DVec2, DVec3};
use moment_shadows_lab::frame::{Frame, FrameDesc};
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::host::{SurfacePixels, read_depth_samples, read_gbuffer};
use moment_shadows_lab::light::{LightKind, LightShape, LightView};
use moment_shadows_lab::penumbra::edge_intensity;
use moment_shadows_lab::scene::{self, EDGE_HEIGHTS, HOLE, Image, Scene, edge_strip};
use moment_shadows_lab::soft::SoftLightChoice;
use moment_shadows_lab::truth::area_light::AreaLight;
use moment_shadows_lab::truth::kernel::TapPattern;
use moment_shadows_lab::truth::pcf::pcf;
use moment_shadows_lab::truth::surface::{DepthRounding, MomentDepths};
use moment_shadows_lab::view::View;

use crate::{LIGHTS, light, open};

#[test]
fn behind_straight_edges_it_is_the_hidden_share_of_the_light() {
    let scene = scene::load("edge").unwrap();
    for (choice, size) in LIGHTS {
        let (light, shape) = light(&scene, choice, size);
        let truth = AreaLight::new(&scene, &light, shape, 256).unwrap();
        for (number, height) in EDGE_HEIGHTS.into_iter().enumerate() {
            let [low, high] = edge_strip(number);
            let mut errors = Vec::new();
            let mut partial = 0;
            for step in 0..=200 {
                let x = -1.0 + 0.02 * f64::from(step);
                let place = DVec3::new(x, 0.0, 0.5 * (low + high));
                let exact = edge_intensity(&light, shape, height, place);
                partial += usize::from(exact > 0.0 && exact < 1.0);
                errors.push((truth.intensity(place, DVec3::Y) - exact).abs());
            }
            let mean = errors.iter().sum::<f64>() / errors.len() as f64;
            let largest = errors.into_iter().fold(0.0, f64::max);
            println!("{choice:?} {height}: {partial} places, {mean:.5} mean, {largest:.5} largest");
            assert!(partial >= 4, "{choice:?} {height}: no penumbra");
            // 256 places: a chord through them counts some sqrt(sqrt(256)) of them too many or too few.
            assert!(
                mean < 0.003 && largest < 0.02,
                "{choice:?} {height}: {mean} {largest}"
            );
        }
    }
}

#[test]
fn a_small_hole_casts_the_picture_of_the_light() {
    let scene = scene::load(HOLE).unwrap();
    let size = [1.6, 0.5];
    let (light, shape) = light(&scene, SoftLightChoice::Rectangle, size);
    let truth = AreaLight::new(&scene, &light, shape, 1024).unwrap();
    // The wall is 4 above the ground; its hole is 0.04 wide.
    let enlarged = 4.0 / (light.distance(DVec3::ZERO) - 4.0);
    for (axis, size) in size.into_iter().enumerate() {
        let half = 0.5 * (enlarged * size + 0.04 * (1.0 + enlarged));
        let at = |along: f64| {
            let place = [DVec3::X, DVec3::Z][axis] * along;
            truth.intensity(place, DVec3::Y)
        };
        assert!(at(0.0) < 1.0, "axis {axis}");
        for side in [-1.0, 1.0] {
            // Two rows of 32 samples of the light fit between.
            assert!(
                at(side * (half - enlarged * size / 16.0)) < 1.0,
                "axis {axis}"
            );
            assert_eq!(at(side * (half + 0.001)), 1.0, "axis {axis}");
        }
    }
}

/// Whether any triangle lies between a point and the light's centre: all are tried, as rays meet planes.
fn hidden(scene: &Scene, light: &LightView, from: DVec3) -> bool {
    let towards = match light.kind() {
        LightKind::Directional => 1e4 * light.towards_light(from),
        LightKind::Spot => light.ray(DVec2::splat(0.5)).0 - from,
    };
    scene.meshes.iter().any(|mesh| {
        mesh.indices.chunks_exact(3).any(|corners| {
            let [a, b, c] = [corners[0], corners[1], corners[2]]
                .map(|corner| DVec3::from(mesh.positions[corner as usize].map(f64::from)));
            let (u, v) = (b - a, c - a);
            let across = towards.cross(v);
            let determinant = u.dot(across);
            if determinant == 0.0 {
                return false;
            }
            let at = from - a;
            let (x, turned) = (at.dot(across) / determinant, at.cross(u));
            let y = towards.dot(turned) / determinant;
            let t = v.dot(turned) / determinant;
            x >= 0.0 && y >= 0.0 && x + y <= 1.0 && t > 0.0 && t < 1.0
        })
    })
}

fn drawn(gpu: &Gpu, scene: &Scene, light: LightView, shape: LightShape) -> Frame {
    let desc = FrameDesc {
        picture: [96, 54],
        map: [2048; 2],
        samples: 1,
        format: wgpu::TextureFormat::Depth32Float,
        camera_depth: (wgpu::TextureFormat::Depth32Float, 1),
        light,
        shape,
        camera: View::numbered(scene, 0).camera,
    };
    Frame::draw(gpu, scene, desc).unwrap()
}

fn facing(light: &LightView, pixels: &SurfacePixels) -> Vec<(usize, DVec3, DVec3)> {
    let vector = |value: [f32; 3]| DVec3::from(value.map(f64::from));
    (0..pixels.covered.len())
        .map(|pixel| {
            (
                pixel,
                vector(pixels.position[pixel]),
                vector(pixels.normal[pixel]),
            )
        })
        .filter(|(pixel, position, normal)| {
            pixels.covered[*pixel] && normal.dot(light.towards_light(*position)) > 0.05
        })
        .collect()
}

#[test]
fn a_light_without_size_casts_hard_shadows() {
    let gpu = open();
    for name in ["hall", "chairs", "fence-and-foliage"] {
        let scene = scene::load(name).unwrap();
        for choice in [SoftLightChoice::Directional, SoftLightChoice::Spot] {
            let (light, shape) = light(&scene, choice, [0.0; 2]);
            let frame = drawn(&gpu, &scene, light, shape);
            let pixels = read_gbuffer(&gpu, &frame.surface).unwrap();
            let truth = AreaLight::new(&scene, &light, shape, 256).unwrap();
            let found = truth.picture(&pixels).unwrap();
            assert!(found.iter().all(|&value| value == 0.0 || value == 1.0));
            let facing = facing(&light, &pixels);
            let shadowed = facing
                .iter()
                .filter(|(pixel, ..)| found[*pixel] == 1.0)
                .count();
            assert!(shadowed > facing.len() / 20, "{name}: {shadowed} shadowed");
            let stored = read_depth_samples(&gpu, &frame.light_map.texture).unwrap();
            let depths =
                MomentDepths::from_stored(&light, &stored, DepthRounding::Float32).unwrap();
            let map = pcf(&light, &depths, &TapPattern::unblurred(), &pixels).unwrap();
            let differ = facing
                .iter()
                .filter(|(pixel, ..)| (found[*pixel] - map[*pixel]).abs() > 0.75)
                .count();
            println!(
                "{name} {choice:?}: {shadowed} of {} shadowed, {differ} differ",
                facing.len()
            );
            // Where a shadow's edge runs through the texel of the map: leaves have many.
            let most = if name == "fence-and-foliage" {
                0.03
            } else {
                0.012
            };
            assert!(
                (differ as f64) < most * facing.len() as f64,
                "{name} {choice:?}: {differ}"
            );
            // Masked leaves have holes that triangles do not know.
            if name == "fence-and-foliage" {
                continue;
            }
            let size = scene.bounds().radius();
            for (pixel, position, normal) in facing.into_iter().step_by(5) {
                let from =
                    position + 1e-5 * (size + position.abs().max_element()) * normal.normalize();
                assert_eq!(
                    found[pixel] == 1.0,
                    hidden(&scene, &light, from),
                    "{name} {pixel}"
                );
            }
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let gpu = open();
    let scene = scene::load("fence-and-foliage").unwrap();
    let (light, shape) = light(&scene, SoftLightChoice::Directional, [4.0; 2]);
    let frame = drawn(&gpu, &scene, light, shape);
    let pixels = read_gbuffer(&gpu, &frame.surface).unwrap();
    let on_threads = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            let truth = AreaLight::new(&scene, &light, shape, 300).unwrap();
            truth.picture(&pixels).unwrap()
        })
    };
    let one = on_threads(1);
    assert!(one.iter().any(|&value| value > 0.1 && value < 0.9));
    assert_eq!(one, on_threads(2));
}

#[test]
fn holes_of_masked_materials_let_light_through() {
    let mut scene = scene::load("edge").unwrap();
    // The boards' far half is solid; the half at the edge is a hole.
    scene.images.push(Image {
        width: 2,
        height: 1,
        rgba: vec![255, 255, 255, 255, 255, 255, 255, 0],
    });
    scene.materials[0].texture = Some(0);
    scene.materials[0].mask = Some(0.5);
    for (choice, size) in LIGHTS {
        let (light, shape) = light(&scene, choice, size);
        let truth = AreaLight::new(&scene, &light, shape, 64).unwrap();
        let below = |x: f64| {
            let board = DVec3::new(x, EDGE_HEIGHTS[1], 0.0);
            let (origin, direction) = light.ray(light.uv(board).unwrap());
            let ground = origin - direction * (origin.y / direction.y);
            truth.intensity(ground, DVec3::Y)
        };
        assert_eq!([-3.0, -1.0].map(below), [1.0, 0.0], "{choice:?}");
        // The solid half ends at x = -2, as straight as the board at 0.
        assert!(
            (below(-2.0) - 0.5).abs() < 0.05,
            "{choice:?}: {}",
            below(-2.0)
        );
    }
}
