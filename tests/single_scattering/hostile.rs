//! Parameters filled by hand with NaN, infinities, or numbers that no camera, light or medium has.

use bytemuck::bytes_of;
use moment_shadows::{
    CompositeScatteringParameters, IntegrateScatteringParameters, RectifyMomentsParameters,
};
use moment_shadows_graph::Capabilities;

use crate::pictures::{PICTURE, Scene, graph_of, seen};
use crate::stage::{Bound, bind, capabilities, gpu};

/// Floats of a rectified frame.
const FRAME: usize = 20;

/// What every number is replaced by.
const NUMBERS: [f32; 9] = [
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    0.0,
    -0.0,
    -1.0,
    1e38,
    -1e38,
    1e-40,
];

/// On a software adapter without the view rays of the camera's depth, elsewhere with them.
fn bound(gpu: &moment_shadows_lab::gpu::Gpu, scene: &Scene, software_adapter: bool) -> Bound {
    let capabilities = Capabilities {
        software_adapter,
        ..capabilities(gpu)
    };
    let imports = scene.imports(gpu);
    let [map, camera_depth] = &imports;
    let mut graph = graph_of([32, 24], "\"hamburger6\"", "float16");
    if !software_adapter {
        graph = seen(&graph);
    }
    bind(
        gpu,
        &capabilities,
        &graph,
        &[("map", map), ("camera_depth", camera_depth)],
        &[],
        &[],
    )
}

#[test]
fn no_number_in_a_parameter_gives_a_pixel_that_is_none() {
    let gpu = gpu();
    let scene = Scene::across();
    let given = scene.parameters();
    // The integers at the end of the resampling's parameters are a region and a layer.
    let rectify: [f32; FRAME + 8] = {
        let bytes = &bytes_of(&given.rectify)[..4 * (FRAME + 8)];
        bytemuck::pod_read_unaligned(bytes)
    };
    let integrate: [f32; FRAME + 4] = bytemuck::cast(given.integrate);
    let composite: [f32; FRAME + 12] = bytemuck::cast(given.composite);
    let mut impossible = 0;
    for software_adapter in [true, false] {
        let bound = bound(&gpu, &scene, software_adapter);
        let mut judge = |blocks: [&[u8]; 3], what: &str| {
            let blocks = [
                ("rectify", blocks[0]),
                ("integrate", blocks[1]),
                ("composite", blocks[2]),
            ];
            let layers = bound.run(&gpu, &blocks, "scattering");
            let pixels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&layers[0]);
            assert_eq!(pixels.len(), (PICTURE[0] * PICTURE[1]) as usize);
            for pixel in pixels {
                let [.., transmittance] = pixel;
                let radiance = &pixel[..3];
                assert!(
                    radiance.iter().all(|value| (0.0..=65504.0).contains(value)),
                    "{what}: {pixel:?}"
                );
                assert!((0.0..=1.0).contains(&transmittance), "{what}: {pixel:?}");
                impossible += usize::from(pixel == [0.0, 0.0, 0.0, 1.0]);
            }
        };
        let [a, b, c] = [
            bytes_of(&given.rectify),
            bytes_of(&given.integrate),
            bytes_of(&given.composite),
        ];
        for number in NUMBERS {
            // The frame is the same in all of them, or one of them has another one.
            for place in 0..FRAME {
                let broken = |block: &[u8]| {
                    let mut block = block.to_vec();
                    block[4 * place..4 * place + 4].copy_from_slice(&number.to_le_bytes());
                    block
                };
                let what = format!("{number} in the frame at {place}");
                judge([&broken(a), &broken(b), &broken(c)], &what);
                judge([a, b, &broken(c)], &format!("{what} of the composite"));
            }
            for place in FRAME..rectify.len() {
                let mut broken = a.to_vec();
                broken[4 * place..4 * place + 4].copy_from_slice(&number.to_le_bytes());
                judge([&broken, b, c], &format!("{number} in rectify at {place}"));
            }
            let mut broken = integrate;
            broken[FRAME] = number;
            judge(
                [a, bytemuck::bytes_of(&broken), c],
                &format!("extinction {number}"),
            );
            for place in FRAME..composite.len() {
                let mut broken = composite;
                broken[place] = number;
                judge(
                    [a, b, bytemuck::bytes_of(&broken)],
                    &format!("{number} in the medium at {}", place - FRAME),
                );
            }
            let all = [number; FRAME + 12];
            let mut everything: RectifyMomentsParameters = given.rectify;
            everything.frame = bytemuck::cast([number; FRAME]);
            everything.map_at_camera = [number; 2];
            everything.depth_per_length = number;
            let sums: IntegrateScatteringParameters = bytemuck::cast([number; FRAME + 4]);
            let picture: CompositeScatteringParameters = bytemuck::cast(all);
            judge(
                [bytes_of(&everything), bytes_of(&sums), bytes_of(&picture)],
                &format!("{number} everywhere"),
            );
        }
    }
    // The guard was needed.
    assert!(impossible > 0);
}

