//! Ranges that fit themselves to what a camera sees, too.

use moment_shadows::MapRegion;

use crate::fit_range::{MAP, Map, PICTURE, casters, check};
use crate::setup::{IDENTITY, gpu, view};

/// One pixel of what the camera sees lies at a depth, and all others farther to the front, or nowhere.
fn farthest(at: f32, others: f32) -> impl Fn(u32, u32) -> f32 {
    move |x, y| if (x, y) == (100, 76) { at } else { others }
}

#[test]
fn a_range_goes_no_farther_than_the_camera_sees() {
    let gpu = gpu();
    for samples in [1, 4] {
        let map = Map::seen(&gpu, 1, 1, 1, Some(samples));
        let ends = [-0.5, 0.75];
        let frame = |at: f32, others: f32| {
            let scaled = move |x: u32, y: u32| farthest(at, others)(x / samples, y);
            map.look(&gpu, scaled);
            map.frame(&gpu, 0, casters(ends))
        };
        // Nothing to see, and no range before: the host's.
        assert_eq!(frame(1.0, 1.0).ends, [-1.0, 1.0]);
        for (at, others, end) in [
            (0.25, 0.0, 0.25),
            (0.25, 1.0, 0.25),
            // Behind all casters: those decide.
            (0.9, -0.75, 0.75),
            // Grows at once, and ends with the farthest.
            (0.0, 0.0, 0.0),
            (0.5, 0.0, 0.5),
        ] {
            check([ends[0], end], frame(at, others));
        }
        // It stays where it is while what is seen ends a little nearer or farther, and while nothing is.
        let before = frame(0.5, 0.0);
        for at in [0.49, 0.51, 0.45, 1.0, 0.5] {
            assert_eq!(frame(at, if at == 1.0 { 1.0 } else { 0.0 }), before, "{at}");
        }
        // All that is seen lies in front of all casters: the shortest range, before which it is lit.
        let lit = frame(-0.75, -0.75);
        check([ends[0]; 2], lit);
    }
}

#[test]
fn each_region_has_what_is_seen_of_it() {
    let gpu = gpu();
    for axis in [0, 1] {
        let map = Map::seen(&gpu, 2, 3, 1, Some(1));
        let mut extent = MAP;
        extent[axis] /= 2;
        let mut origin = [0; 2];
        origin[axis] = extent[axis];
        let regions = [
            MapRegion::new([0, 0], extent),
            MapRegion::new(origin, extent),
        ];
        // The left or the upper half of the picture is the first region, the other one the second. Up is towards positive y.
        let half = |is_first: bool| {
            let mut light = IDENTITY;
            light[axis][axis] = 2.0;
            light[3][axis] = if is_first == (axis == 0) { 1.0 } else { -1.0 };
            view(IDENTITY, light, 0)
        };
        let parameters = &map.bound.plan.parameters;
        let mut bytes = parameters.initial();
        for layer in 0..2 {
            parameters
                .write_regions(&mut bytes, "light_depth", layer, &regions)
                .unwrap();
            // The other way round in the other layer.
            let views = [half(layer == 0), half(layer == 1)];
            parameters
                .write_all(&mut bytes, "fit", layer, &views)
                .unwrap();
        }
        gpu.queue.write_buffer(&map.bound.parameters, 0, &bytes);
        // Tiles that show both halves, eight pixels wide, show the nearer one.
        let middle = PICTURE[axis] / 2;
        map.look(&gpu, |x, y| match [x, y][axis] {
            at if at < middle - 6 => 0.0,
            at if at < middle + 10 => -0.25,
            _ => 0.5,
        });
        for (layer, ends) in [(0, [0.0, 0.5]), (1, [0.5, 0.0])] {
            map.frame(&gpu, layer, |x, _| if x % 2 == 0 { -0.5 } else { 0.75 });
            let ranges = map.ranges(&gpu, layer);
            for (range, end) in ranges.iter().zip(ends) {
                check([-0.5, end], *range);
            }
            assert_eq!(ranges[2].origin, [-1.0; 2]);
        }
    }
}
