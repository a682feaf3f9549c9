//! Layers that are placed on the device: where their splits go, per layer and region of the map, and what that is worth.

use moment_shadows::{DepthConversion, MapRegion, TextureFormat};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::{ImportedResource, Layers};
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt as _, SeedableRng as _};

use crate::depth_map;
use crate::setup::{Bound, aligned_view, bind, capabilities, compiled, gpu};

/// Not a multiple of the shader's tiles.
const MAP: [u32; 2] = [72, 40];

/// Frames until a single split has settled.
const FRAMES: usize = 8;

/// The node alone.
fn graph(layers: u32) -> String {
    format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "light_depth" }}],
  "nodes": [{{ "name": "place", "type": "place_layers", "properties": {{ "layers": {layers} }} }}],
  "edges": [{{ "from": "light_depth", "to": "place.depth" }}],
  "outputs": [{{ "name": "splits", "from": "place.splits" }}]
}}"#
    )
}

fn light(layers: u32, samples: u32, regions: u32) -> TextureDesc {
    TextureDesc {
        layers,
        samples,
        regions,
        ..TextureDesc::new(TextureFormat::Depth32Float, MAP)
    }
}

/// The splits of a layer of the map.
fn splits(gpu: &Gpu, bound: &Bound, layer: u32) -> Vec<f32> {
    bound.read_floats(gpu, "splits", layer)
}

/// Stored depth of a moment depth, and back.
fn stored(z: f32) -> f32 {
    0.5 + 0.5 * z
}

/// The node bound to a map of several layers, each with its own depths.
struct Map {
    bound: Bound,
    texture: wgpu::Texture,
}

impl Map {
    fn new(gpu: &Gpu, split_layers: u32, layers: u32, regions: u32) -> Self {
        let desc = light(layers, 1, regions);
        let plan = compiled(
            &graph(split_layers),
            &capabilities(gpu),
            &[("light_depth", desc)],
        );
        let texture = depth_map::texture(gpu, wgpu::TextureFormat::Depth32Float, MAP, layers, 1);
        let bytes = plan.parameters.initial();
        let imports = [("light_depth", ImportedResource::from(&texture))];
        let bound = bind(gpu, plan, &imports, &bytes);
        Self { bound, texture }
    }

    /// Draws moment depths to a layer.
    fn draw(&self, gpu: &Gpu, layer: u32, depth: impl Fn(u32, u32) -> f32) {
        let values = depth_map::values(MAP, |x, y| stored(depth(x, y)));
        depth_map::draw(gpu, &self.texture, layer, &values);
    }

    fn run(&self, gpu: &Gpu, frames: usize, layers: Layers<'_>) {
        for _ in 0..frames {
            self.bound.run_layers(gpu, layers);
        }
    }
}

/// An edge through the middle of the map.
fn edge(angle: f32, [near, far]: [f32; 2]) -> impl Fn(u32, u32) -> f32 {
    let normal = [angle.cos(), angle.sin()];
    let middle = [0.5 * (MAP[0] - 1) as f32, 0.5 * (MAP[1] - 1) as f32];
    move |x, y| {
        let side = normal[0] * (x as f32 - middle[0]) + normal[1] * (y as f32 - middle[1]);
        if side > 0.0 { far } else { near }
    }
}

/// Where an edge between two planes wants a split: a sixth of the gap in front of the farther one.
fn wanted([near, far]: [f32; 2]) -> f32 {
    far - (far - near) / 6.0
}

#[test]
fn before_any_edge_is_seen_layers_have_equal_depth() {
    let gpu = gpu();
    for (layers, expected) in [
        (1, vec![]),
        (2, vec![0.0]),
        (4, vec![-0.5, 0.0, 0.5]),
        (8, vec![-0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75]),
    ] {
        let map = Map::new(&gpu, layers, 1, 1);
        map.draw(&gpu, 0, |_, _| 0.3);
        map.run(&gpu, 3, Layers::All);
        let found = splits(&gpu, &map.bound, 0);
        assert_eq!(found[..expected.len()], expected, "{layers} layers");
        // Nothing lies behind the far end, so an edge against it does not count.
        map.draw(&gpu, 0, edge(0.7, [-0.2, 1.0]));
        map.run(&gpu, 3, Layers::All);
        assert_eq!(splits(&gpu, &map.bound, 0), found, "{layers} layers");
    }
}

