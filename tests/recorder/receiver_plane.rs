//! Receivers that slope along the map: filters on the plain depth map compare each tap with the receiver's plane there.

use moment_shadows::{AreaLight, DepthRange, LightSize, ReceiverBias, TextureFormat};
use moment_shadows_lab::techniques;

use crate::depth_map;
use crate::depth_tests::{picture, view};
use crate::setup::gpu;

/// A pixel per texel.
const SIDE: u32 = 32;

/// What filters leave of the picture: their reach, four texels for fixed kernels and six for the light below, stays within.
const BORDER: u32 = 7;

/// Samples of the camera's depth, and where in a pixel the first of them lies, which is shaded.
const CAMERAS: [(u32, [f32; 2]); 2] = [(1, [0.5, 0.5]), (4, [0.375, 0.125])];

#[test]
fn a_floor_that_slopes_either_way_is_lit_and_what_lies_behind_it_is_not() {
    let gpu = gpu();
    // Only rounding is to be covered: a step of depth is 6e-8, and a plane that leans the wrong way is off by more than a
    // hundredth at the first texel. Gradients count up to a thousand.
    let bias = ReceiverBias {
        constant: 1e-4,
        slope_scale: 1e-3,
        maximum: 1.0,
        ..ReceiverBias::NONE
    };
    let mut view = view(false, bias);
    let range = DepthRange {
        near: 0.0,
        far: 1.0,
    };
    let radii = 1.0..=6.0;
    view.light = AreaLight::new(
        LightSize::AngularDiameter(1.0),
        [1.0 / f64::from(SIDE); 2],
        range,
        radii,
    )
    .unwrap();
    for technique in techniques::reading_depth() {
        // Stored depth per texel along u and v. With both, neither sign nor axis is left to chance.
        for [u, v] in [[0.0, 0.01], [0.0, -0.01], [-0.008, 0.005_f32]] {
            let middle = 0.5 * SIDE as f32 - 0.5;
            // At a place in texel (x, y).
            let floor = |x: u32, y: u32, place: [f32; 2]| {
                let [x, y] = [x as f32 + place[0], y as f32 + place[1]];
                0.5 + u * (x - 0.5 - middle) + v * (y - 0.5 - middle)
            };
            let map = depth_map::of(&gpu, [SIDE; 2], |x, y| floor(x, y, [0.5; 2]));
            let cases = [(0.0, 0.0), (0.1, 1.0)].map(|case| CAMERAS.map(|camera| (case, camera)));
            for ((behind, expected), (samples, place)) in cases.into_iter().flatten() {
                let format = wgpu::TextureFormat::Depth32Float;
                let camera = depth_map::texture(&gpu, format, [SIDE; 2], 1, samples);
                // What hides a part of the floor from the camera leaves each pixel beside it one neighbour along the axis.
                let hidden = |x: u32, y: u32| [x, y].iter().all(|at| (12..20).contains(at));
                let depth = |x, y| floor(x, y, place) + if hidden(x, y) { -0.2 } else { behind };
                let depths = depth_map::values([SIDE; 2], depth);
                let depths = depths
                    .into_iter()
                    .flat_map(|depth| vec![depth; samples as usize]);
                depth_map::draw(&gpu, &camera, 0, &depths.collect::<Vec<_>>());
                let map = (&map, TextureFormat::Depth32Float);
                let found = picture(&gpu, &technique, map, &camera, &view);
                for (index, &intensity) in found.iter().enumerate() {
                    let place = [index as u32 % SIDE, index as u32 / SIDE];
                    let outside = place.iter().any(|&at| at.min(SIDE - 1 - at) < BORDER);
                    if outside || hidden(place[0], place[1]) {
                        continue;
                    }
                    // Sums of weights may miss one by their rounding.
                    assert!(
                        (intensity - expected).abs() < 1e-5,
                        "{}, slope {u}, {v}, {behind} behind, {samples} samples: {intensity} at {place:?}",
                        techniques::label(&technique)
                    );
                }
            }
        }
    }
}
