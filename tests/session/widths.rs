//! Filters whose width is given in scene units: penumbrae are as wide in the scene, however large texels are.

use glam::{DMat4, DVec3, DVec4};
use moment_shadows::{Atlas, LightSize, LightView, MapRegion, TextureFormat};
use moment_shadows_lab::gpu::Gpu;

use crate::normals::texture;
use crate::views::{frame, seen};
use crate::{HARD, gpu, imports, places, recorded, session};

const SOFT: &str = include_str!("../../examples/soft_shadows.json");

/// The light's maps cover this much of the floor, in so many texels each.
const SIDE: f64 = 5.0;
const TEXELS: [u32; 3] = [384, 192, 96];

/// Where the floor is in shadow of a board one unit above it.
fn edge_at(z: f64) -> f64 {
    0.05 + 0.37 * z
}

/// Lights straight above, whose maps have texels of different sizes.
fn lights(size: LightSize) -> (Atlas, Vec<LightView>) {
    let clip = DMat4::from_cols(
        DVec4::new(2.0 / SIDE, 0.0, 0.0, 0.0),
        DVec4::new(0.0, 0.0, -0.25, 0.0),
        DVec4::new(0.0, -2.0 / SIDE, 0.0, 0.0),
        DVec4::new(0.0, 0.0, 0.5, 1.0),
    );
    let views = (0..).zip(TEXELS).map(|(channel, texels)| LightView {
        channel,
        region: MapRegion::new([0; 2], [texels; 2]),
        size,
        ..LightView::orthographic(clip.to_cols_array_2d())
    });
    let mut views: Vec<LightView> = views.collect();
    let atlas = Atlas {
        size: [576, 384],
        layers: 1,
    };
    atlas.place(&mut views).unwrap();
    (atlas, views)
}

/// Their depth maps, of the board and the floor.
fn drawn(gpu: &Gpu, atlas: &Atlas, views: &[LightView]) -> wgpu::Texture {
    let [width, height] = atlas.size;
    let mut texels = vec![1.0_f32; (width * height) as usize];
    for view in views {
        let MapRegion { origin, extent } = view.region;
        for (x, y) in (0..extent[0]).flat_map(|x| (0..extent[1]).map(move |y| (x, y))) {
            let [u, v] = [(x, 0), (y, 1)]
                .map(|(texel, axis)| (f64::from(texel) + 0.5) / f64::from(extent[axis]) - 0.5);
            let board = SIDE * u < edge_at(SIDE * v);
            let place = (origin[1] + y) * width + origin[0] + x;
            texels[place as usize] = if board { 0.25 } else { 0.5 };
        }
    }
    let bytes = bytemuck::cast_slice(&texels);
    texture(gpu, TextureFormat::R32Float, atlas.size, bytes)
}

