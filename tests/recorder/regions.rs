//! Regions: each is a map of its own, whatever lies beside it, on every mip level and to the bit.

use moment_shadows::{DepthConversion, MapRegion, TextureFormat};
use moment_shadows_graph::record::{ImportedResource, Layers};
use moment_shadows_graph::{Plan, TextureDesc};
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt as _, SeedableRng as _};

use crate::depth_map;
use crate::setup::{Bound, bind, capabilities, compiled, gpu};

/// Resolved, blurred, downsampled; the map is the output.
fn graph(storage: &str, radius: u32, mip_levels: &str) -> String {
    // A map that is drawn holds six moments.
    let technique = match storage {
        "unorm10" => "hamburger6",
        _ => "hamburger4",
    };
    format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "light_depth" }}],
  "nodes": [
    {{ "name": "resolve", "type": "resolve",
       "properties": {{ "technique": "{technique}", "storage": "{storage}" }} }},
    {{ "name": "blur", "type": "blur",
       "properties": {{ "kernel": {{ "radius": {radius} }}, "mip_levels": {mip_levels} }} }},
    {{ "name": "downsample", "type": "downsample" }}
  ],
  "edges": [
    {{ "from": "light_depth", "to": "resolve.depth" }},
    {{ "from": "resolve.map", "to": "blur.map" }},
    {{ "from": "blur.blurred", "to": "downsample.map" }}
  ],
  "outputs": [{{ "name": "map", "from": "downsample.map" }}]
}}"#
    )
}

/// The same with a blur that resolves; it is named `resolve`.
fn resolved_graph(storage: &str, radius: u32) -> String {
    format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "light_depth" }}],
  "nodes": [
    {{ "name": "resolve", "type": "blur",
       "properties": {{ "resolve": {{ "storage": "{storage}" }}, "kernel": {{ "radius": {radius} }}, "mip_levels": "all" }} }},
    {{ "name": "downsample", "type": "downsample" }}
  ],
  "edges": [
    {{ "from": "light_depth", "to": "resolve.depth" }},
    {{ "from": "resolve.blurred", "to": "downsample.map" }}
  ],
  "outputs": [{{ "name": "map", "from": "downsample.map" }}]
}}"#
    )
}

fn depth(size: [u32; 2], regions: u32) -> TextureDesc {
    TextureDesc {
        regions,
        ..TextureDesc::new(TextureFormat::Depth32Float, size)
    }
}

/// A pattern of depths that differs from place to place and with `turn`.
fn pattern(x: u32, y: u32, turn: u32) -> f32 {
    let mixed = (x.wrapping_mul(0x9e37_79b9)
        ^ y.wrapping_mul(0x85eb_ca6b)
        ^ turn.wrapping_mul(0xc2b2_ae35))
    .wrapping_mul(0x27d4_eb2f);
    let noise = (mixed >> 8) as f32 / (1 << 24) as f32;
    if (x / 9 + y / 7 + turn).is_multiple_of(3) {
        1.0
    } else {
        0.1 + 0.8 * noise
    }
}

/// The region's texels on a mip level: both edges are rounded down, so that regions which touch do so on every level.
pub(crate) fn at_level(region: &MapRegion, level: u32) -> MapRegion {
    let ends = [0, 1].map(|axis| (region.origin[axis] + region.extent[axis]) >> level);
    let origin = region.origin.map(|edge| edge >> level);
    MapRegion::new(origin, [0, 1].map(|axis| ends[axis] - origin[axis]))
}

/// The pattern of each region in its own coordinates; `turns` says which.
fn depths_of(size: [u32; 2], regions: &[MapRegion], turns: &[u32]) -> Vec<f32> {
    depth_map::values(size, |x, y| {
        let inside = |region: &MapRegion| {
            let [left, top] = region.origin;
            (left..left + region.extent[0]).contains(&x)
                && (top..top + region.extent[1]).contains(&y)
        };
        match regions.iter().position(inside) {
            Some(index) => {
                let [left, top] = regions[index].origin;
                pattern(x - left, y - top, turns[index])
            }
            None => 0.5,
        }
    })
}