#[test]
fn an_axis_aligned_edge_takes_a_split_in_front_of_the_farther_plane() {
    let gpu = gpu();
    let planes = [[-0.5, 0.25], [-0.875, -0.75], [0.0, 0.99]];
    for layers in [2, 3, 4, 8] {
        let map = Map::new(&gpu, layers, 3, 1);
        for (layer, &planes) in (0..).zip(&planes) {
            map.draw(&gpu, layer, edge(0.0, planes));
        }
        // Two splits move per frame; one that is taken elsewhere waits for its turn.
        map.run(&gpu, 8 * FRAMES, Layers::All);
        for (layer, planes) in (0..).zip(planes) {
            let found = splits(&gpu, &map.bound, layer);
            let found = &found[..layers as usize - 1];
            assert!(found.is_sorted(), "{found:?}");
            let error = found
                .iter()
                .map(|split| (split - wanted(planes)).abs())
                .fold(2.0, f32::min);
            // A square root of a square, and a quotient of sums of equal terms.
            assert!(error <= 2e-6, "{found:?}, {planes:?}: off by {error:e}");
        }
    }
}

#[test]
fn edges_of_any_direction_take_it_close_to_there() {
    const LAYERS: u32 = 128;
    let gpu = gpu();
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(413);
    let map = Map::new(&gpu, 2, LAYERS, 1);
    let planes: Vec<[f32; 2]> = (0..LAYERS)
        .map(|layer| {
            let near = random.random_range(-1.0..0.5_f32);
            let planes = [near, random.random_range(near + 0.05..0.9)];
            let angle = random.random_range(0.0..core::f32::consts::TAU);
            map.draw(&gpu, layer, edge(angle, planes));
            planes
        })
        .collect();
    map.run(&gpu, FRAMES, Layers::All);
    let errors: Vec<f32> = (0..)
        .zip(&planes)
        .map(|(layer, &planes)| {
            let off = splits(&gpu, &map.bound, layer)[0] - wanted(planes);
            off.abs() / (planes[1] - planes[0])
        })
        .collect();
    let mean = errors.iter().sum::<f32>() / errors.len() as f32;
    let largest = errors.iter().copied().fold(0.0, f32::max);
    println!("off by {mean:.4} of the gap on average, {largest:.4} at most");
    assert!(mean <= 0.05, "{mean}");
    // On a diagonal all footprints have one texel or three in front: they see it at 0.933 of the gap on average.
    assert!(largest <= 1.0 - 0.933 + 2e-3, "{largest}");
}

#[test]
fn layers_of_the_map_have_their_own_splits_and_clean_ones_keep_them() {
    let gpu = gpu();
    let map = Map::new(&gpu, 4, 3, 1);
    let planes = [[-0.9, -0.3], [-0.2, 0.1], [0.0, 0.7]];
    for (layer, &planes) in (0..).zip(&planes) {
        map.draw(&gpu, layer, edge(0.4, planes));
    }
    map.run(&gpu, FRAMES, Layers::All);
    let all = || [0, 1, 2].map(|layer| splits(&gpu, &map.bound, layer));
    let before = all();
    assert!(before[0] != before[1] && before[1] != before[2] && before[0] != before[2]);
    // Everything changes, but one layer is said to be dirty: by its number, or as one of the light's map.
    for layer in 0..3 {
        map.draw(&gpu, layer, edge(1.0, [-0.7, 0.45]));
    }
    map.run(&gpu, FRAMES, Layers::Only(&[1]));
    let after = all();
    assert_eq!((&before[0], &before[2]), (&after[0], &after[2]));
    assert_ne!(before[1], after[1]);
    map.run(&gpu, FRAMES, Layers::OfMaps(&[("light_depth", &[2])]));
    let by_map = all();
    assert_eq!(after[..2], by_map[..2]);
    assert_ne!(after[2], by_map[2]);
}

