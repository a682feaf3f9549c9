//! Percentage closer soft shadows.

use moment_shadows::{AreaLight, DepthRange, LightSize};
use moment_shadows_lab::gpu::Gpu;

use crate::brute_force::Convention;
use crate::device::{self, Query, Shader};
use crate::poisson::segment;

const IMPORTS: &str = "
import moment_shadows::shade::area_light::{AreaLight};
import moment_shadows::techniques::percentage_closer_soft::{percentage_closer_soft_intensity};
";

/// The taps of search and filter are in `taps` and `radius`.
const BODY: &str = "
alias Extra = AreaLight;
fn answer(query: Query, plane: ReceiverPlane) -> f32 {
    return percentage_closer_soft_intensity(map, query.layer, query.region, plane, conversion, extra, query.taps, u32(query.radius), query.angle);
}
";

const SIZE: [u32; 2] = [256, 128];
const ANGLES: u32 = 32;
const RADII: std::ops::RangeInclusive<f64> = 0.5..=60.0;

/// A half-plane of casters at a moment depth: left of the middle, or above it.
fn edge(gpu: &Gpu, convention: Convention, axis: usize, depth: f64) -> wgpu::Texture {
    let stored = (0..SIZE[0] * SIZE[1])
        .map(|texel| {
            let place = [texel % SIZE[0], texel / SIZE[0]][axis];
            convention.store(if 2 * place < SIZE[axis] { depth } else { 1.0 }) as f32
        })
        .collect();
    device::map(gpu, wgpu::TextureFormat::Depth32Float, SIZE, &[stored])
}

/// The distance in texels between the intensities 0.9 and 0.1 across the edge, over the mean of many rotations.
fn width(
    shader: &Shader<'_>,
    map: &wgpu::Texture,
    convention: Convention,
    axis: usize,
    light: AreaLight,
    depth: f32,
) -> f64 {
    let steps = 4 * 100;
    let mut queries = Vec::new();
    for step in 0..=steps {
        for angle in 0..ANGLES {
            let place = SIZE[axis] as f32 / 2.0 + (step - steps / 2) as f32 / 8.0;
            let mut uv = [0.5; 2];
            uv[axis] = place / SIZE[axis] as f32;
            queries.push(Query {
                taps: 64,
                radius: 128.0,
                angle: std::f32::consts::TAU * angle as f32 / ANGLES as f32,
                ..Query::new(uv, depth, SIZE)
            });
        }
    }
    let compare = wgpu::CompareFunction::Greater;
    let answers = shader.run(
        map,
        compare,
        convention.conversion(),
        bytemuck::bytes_of(&light),
        &queries,
    );
    let profile: Vec<f64> = answers
        .chunks_exact(ANGLES as usize)
        .map(|angles| angles.iter().copied().map(f64::from).sum::<f64>() / f64::from(ANGLES))
        .collect();
    let crossing = |level: f64| {
        profile
            .iter()
            .filter(|&&intensity| intensity > level)
            .count() as f64
            / 8.0
    };
    crossing(0.1) - crossing(0.9)
}

/// The width from 10 % to 90 % of a disk of a diameter: a segment has a tenth of its area there.
fn disk_width(diameter: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if segment(middle) > 0.1 {
            low = middle
        } else {
            high = middle
        }
    }
    diameter * low
}

#[track_caller]
fn assert_close(found: f64, diameter: f64, what: &str) {
    let expected = disk_width(diameter);
    println!("{what}: {found:.2} texels, exactly {expected:.2}");
    assert!(
        (found / expected - 1.0).abs() < 0.15,
        "{what}: {found}, not {expected}"
    );
}

#[test]
fn a_sun_throws_penumbrae_as_wide_as_its_angle_says() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let convention = Convention::Orthographic { reversed: false };
    // A range of 20 scene units over texels of 0.05 by 0.1.
    let range = DepthRange {
        near: 5.0,
        far: 25.0,
    };
    let angle = 0.15_f64;
    let light =
        AreaLight::new(LightSize::AngularDiameter(angle), [0.05, 0.1], range, RADII).unwrap();
    for axis in [0, 1] {
        for caster in [-0.6, 0.0, 0.5] {
            let map = edge(&gpu, convention, axis, caster);
            for receiver in [0.7_f32, 0.95] {
                let apart = 10.0 * (f64::from(receiver) - caster);
                let diameter = 2.0 * (0.5 * angle).tan() * apart / [0.05, 0.1][axis];
                let found = width(&shader, &map, convention, axis, light, receiver);
                assert_close(
                    found,
                    diameter,
                    &format!("sun, axis {axis}, from {caster} to {receiver}"),
                );
            }
        }
    }
}