/// One map with its regions' parameters.
struct Atlas {
    bound: Bound,
    depth: wgpu::Texture,
    size: [u32; 2],
}

impl Atlas {
    fn new(gpu: &Gpu, text: &str, size: [u32; 2], capacity: u32) -> Self {
        let plan = compiled(
            text,
            &capabilities(gpu),
            &[("light_depth", depth(size, capacity))],
        );
        let texture = depth_map::texture(gpu, wgpu::TextureFormat::Depth32Float, size, 1, 1);
        let bytes = plan.parameters.initial();
        let bound = bind(
            gpu,
            plan,
            &[("light_depth", ImportedResource::from(&texture))],
            &bytes,
        );
        Self {
            bound,
            depth: texture,
            size,
        }
    }

    fn plan(&self) -> &Plan {
        &self.bound.plan
    }

    /// Makes the regions anew from these depths.
    fn run(
        &self,
        gpu: &Gpu,
        regions: &[MapRegion],
        conversions: &[DepthConversion],
        depths: &[f32],
    ) {
        let mut bytes = self.plan().parameters.initial();
        self.plan()
            .parameters
            .write_regions(&mut bytes, "light_depth", 0, regions)
            .unwrap();
        self.plan()
            .parameters
            .write_all(&mut bytes, "resolve", 0, conversions)
            .unwrap();
        gpu.queue.write_buffer(&self.bound.parameters, 0, &bytes);
        depth_map::draw(gpu, &self.depth, 0, depths);
        self.bound.run_layers(gpu, Layers::All);
    }

    /// The texels of a region on a mip level, plane by plane.
    fn read(&self, gpu: &Gpu, region: &MapRegion, level: u32) -> Vec<u8> {
        let planes = self.plan().output_texture("map").unwrap().planes;
        (0..planes)
            .flat_map(|plane| self.read_plane(gpu, region, level, plane))
            .collect()
    }

    fn read_plane(&self, gpu: &Gpu, region: &MapRegion, level: u32, plane: u32) -> Vec<u8> {
        let texture = self.bound.bindings.output("map").unwrap();
        let bytes = gpu.read_level(texture, plane, level, "map").unwrap();
        let width = (self.size[0] >> level) as usize;
        let texel = bytes.len() / (width * (self.size[1] >> level) as usize);
        let part = at_level(region, level);
        let [left, top] = part.origin.map(|value| value as usize);
        let [columns, rows] = part.extent.map(|value| value as usize);
        (top..top + rows)
            .flat_map(|row| {
                let start = (row * width + left) * texel;
                bytes[start..start + columns * texel].to_vec()
            })
            .collect()
    }

    fn levels(&self) -> u32 {
        self.plan().output_texture("map").unwrap().mips
    }
}

/// A region, and everything to the right of it.
fn halves(size: [u32; 2], at: u32) -> [MapRegion; 2] {
    [
        MapRegion::new([0, 0], [at, size[1]]),
        MapRegion::new([at, 0], [size[0] - at, size[1]]),
    ]
}

