//! Several lights, the layers that are dirty, and a device of core WebGPU.

use crate::depth_map;
use crate::setup::{IDENTITY, bind, capabilities, compiled, gpu};
use crate::shade_regions::{MAP, Shading, depth, graph, half_sized, view};
use moment_shadows::{MapRegion, Profile};
use moment_shadows_graph::record::{ImportedResource, Layers, Recording};
use moment_shadows_graph::{GraphError, GraphErrorKind, Stage};
use moment_shadows_lab::gpu::Gpu;

#[test]
fn lights_have_a_channel_each_and_the_first_view_that_contains_a_pixel_shades_it() {
    let gpu = gpu();
    let left = MapRegion::new([0, 0], [64, 96]);
    let right = MapRegion::new([64, 0], [64, 96]);
    // Left: a caster everywhere. Right: none.
    let map = depth_map::of(&gpu, MAP, |x, _| if x < 64 { 0.1 } else { 1.0 });
    let picture = [32, 32];
    let camera = depth_map::of(&gpu, picture, |_, _| 0.8);
    let views = [
        // Channel 0: a cascade without casters over the middle, one with casters over everything.
        view(half_sized(0.0, 0.0), 0, right, 0),
        view(IDENTITY, 0, left, 0),
        // Channel 2: shadow in the upper left quarter alone; the rest lies outside of its map.
        view(half_sized(-0.5, 0.5), 0, left, 2),
        // Channel 3: no such view.
        view(IDENTITY, 0, MapRegion::NONE, 3),
        // Channel 1: a light without casters.
        view(IDENTITY, 0, right, 1),
    ];
    let text = graph(
        "float32",
        1,
        r#"{ "format": "rgba32float", "lights": 4, "views": 6 }"#,
    );
    let shading = Shading::new(
        &gpu,
        &capabilities(&gpu),
        &text,
        (&map, depth(2, 1)),
        (&camera, picture),
        &views,
        &[left, right],
    );
    for (index, channels) in shading.run(&gpu).into_iter().enumerate() {
        let (x, y) = (index as u32 % 32, index as u32 / 32);
        let middle = (8..24).contains(&x) && (8..24).contains(&y);
        let upper_left = x < 16 && y < 16;
        let expected = [
            if middle { 0.0 } else { 1.0 },
            0.0,
            if upper_left { 1.0 } else { 0.0 },
            0.0,
        ];
        for (channel, (found, expected)) in channels.into_iter().zip(expected).enumerate() {
            assert!(
                (found - expected).abs() < 1e-3,
                "pixel {x}, {y}, channel {channel}: {found} for {expected}"
            );
        }
    }
}

#[test]
fn only_the_dirty_layers_of_the_named_map_are_recorded() {
    let gpu = gpu();
    let text = r#"{
  "version": 2,
  "imports": [{ "name": "sun" }, { "name": "spots" }],
  "nodes": [
    { "name": "a", "type": "resolve", "properties": { "storage": "float32" } },
    { "name": "b", "type": "resolve", "properties": { "storage": "float32" } }
  ],
  "edges": [{ "from": "sun", "to": "a.depth" }, { "from": "spots", "to": "b.depth" }],
  "outputs": [{ "name": "sun", "from": "a.map" }, { "name": "spots", "from": "b.map" }]
}"#;
    let plan = compiled(
        text,
        &capabilities(&gpu),
        &[("sun", depth(1, 2)), ("spots", depth(1, 3))],
    );
    let maps = [2, 3]
        .map(|layers| depth_map::texture(&gpu, wgpu::TextureFormat::Depth32Float, MAP, layers, 1));
    let bytes = plan.parameters.initial();
    let imports = [
        ("sun", ImportedResource::from(&maps[0])),
        ("spots", ImportedResource::from(&maps[1])),
    ];
    let bound = bind(&gpu, plan, &imports, &bytes);
    let clear = |value: f32| {
        (0..2).for_each(|layer| depth_map::clear(&gpu, &maps[0], layer, value));
        (0..3).for_each(|layer| depth_map::clear(&gpu, &maps[1], layer, value));
    };
    // Depth 0.25 is the moment depth -0.5, 0.75 is 0.5.
    clear(0.25);
    bound.run(&gpu);
    clear(0.75);
    bound.run_layers(&gpu, Layers::OfMaps(&[("spots", &[2]), ("sun", &[])]));
    let first = |output: &str, layer| bound.read_floats(&gpu, output, layer)[0];
    assert_eq!([first("sun", 0), first("sun", 1)], [-0.5, -0.5]);
    let spots = [0, 1, 2].map(|layer| first("spots", layer));
    assert_eq!(spots, [-0.5, -0.5, 0.5]);
    bound.run_layers(&gpu, Layers::OfMaps(&[("sun", &[0])]));
    assert_eq!([first("sun", 0), first("sun", 1)], [0.5, -0.5]);
    assert_eq!(first("spots", 0), -0.5);

    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let mut refused = |layers| {
        let recording = Recording {
            layers,
            ..Recording::default()
        };
        bound
            .bindings
            .record(Stage::AfterShadowMaps, &mut encoder, recording)
            .unwrap_err()
    };
    let says = "there is no map 'moon'; the nearest are `sun`, `spots` (dirty layers are those of maps that passes follow)";
    assert_eq!(
        refused(Layers::OfMaps(&[("moon", &[0])])),
        GraphError::new(GraphErrorKind::UnknownName, says)
    );
    let beyond = refused(Layers::OfMaps(&[("sun", &[2])]));
    assert_eq!(beyond.kind, GraphErrorKind::Recording);
    let says = ["layer 2 is marked dirty", "has 2 layers"];
    assert!(
        says.iter().all(|says| beyond.message.contains(says)),
        "{beyond}"
    );
}

#[test]
fn core_webgpu_shades_regions_too() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let left = MapRegion::new([0, 0], [61, 96]);
    let right = MapRegion::new([61, 0], [67, 96]);
    let map = depth_map::of(&gpu, MAP, |x, _| if x < 61 { 0.1 } else { 1.0 });
    let picture = [8, 8];
    let camera = depth_map::of(&gpu, picture, |_, _| 0.8);
    let text = graph(
        "float16",
        5,
        r#"{ "format": "rgba32float", "lights": 2, "views": 2 }"#,
    );
    let views = [view(IDENTITY, 0, left, 0), view(IDENTITY, 0, right, 1)];
    let capabilities = capabilities(&gpu);
    let light = (&map, depth(2, 1));
    let shading = Shading::new(
        &gpu,
        &capabilities,
        &text,
        light,
        (&camera, picture),
        &views,
        &[left, right],
    );
    for [first, second, ..] in shading.run(&gpu) {
        assert!(first > 0.995 && second < 5e-3, "{first}, {second}");
    }
}
