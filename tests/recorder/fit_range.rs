//! Ranges that fit themselves: what each region gets, and how long it keeps it.

use moment_shadows::{DepthConversion, MapRegion, TextureFormat};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::{ImportedResource, Layers};
use moment_shadows_lab::gpu::Gpu;

use crate::depth_map;
use crate::setup::{Bound, aligned_view, bind, capabilities, compiled, gpu};

/// Not a multiple of the shader's tiles.
pub(crate) const MAP: [u32; 2] = [72, 40];

/// Neither a multiple of its tiles nor the map's size.
pub(crate) const PICTURE: [u32; 2] = [101, 77];

/// The shortest range in moment depth (`SHORTEST` of the shader).
const SHORTEST: f32 = 1.0 / 256.0;

/// How far it goes on behind the casters (`ROOM_BEHIND` of the shader).
const BEHIND: f32 = 7.0 / 128.0;

const GRAPH: &str = r#"{
  "version": 2,
  "imports": [{ "name": "light_depth" }],
  "nodes": [{ "name": "fit", "type": "fit_range" }],
  "edges": [{ "from": "light_depth", "to": "fit.depth" }],
  "outputs": [{ "name": "ranges", "from": "fit.ranges" }]
}"#;

/// The node bound to a map of several layers and regions.
pub(crate) struct Map {
    pub(crate) bound: Bound,
    texture: wgpu::Texture,
    /// The camera's depth, where it is connected.
    seen: Option<wgpu::Texture>,
}

/// The ends of a range, and where its region begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    pub(crate) ends: [f32; 2],
    scale: f32,
    pub(crate) origin: [f32; 2],
}

impl Range {
    fn length(self) -> f32 {
        self.ends[1] - self.ends[0]
    }
}

impl Map {
    pub(crate) fn new(gpu: &Gpu, layers: u32, regions: u32, samples: u32) -> Self {
        Self::seen(gpu, layers, regions, samples, None)
    }

    /// With a camera whose depth has so many samples.
    pub(crate) fn seen(
        gpu: &Gpu,
        layers: u32,
        regions: u32,
        samples: u32,
        camera: Option<u32>,
    ) -> Self {
        let desc = TextureDesc {
            layers,
            regions,
            samples,
            ..TextureDesc::new(TextureFormat::Depth32Float, MAP)
        };
        let format = wgpu::TextureFormat::Depth32Float;
        let texture = depth_map::texture(gpu, format, MAP, layers, samples);
        let mut imports = vec![("light_depth", ImportedResource::from(&texture))];
        let mut descs = vec![("light_depth", desc)];
        let seen = camera.map(|samples| depth_map::texture(gpu, format, PICTURE, 1, samples));
        let mut text = GRAPH.to_owned();
        if let Some(seen) = &seen {
            text = text
                .replace(
                    r#"[{ "name": "light_depth" }"#,
                    r#"[{ "name": "camera_depth" }, { "name": "light_depth" }"#,
                )
                .replace(
                    r#""edges": ["#,
                    r#""edges": [{ "from": "camera_depth", "to": "fit.camera_depth" }, "#,
                );
            imports.push(("camera_depth", ImportedResource::from(seen)));
            let desc = TextureDesc::new(TextureFormat::Depth32Float, PICTURE);
            let samples = seen.sample_count();
            descs.push(("camera_depth", TextureDesc { samples, ..desc }));
        }
        let plan = compiled(&text, &capabilities(gpu), &descs);
        let mut bytes = plan.parameters.initial();
        if seen.is_some() {
            let view = aligned_view(0);
            for layer in 0..layers {
                let views = vec![view; regions as usize];
                plan.parameters
                    .write_all(&mut bytes, "fit", layer, &views)
                    .unwrap();
            }
        }
        let bound = bind(gpu, plan, &imports, &bytes);
        Self {
            bound,
            texture,
            seen,
        }
    }

    /// Draws what the camera sees, moment depths again; 1 is no surface.
    pub(crate) fn look(&self, gpu: &Gpu, depth: impl Fn(u32, u32) -> f32) {
        let seen = self.seen.as_ref().unwrap();
        let wide = [PICTURE[0] * seen.sample_count(), PICTURE[1]];
        let values = depth_map::values(wide, |x, y| stored(depth(x, y)));
        depth_map::draw(gpu, seen, 0, &values);
    }