/// A graph of these three lights.
fn graph(text: &str, shade: &str) -> String {
    let import = r#""texture": { "format": "r32float", "size": [64, 64], "regions": 3 }"#;
    let depth = r#""texture": { "format": "depth32float", "size": [1024, 1024], "samples": 4 }"#;
    let of_all = r#""properties": { "format": "rgba32float", "lights": 3, "views": 3 }"#;
    let storages = r#""storage": ["unorm16", "float16"]"#;
    text.replace(depth, import)
        .replace(storages, r#""storage": "float32""#)
        .replace(
            &format!(r#""type": "{shade}""#),
            &format!(r#""type": "{shade}", {of_all}"#),
        )
}

/// How wide the edge's penumbra is in scene units in the map of each light, from a tenth to nine tenths.
fn penumbrae(gpu: &Gpu, text: &str, size: LightSize) -> [f64; 3] {
    let frame = frame(gpu, DVec3::new(0.0, 2.0, 0.1), DVec3::ZERO);
    let (camera, _) = places(&frame);
    let (atlas, views) = lights(size);
    let map = drawn(gpu, &atlas, &views);
    let mut imports = imports(&frame);
    imports[0].1 = (&map).into();
    let mut session = session(gpu, text, &imports);
    session.view(&gpu.queue, 0, &camera, &views).unwrap();
    let picture: Vec<[f32; 4]> =
        bytemuck::pod_collect_to_vec(&recorded(gpu, &session, 0, "shadow_intensity"));
    let points = (0..picture.len()).filter_map(|pixel| {
        let point = seen(&camera, frame.desc.picture, pixel)?;
        // Across the edge; far from the maps' borders.
        let across = (point.x - edge_at(point.z)) / 1.0_f64.hypot(0.37);
        (point.z.abs() < 0.7 && across.abs() < 0.7).then_some((across, picture[pixel]))
    });
    let points: Vec<(f64, [f32; 4])> = points.collect();
    [0, 1, 2].map(|light| {
        // A distribution's quantile: how far the shadow reaches in the mean where it is at least so dark.
        let reach = |intensity: f32| {
            let mut steps: Vec<(f64, bool)> = points
                .iter()
                .map(|(across, all)| (*across, all[light] >= intensity))
                .collect();
            steps.sort_by(|a, b| a.0.total_cmp(&b.0));
            // The place that parts the pixels best.
            let darker = steps.iter().filter(|(_, dark)| *dark).count();
            steps[darker].0
        };
        reach(0.1) - reach(0.9)
    })
}

#[test]
fn a_width_in_scene_units_is_that_of_every_region() {
    let gpu = gpu();
    // 9, 5 and 2 texels.
    let [same, texels] = [
        r#"{ "radius": 20, "width": 0.12 }"#,
        r#"{ "radius": 18, "sigma": 10.0 }"#,
    ]
    .map(|kernel| {
        let text = HARD.replace(r#"{ "radius": 4, "sigma": 2.4 }"#, kernel);
        penumbrae(&gpu, &graph(&text, "shade_hard"), LightSize::Point)
    });
    let beside = |all: [f64; 3]| [1, 2].map(|light| all[light] / all[0]);
    println!(
        "in scene units {same:.3?}, beside the first {:.3?}; in texels {texels:.3?}, {:.3?}",
        beside(same),
        beside(texels)
    );
    assert!(beside(same).iter().all(|ratio| (ratio - 1.0).abs() <= 0.05));
    assert!((beside(texels)[1] - 4.0).abs() < 0.5);
    // A Gaussian's, of that standard deviation.
    assert!((same[0] / (2.563 * 0.12) - 1.0).abs() <= 0.03);
}

#[test]
fn a_penumbra_is_at_most_as_wide_as_the_largest_kernel_of_the_table() {
    let gpu = gpu();
    // Of a sun so wide that it would be 84, 42 and 21 texels.
    let sun = LightSize::AngularDiameter(1.0);
    let texel = TEXELS.map(|texels| SIDE / f64::from(texels));
    // A filter of a kernel that is no square is as wide in both directions.
    for (kernel, largest) in [("9", 9.0), ("17", 17.0), ("[33, 9]", 9.0)] {
        let kernel = format!(r#""largest_kernel": {kernel}"#);
        let text = SOFT.replace(r#""largest_kernel": 129"#, &kernel);
        let found = penumbrae(&gpu, &graph(&text, "shade_soft"), sun);
        // A box across the edge has four fifths of its width between a tenth and nine tenths.
        let widths = [0, 1, 2].map(|light| found[light] / texel[light] / (0.8 * largest));
        println!("{kernel}: {widths:.3?}");
        assert!(
            widths.iter().all(|ratio| (ratio - 1.0).abs() < 0.1),
            "{kernel}: {widths:.3?}"
        );
    }
}

#[test]
fn a_width_beyond_the_largest_kernel_is_refused_by_name() {
    let gpu = gpu();
    let frame = frame(&gpu, DVec3::new(0.0, 2.0, 0.1), DVec3::ZERO);
    let (camera, mut light) = places(&frame);
    let kernel = r#"{ "radius": 3, "width": 0.5 }"#;
    let text = HARD.replace(r#"{ "radius": 4, "sigma": 2.4 }"#, kernel);
    let mut session = session(&gpu, &text, &imports(&frame));
    light.clip_from_world[0][0] *= 1000.0;
    let found = session.view(&gpu.queue, 0, &camera, &[light]).unwrap_err();
    let found = found.to_string();
    assert!(
        found.contains("view 0") && found.contains("'blur'"),
        "{found}"
    );
    assert!(found.contains("larger radius"), "{found}");
}