#[test]
fn regions_that_touch_leave_each_other_untouched_to_the_bit() {
    let gpu = gpu();
    let size = [200, 120];
    // An edge that no mip level is aligned with, and a kernel that reaches far beyond it.
    let regions = halves(size, 77);
    let conversions = [
        DepthConversion::orthographic(),
        DepthConversion::orthographic().reversed(),
    ];
    for (storage, radius, resolved) in [
        ("unorm16", 32, false),
        ("float16", 12, false),
        ("float32", 32, false),
        ("unorm10", 32, false),
        ("unorm10", 12, false),
        ("unorm16", 4, true),
        ("float32", 12, true),
    ] {
        let text = match resolved {
            true => resolved_graph(storage, radius),
            false => graph(storage, radius, "\"all\""),
        };
        let atlas = Atlas::new(&gpu, &text, size, 2);
        assert_eq!(atlas.levels(), 7);
        let texels = |region: usize| -> Vec<Vec<u8>> {
            (0..atlas.levels())
                .map(|level| atlas.read(&gpu, &regions[region], level))
                .collect()
        };
        let depths = |turns: [u32; 2]| depths_of(size, &regions, &turns);
        atlas.run(&gpu, &regions, &conversions, &depths([0, 1]));
        let before = [texels(0), texels(1)];
        // The neighbour changes.
        atlas.run(&gpu, &regions, &conversions, &depths([0, 2]));
        let after = [texels(0), texels(1)];
        assert!(before[0] == after[0], "{storage}: the left region changed");
        for (level, (before, after)) in before[1].iter().zip(&after[1]).enumerate() {
            assert_ne!(before, after, "{storage}: level {level} was not made anew");
        }
        // Both change, but only the left region is listed.
        atlas.run(&gpu, &regions[..1], &conversions[..1], &depths([3, 3]));
        assert!(
            after[1] == texels(1),
            "{storage}: a region that is not listed changed"
        );
        assert_ne!(after[0], texels(0));
        // On its own, in a map of its own, the left region is the same.
        let alone = Atlas::new(&gpu, &text, regions[0].extent, 1);
        let whole = MapRegion::new([0, 0], regions[0].extent);
        let own = depths_of(whole.extent, &[whole], &[0]);
        alone.run(&gpu, &[MapRegion::WHOLE], &conversions[..1], &own);
        for level in 0..alone.levels() {
            let same = alone.read(&gpu, &whole, level) == before[0][level as usize];
            assert!(
                same,
                "{storage}: level {level} differs from that of a map of its own"
            );
        }
    }
}

/// A map cut into rectangles with sides of at least `smallest`.
fn cut(size: [u32; 2], count: usize, smallest: u32, seed: u64) -> Vec<MapRegion> {
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
    let mut regions = vec![MapRegion::new([0, 0], size)];
    for _ in 0..10_000 {
        if regions.len() == count {
            break;
        }
        let index = random.random_range(0..regions.len());
        let axis = random.random_range(0..2);
        let side = regions[index].extent[axis];
        if side < 2 * smallest {
            continue;
        }
        let at = random.random_range(smallest..=side - smallest);
        let mut rest = regions[index];
        regions[index].extent[axis] = at;
        rest.origin[axis] += at;
        rest.extent[axis] -= at;
        regions.push(rest);
    }
    assert_eq!(regions.len(), count);
    regions
}

#[test]
fn each_of_many_regions_is_what_a_map_of_its_own_would_be() {
    let gpu = gpu();
    let size = [173, 131];
    for (storage, seed, radius, per_frame_radius) in [
        ("unorm16", 1, 2, false),
        ("unorm16", 2, 13, true),
        ("unorm10", 3, 2, false),
    ] {
        let smallest = 2 * radius + 1;
        let count = if per_frame_radius { 9 } else { 40 };
        let regions = cut(size, count, smallest, seed);
        let turns: Vec<u32> = (0..count as u32).collect();
        let conversions: Vec<DepthConversion> = turns
            .iter()
            .map(|turn| match turn % 2 {
                0 => DepthConversion::orthographic(),
                _ => DepthConversion::orthographic().reversed(),
            })
            .collect();
        let text = graph(storage, radius, "2");
        let atlas = Atlas::new(&gpu, &text, size, 64);
        let depths = depths_of(size, &regions, &turns);
        atlas.run(&gpu, &regions, &conversions, &depths);
        for (index, region) in regions.iter().enumerate() {
            let alone = Atlas::new(&gpu, &text, region.extent, 1);
            let whole = MapRegion::new([0, 0], region.extent);
            let own = depths_of(whole.extent, &[whole], &[index as u32]);
            alone.run(&gpu, &[MapRegion::WHOLE], &[conversions[index]], &own);
            let same = alone.read(&gpu, &whole, 0) == atlas.read(&gpu, region, 0);
            assert!(same, "region {index}: {region:?}");
        }
    }
}

