//! Magnified lookups, also beyond the centres of a region's first and last texels: those repeat, nothing else is read.

use moment_shadows::MapRegion;

use crate::device::{LOADED, Query, SAMPLED, Shader, TRILINEAR};
use crate::map::{Map, OUTSIDE};

const SIZE: [u32; 2] = [64, 40];
const LEVELS: u32 = 5;

/// Rectangles within the map and at its ends, aligned with mip levels and not.
pub(crate) fn regions() -> [MapRegion; 5] {
    [
        ([0, 0], SIZE),
        ([16, 8], [32, 16]),
        ([13, 7], [27, 19]),
        ([51, 29], [13, 11]),
        ([9, 30], [5, 3]),
    ]
    .map(|(origin, extent)| MapRegion::new(origin, extent))
}

/// Places across a region and beyond it, many of them within half a texel of its edges.
fn places(extent: [u32; 2]) -> Vec<[f32; 2]> {
    let along = |extent: u32| {
        let texel = 1.0 / extent as f32;
        let from_the_edge = [-3.0, -0.2, 0.0, 0.2, 0.5, 0.7, 1.3].map(|texels| texels * texel);
        let mut all: Vec<f32> = from_the_edge.to_vec();
        all.extend(from_the_edge.map(|distance| 1.0 - distance));
        all.extend([0.31, 0.5, 0.83, -1.5, 2.5]);
        all
    };
    let rows = along(extent[1]);
    let columns = along(extent[0]);
    rows.iter()
        .flat_map(|&v| columns.iter().map(move |&u| [u, v]))
        .collect()
}

fn map(region: MapRegion) -> Map {
    Map::new(SIZE, region, LEVELS, 11)
}

fn ask(map: &Map, lookup: u32, uv: [f32; 2], level: f32) -> Query {
    Query {
        uv,
        difference_x: [0.0; 2],
        difference_y: [0.0; 2],
        region: map.region,
        lookup,
        levels: LEVELS,
        level,
        anisotropy: 1.0,
    }
}

/// The largest difference of lookups from those in f64.
fn check(lookup: u32, levels: &[f32], tolerance: f64) {
    let shader = Shader::new();
    for region in regions() {
        let map = map(region);
        for &level in levels {
            // Bilinear lookups are of levels that the region has.
            if lookup != TRILINEAR && level > map.last_level() as f32 {
                continue;
            }
            // One level at a time: a driver may sample neighbouring invocations on the level of one of them (lavapipe does).
            let places = places(region.extent).into_iter();
            let queries: Vec<Query> = places.map(|uv| ask(&map, lookup, uv, level)).collect();
            for (query, found) in queries.iter().zip(shader.run(&map, &queries)) {
                let expected = map.trilinear(query.uv.map(f64::from), f64::from(query.level));
                for (found, expected) in found.into_iter().zip(expected) {
                    assert!(
                        (f64::from(found) - expected).abs() <= tolerance,
                        "{found}, not {expected}: {query:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_sampler_reads_the_region_alone() {
    // Weights have 8 bits at least, and may be cut off: each axis is off by 1/256 of a difference below 1. A weight of
    // 1/256 of a texel outside would be thirty times as much.
    let tolerance = 2.1 / 256.0;
    assert!(OUTSIDE / 256.0 > 30.0 * tolerance);
    check(SAMPLED, &[0.0, 1.0, 2.0, 3.0, 4.0], tolerance);
}

#[test]
fn loaded_texels_are_those_of_the_region_alone() {
    // Places are below 64: their rounding, 2^-19, twice per axis, is what weights are off by.
    check(LOADED, &[0.0, 1.0, 2.0, 3.0, 4.0], 1e-5);
}

#[test]
fn between_two_levels_both_have_a_share() {
    // As above, and the same again for the levels' own weight. Levels that the region does not have are its last one.
    let levels = [
        -0.5, 0.0, 0.1, 0.5, 0.99, 1.0, 1.25, 2.5, 3.75, 4.0, 4.5, 9.0,
    ];
    check(TRILINEAR, &levels, 2e-5);
}
