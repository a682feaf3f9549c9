//! Cascades: splits, what they contain, and that texels stay where they are.

use glam::{DMat4, DVec2, DVec3};
use moment_shadows::{CascadeSplits, Cascades, LightView};
use rand::RngExt as _;

use crate::camera::{LENSES, Lens, Pose};
use crate::{cascades, direction, place, random, within};

const FORWARD: Lens = LENSES[0];

/// How far apart two numbers are for rounding alone.
#[track_caller]
fn assert_near(found: f64, expected: f64) {
    let off = (found - expected).abs();
    assert!(off <= 1e-12 * expected.abs(), "{found} is not {expected}");
}

#[test]
fn splits_are_uniform_logarithmic_between_them_or_given() {
    let ends = |splits, overlap| {
        let cascades = Cascades {
            splits,
            near: 1.0,
            far: 16.0,
            overlap,
            ..cascades()
        };
        cascades.slices().unwrap()
    };
    let blend = |logarithmic| CascadeSplits::Blend {
        count: 4,
        logarithmic,
    };
    let uniform = [1.0, 4.75, 8.5, 12.25, 16.0];
    let logarithmic = [1.0, 2.0, 4.0, 8.0, 16.0];
    for weight in [0.0, 0.25, 1.0] {
        for (index, slice) in ends(blend(weight), 0.0).into_iter().enumerate() {
            for (end, found) in slice.into_iter().enumerate() {
                let [first, second] = [uniform, logarithmic].map(|ends| ends[index + end]);
                assert_near(found, first + weight * (second - first));
            }
        }
    }
    let given = ends(CascadeSplits::Given(vec![3.0, 9.0]), 0.5);
    // Half of their own lengths, 2 and 6, and nothing beyond the last.
    assert_eq!(given, [[1.0, 4.0], [3.0, 12.0], [9.0, 16.0]]);
    assert_eq!(ends(CascadeSplits::Given(vec![]), 1.0), [[1.0, 16.0]]);
}

#[test]
fn every_slice_lies_within_its_cascade_with_any_camera() {
    let mut random = random();
    for lens in LENSES {
        for _ in 0..20 {
            let pose = Pose {
                lens,
                eye: 1e5 * direction(&mut random),
                forward: direction(&mut random),
            };
            let cascades = Cascades {
                direction: direction(&mut random).to_array(),
                reversed: random.random(),
                ..cascades()
            };
            let views = cascades.views(&pose.camera()).unwrap();
            let slices = cascades.slices().unwrap();
            assert_eq!(views.len(), slices.len());
            for (view, slice) in views.iter().zip(slices) {
                let clip = DMat4::from_cols_array_2d(&view.clip_from_world);
                // Clip space is left-handed: a view of a right-handed scene that mirrors nothing turns that around, unless it
                // reverses depth.
                let sign = if cascades.reversed { 1.0 } else { -1.0 };
                assert!(sign * clip.determinant() > 0.0);
                let mut smallest = f64::INFINITY;
                for distance in slice {
                    for corner in [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]] {
                        let (texel, depth) = place(view, pose.corner(distance, corner)).unwrap();
                        let inside = within(view, texel);
                        assert!(inside >= 0.0, "{pose:?} {slice:?}: {inside}");
                        assert!((0.0..=1.0).contains(&depth), "{pose:?}: {depth}");
                        smallest = smallest.min(inside);
                    }
                }
                let inner = f64::from(view.region.extent[0] - 2 * view.guard);
                // Turned every way, some corner of a sphere around a slice comes close to the edge of its square.
                assert!(smallest < 0.35 * inner, "{smallest}");
            }
        }
    }
}

#[test]
fn a_cascade_is_as_small_as_a_sphere_around_its_slice() {
    for tangents in [[0.9, 0.5], [0.3, 0.2]] {
        let pose = Pose {
            lens: Lens::Perspective(tangents, [0.0; 2], true),
            eye: DVec3::ZERO,
            forward: DVec3::Z,
        };
        let cascades = cascades();
        let views = cascades.views(&pose.camera()).unwrap();
        for (view, slice) in views.iter().zip(cascades.slices().unwrap()) {
            let radius = |middle: f64| {
                let corners = slice.map(|distance| pose.corner(distance, [1.0; 2]));
                let far = corners.map(|corner| corner.distance(middle * DVec3::Z));
                far[0].max(far[1])
            };
            // Of all places along the axis.
            let places = (0..=100_000).map(|part| slice[1] * f64::from(part) / 1e5);
            let smallest = places.map(radius).fold(f64::INFINITY, f64::min);
            let inner = f64::from(view.region.extent[0] - 2 * view.guard);
            let texel = view.texel_size(view.region.extent)[0];
            let loss = texel * (inner - 1.0) / (2.0 * smallest);
            // Rounding to 11 bits.
            assert!((1.0..1.0011).contains(&loss), "{slice:?}: {loss}");
        }
    }
}