    /// Draws moment depths to a layer, and runs the node.
    pub(crate) fn frame(&self, gpu: &Gpu, layer: u32, depth: impl Fn(u32, u32) -> f32) -> Range {
        let wide = [MAP[0] * self.texture.sample_count(), MAP[1]];
        let values = depth_map::values(wide, |x, y| stored(depth(x, y)));
        depth_map::draw(gpu, &self.texture, layer, &values);
        self.bound.run_layers(gpu, Layers::Only(&[layer]));
        self.ranges(gpu, layer)[0]
    }

    pub(crate) fn ranges(&self, gpu: &Gpu, layer: u32) -> Vec<Range> {
        let texels = self.bound.read_floats(gpu, "ranges", layer);
        let range = |texel: &[f32]| Range {
            ends: [texel[0] - 1.0 / texel[1], texel[0] + 1.0 / texel[1]],
            scale: texel[1],
            origin: [texel[2], texel[3]],
        };
        texels.chunks_exact(4).map(range).collect()
    }
}

/// Stored depth of a moment depth, exact for multiples of a power of two.
fn stored(z: f32) -> f32 {
    0.5 + 0.5 * z
}

/// A caster at either end, the farther one in the last texel, and nothing anywhere else.
pub(crate) fn casters([near, far]: [f32; 2]) -> impl Fn(u32, u32) -> f32 {
    move |x, y| match (x, y) {
        (33, 17) => near,
        (71, 39) => far,
        _ => 1.0,
    }
}

/// The range goes around the casters, by 1/64 of their depth in front and 7/128 behind, and at most one step of the grid more at
/// either end: 1/128 of the length. It does not leave the host's.
pub(crate) fn check([near, far]: [f32; 2], range: Range) {
    let depth = (far - near).max(SHORTEST);
    let [first, last] = range.ends;
    assert!(-1.0 <= first && last <= 1.0, "{range:?}");
    assert!(first <= near && far <= last, "{range:?}");
    // A step, and the rounding of middle and scale.
    let room = range.length() / 128.0 + 1e-6;
    // At the host's far end the shortest range reaches farther to the front.
    let nearest = near.min(1.0 - SHORTEST);
    assert!(nearest - first <= depth / 64.0 + room, "{near}: {range:?}");
    // A single depth gets the shortest range, behind it.
    assert!(
        last - far.max(near + depth) <= depth * BEHIND + room,
        "{far}: {range:?}"
    );
    assert!(
        last == 1.0 || last - far >= depth * BEHIND - 1e-6,
        "{far}: {range:?}"
    );
}

#[test]
fn a_range_goes_around_the_casters_and_stays_within_the_hosts() {
    let gpu = gpu();
    for ends in [
        [-0.5, 0.25],
        [-1.0, -0.875],
        [-1.0, 0.9990234],
        [0.125, 0.125],
        [-1.0, -1.0],
        [0.9999, 0.9999],
        [0.0, 2e-5],
        [0.484375, 0.5],
    ] {
        let range = Map::new(&gpu, 1, 1, 1).frame(&gpu, 0, casters(ends));
        check(ends, range);
        assert_eq!(range.origin, [0.0; 2]);
        assert!((1.0..=512.0).contains(&range.scale), "{range:?}");
    }
}

#[test]
fn without_casters_the_range_is_the_hosts_or_what_it_was() {
    let gpu = gpu();
    let map = Map::new(&gpu, 1, 1, 1);
    let empty = map.frame(&gpu, 0, |_, _| 1.0);
    assert_eq!((empty.ends, empty.scale), ([-1.0, 1.0], 1.0));
    let found = map.frame(&gpu, 0, casters([-0.25, 0.5]));
    check([-0.25, 0.5], found);
    // What is beyond the far end counts as none.
    for nothing in [1.0, f32::INFINITY, 1e30] {
        assert_eq!(map.frame(&gpu, 0, |_, _| nothing), found, "{nothing}");
    }
}

#[test]
fn a_range_grows_at_once_and_shrinks_where_it_is_clearly_too_long() {
    let gpu = gpu();
    let map = Map::new(&gpu, 1, 1, 1);
    let first = map.frame(&gpu, 0, casters([-0.25, 0.25]));
    // Within the room nothing changes, to the bit, and a tenth shorter is no reason to shrink.
    for ends in [[-0.255, 0.26], [-0.25, 0.25], [-0.23, 0.23], [-0.25, 0.25]] {
        assert_eq!(map.frame(&gpu, 0, casters(ends)), first, "{ends:?}");
    }
    // The end that is too near moves, the other one stays.
    let farther = map.frame(&gpu, 0, casters([-0.25, 0.28]));
    check([-0.25, 0.28], farther);
    // Middle and scale are rounded.
    assert!((farther.ends[0] - first.ends[0]).abs() <= 1e-6);
    assert!(farther.ends[1] > first.ends[1]);
    let longer = map.frame(&gpu, 0, casters([-0.75, 0.5]));
    check([-0.75, 0.5], longer);
    let back = map.frame(&gpu, 0, casters([-0.25, 0.25]));
    assert_eq!(back, first);
}