#[test]
fn a_spot_light_throws_penumbrae_as_wide_as_its_disk_says() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let convention = Convention::Perspective {
        far: 12.0,
        reversed: false,
    };
    let range = convention.range();
    let texel = [1.0 / 256.0, 1.0 / 128.0];
    let light = AreaLight::new(LightSize::Disk(0.6), texel, range, RADII).unwrap();
    for axis in [0, 1] {
        for caster in [-0.5, 0.2] {
            let map = edge(&gpu, convention, axis, caster);
            for receiver in [0.5_f32, 0.9] {
                let [near, far] = [caster, f64::from(receiver)].map(|z| 5.0 + 4.0 * z);
                // By similar triangles the penumbra is 0.6 (far - near) / near wide where the receiver is, and a texel
                // is as wide as at distance 1 times the receiver's distance.
                let diameter = 0.6 * (far - near) / near / (far * texel[axis]);
                let found = width(&shader, &map, convention, axis, light, receiver);
                assert_close(
                    found,
                    diameter,
                    &format!("spot, axis {axis}, from {caster} to {receiver}"),
                );
            }
        }
    }
}

#[test]
fn the_largest_radius_bounds_the_penumbra() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let convention = Convention::Orthographic { reversed: false };
    let range = DepthRange {
        near: 0.0,
        far: 20.0,
    };
    let radii = 0.5..=8.0;
    let light =
        AreaLight::new(LightSize::AngularDiameter(0.5), [0.05, 0.05], range, radii).unwrap();
    let map = edge(&gpu, convention, 0, -0.5);
    assert_close(
        width(&shader, &map, convention, 0, light, 0.9),
        16.0,
        "at most 8 texels",
    );
    let radii = 6.0..=40.0;
    let light =
        AreaLight::new(LightSize::AngularDiameter(1e-4), [0.05, 0.05], range, radii).unwrap();
    assert_close(
        width(&shader, &map, convention, 0, light, 0.9),
        12.0,
        "at least 6 texels",
    );
}

#[test]
fn any_counts_of_taps_agree_on_what_is_lit_and_what_is_dark() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let convention = Convention::Orthographic { reversed: false };
    let range = DepthRange {
        near: 0.0,
        far: 20.0,
    };
    let light =
        AreaLight::new(LightSize::AngularDiameter(0.1), [0.05, 0.05], range, RADII).unwrap();
    let map = edge(&gpu, convention, 0, 0.0);
    let counts = [0_u32, 1, 2, 3, 5, 16, 333, 4096, u32::MAX];
    let mut queries = Vec::new();
    for (search, filter) in counts.into_iter().flat_map(|s| counts.map(|f| (s, f))) {
        for u in [0.02, 0.5, 0.98] {
            queries.push(Query {
                taps: search,
                radius: filter as f32,
                angle: 1.0,
                ..Query::new([u, 0.5], 0.5, SIZE)
            });
        }
    }
    // No blockers: in front of the casters, on either side.
    queries.push(Query {
        taps: 16,
        radius: 16.0,
        ..Query::new([0.1, 0.5], -0.1, SIZE)
    });
    queries.push(Query {
        taps: 16,
        radius: 16.0,
        ..Query::new([0.5, 0.5], -0.1, SIZE)
    });
    let found = shader.run(
        &map,
        wgpu::CompareFunction::Greater,
        convention.conversion(),
        bytemuck::bytes_of(&light),
        &queries,
    );
    let (counted, lit) = found.split_at(found.len() - 2);
    for (place, query) in counted.chunks_exact(3).zip(queries.chunks_exact(3)) {
        assert_eq!([place[0], place[2]], [1.0, 0.0], "{:?}", query[0]);
        // A single tap finds nothing but blockers, or none.
        let one = query[0].taps <= 1;
        assert!(!one || place[1] == 0.0 || place[1] == 1.0, "{}", place[1]);
        let enough = query[0].taps >= 16 && query[0].radius >= 16.0;
        assert!(
            !enough || (place[1] - 0.5).abs() < 0.13,
            "{} on the edge",
            place[1]
        );
    }
    assert_eq!(lit, [0.0, 0.0]);
}