/// Texels of a float32 map.
fn floats(bytes: &[u8]) -> Vec<[f32; 4]> {
    bytemuck::pod_collect_to_vec(bytes)
}

#[test]
fn mip_levels_keep_the_mean_of_odd_sizes() {
    let gpu = gpu();
    let size = [201, 118];
    let regions = halves(size, 83);
    let atlas = Atlas::new(&gpu, &graph("float32", 1, "\"all\""), size, 2);
    let depths = depths_of(size, &regions, &[4, 5]);
    let conversions = [DepthConversion::orthographic(); 2];
    atlas.run(&gpu, &regions, &conversions, &depths);
    for region in &regions {
        let mean = |level: u32| {
            let texels = floats(&atlas.read(&gpu, region, level));
            assert_eq!(
                texels.len() as u32,
                at_level(region, level).extent.iter().product::<u32>()
            );
            let mut sum = [0.0; 4];
            for texel in &texels {
                sum.iter_mut()
                    .zip(texel)
                    .for_each(|(sum, &value)| *sum += f64::from(value));
            }
            sum.map(|sum| sum / texels.len() as f64)
        };
        let expected = mean(0);
        for level in 1..atlas.levels() {
            for (found, expected) in mean(level).into_iter().zip(expected) {
                // Rounding of each level to f32: half a unit of 2^-24 a texel, which averages out.
                assert!(
                    (found - expected).abs() < 1e-6,
                    "level {level}: {found} for {expected}"
                );
            }
        }
    }
}

#[test]
fn a_mip_level_is_the_mean_over_what_each_texel_covers() {
    let gpu = gpu();
    let size = [83, 50];
    let whole = MapRegion::new([0, 0], size);
    let atlas = Atlas::new(&gpu, &graph("float32", 1, "\"all\""), size, 1);
    let depths = depths_of(size, &[whole], &[6]);
    atlas.run(
        &gpu,
        &[MapRegion::WHOLE],
        &[DepthConversion::orthographic()],
        &depths,
    );
    for level in 1..atlas.levels() {
        let finer = floats(&atlas.read(&gpu, &whole, level - 1));
        let coarser = floats(&atlas.read(&gpu, &whole, level));
        let [width, height] = at_level(&whole, level - 1).extent.map(f64::from);
        let [columns, rows] = at_level(&whole, level).extent.map(f64::from);
        // How much of texel t lies within [start, end], by areas; all texels are asked, however far away.
        let covered =
            |texel: f64, start: f64, end: f64| ((texel + 1.0).min(end) - texel.max(start)).max(0.0);
        for row in 0..rows as usize {
            for column in 0..columns as usize {
                let span = |index: usize, from: f64, to: f64| {
                    (index as f64 * from / to, (index + 1) as f64 * from / to)
                };
                let (left, right) = span(column, width, columns);
                let (top, bottom) = span(row, height, rows);
                let mut sum = [0.0; 4];
                for y in 0..height as usize {
                    for x in 0..width as usize {
                        let area = covered(x as f64, left, right) * covered(y as f64, top, bottom);
                        if area > 0.0 {
                            let texel = finer[y * width as usize + x];
                            sum.iter_mut()
                                .zip(texel)
                                .for_each(|(sum, value)| *sum += area * f64::from(value));
                        }
                    }
                }
                let area = (right - left) * (bottom - top);
                let found = coarser[row * columns as usize + column];
                for (found, sum) in found.into_iter().zip(sum) {
                    // Nine products of f32 with weights that are rounded themselves.
                    assert!(
                        (f64::from(found) - sum / area).abs() < 1e-6,
                        "level {level}, texel {column}, {row}: {found} for {}",
                        sum / area
                    );
                }
            }
        }
    }
}
