//! Percentage closer filtering against receiver planes.

use glam::{DVec2, DVec3};
use moment_shadows::Kernel;
use moment_shadows_lab::light::{DirectionalFit, LightKind, LightView};
use moment_shadows_lab::truth::kernel::{AxisTaps, TapPattern, sample_positions};
use moment_shadows_lab::truth::pcf::pcf;
use moment_shadows_lab::truth::surface::DepthRounding;

use crate::setup::{
    Random, depth_map, from_values, gaussian, half_normal, parallel_light, plane_distance,
    spot_light, surface,
};

#[test]
fn a_straight_edge_gives_a_linear_ramp() {
    let light = parallel_light();
    // The left 8 of 16 columns hold an occluder at moment depth -0.5, the others the far end.
    let depths = depth_map(&light, [16, 16], 1, DepthRounding::Float32, |uv| {
        if uv.x < 0.5 { 0.5 } else { 2.0 }
    });
    let taps = TapPattern::of_kernel(&Kernel::from_weights(&[1.0, 1.0, 1.0]).unwrap());
    let points: Vec<(DVec3, DVec3)> = (0..=64)
        .map(|i| (DVec3::new(f64::from(i) / 32.0 - 1.0, 0.1, -1.2), DVec3::Z))
        .collect();
    let intensities = pcf(&light, &depths, &taps, &surface(&points)).unwrap();
    for (i, intensity) in intensities.into_iter().enumerate() {
        // A box of three texels whose centre is interpolated: 1 up to column 6.5, 0 from 9.5 on.
        let column = i as f64 / 4.0;
        let expected = ((9.5 - column) / 3.0).clamp(0.0, 1.0);
        // Weights are multiples of 2^-18.
        assert!(
            (f64::from(intensity) - expected).abs() < 4e-6,
            "column {column}: {intensity} instead of {expected}"
        );
    }
}

#[test]
fn every_sample_of_a_texel_counts() {
    let light = parallel_light();
    // The occluder covers the left half of the one column 4: the two samples at 0.375 and 0.125 of four.
    let depths = depth_map(&light, [8, 8], 4, DepthRounding::Float32, |uv| {
        if uv.x * 8.0 > 4.0 && uv.x * 8.0 < 4.5 {
            0.5
        } else {
            2.0
        }
    });
    let point = DVec3::new(4.5 / 4.0 - 1.0, 1.0 / 8.0, -1.2);
    let taps = TapPattern::unblurred();
    let intensity = pcf(&light, &depths, &taps, &surface(&[(point, DVec3::Z)])).unwrap();
    assert_eq!(intensity, [0.5]);
}

