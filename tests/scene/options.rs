//! The camera, the light and the ground that a command line names.

use crate::Files;
use crate::build::options;
use glam::DVec3;
use moment_shadows::Profile;
use moment_shadows_lab::command::drawn::Drawn;
use moment_shadows_lab::command::render::RenderOptions;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::scene::{self, Mesh, Scene};
use moment_shadows_lab::view::View;
use serde_json::json;

/// The block, somewhere.
fn block() -> Files {
    let mut files = Files::block();
    files.document["nodes"][0]["translation"] = json!([1000.5, -50.25, 3.0]);
    files
}

#[test]
fn cameras_and_lights_are_in_the_file_s_coordinates() {
    let files = block();
    files.load().unwrap();
    let path = files.folder.path().join("sail.gltf");
    let scene = scene::load(path.to_str().unwrap()).unwrap();
    assert_eq!(scene.origin, DVec3::new(1000.5, -50.25, 3.0));
    for number in [0, 3] {
        let view = View::numbered(&scene, number);
        let numbered = RenderOptions {
            view: number,
            camera: None,
            light_direction: None,
            ..options()
        };
        let named = RenderOptions {
            camera: Some([view.camera.eye, view.camera.target].map(|point| point + scene.origin)),
            light_direction: Some(view.light_direction),
            ..options()
        };
        let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
        let [numbered, named] = [numbered, named].map(|options| {
            let drawn = options.sized(Drawn::default());
            options.frame(&gpu, &scene, &drawn, 4).unwrap().desc
        });
        assert_eq!(named.light, numbered.light);
        assert!((named.camera.eye - numbered.camera.eye).length() < 1e-9);
        assert!((named.camera.target - numbered.camera.target).length() < 1e-9);
    }
    // Whatever is looked at, what is near is seen.
    let eye = scene.origin + DVec3::new(0.0, 0.5, 3.0);
    let far = View::numbered(&scene, 0)
        .seen_from(&scene, [eye, eye - 1e6 * DVec3::Z])
        .unwrap();
    assert!(far.camera.near < 0.01, "{}", far.camera.near);
    let error = View::numbered(&scene, 0).seen_from(&scene, [eye, eye]);
    assert!(error.is_err());
}

#[test]
fn without_a_ground_there_are_casters_alone() {
    let files = block();
    let bare = RenderOptions {
        no_ground: true,
        camera: None,
        light_direction: None,
        ..options()
    };
    let ground = RenderOptions {
        no_ground: false,
        ..bare.clone()
    };
    let [bare, ground] = [bare, ground].map(|options| files.seen(&options));
    let count = |covered: &[bool]| covered.iter().filter(|&&it| it).count();
    let [bare_pixels, ground_pixels] = [&bare, &ground].map(|seen| count(&seen.pixels.covered));
    assert!(
        bare_pixels > 1000 && bare_pixels + 10_000 < ground_pixels,
        "{bare_pixels} {ground_pixels}"
    );
    // The light is fitted to the same casters.
    let casters = |seen: &crate::build::Seen| {
        seen.peeled
            .iter()
            .map(|&surfaces| surfaces / 2)
            .sum::<u32>()
    };
    assert!(bare.peeled.iter().sum::<u32>() < ground.peeled.iter().sum());
    assert!(casters(&bare) > 1000 && casters(&bare) == casters(&ground));
    // From below, edge-on and from the side nothing is special.
    for light_direction in [DVec3::Y, DVec3::X, DVec3::new(0.0, 1e-9, 1.0)] {
        let options = RenderOptions {
            no_ground: true,
            light_direction: Some(light_direction),
            ..options()
        };
        let seen = files.seen(&RenderOptions {
            camera: None,
            ..options
        });
        assert!(
            seen.peeled.iter().any(|&surfaces| surfaces > 1),
            "{light_direction}"
        );
    }
}

#[test]
fn files_with_the_same_box_are_seen_and_lit_the_same() {
    // A square panel, and two slivers in opposite corners of its box.
    let scene = |positions: &[[f32; 3]], in_box: bool| Scene {
        meshes: vec![Mesh {
            positions: positions.to_vec(),
            indices: (0..positions.len() as u32).collect(),
            ..Mesh::default()
        }],
        in_box,
        ..Scene::default()
    };
    let [a, b, c, d] = [
        [-1.0, 0.0, -1.0],
        [1.0, 0.0, -1.0],
        [1.0, 0.5, 1.0],
        [-1.0, 0.5, 1.0],
    ];
    let placed = |positions: &[[f32; 3]], in_box: bool| {
        let scene = scene(positions, in_box);
        let view = View::numbered(&scene, 0);
        (view, view.sun(&scene, [256; 2], 4.0, false).unwrap())
    };
    let (panel, slivers) = ([a, b, c, a, c, d], [a, a, a, c, c, c]);
    assert_eq!(placed(&panel, true), placed(&slivers, true));
    assert_ne!(placed(&panel, false), placed(&slivers, false));
}
