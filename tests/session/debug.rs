//! Debug views of nodes that shade: each shows what it says.

use glam::{DMat4, DVec3};
use moment_shadows::{LightSize, LightView};
use moment_shadows_lab::frame::Frame;
use moment_shadows_lab::gpu::Gpu;

use crate::views::{cascades, frame, in_one_map_by, seen, within};
use crate::{HARD, gpu, imports, places, recorded, session};

/// The colour of a number from 0 to 1: blue, green, red.
fn part_of([red, green, blue]: [u8; 3]) -> f64 {
    let [red, green, blue] = [red, green, blue].map(|byte| f64::from(byte) / 255.0);
    assert!(
        (red + green + blue - 1.0).abs() < 0.02,
        "{red} {green} {blue}"
    );
    0.5 + 0.5 * (red - blue)
}

/// Colours, all of which hide what is behind them.
fn pixels(bytes: &[u8]) -> Vec<[u8; 3]> {
    assert!(bytes.iter().skip(3).step_by(4).all(|&alpha| alpha == 255));
    bytes
        .chunks_exact(4)
        .map(|texel| [texel[0], texel[1], texel[2]])
        .collect()
}

#[test]
fn cascades_have_a_hue_each() {
    let gpu = gpu();
    let frame = frame(&gpu, DVec3::new(1.0, 3.0, 0.0), DVec3::new(4.0, 0.0, 4.0));
    let (camera, _) = places(&frame);
    let views = cascades(&camera, 5, 0.0);
    let graph = HARD.replace("shade.shadow_intensity", "shade.debug");
    let shown = in_one_map_by(&graph, &gpu, &frame, &camera, views.clone());
    // Four bytes each.
    let shown = pixels(bytemuck::cast_slice(&shown));
    let mut hues = [None; 4];
    let mut counts = [0; 4];
    for (pixel, &colour) in shown.iter().enumerate() {
        let Some(point) = seen(&camera, frame.desc.picture, pixel) else {
            continue;
        };
        let inside: Vec<f64> = views.iter().map(|view| within(view, point)).collect();
        // The rounding of places decides right at a border.
        if inside.iter().any(|it| (it + 1.0 / 16.0).abs() < 0.07) {
            continue;
        }
        let first = inside.iter().position(|&it| it > 0.0).unwrap_or(3);
        assert_eq!(*hues[first].get_or_insert(colour), colour, "{first}");
        counts[first] += 1;
    }
    println!("{hues:?} {counts:?}");
    assert!(counts.iter().all(|&count| count > 100));
    // The first is red: a hue that is 0 of a turn, of which 0.15 is white.
    assert_eq!(hues[0], Some([255, 38, 38]));
    // Grey where none contains the pixel.
    assert_eq!(hues[3], Some([51; 3]));
    for other in 0..3 {
        assert_eq!(hues.iter().filter(|hue| **hue == hues[other]).count(), 1);
    }
}

/// What a node that shades the floor of boards shows of itself.
fn shown(
    gpu: &Gpu,
    frame: &Frame,
    nodes: &[(&str, &str)],
    light: &LightView,
    show: &str,
) -> Vec<[u8; 3]> {
    let (camera, _) = places(frame);
    let mut text = HARD.replace(
        r#"{ "name": "shadow_intensity", "from""#,
        r#"{ "name": "debug", "from": "shade.debug" }, { "name": "shadow_intensity", "from""#,
    );
    for (from, to) in nodes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, &to.replace("SHOW", show));
    }
    let mut session = session(gpu, &text, &imports(frame));
    session.view(&gpu.queue, 0, &camera, &[*light]).unwrap();
    pixels(&recorded(gpu, &session, 0, "debug"))
}

const BLURRED: [(&str, &str); 1] = [(
    r#""type": "shade_hard""#,
    r#""type": "shade_hard", "properties": { "debug": "SHOW" }"#,
)];

const SOFT: [(&str, &str); 4] = [
    (
        r#""type": "blur", "properties": { "kernel": { "radius": 4, "sigma": 2.4 } }"#,
        r#""type": "summed_area_table", "properties": { "largest_kernel": 65 }"#,
    ),
    ("blur.blurred", "blur.table"),
    ("shade.map", "shade.table"),
    (
        r#""type": "shade_hard""#,
        r#""type": "shade_soft", "properties": { "debug": "SHOW" }"#,
    ),
];

#[test]
fn texels_and_filters_are_measured_in_pixels() {
    let gpu = gpu();
    let frame = crate::frame(&gpu, 0, [160, 90]);
    let (_, light) = places(&frame);
    let show = |what| shown(&gpu, &frame, &BLURRED, &light, what);
    let [texels, filter, range] = ["texels", "filter", "range"].map(show);
    let mut compared = 0;
    for (texels, filter) in texels.iter().zip(&filter) {
        if *texels == [0; 3] || *texels == [51; 3] {
            continue;
        }
        // Texels per pixel, and pixels of the filter's standard deviation: its product is that in texels.
        let [per_pixel, wide] = [6.0 * part_of(*texels) - 3.0, 8.0 * part_of(*filter) - 2.0];
        let clamped = per_pixel.abs() > 2.9 || !(-1.9..5.9).contains(&wide);
        if !clamped {
            let deviation = (per_pixel + wide).exp2();
            // Of the kernel of 2.4 texels, cut off, with a lookup.
            assert!((deviation - 2.12).abs() < 0.15, "{deviation}");
            compared += 1;
        }
    }
    println!("{compared} pixels");
    assert!(compared > 3000);
    let grey = range
        .iter()
        .filter(|it| it[0] == it[1] && it[1] == it[2] && it[0] > 60);
    assert!(grey.count() > 3000);
}