#[test]
fn samples_of_a_texel_do_not_matter_where_they_agree() {
    let gpu = gpu();
    let single = Map::new(&gpu, 4, 2, 1);
    let plan = compiled(
        &graph(4),
        &capabilities(&gpu),
        &[("light_depth", light(2, 4, 1))],
    );
    let maps: Vec<wgpu::Texture> = (0..2)
        .map(|_| depth_map::texture(&gpu, wgpu::TextureFormat::Depth32Float, MAP, 1, 4))
        .collect();
    for (layer, map) in (0..).zip(&maps) {
        let depth = edge(0.3 + layer as f32, [-0.4, 0.6]);
        single.draw(&gpu, layer, &depth);
        let wide = [4 * MAP[0], MAP[1]];
        let values = depth_map::values(wide, |x, y| stored(depth(x / 4, y)));
        depth_map::draw(&gpu, map, 0, &values);
    }
    let bytes = plan.parameters.initial();
    let imports = [("light_depth", ImportedResource::Layers(maps.clone()))];
    let bound = bind(&gpu, plan, &imports, &bytes);
    for _ in 0..FRAMES {
        bound.run(&gpu);
    }
    single.run(&gpu, FRAMES, Layers::All);
    for layer in 0..2 {
        let found = splits(&gpu, &bound, layer);
        assert_eq!(found, splits(&gpu, &single.bound, layer));
        assert!(found.iter().all(|split| split.is_finite()));
    }
}

#[test]
fn regions_share_splits_but_no_footprint_and_have_their_own_conversions() {
    let gpu = gpu();
    let map = Map::new(&gpu, 2, 1, 3);
    let half = MAP[0] / 2;
    let sides = [
        MapRegion::new([0, 0], [half, MAP[1]]),
        MapRegion::new([half, 0], [half, MAP[1] / 2]),
    ];
    let run = |regions: &[MapRegion], conversions: &[DepthConversion]| {
        let parameters = &map.bound.plan.parameters;
        let mut bytes = parameters.initial();
        parameters
            .write_regions(&mut bytes, "light_depth", 0, regions)
            .unwrap();
        parameters
            .write_all(&mut bytes, "place", 0, conversions)
            .unwrap();
        gpu.queue.write_buffer(&map.bound.parameters, 0, &bytes);
        map.run(&gpu, FRAMES, Layers::All);
        splits(&gpu, &map.bound, 0)[0]
    };
    let forward = [DepthConversion::orthographic(); 3];
    // Two regions with a plane each, and something else in the quarter that belongs to none.
    map.draw(&gpu, 0, |x, y| match (x < half, y < MAP[1] / 2) {
        (true, _) => -0.6,
        (false, true) => 0.4,
        (false, false) => -0.9,
    });
    assert_eq!(run(&sides, &forward), 0.0, "no region has an edge");
    // One region over both sees the edge, and so does one over the quarter that belonged to none.
    let top = MapRegion::new([0, 0], [MAP[0], MAP[1] / 2]);
    let split = run(&[top], &forward);
    assert!((split - wanted([-0.6, 0.4])).abs() <= 2e-6, "{split}");
    // Two regions with an edge each, the second one reversed: its depths are those of the first.
    map.draw(&gpu, 0, |x, _| match (x < half, x % half < half / 2) {
        (true, true) => -0.5,
        (true, false) => 0.25,
        (false, true) => 0.5,
        (false, false) => -0.25,
    });
    let reversed = [
        forward[0],
        DepthConversion::orthographic().reversed(),
        forward[2],
    ];
    let split = run(&sides, &reversed);
    assert!((split - wanted([-0.5, 0.25])).abs() <= 2e-6, "{split}");
    // Without the reversal the second one, of 20 rows to the first one's 40, has other planes as far apart.
    let rows = [MAP[1] - 1, MAP[1] / 2 - 1].map(|rows| rows as f32);
    let places = [wanted([-0.5, 0.25]), wanted([-0.25, 0.5])];
    let expected = (places[0] * rows[0] + places[1] * rows[1]) / (rows[0] + rows[1]);
    let split = run(&sides, &forward);
    assert!((split - expected).abs() <= 2e-6, "{split} and {expected}");
}

