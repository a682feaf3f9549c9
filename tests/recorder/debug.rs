//! `debug_moments`: each picture says of each texel what the map holds.

use moment_shadows::TextureFormat;
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_lab::gpu::Gpu;
use wgpu::util::DeviceExt as _;

use crate::setup::{bind, capabilities, compiled, gpu};

/// The picture of a map of float32 moments in one row.
fn picture(gpu: &Gpu, show: &str, moments: &[[f32; 4]]) -> Vec<[u8; 4]> {
    let size = [moments.len() as u32, 1];
    let text = format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "map" }}],
  "nodes": [{{ "name": "debug", "type": "debug_moments", "properties": {{ "show": "{show}" }} }}],
  "edges": [{{ "from": "map", "to": "debug.map" }}],
  "outputs": [{{ "name": "picture", "from": "debug.picture" }}]
}}"#
    );
    let desc = TextureDesc::new(TextureFormat::Rgba32Float, size);
    let plan = compiled(&text, &capabilities(gpu), &[("map", desc)]);
    let map = gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: Some("map"),
            size: wgpu::Extent3d {
                width: size[0],
                height: 1,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        bytemuck::cast_slice(moments),
    );
    let bound = bind(gpu, plan, &[("map", ImportedResource::from(&map))], &[]);
    bound.run(gpu);
    bytemuck::pod_collect_to_vec(&bound.read(gpu, "picture", 0))
}

/// The moments of depths with their weights.
fn moments(depths: &[(f32, f32)]) -> [f32; 4] {
    [1, 2, 3, 4].map(|power| {
        depths
            .iter()
            .map(|(z, weight)| weight * z.powi(power))
            .sum()
    })
}

#[test]
fn validity_tells_possible_from_repaired_impossible_and_broken() {
    let gpu = gpu();
    let single = moments(&[(0.25, 1.0)]);
    // Less than the variance that a distribution with this mean needs: by less, and by more than the bias adds.
    let rounded = [single[0], single[1] - 2e-7, single[2], single[3]];
    let impossible = [single[0], single[1] - 0.01, single[2], single[3]];
    let found = picture(
        &gpu,
        "validity",
        &[
            moments(&[(-0.5, 0.3), (0.1, 0.3), (0.7, 0.4)]),
            rounded,
            impossible,
            [f32::NAN, 0.0, 0.0, 0.0],
            [0.0, f32::INFINITY, 0.0, 0.0],
            [1.0; 4],
        ],
    );
    let [possible, repaired, impossible, nan, infinite, empty] = found[..] else {
        panic!("{} pixels", found.len());
    };
    assert!(
        possible[1] > possible[0] && possible[1] > possible[2],
        "green: {possible:?}"
    );
    assert!(
        repaired[0] > 200 && repaired[1] > 180 && repaired[2] < 50,
        "yellow: {repaired:?}"
    );
    assert_eq!(impossible, [255, 0, 0, 255]);
    assert_eq!((nan, infinite), ([255, 0, 255, 255], [255, 0, 255, 255]));
    assert!(
        empty[2] > empty[0] && empty[2] > empty[1],
        "blue: {empty:?}"
    );
}

#[test]
fn moments_of_enough_variance_are_impossible_where_their_determinant_is_negative() {
    let gpu = gpu();
    // Half of the weight each at -1/2 and 1/2: all moments are exact, the variance is 1/4 and the determinant 0.
    let two = moments(&[(-0.5, 0.5), (0.5, 0.5)]);
    let moved = |third: f32, fourth: f32| [two[0], two[1], two[2] + third, two[3] + fourth];
    // The determinant is the fourth moment's step / 4 less the square of the third one's.
    let cases = [
        (moved(0.0, 0.0), "green"),
        (moved(0.0, 1e-3), "green"),
        (moved(0.0, -1e-3), "red"),
        // The moment bias of float32 adds 9e-8 to the determinant, and this takes 3e-8.
        (moved(0.0, -1.2e-7), "yellow"),
        (moved(0.03, 1e-2), "green"),
        (moved(-0.03, 1e-2), "green"),
        (moved(0.03, 1e-3), "red"),
        (moved(-0.03, 1e-3), "red"),
    ];
    let found = picture(&gpu, "validity", &cases.map(|(moments, _)| moments));
    for ((moments, expected), [red, green, blue, _]) in cases.into_iter().zip(found) {
        let shown = match (red > 128, green > 128, blue > 128) {
            (true, false, false) => "red",
            (false, true, false) => "green",
            (true, true, false) => "yellow",
            _ => "another colour",
        };
        assert_eq!(shown, expected, "{moments:?}");
    }
}

#[test]
fn mean_deviation_and_moments_are_levels_of_grey_and_colour() {
    let gpu = gpu();
    let maps = [
        moments(&[(-1.0, 1.0)]),
        moments(&[(0.0, 1.0)]),
        moments(&[(-0.6, 0.5), (0.6, 0.5)]),
        moments(&[(-1.0, 0.5), (1.0, 0.5)]),
    ];
    // Within the rounding of 8 bits.
    let near = |found: u8, expected: f64| (f64::from(found) - 255.0 * expected).abs() <= 0.51;
    let expected_mean = [0.0, 0.5, 0.5, 0.5];
    for (pixel, expected) in picture(&gpu, "mean", &maps).into_iter().zip(expected_mean) {
        assert!(
            pixel[..3].iter().all(|&grey| near(grey, expected)),
            "{pixel:?} for {expected}"
        );
    }
    let expected_deviation = [0.0, 0.0, 0.6, 1.0];
    for (pixel, expected) in picture(&gpu, "deviation", &maps)
        .into_iter()
        .zip(expected_deviation)
    {
        assert!(
            pixel[..3].iter().all(|&grey| near(grey, expected)),
            "{pixel:?} for {expected}"
        );
    }
    let pixels = picture(&gpu, "moments", &maps);
    for (pixel, [b1, b2, b3, _]) in pixels.into_iter().zip(maps) {
        let expected = [0.5 * b1 + 0.5, b2, 0.5 * b3 + 0.5].map(f64::from);
        assert!(
            (0..3).all(|channel| near(pixel[channel], expected[channel])),
            "{pixel:?}"
        );
    }
}

#[test]
fn a_level_that_is_not_there_is_refused() {
    let text = r#"{
  "version": 2,
  "imports": [{ "name": "map" }],
  "nodes": [{ "name": "debug", "type": "debug_moments", "properties": { "level": 3 } }],
  "edges": [{ "from": "map", "to": "debug.map" }],
  "outputs": [{ "name": "picture", "from": "debug.picture" }]
}"#;
    let graph = moment_shadows_graph::Graph::parse(text, &Default::default()).unwrap();
    let desc = TextureDesc {
        mips: 3,
        ..TextureDesc::new(TextureFormat::Rgba16Float, [16, 16])
    };
    let imports = [("map", moment_shadows_graph::ResourceDesc::Texture(desc))];
    let native = moment_shadows_graph::Capabilities::of_profile(moment_shadows::Profile::Native);
    let error = graph.compile(&native, &imports).unwrap_err();
    assert!(
        error.to_string().contains("the map has 3 mip levels"),
        "{error}"
    );
}
