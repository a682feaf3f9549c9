//! Where rays of a rectified map are looked up in the light's map, and pixels in an integrated one.

use bytemuck::bytes_of;
use glam::{DMat4, DVec3, DVec4};
use moment_shadows::{MapEncoding, RectifiedView, Storage, Technique};

use crate::pictures::{FAR, MAP, PICTURE, Scene};
use crate::stage::{capabilities, gpu, run, sky, upload};

const GRAPH: &str = r#"{
  "version": 2,
  "imports": [{ "name": "map" }, { "name": "camera_depth" }],
  "nodes": [
    { "name": "composite", "type": "composite_scattering", "properties": { "format": "rgba32float" } }
  ],
  "edges": [
    { "from": "map", "to": "composite.integrated" },
    { "from": "camera_depth", "to": "composite.camera_depth" }
  ],
  "outputs": [{ "name": "scattering", "from": "composite.scattering" }]
}"#;

const RECTIFY: &str = r#"{
  "version": 2,
  "imports": [{ "name": "map" }],
  "nodes": [
    { "name": "rectify", "type": "rectify_moments",
      "properties": { "technique": "hamburger4", "storage": "float32", "extent": [6, 5] } }
  ],
  "edges": [{ "from": "map", "to": "rectify.map" }],
  "outputs": [{ "name": "rectified", "from": "rectify.rectified" }]
}"#;

/// Columns and rows of that.
const RECTIFIED: [u32; 2] = [6, 5];

/// The rectified map that a map of raw moments gives.
fn rectified(scene: &Scene, texels: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let gpu = gpu();
    let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float32).unwrap();
    let map = upload(&gpu, &encoding, [MAP; 2], texels);
    let layers = run(
        &gpu,
        &capabilities(&gpu),
        RECTIFY,
        &[("map", &map)],
        &[("rectify", bytes_of(&scene.parameters().rectify))],
        "rectified",
    );
    bytemuck::pod_collect_to_vec(&layers[0])
}

/// The radius of the ray of each texel of a rectified map, and where that ray meets the plane through the camera, in the light's
/// clip space. Columns are looked up in their middles, the first and the last row at the ends of the frame.
fn rays(scene: &Scene, view: &RectifiedView) -> Vec<(f64, DVec3)> {
    let matrix = scene.light().clip_from_world;
    let matrix = DMat4::from_cols_array_2d(&matrix.map(|column| column.map(f64::from)));
    let frame = view.frame;
    let [first, second, _] = view.axes.map(DVec3::from_array);
    (0..RECTIFIED[0] * RECTIFIED[1])
        .map(|index| {
            let [column, row] = [index % RECTIFIED[0], index / RECTIFIED[0]].map(f64::from);
            let across = (column + 0.5) / f64::from(RECTIFIED[0]);
            let radius = across * f64::from(frame.largest_radius);
            let down = row / f64::from(RECTIFIED[1] - 1);
            let azimuth = f64::from(frame.first_azimuth) + down * f64::from(frame.azimuth_extent);
            let across = azimuth.cos() * first + azimuth.sin() * second;
            let at = DVec3::from_array(view.camera) + radius * across;
            (radius, matrix.project_point3(at))
        })
        .collect()
}

fn view(scene: &Scene) -> RectifiedView {
    let light = scene.light_direction().to_array();
    RectifiedView::new(&scene.camera().clip_from_world, FAR, light).unwrap()
}

#[test]
fn rays_are_looked_up_where_they_meet_the_lights_map() {
    let scene = Scene::across();
    let rays = rays(&scene, &view(&scene));
    for axis in [0, 1] {
        // A part that grows from 0 to 1 across the map is in front of all view rays, the rest behind.
        let texels: Vec<[f32; 4]> = (0..MAP * MAP)
            .map(|index| [index % MAP, index / MAP][axis])
            .map(|place| 1.0 - 2.0 * (place as f32 + 0.5) / MAP as f32)
            .map(|mean| [mean, 1.0, mean, 1.0])
            .collect();
        for (found, (_, clip)) in rectified(&scene, &texels).into_iter().zip(&rays) {
            let place = [0.5 + 0.5 * clip.x, 0.5 - 0.5 * clip.y][axis];
            // Samplers may have weights of 8 bits.
            let error = f64::from(found[0]) - (1.0 - 2.0 * place);
            assert!(error.abs() < 1e-4, "{clip}: {error}");
        }
    }
}

#[test]
fn depths_of_the_light_become_inclinations() {
    let scene = Scene::across();
    let view = view(&scene);
    let [low, high] = [
        view.frame.smallest_inclination,
        view.frame.largest_inclination,
    ]
    .map(f64::from);
    let mut inner = 0;
    for depth in [-0.9_f32, -0.2, 0.1, 0.4, 0.6, 0.95] {
        let texel = [1, 2, 3, 4].map(|power| depth.powi(power));
        let found = rectified(&scene, &vec![texel; (MAP * MAP) as usize]);
        for (found, (radius, clip)) in found.into_iter().zip(rays(&scene, &view)) {
            // 70 scene units for moment depth from -1 to 1.
            let along = (f64::from(depth) - (2.0 * clip.z - 1.0)) * 35.0;
            // The first column is that of view rays along the light.
            let first = radius < f64::from(view.frame.largest_radius) / f64::from(RECTIFIED[0]);
            let inclination = if first { 0.0 } else { radius }.atan2(along);
            let expected = (2.0 * (high - inclination) / (high - low) - 1.0).clamp(-1.0, 1.0);
            // View rays are moved by a twentieth of their depth to the near end; here occluders are moved the other way.
            let expected = ((expected + 0.05) / 0.95).min(1.0);
            inner += usize::from(expected.abs() < 0.9);
            // A single surface is as wide as the smallest variance, 1e-7.
            let error = f64::from(found[0]) - expected;
            assert!(error.abs() < 1e-3, "{depth} at {radius}: {error}");
        }
    }
    assert!(inner > 40, "{inner}");
}