#[test]
fn range_is_black_at_its_near_end_white_at_its_far_end_and_red_before() {
    let gpu = gpu();
    let frame = crate::frame(&gpu, 0, [160, 90]);
    let (_, light) = places(&frame);
    let sun = frame.desc.light;
    let positions = &frame.surface.position;
    let positions = gpu.read_texture(positions, 0, "positions").unwrap();
    let positions: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&positions);
    // Moment depth where there is a surface within the light's map.
    let depth = |[x, y, z, seen]: [f32; 4]| {
        let point = DVec3::new(x.into(), y.into(), z.into());
        let uv = sun.uv(point)?;
        let inside = uv.min_element() > 0.01 && uv.max_element() < 0.99;
        (seen != 0.0 && inside).then(|| sun.moment_depth(point))
    };
    let depths: Vec<Option<f64>> = positions.into_iter().map(depth).collect();
    let mut sorted: Vec<f64> = depths.iter().copied().flatten().collect();
    sorted.sort_by(f64::total_cmp);
    let median = sorted[sorted.len() / 2];
    let clip = DMat4::from_cols_array_2d(&light.clip_from_world);
    let (mut greys, mut reds) = (0, 0);
    // The range is moved until half of all surfaces lie farther than that.
    for middle in [0.0, -0.75, -1.25] {
        // Of stored depth, half as much.
        let by = middle - median;
        let moved = DMat4::from_translation(0.5 * by * DVec3::Z) * clip;
        let light = LightView {
            clip_from_world: moved.to_cols_array_2d(),
            ..light
        };
        let shown = shown(&gpu, &frame, &BLURRED, &light, "range");
        for (depth, colour) in depths.iter().zip(shown) {
            let Some(depth) = depth.map(|depth| depth + by) else {
                continue;
            };
            let [red, green, blue] = colour.map(|byte| f64::from(byte) / 255.0);
            if depth < -1.01 {
                let off = (red - 1.0).abs() + (green - 0.2).abs() + (blue - 0.1).abs();
                assert!(off < 0.02, "{depth}: {colour:?}");
                reds += 1;
            } else if (-0.98..0.98).contains(&depth) {
                // Half a step of bytes, and what the light's depth is rounded by.
                let off = (red - (0.5 + 0.5 * depth)).abs();
                assert!(
                    off < 0.01 && red == green && green == blue,
                    "{depth}: {colour:?}"
                );
                greys += 1;
            }
        }
    }
    println!("{greys} grey, {reds} red");
    assert!(greys > 3000 && reds > 1000, "{greys} {reds}");
}

#[test]
fn penumbrae_grow_with_the_light_and_with_the_distance_of_blockers() {
    let gpu = gpu();
    let frame = crate::frame(&gpu, 0, [160, 90]);
    let (_, light) = places(&frame);
    let sized = |degrees: f64| LightView {
        size: LightSize::AngularDiameter(degrees.to_radians()),
        ..light
    };
    let wide = |degrees| -> Vec<f64> {
        let shown = shown(&gpu, &frame, &SOFT, &sized(degrees), "penumbra");
        let width = |colour: &[u8; 3]| match *colour {
            [0, 0, 0] | [51, 51, 51] => 0.0,
            colour => (6.0 * part_of(colour) - 1.0).exp2(),
        };
        shown.iter().map(width).collect()
    };
    // Beyond the smallest filter, and within the largest.
    let pairs = wide(3.0).into_iter().zip(wide(6.0));
    let within = pairs.filter(|(small, large)| *small > 1.5 && *large < 24.0);
    let mut ratios: Vec<f64> = within.map(|(small, large)| large / small).collect();
    ratios.sort_by(f64::total_cmp);
    let median = ratios[ratios.len() / 2];
    println!(
        "{} penumbrae, {median:.2} times as wide for twice the light",
        ratios.len()
    );
    assert!(ratios.len() > 100 && (median - 2.0).abs() < 0.2, "{median}");
    let blockers = shown(&gpu, &frame, &SOFT, &sized(10.0), "blockers");
    let none = blockers
        .iter()
        .filter(|colour| **colour == [0, 0, 153])
        .count();
    let some = blockers
        .iter()
        .filter(|colour| colour[0] == colour[2] && colour[0] > 60);
    assert!(none > 500 && some.count() > 500);
}

#[test]
fn layers_have_a_hue_each_and_what_a_technique_lacks_is_named() {
    let gpu = gpu();
    let frame = crate::frame(&gpu, 0, [160, 90]);
    let (_, light) = places(&frame);
    let layered = |show: &str| {
        let storage = r#"{ "storage": ["unorm16", "float16"] }"#;
        let lvsm = r#"{ "technique": { "lvsm": { "layers": 4 } }, "storage": "float32" }"#;
        let nodes = [(storage, lvsm), BLURRED[0]];
        shown(&gpu, &frame, &nodes, &light, show)
    };
    let mut hues = layered("layer");
    hues.sort_unstable();
    let mut counts: Vec<usize> = hues.chunk_by(|a, b| a == b).map(<[_]>::len).collect();
    counts.sort_unstable();
    // Of four layers three hold many pixels each; the rest are mixtures.
    assert!(
        counts.iter().rev().take(3).all(|&count| count > 200),
        "{counts:?}"
    );
    for (show, lacks) in [("layer", "layers"), ("penumbra", "a search for blockers")] {
        let text = HARD.replace(BLURRED[0].0, &BLURRED[0].1.replace("SHOW", show));
        let imports = imports(&frame);
        let session = moment_shadows_graph::Session::new(
            &gpu.adapter,
            &gpu.device,
            crate::parsed(&text),
            &imports,
            Default::default(),
        );
        let found = pollster::block_on(session).unwrap_err().to_string();
        assert!(
            found.contains("'debug'") && found.contains(lacks),
            "{found}"
        );
    }
}
