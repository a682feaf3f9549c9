//! The average over a pixel, from loaded texels: probes along the major axis, each blended from two mip levels.

use crate::device::{GRADIENT, Query, Shader};
use crate::edges::regions;
use crate::footprints::{Pixel, pixels};
use crate::map::Map;
use moment_shadows::MapRegion;

const SIZE: [u32; 2] = [64, 40];
const LEVELS: u32 = 5;

/// The average in f64, or nothing where rounding decides how many probes there are.
fn average(map: &Map, uv: [f64; 2], pixel: &Pixel) -> Option<[f64; 4]> {
    let (major, minor) = pixel.axes();
    let length = major[0].hypot(major[1]);
    let most = f64::from(pixel.anisotropy);
    let width = (length * (3.0 / (most * most + 2.0)).sqrt())
        .max(minor)
        .max(1.0);
    let line = (length * length - width * width).max(0.0).sqrt();
    let texel = (width / 3f64.sqrt()).max(1.0);
    let filled = line / texel - 1e-3;
    if (filled - filled.round()).abs() < 1e-4 || length - minor < 1e-2 * length {
        return None;
    }
    let probes = filled.ceil().clamp(1.0, most);
    let mut sum = [0.0; 4];
    for probe in 0..probes as u32 {
        // The middle of each of as many equal parts of the line.
        let along = ((f64::from(probe) + 0.5) / probes - 0.5) * line / length;
        let place =
            [0, 1].map(|axis| uv[axis] + along * major[axis] / f64::from(map.region.extent[axis]));
        let found = map.trilinear(place, texel.log2());
        for (sum, channel) in sum.iter_mut().zip(found) {
            *sum += channel / probes;
        }
    }
    Some(sum)
}

fn query(pixel: &Pixel, uv: [f32; 2], region: MapRegion) -> Query {
    Query {
        uv,
        difference_x: pixel.difference_x,
        difference_y: pixel.difference_y,
        region,
        lookup: GRADIENT,
        levels: LEVELS,
        level: 0.0,
        anisotropy: pixel.anisotropy,
    }
}

#[test]
fn it_is_that_of_its_probes_around_the_pixels_centre() {
    let shader = Shader::new();
    let mut compared = 0;
    // All but the region that is the whole map, which is the sampler's.
    for (seed, region) in (30..).zip(regions()).skip(1) {
        let map = Map::new(SIZE, region, LEVELS, seed);
        // One that is aligned with all mip levels is read by the sampler, too, away from its edges.
        let at_the_edge = [[0.02, 0.5], [0.97, 0.96], [1.0, 0.0], [0.4, 0.99_f32]];
        let pixels = pixels(seed, 400, 24.0);
        let queries: Vec<Query> = pixels
            .iter()
            .zip(at_the_edge.into_iter().cycle())
            .map(|(pixel, uv)| query(pixel, uv, region))
            .collect();
        let answers = shader.run(&map, &queries);
        for ((pixel, query), found) in pixels.iter().zip(&queries).zip(answers) {
            let Some(expected) = average(&map, query.uv.map(f64::from), pixel) else {
                continue;
            };
            compared += 1;
            for (found, expected) in found.into_iter().zip(expected) {
                // Axes, places and levels in f32 are off by 1e-5 of a texel or a level, where texels differ by less than 1.
                assert!(
                    (f64::from(found) - expected).abs() < 1e-3,
                    "{found}, not {expected}: {query:?}"
                );
            }
        }
    }
    assert!(compared > 1200, "{compared}");
}

/// A sampler without anisotropy averages over squares, as long as the pixel; probes are as wide as it is.
#[test]
fn where_the_region_is_the_whole_map_it_is_that_of_the_sampler() {
    let shader = Shader::new();
    let map = Map::new(SIZE, regions()[0], LEVELS, 40);
    let long = pixels(40, 400, 24.0).into_iter().filter(|pixel| {
        let ([x, y], minor) = pixel.axes();
        pixel.anisotropy >= 7.0 && x.hypot(y) > 4.0 * minor.max(1.0)
    });
    let long: Vec<_> = long.collect();
    // At the edge, where other regions would be left to probes.
    let uv = [0.97, 0.96];
    let queries: Vec<Query> = long
        .iter()
        .map(|pixel| query(pixel, uv, map.region))
        .collect();
    let answers = shader.run(&map, &queries);
    let pairs = long.iter().zip(answers);
    let compared: Vec<bool> = pairs
        .filter_map(|(pixel, found)| {
            let probes = average(&map, uv.map(f64::from), pixel)?;
            let pairs = found.into_iter().zip(probes);
            let apart = pairs.map(|(found, probes)| (f64::from(found) - probes).abs());
            Some(apart.fold(0.0, f64::max) > 1e-2)
        })
        .collect();
    let by_sampler = compared.iter().filter(|it| **it).count();
    assert!(compared.len() > 20, "{}", compared.len());
    assert!(
        10 * by_sampler > 9 * compared.len(),
        "{by_sampler} of {}",
        compared.len()
    );
}