/// A caster that bobs through a third of the casters' depth, twice, and one that moves away until that is two thirds longer. The range
/// grows by 1/32 or more at once, half of its room, and each fall shrinks it by an eighth or more.
#[test]
fn what_moves_slowly_changes_the_range_seldom() {
    const FRAMES: u32 = 60;
    let gpu = gpu();
    let bob = |frame: u32| 0.125 * (frame as f32 * core::f32::consts::TAU / 30.0).sin();
    let leave = |frame: u32| 0.5 * frame as f32 / FRAMES as f32;
    for (what, far, most) in [
        ("bobs", &bob as &dyn Fn(u32) -> f32, 16),
        ("leaves", &leave, 20),
    ] {
        let map = Map::new(&gpu, 1, 1, 1);
        let ranges: Vec<Range> = (0..FRAMES)
            .map(|frame| {
                let far = 0.25 + far(frame);
                let range = map.frame(&gpu, 0, casters([-0.5, far]));
                assert!(
                    range.ends[1] >= far && range.length() <= 1.3 * (far + 0.5),
                    "{range:?}"
                );
                range
            })
            .collect();
        let changes = ranges.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let ratios = ranges
            .windows(2)
            .map(|pair| pair[1].length() / pair[0].length());
        let largest = ratios.map(|ratio| (ratio - 1.0).abs()).fold(0.0, f32::max);
        println!(
            "a caster that {what}: {changes} changes in {FRAMES} frames, the largest {largest:.3}"
        );
        assert!(changes <= most, "{changes}");
    }
}

#[test]
fn layers_and_regions_have_their_own_ranges_and_samples_count() {
    let gpu = gpu();
    let map = Map::new(&gpu, 2, 3, 1);
    let half = MAP[0] / 2;
    let regions = [
        MapRegion::new([0, 0], [half, MAP[1]]),
        MapRegion::new([half, 8], [half, MAP[1] - 8]),
    ];
    let parameters = &map.bound.plan.parameters;
    let mut bytes = parameters.initial();
    let conversions = [
        DepthConversion::orthographic(),
        DepthConversion::orthographic().reversed(),
        DepthConversion::orthographic(),
    ];
    for layer in 0..2 {
        parameters
            .write_regions(&mut bytes, "light_depth", layer, &regions)
            .unwrap();
        parameters
            .write_all(&mut bytes, "fit", layer, &conversions)
            .unwrap();
    }
    gpu.queue.write_buffer(&map.bound.parameters, 0, &bytes);
    // Far left, nearer on the right, where depth is reversed; the strip above belongs to no region.
    let depths = |x: u32, y: u32| match (x < half, y < 8) {
        (true, _) => casters([0.25, 0.5])(2 * x, y).min(if x == 30 { 0.5 } else { 1.0 }),
        (false, true) => 0.0,
        (false, false) => {
            if x.is_multiple_of(2) {
                0.75
            } else {
                0.875
            }
        }
    };
    map.frame(
        &gpu,
        0,
        |x, y| if x == 1 && y == 1 { 0.25 } else { depths(x, y) },
    );
    let [left, right, none] = map.ranges(&gpu, 0)[..] else {
        panic!("three regions")
    };
    check([0.25, 0.5], left);
    check([-0.875, -0.75], right);
    assert_eq!(
        [left.origin, right.origin, none.origin],
        [[0.0, 0.0], [half as f32, 8.0], [-1.0, -1.0]]
    );
    // The other layer was not run, and holds nothing yet.
    let texels = map.bound.read_floats(&gpu, "ranges", 1);
    assert!(texels.iter().all(|&value| value == 0.0), "{texels:?}");
    // One sample of one texel is a caster.
    let several = Map::new(&gpu, 1, 1, 4);
    let range = several.frame(&gpu, 0, |x, y| match (x, y) {
        (103, 9) => -0.5,
        (4, 4) => 0.0,
        _ => 1.0,
    });
    check([-0.5, 0.0], range);
}