#[test]
fn a_medium_of_no_number_is_no_fog() {
    let gpu = gpu();
    let scene = Scene::across();
    let bound = bound(&gpu, &scene, true);
    let given = scene.parameters();
    for colour in 0..3 {
        let mut media = [given.composite.medium; 3];
        media[0].extinction[colour] = f32::NAN;
        media[1].scattering[colour] = f32::NAN;
        media[2].irradiance[colour] = f32::INFINITY;
        for medium in media {
            let composite = CompositeScatteringParameters {
                medium,
                ..given.composite
            };
            let blocks = [
                ("rectify", bytes_of(&given.rectify)),
                ("integrate", bytes_of(&given.integrate)),
                ("composite", bytes_of(&composite)),
            ];
            let layers = bound.run(&gpu, &blocks, "scattering");
            let pixels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&layers[0]);
            assert!(
                pixels.iter().all(|&pixel| pixel == [0.0, 0.0, 0.0, 1.0]),
                "{medium:?}"
            );
        }
    }
}

#[test]
fn negative_extinction_counts_as_none() {
    let gpu = gpu();
    let scene = Scene::across();
    let bound = bound(&gpu, &scene, true);
    let mut given = scene.parameters();
    let mut pictures = [-3.0_f32, 0.0].map(|extinction| {
        given.composite.medium.extinction = [extinction; 3];
        given.integrate.extinction = extinction;
        let blocks = [
            ("rectify", bytes_of(&given.rectify)),
            ("integrate", bytes_of(&given.integrate)),
            ("composite", bytes_of(&given.composite)),
        ];
        bound.run(&gpu, &blocks, "scattering").remove(0)
    });
    let none: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&pictures[1]);
    assert!(none.iter().all(|pixel| pixel[3] == 1.0 && pixel[0] > 0.0));
    let [negative, none] = &mut pictures;
    assert!(negative == none);
}

#[test]
fn a_dark_medium_and_a_blinding_light_stay_within_float16() {
    let gpu = gpu();
    let scene = Scene::across();
    let bound = bound(&gpu, &scene, true);
    let mut given = scene.parameters();
    given.composite.medium.irradiance = [1e9; 3];
    given.composite.medium.scattering = [1e9, 0.0, 1e-9];
    let blocks = [
        ("rectify", bytes_of(&given.rectify)),
        ("integrate", bytes_of(&given.integrate)),
        ("composite", bytes_of(&given.composite)),
    ];
    let layers = bound.run(&gpu, &blocks, "scattering");
    let pixels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&layers[0]);
    let lit = pixels.iter().filter(|pixel| pixel[0] == 65504.0).count();
    assert!(2 * lit > pixels.len(), "{lit} of {}", pixels.len());
    assert!(
        pixels
            .iter()
            .all(|pixel| pixel[1] == 0.0 && pixel[2] < 10.0)
    );
}