#[test]
fn a_tilted_plane_does_not_shadow_itself() {
    let mut random = Random(1);
    let mut compared = 0;
    let lights = [
        parallel_light(),
        spot_light(false),
        spot_light(true),
        LightView::directional_fitted(
            DVec3::new(-0.5, -0.4, 0.3),
            &[DVec3::splat(-3.0), DVec3::splat(3.0)],
            DirectionalFit {
                map: [64, 64],
                margin: 4.0,
                reversed: true,
            },
        )
        .unwrap(),
    ];
    for light in lights {
        for rounding in [DepthRounding::Float32, DepthRounding::Unorm16] {
            // Reversed perspective depth in 16 bits resolves nothing at a distance; nobody stores it.
            if rounding == DepthRounding::Unorm16 && light.kind() == LightKind::Spot {
                continue;
            }
            for tilt in (0..=80).step_by(8) {
                let (origin, direction) = light.ray(DVec2::new(0.45, 0.55));
                let middle = 0.5 * (light.range[0] + light.range[1]);
                let point = origin + middle * direction;
                let to_light = -direction.normalize();
                let side = to_light.cross(random.direction()).normalize();
                let (sine, cosine) = f64::from(tilt).to_radians().sin_cos();
                let normal = cosine * to_light + sine * side;
                // Each sample sees the plane where a rasteriser that snaps to 1/256 texel may have drawn it.
                let mut jitter = Random(7);
                let distance = |uv| {
                    let by = DVec2::from_array([(); 2].map(|()| jitter.between(-0.5, 0.5)));
                    let drawn = uv + by / 256.0 / 64.0;
                    let distance = plane_distance(&light, drawn, point, normal);
                    if distance > 0.0 { distance } else { f64::MAX }
                };
                let depths = depth_map(&light, [64, 64], 4, rounding, distance);
                // Receivers on the plane, wherever it is inside of the range of depths.
                let points: Vec<(DVec3, DVec3)> = (0..200)
                    .filter_map(|_| {
                        let uv = DVec2::new(random.next(), random.next());
                        let distance = plane_distance(&light, uv, point, normal);
                        let (origin, direction) = light.ray(uv);
                        let inside = distance > light.range[0] && distance < light.range[1];
                        inside.then_some((origin + distance * direction, half_normal(normal)))
                    })
                    .collect();
                assert!(points.len() > 5);
                let lit = pcf(&light, &depths, &gaussian(), &surface(&points)).unwrap();
                assert!(
                    lit.iter().all(|&i| i == 0.0),
                    "{rounding:?}, {tilt} degrees"
                );
                // The tolerance is small: four thousandths of the range behind the plane all is dark, if all that the
                // kernel sees of the plane is inside of the range.
                let away = 4e-3 * (light.range[1] - light.range[0]);
                let seen = |p: DVec3| {
                    let uv = light.uv(p).unwrap();
                    [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]]
                        .into_iter()
                        .all(|corner| {
                            let at = uv + DVec2::from_array(corner) * 6.0 / 64.0;
                            let distance = plane_distance(&light, at, point, normal);
                            distance > light.range[0] && distance + away < light.range[1]
                        })
                };
                let behind: Vec<(DVec3, DVec3)> = points
                    .iter()
                    .filter(|&&(p, _)| seen(p))
                    .map(|&(p, n)| (p - away * light.towards_light(p), n))
                    .collect();
                let dark = pcf(&light, &depths, &gaussian(), &surface(&behind)).unwrap();
                compared += dark.len();
                // Weights are rounded to single precision.
                assert!(
                    dark.iter().all(|&i| i > 0.999_999),
                    "{rounding:?}, {tilt} degrees"
                );
            }
        }
    }
    assert!(compared > 1000, "{compared} receivers behind their plane");
}

#[test]
fn rounding_of_a_16_bit_map_is_no_occluder() {
    let light = parallel_light();
    let mut random = Random(6);
    for _ in 0..16 {
        // Seen face-on through few texels, so that nothing but the rounding of depth is left to tolerate.
        let distance = random.between(0.1, 1.9);
        let depths = depth_map(&light, [256, 256], 1, DepthRounding::Unorm16, |_| distance);
        let point = DVec3::new(0.3, 0.2, -distance);
        let taps = TapPattern::unblurred();
        let lit = pcf(&light, &depths, &taps, &surface(&[(point, DVec3::Z)])).unwrap();
        assert_eq!(lit, [0.0], "at distance {distance}");
    }
}