/// Fractions of a place in texels, and a texel's size.
fn phase(view: &LightView, point: DVec3) -> (DVec2, [f64; 2]) {
    let (texel, _) = place(view, point).unwrap();
    (texel.fract(), view.texel_size(view.region.extent))
}

#[test]
fn texels_keep_their_size_and_phase_while_a_camera_moves_and_turns() {
    let corners = Some([[-30.0, -1.0, -20.0], [30.0, 8.0, 25.0]]);
    let mut largest = 0.0_f64;
    for lens in LENSES {
        for (casters, tile, far_away) in [
            (None, 512, 0.0),
            (corners, 512, 0.0),
            (None, 511, 0.0),
            (None, 512, 1e5),
        ] {
            let mut cascades = cascades();
            cascades.casters = casters;
            cascades.tile.texels = tile;
            let frame = |number: i32| {
                let t = f64::from(number);
                let eye = DVec3::new(0.31 * t, 1.7 + (0.2 * t).sin(), -0.17 * t);
                let turn = DVec3::new((0.09 * t).sin(), 0.4 * (0.05 * t).cos(), (0.09 * t).cos());
                let pose = Pose {
                    lens,
                    eye: eye + far_away,
                    forward: turn.normalize(),
                };
                cascades.views(&pose.camera()).unwrap()
            };
            let point = DVec3::new(0.123, 0.456, 7.89) + far_away;
            let first = frame(0);
            for number in 1..60 {
                for (before, view) in first.iter().zip(frame(number)) {
                    let ((was, size), (is, now)) = (phase(before, point), phase(&view, point));
                    assert_eq!(size, now, "{lens:?} {number}");
                    // A fraction of almost 1 is one of almost 0.
                    let off = (is - was - (is - was).round()).abs().max_element();
                    assert!(off < 1e-6, "{lens:?} {number}: {off}");
                    largest = largest.max(off);
                }
            }
        }
    }
    println!("the largest change of a texel's phase is {largest:e} texels");
}

#[test]
fn ranges_contain_all_casters_or_clamp_those_in_front() {
    let mut random = random();
    let (mut clamped, mut tighter) = (0, 0);
    for _ in 0..100 {
        let pose = Pose {
            lens: FORWARD,
            eye: 30.0 * direction(&mut random),
            forward: direction(&mut random),
        };
        let low = 40.0 * direction(&mut random);
        let high = low + 30.0 * direction(&mut random).abs();
        let casters = Some([low.to_array(), high.to_array()]);
        let ranges = [true, false].map(|pancaking| {
            let cascades = Cascades {
                direction: [-0.2, -1.0, 0.1],
                casters,
                pancaking,
                ..cascades()
            };
            cascades.views(&pose.camera()).unwrap()
        });
        let [with, without] = ranges;
        for (with, without) in with.iter().zip(&without) {
            let [short, long] = [with, without].map(|view| view.range().far);
            assert!(short <= long * (1.0 + 1e-12));
            tighter += usize::from(short < 0.9 * long);
            for _ in 0..20 {
                let part = DVec3::from([0; 3].map(|_| random.random_range(0.0..=1.0)));
                let caster = low + part * (high - low);
                let [shallow, depth] = [with, without].map(|view| place(view, caster).unwrap().1);
                // In front of the near plane only those that are clamped there.
                assert!(depth >= 0.0, "{depth}");
                clamped += usize::from(shallow < 0.0);
            }
        }
    }
    assert!(clamped > 100 && tighter > 50, "{clamped} {tighter}");
}

#[test]
fn a_map_is_no_larger_than_the_casters() {
    let pose = Pose {
        lens: FORWARD,
        eye: DVec3::ZERO,
        forward: DVec3::Z,
    };
    let (low, high) = (DVec3::new(-3.0, 0.0, 10.0), DVec3::new(3.0, 5.0, 14.0));
    let cascades = Cascades {
        casters: Some([low.to_array(), high.to_array()]),
        ..cascades()
    };
    let far = *cascades.views(&pose.camera()).unwrap().last().unwrap();
    let corners = (0..8).map(|corner| {
        let high_at = glam::BVec3::new(corner & 1 > 0, corner & 2 > 0, corner & 4 > 0);
        place(&far, DVec3::select(high_at, high, low)).unwrap()
    });
    let (mut least, mut most) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for (texel, depth) in corners {
        assert!(within(&far, texel) >= 0.0 && (0.0..=1.0).contains(&depth));
        (least, most) = (least.min(texel), most.max(texel));
    }
    // All but a texel or two, for snapping and for rounding the size of texels up by less than a thousandth.
    let inner = f64::from(far.region.extent[0] - 2 * far.guard);
    let used = (most - least).max_element();
    assert!(used > inner * 0.998 - 2.0, "{used} of {inner}");
}
