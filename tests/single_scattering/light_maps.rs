//! Where the light's map lies, how its matrix is scaled, which way it stores depth, and its mip levels.

use bytemuck::bytes_of;
use glam::DMat4;
use moment_shadows::{
    LightDepth, LightView, MapEncoding, MapRegion, ScatteringParameters, SingleScattering, Storage,
    Technique,
};
use moment_shadows_graph::TextureDesc;
use moment_shadows_lab::gpu::Gpu;

use crate::pictures::{EYE, MAP, Scene, graph};
use crate::stage::{Block, capabilities, gpu, run, upload, upload_layers};

/// Places and depths are the same but for their last digits, which decide for a few texels whether an occluder lies between the ends
/// of the range or at one of them.
const ROUNDING: f32 = 5e-3;

fn raw() -> MapEncoding {
    MapEncoding::new(Technique::Hamburger4, Storage::Float32).unwrap()
}

fn blocks(parameters: &ScatteringParameters) -> [Block<'_>; 3] {
    [
        ("rectify", bytes_of(&parameters.rectify)),
        ("integrate", bytes_of(&parameters.integrate)),
        ("composite", bytes_of(&parameters.composite)),
    ]
}

fn picture(
    gpu: &Gpu,
    scene: &Scene,
    light: &LightView,
    map: &(TextureDesc, wgpu::Texture),
) -> Vec<[f32; 4]> {
    let [_, camera_depth] = scene.imports(gpu);
    let layers = run(
        gpu,
        &capabilities(gpu),
        &graph("\"hamburger6\"", "float32"),
        &[("map", map), ("camera_depth", &camera_depth)],
        &blocks(&scene.parameters_of(light)),
        "scattering",
    );
    bytemuck::pod_collect_to_vec(&layers[0])
}

/// The largest difference of two pictures, as a part of the largest radiance.
fn difference(one: &[[f32; 4]], other: &[[f32; 4]]) -> f32 {
    let largest = one.iter().flatten().copied().fold(0.0, f32::max);
    let pairs = one.iter().flatten().zip(other.iter().flatten());
    let apart = pairs.map(|(one, other)| (one - other).abs());
    apart.fold(0.0, f32::max) / largest
}

#[test]
fn a_region_of_a_layer_is_a_map_like_any_other() {
    let gpu = gpu();
    let scene = Scene::across();
    let [map, _] = scene.imports(&gpu);
    let alone = picture(&gpu, &scene, &scene.light(), &map);
    // Everything around the region is in shadow.
    let region = MapRegion::new([96, 40], [MAP; 2]);
    let size = [MAP + 160, MAP + 96];
    let dark = [-1.0, 1.0, -1.0, 1.0];
    let mut atlas = vec![dark; (2 * size[0] * size[1]) as usize];
    for row in 0..MAP {
        let start = ((size[1] + 40 + row) * size[0] + 96) as usize;
        let from = (row * MAP) as usize;
        let width = MAP as usize;
        atlas[start..start + width].copy_from_slice(&scene.moments[from..from + width]);
    }
    let map = upload_layers(&gpu, &raw(), size, 2, &atlas);
    let light = LightView {
        layer: 1,
        region,
        ..scene.light()
    };
    let apart = difference(&alone, &picture(&gpu, &scene, &light, &map));
    println!("{apart}");
    assert!(apart <= ROUNDING, "{apart}");
    for wrong in [
        LightView { layer: 0, ..light },
        LightView {
            region: MapRegion::WHOLE,
            ..light
        },
    ] {
        assert!(difference(&alone, &picture(&gpu, &scene, &wrong, &map)) > 0.05);
    }
}

#[test]
fn reversed_depth_and_a_scaled_matrix_are_the_same_light() {
    let gpu = gpu();
    let scene = Scene::across();
    let [map, _] = scene.imports(&gpu);
    let plain = scene.light();
    let alone = picture(&gpu, &scene, &plain, &map);
    // Columns; z becomes w - z, and then all of it is tripled.
    let scaled = |reversed: bool| LightView {
        clip_from_world: plain.clip_from_world.map(|[x, y, z, w]| {
            let z = if reversed { w - z } else { z };
            [x, y, z, w].map(|entry| 3.0 * entry)
        }),
        depth: LightDepth::Orthographic { reversed },
        ..plain
    };
    for reversed in [false, true] {
        let apart = difference(&alone, &picture(&gpu, &scene, &scaled(reversed), &map));
        println!("{apart}");
        assert!(apart <= ROUNDING, "{reversed}: {apart}");
    }
    // Depth the wrong way round is another light.
    let wrong = LightView {
        depth: LightDepth::Orthographic { reversed: true },
        ..plain
    };
    assert!(difference(&alone, &picture(&gpu, &scene, &wrong, &map)) > 0.05);
}

#[test]
fn a_mirrored_map_is_the_same_light() {
    let gpu = gpu();
    let scene = Scene::across();
    let [map, _] = scene.imports(&gpu);
    let plain = scene.light();
    let alone = picture(&gpu, &scene, &plain, &map);
    let mirrored: Vec<[f32; 4]> = scene
        .moments
        .chunks(MAP as usize)
        .flat_map(|row| row.iter().rev().copied())
        .collect();
    let map = upload(&gpu, &raw(), [MAP; 2], &mirrored);
    let light = LightView {
        clip_from_world: plain.clip_from_world.map(|[x, y, z, w]| [-x, y, z, w]),
        ..plain
    };
    let apart = difference(&alone, &picture(&gpu, &scene, &light, &map));
    assert!(apart <= ROUNDING, "{apart}");
}

#[test]
fn nodes_are_told_of_the_light_the_medium_and_one_frame() {
    let scene = Scene::across();
    let light = LightView {
        layer: 3,
        region: MapRegion::new([5, 6], [7, 8]),
        ..scene.light()
    };
    let medium = SingleScattering::new([0.1, 0.2, 0.6], [0.0; 3], 0.0, [0.0; 3]).unwrap();
    let found = scene.parameters_in(&light, medium);
    assert_eq!(
        (found.rectify.layer, found.rectify.region),
        (3, light.region)
    );
    assert_eq!(found.rectify.frame, found.integrate.frame);
    assert_eq!(found.rectify.frame, found.composite.frame);
    assert_eq!(found.composite.medium, medium);
    // The mean over the colours.
    assert!((found.integrate.extinction - 0.3).abs() < 1e-6);
    // Where the camera is in the light's clip space, which here is that of its map.
    let matrix = DMat4::from_cols_array_2d(&light.clip_from_world.map(|it| it.map(f64::from)));
    let clip = matrix.project_point3(EYE);
    let expected = [0.5 + 0.5 * clip.x, 0.5 - 0.5 * clip.y, 2.0 * clip.z - 1.0];
    let [u, v] = found.rectify.map_at_camera;
    for (found, expected) in [u, v, found.rectify.depth_at_camera]
        .into_iter()
        .zip(expected)
    {
        assert!(
            (f64::from(found) - expected).abs() < 1e-6,
            "{found} for {expected}"
        );
    }
    // Moment depth runs from -1 to 1 over 70 scene units.
    assert!((found.rectify.depth_per_length * 35.0 - 1.0).abs() < 1e-5);
}