#[test]
fn samples_in_front_of_the_plane_are_those_on_the_lights_side() {
    // Independently in world space: a sample is an occluder if it lies on the side of the plane where its ray starts.
    let mut random = Random(2);
    let size = [12, 9];
    let mut decided = 0;
    for light in [parallel_light(), spot_light(true)] {
        for _ in 0..40 {
            let mut distances = Vec::new();
            let [near, far] = light.range;
            let depths = depth_map(&light, size, 4, DepthRounding::Float32, |_| {
                // Never at the very end, which stands for no caster.
                let distance = random.between(near + 0.01, far - 0.1);
                distances.push(distance);
                distance
            });
            let uv = DVec2::new(random.next(), random.next());
            let (origin, direction) = light.ray(uv);
            let point = origin + random.between(near, far) * direction;
            let normal = random.direction();
            let cosine = normal.dot(direction.normalize()).abs();
            if cosine < 0.1 {
                continue;
            }
            let taps = gaussian();
            let intensity = pcf(&light, &depths, &taps, &surface(&[(point, normal)])).unwrap()[0];
            let (mut columns, mut rows) = (AxisTaps::default(), AxisTaps::default());
            taps.along_axis(uv.x, size[0], &mut columns);
            taps.along_axis(uv.y, size[1], &mut rows);
            let mut expected = 0.0;
            // Samples this close to the plane may count either way: the tolerance of the comparison, mostly for normals
            // in half precision on a map of few texels.
            let mut undecided = 1e-5;
            let close = 1e-2 * (1.0 + 0.2 / cosine);
            for (y, row) in rows.weights.iter().enumerate() {
                for (x, column) in columns.weights.iter().enumerate() {
                    let (x, y) = (columns.first + x, rows.first + y);
                    for (sample, [sx, sy]) in sample_positions(4).unwrap().iter().enumerate() {
                        let at = DVec2::new(
                            (x as f64 + sx) / f64::from(size[0]),
                            (y as f64 + sy) / f64::from(size[1]),
                        );
                        let (start, along) = light.ray(at);
                        let distance = distances[(y * size[0] as usize + x) * 4 + sample];
                        // Parallel rays start infinitely far up, those of a spot light at its position.
                        let start = match light.kind() {
                            LightKind::Directional => start - 1e6 * along,
                            LightKind::Spot => start,
                        };
                        let end = light.ray(at).0 + distance * along;
                        let side = |p: DVec3| normal.dot(p - point);
                        let weight = row * column / 4.0;
                        if side(end).abs() < close {
                            undecided += weight;
                        }
                        if side(end) * side(start) > 0.0 {
                            expected += weight;
                        }
                    }
                }
            }
            assert!(
                (f64::from(intensity) - expected).abs() <= undecided,
                "{:?}: {intensity} instead of {expected} (undecided {undecided})",
                light.kind()
            );
            decided += usize::from(undecided < 0.02);
        }
    }
    assert!(decided > 40, "only {decided} of 80 receivers tell much");
}

#[test]
fn nothing_is_shadowed_outside_of_the_map_or_by_nothing() {
    let light = parallel_light();
    let near = depth_map(&light, [8, 8], 1, DepthRounding::Float32, |_| 0.1);
    let empty = depth_map(&light, [8, 8], 1, DepthRounding::Float32, |_| 2.0);
    let inside = (DVec3::new(0.0, 0.0, -1.5), DVec3::Z);
    let outside = (DVec3::new(1.5, 0.0, -1.5), DVec3::Z);
    let beyond = (DVec3::new(0.0, 0.0, -50.0), DVec3::new(0.9, 0.1, 0.4));
    let edge_on = (DVec3::new(0.0, 0.0, -1.5), DVec3::X);
    let mut pixels = surface(&[inside, outside, beyond, edge_on, inside]);
    pixels.covered[4] = false;
    let shadowed = pcf(&light, &near, &gaussian(), &pixels).unwrap();
    assert!(shadowed[0] > 0.999_999 && shadowed[2] > 0.999_999 && shadowed[3] > 0.999_999);
    assert_eq!((shadowed[1], shadowed[4]), (0.0, 0.0));
    let lit = pcf(&light, &empty, &gaussian(), &pixels).unwrap();
    assert_eq!(lit, [0.0; 5]);
}

#[test]
fn lists_of_the_wrong_length_are_refused() {
    let light = parallel_light();
    let of = |size, samples, stored: &[f32]| {
        from_values(
            &light,
            size,
            samples,
            DepthRounding::Float32,
            stored.to_vec(),
        )
    };
    let short = of([4, 4], 4, &[0.0; 63]).unwrap_err();
    assert_eq!(
        short.to_string(),
        "the depth map has 63 entries where its size asks for 64"
    );
    for (refused, culprit) in [
        (of([4, 4], 3, &[0.0; 48]), "3 samples per texel"),
        (of([0, 4], 1, &[]), "0x4 texels is empty"),
    ] {
        let error = refused.unwrap_err().to_string();
        assert!(error.contains(culprit), "{error}");
    }
    let depths = of([1, 1], 1, &[0.5]).unwrap();
    let mut pixels = surface(&[(DVec3::ZERO, DVec3::Z)]);
    pixels.normal.clear();
    let error = pcf(&light, &depths, &gaussian(), &pixels).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the list of normals has 0 entries where its size asks for 1"
    );
}
