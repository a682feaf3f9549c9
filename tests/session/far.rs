//! Far from the origin shadows stay where they are: matrices are f64 until camera and light are combined.

use glam::dcamera::rh::proj::directx::{orthographic, perspective_infinite_reverse};
use glam::dcamera::rh::view::look_at_mat4;
use glam::{DMat4, DVec3, DVec4};
use moment_shadows::{CameraView, LeakReduction, LightView, ReceiverBias, ViewParameters};

const MAP: f64 = 2048.0;

/// The parameters of a camera and a sun around (t, 0, t).
fn parameters(t: f64) -> ViewParameters {
    let there = DVec3::new(t, 0.0, t);
    let camera = perspective_infinite_reverse(0.9, 1.6, 0.1)
        * look_at_mat4(there + DVec3::new(3.0, 2.0, 5.0), there, DVec3::Y);
    let sun = orthographic(-7.0, 7.0, -7.0, 7.0, 0.0, 20.0)
        * look_at_mat4(there + DVec3::new(4.0, 9.0, -2.0), there, DVec3::Y);
    let camera = CameraView {
        clip_from_world: camera.to_cols_array_2d(),
        far_depth: 0.0,
    };
    let light = LightView::orthographic(sun.to_cols_array_2d());
    ViewParameters::new(&camera, &light, ReceiverBias::NONE, LeakReduction::NONE).unwrap()
}

/// Where a pixel at a distance from the camera is in the map, in texels, and its moment depth.
fn place(of: &ViewParameters, x: f64, y: f64, distance: f64) -> [f64; 3] {
    let wide = |column: [f32; 4]| DVec4::from_array(column.map(f64::from));
    let clip = DVec4::new(x, y, 0.1 / distance, 1.0);
    let [a, b, c, d] = of.light_from_camera.map(wide);
    let light = DMat4::from_cols(a, b, c, d) * clip;
    let scene_w = wide(of.scene_w_from_camera).dot(clip);
    [
        MAP * light.x / light.z,
        MAP * light.y / light.z,
        light.w / scene_w,
    ]
}

#[test]
fn shadows_stay_in_place_however_far_the_origin_is() {
    let here = parameters(0.0);
    for t in [1e3, 1e5, 1e6, 6e6] {
        let there = parameters(t);
        let mut largest: [f64; 2] = [0.0; 2];
        for index in 0..1000 {
            let along = |step: f64| 2.0 * (step * f64::from(index)).fract() - 1.0;
            let (x, y) = (along(0.754_877_67), along(0.569_840_29));
            let distance = 0.5 + 9.0 * f64::from(index) / 1000.0;
            let [expected, found] = [&here, &there].map(|of| place(of, x, y, distance));
            let texels = (found[0] - expected[0]).hypot(found[1] - expected[1]);
            largest[0] = largest[0].max(texels);
            largest[1] = largest[1].max((found[2] - expected[2]).abs());
        }
        // Rows of what gives positions from the camera on: they are of its size.
        let rows = [&here, &there].map(|of| of.position_from_camera);
        let entries = rows[0].as_flattened().iter().zip(rows[1].as_flattened());
        let moved = entries.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(moved < 1e-5, "{t:e}: {moved}");
        println!(
            "{t:e}: {:.2e} texels, {:.2e} moment depth",
            largest[0], largest[1]
        );
        assert!(largest[0] < 0.01 && largest[1] < 1e-6, "{t:e}: {largest:?}");
    }
}