/// Resolve, blur and shade with layers that are placed, or of equal depth.
fn shading(technique: &str, placed: bool) -> String {
    let (node, edges) = if placed {
        (
            r#"{ "name": "place", "type": "place_layers", "properties": { "layers": 2 } },"#,
            r#"{ "from": "light_depth", "to": "place.depth" },
               { "from": "place.splits", "to": "resolve.splits" },
               { "from": "place.splits", "to": "shade.splits" },"#,
        )
    } else {
        ("", "")
    };
    format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "light_depth" }}, {{ "name": "camera_depth" }}],
  "nodes": [ {node}
    {{ "name": "resolve", "type": "resolve", "properties": {{ "technique": {technique}, "storage": "unorm16" }} }},
    {{ "name": "blur", "type": "blur", "properties": {{ "kernel": {{ "radius": 2, "sigma": 1.2 }} }} }},
    {{ "name": "shade", "type": "shade_hard", "properties": {{ "format": "r32float" }} }}
  ],
  "edges": [ {edges}
    {{ "from": "light_depth", "to": "resolve.depth" }},
    {{ "from": "resolve.map", "to": "blur.map" }},
    {{ "from": "blur.blurred", "to": "shade.map" }},
    {{ "from": "camera_depth", "to": "shade.camera_depth" }}
  ],
  "outputs": [{{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }}]
}}"#
    )
}

#[test]
fn placed_layers_bleed_less_than_twice_as_many_of_equal_depth() {
    // An occluder over the left half, a second one over everything, and a receiver behind both: all of it is in shadow.
    let [first, second, near_behind] = [-0.9, 0.4, 0.48];
    let gpu = gpu();
    let light = depth_map::of(&gpu, MAP, |x, _| {
        stored(if x < MAP[0] / 2 { first } else { second })
    });
    let lightest = |receiver: f32, layers: u32, splits: &str, frames: usize| {
        let camera = depth_map::of(&gpu, MAP, |_, _| stored(receiver));
        let technique = format!(r#"{{ "lvsm": {{ "layers": {layers}, "splits": "{splits}" }} }}"#);
        let text = shading(&technique, splits == "lloyd");
        let desc = TextureDesc::new(TextureFormat::Depth32Float, MAP);
        let plan = compiled(
            &text,
            &capabilities(&gpu),
            &[("light_depth", desc.clone()), ("camera_depth", desc)],
        );
        let mut bytes = plan.parameters.initial();
        plan.parameters
            .write(&mut bytes, "shade", 0, &aligned_view(0))
            .unwrap();
        let imports = [
            ("light_depth", ImportedResource::from(&light)),
            ("camera_depth", ImportedResource::from(&camera)),
        ];
        let bound = bind(&gpu, plan, &imports, &bytes);
        for _ in 0..frames {
            bound.run(&gpu);
        }
        let intensities = bound.read_floats(&gpu, "shadow_intensity", 0);
        intensities.into_iter().fold(1.0, f32::min)
    };
    let uniform = [2, 4, 8].map(|layers| lightest(near_behind, layers, "uniform", 1));
    let placed = lightest(near_behind, 2, "lloyd", FRAMES);
    println!(
        "lightest pixel: {uniform:.4?} with layers of equal depth, {placed:.4} with placed ones"
    );
    // Two layers that meet at the wanted split 0.183, which is where the first occluder counts for the second layer: 0.217 in front of
    // the second occluder and 0.297 in front of the receiver. With a share w of the first, Chebyshev is d^2 / (d^2 + w (1 - w) 0.217^2)
    // with d = 0.08 + 0.217 w, at least 0.669 over all w.
    assert!(placed >= 0.668, "{placed}");
    // With two layers of equal depth the first occluder counts at 0, 0.4 in front of the second one: at equal shares
    // 0.28^2 / (0.28^2 + 0.2^2) = 0.66. With four the layer is [0, 0.5], where it is the same.
    assert!(uniform[..2].iter().all(|&lightest| lightest <= 0.67));
    // With eight it is [0.25, 0.5], and 0.155^2 / (0.155^2 + 0.075^2) = 0.81.
    assert!(uniform[2] <= 0.82);
    // A receiver farther behind.
    let [uniform, placed] = [
        lightest(0.75, 2, "uniform", 1),
        lightest(0.75, 2, "lloyd", FRAMES),
    ];
    println!(
        "farther behind: {uniform:.4} with layers of equal depth, {placed:.4} with placed ones"
    );
    // 0.35 + 0.4 w and 0.35 + 0.217 w in place of d: at least 0.868 and 0.943.
    assert!(uniform <= 0.88 && placed >= 0.943, "{uniform}, {placed}");
}