/// Few enough that half a texel is much.
const SIZE: u32 = 5;

/// The picture under a map whose texels are in shadow by a part.
fn picture(scene: &Scene, part: impl Fn(u32, u32) -> f32) -> Vec<[f32; 4]> {
    let gpu = gpu();
    let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float32).unwrap();
    let camera_depth = sky(&gpu, PICTURE);
    let parameters = scene.parameters();
    let texels: Vec<[f32; 4]> = (0..SIZE * SIZE)
        .map(|index| part(index % SIZE, index / SIZE))
        // Occluders in front of all view rays, or behind.
        .map(|front| [1.0 - 2.0 * front, 1.0, 1.0 - 2.0 * front, 1.0])
        .collect();
    let map = upload(&gpu, &encoding, [SIZE; 2], &texels);
    let layers = run(
        &gpu,
        &capabilities(&gpu),
        GRAPH,
        &[("map", &map), ("camera_depth", &camera_depth)],
        &[("composite", bytes_of(&parameters.composite))],
        "scattering",
    );
    bytemuck::pod_collect_to_vec(&layers[0])
}

/// The shadow of each pixel.
fn shadows(scene: &Scene, part: impl Fn(u32, u32) -> f32) -> Vec<f64> {
    let pairs = picture(scene, part)
        .into_iter()
        .zip(picture(scene, |_, _| 0.0));
    pairs
        .map(|(shadowed, lit)| 1.0 - f64::from(shadowed[0]) / f64::from(lit[0]))
        .collect()
}

/// From the camera to the far end of each pixel's view ray.
fn ends(scene: &Scene, view: &RectifiedView) -> Vec<DVec3> {
    let pair = scene.camera();
    let eye = DVec3::from_array(view.camera);
    let along = |x: f64, y: f64| {
        let point = pair.world_from_clip * DVec4::new(x, y, 1.0, 1.0);
        point.truncate() / point.w - eye
    };
    let axis = along(0.0, 0.0).normalize();
    let [width, height] = PICTURE.map(f64::from);
    (0..PICTURE[0] * PICTURE[1])
        .map(|index| {
            let [x, y] =
                [index % PICTURE[0], index / PICTURE[0]].map(|place| f64::from(place) + 0.5);
            let ray = along(2.0 * x / width - 1.0, 1.0 - 2.0 * y / height);
            ray * (FAR / ray.dot(axis))
        })
        .collect()
}

/// Radius and azimuth of those, from 0 to 1 across the frame.
fn places(scene: &Scene) -> Vec<[f64; 2]> {
    let view = view(scene);
    let place = |end: DVec3| {
        let [first, second, _] = view.axes.map(|axis| DVec3::from_array(axis).dot(end));
        let turned = second.atan2(first) - f64::from(view.frame.first_azimuth);
        [
            first.hypot(second) / f64::from(view.frame.largest_radius),
            turned.rem_euclid(core::f64::consts::TAU) / f64::from(view.frame.azimuth_extent),
        ]
    };
    ends(scene, &view).into_iter().map(place).collect()
}

/// What a bias and f32 make of a shadow.
const TOLERANCE: f64 = 2e-3;

#[test]
fn rows_are_azimuths_from_end_to_end() {
    let scene = Scene::across();
    let found = shadows(&scene, |_, row| row as f32 / (SIZE - 1) as f32);
    let mut range = [1.0_f64, 0.0];
    for (found, [_, row]) in found.into_iter().zip(places(&scene)) {
        assert!((found - row).abs() < TOLERANCE, "{found}, not {row}");
        range = [range[0].min(row), range[1].max(row)];
    }
    assert!(range[0] < 0.1 && range[1] > 0.9, "{range:?}");
}

#[test]
fn a_column_serves_view_rays_that_end_in_the_middle_of_the_next() {
    let scene = Scene::across();
    let columns = f64::from(SIZE);
    let found = shadows(&scene, |column, _| {
        (column as f32 + 1.5) / (SIZE + 1) as f32
    });
    let mut range = [1.0_f64, 0.0];
    for (found, [column, _]) in found.into_iter().zip(places(&scene)) {
        // Up to there of the first one there is nothing to interpolate with.
        let expected = (columns * column).max(1.5) / (columns + 1.0);
        assert!(
            (found - expected).abs() < TOLERANCE,
            "{found}, not {expected}"
        );
        range = [range[0].min(column), range[1].max(column)];
    }
    assert!(range[0] < 0.8 && range[1] > 0.95, "{range:?}");
}

#[test]
fn transmittance_is_the_mean_over_the_colours() {
    let scene = Scene::across();
    let extinction = scene.parameters().composite.medium.extinction;
    assert!(extinction[0] < extinction[1] && extinction[1] < extinction[2]);
    let pixels = picture(&scene, |_, _| 0.5);
    for (pixel, end) in pixels.into_iter().zip(ends(&scene, &view(&scene))) {
        let colours = extinction.map(|colour| (-f64::from(colour) * end.length()).exp());
        let expected = colours.iter().sum::<f64>() / 3.0;
        let error = f64::from(pixel[3]) - expected;
        assert!(error.abs() < 1e-5, "{} for {expected}", pixel[3]);
    }
}
