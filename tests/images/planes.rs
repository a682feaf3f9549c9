//! Unoccluded planes are lit: at every tilt up to 80 degrees, in every storage, from near and far, with the one receiver
//! bias that follows from the kernel.

use glam::{DMat4, DVec2, DVec3};
use moment_shadows::Storage;
use moment_shadows_lab::light::{LightView, StoredDepth};
use moment_shadows_lab::view::Camera;

use crate::stage::{Stage, StageDesc, camera_at, scene_of};

/// What the library promises.
const LARGEST: f32 = 0.02;

/// The steepest angle between a plane's normal and the light's rays for which it is promised, with 0.1 degrees against
/// rounding of normals to half precision.
const STEEPEST: f64 = 80.1;

/// Moment depth per texel of a map of 1024 texels whose footprint is half, once and four times as wide as the range.
const DEPTH_PER_TEXEL: [f64; 3] = [0.5 * 2.0 / 1024.0, 2.0 / 1024.0, 4.0 * 2.0 / 1024.0];

/// In degrees.
const TILTS: [f64; 9] = [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0];

/// A direction that is aligned with nothing.
const ALONG: DVec3 = DVec3::new(0.35, -0.9, 0.26);

/// A light, the frame that planes are built in, and what a texel is there.
struct Setup {
    light: LightView,
    /// On the light's axis, at moment depth 0.
    centre: DVec3,
    right: DVec3,
    up: DVec3,
    towards: DVec3,
    /// Width of a texel at the centre.
    texel: f64,
}

/// A sun whose range is 10 units deep, shallower than most planes at 80 degrees.
fn sun(map: u32, depth_per_texel: f64) -> Setup {
    let range = 10.0;
    let texel = 0.5 * depth_per_texel * range;
    let along = ALONG.normalize();
    let (right, up) = along.any_orthonormal_pair();
    let origin = DVec3::new(3.0, 40.0, -7.0);
    let depth = StoredDepth::Orthographic {
        near: 0.0,
        far: range,
        reversed: false,
    };
    let world_from_view = DMat4::from_cols(
        right.extend(0.0),
        along.cross(right).extend(0.0),
        (-along).extend(0.0),
        origin.extend(1.0),
    );
    let half = 0.5 * texel * f64::from(map);
    Setup {
        light: LightView {
            view_from_world: world_from_view.inverse(),
            clip_from_view: depth.clip_from_view(DVec2::splat(1.0 / half)),
            depth,
            range: [0.0, range],
        },
        centre: origin + 0.5 * range * along,
        right,
        up,
        towards: -along,
        texel,
    }
}

/// A spot light with a range from 1 to 9 units; `depth_per_texel` at its far end.
fn spot(map: u32, depth_per_texel: f64) -> Setup {
    let [near, far] = [1.0, 9.0];
    let along = ALONG.normalize();
    let (right, up) = along.any_orthonormal_pair();
    // The width of a texel at distance 1.
    let width = 0.5 * depth_per_texel * (far - near) / far;
    let angle = 2.0 * (0.5 * width * f64::from(map)).atan();
    let origin = DVec3::new(3.0, 40.0, -7.0);
    let light = LightView::spot(origin, along, angle, 0.5, None, [near, far], false).unwrap();
    let distance = 0.5 * (near + far);
    Setup {
        light,
        centre: origin + distance * along,
        right,
        up,
        towards: -along,
        texel: distance * width,
    }
}

/// Tilt and azimuth in degrees, and half the plane's edges in texels as the light sees them.
#[derive(Clone, Copy, Debug)]
struct Plane {
    tilt: f64,
    azimuth: f64,
    half: f64,
}

impl Plane {
    /// The unit vectors down the slope and across it, and the normal.
    fn axes(&self, setup: &Setup) -> [DVec3; 3] {
        let (sin, cos) = self.azimuth.to_radians().sin_cos();
        let out = cos * setup.right + sin * setup.up;
        let (tilt_sin, tilt_cos) = self.tilt.to_radians().sin_cos();
        let down = tilt_cos * out - tilt_sin * setup.towards;
        let normal = tilt_sin * out + tilt_cos * setup.towards;
        [down, normal.cross(down), normal]
    }

    fn corners(&self, setup: &Setup) -> [DVec3; 4] {
        let [down, across, _] = self.axes(setup);
        let half = self.half * setup.texel;
        let (down, across) = (down * half / self.tilt.to_radians().cos(), across * half);
        [
            setup.centre - down - across,
            setup.centre + down - across,
            setup.centre + down + across,
            setup.centre - down + across,
        ]
    }

    /// All of it, from in front; along it; from afar; and so closely that a texel covers hundreds of pixels.
    fn cameras(&self, setup: &Setup) -> [(&'static str, Camera); 4] {
        let [down, across, normal] = self.axes(setup);
        let size = self.half * setup.texel;
        let from = |direction: DVec3, distance: f64| {
            camera_at(
                setup.centre + distance * direction.normalize(),
                setup.centre,
            )
        };
        [
            ("in front", from(normal + 0.1 * across, 3.0 * size)),
            (
                "grazing",
                from(down + 0.7 * across + 0.08 * normal, 2.0 * size),
            ),
            (
                "afar",
                from(normal - 0.8 * down + 0.5 * across, 200.0 * size),
            ),
            (
                "close",
                from(normal + 0.5 * down - across, 3.0 * setup.texel),
            ),
        ]
    }
}

/// The largest intensity over all planes and cameras, with the case it belongs to.
fn worst(stage: &Stage, setups: &[Setup], tilts: &[f64]) -> (f32, String) {
    let mut worst = (0.0f32, String::new());
    let mut lit = 0u64;
    for setup in setups {
        for &tilt in tilts {
            for azimuth in [0.0, 33.0, 200.0] {
                // Its edges inside of the map, then beyond the map's borders.
                for half in [40.0, 90.0] {
                    let plane = Plane {
                        tilt,
                        azimuth,
                        half,
                    };
                    let model = stage.upload(&scene_of("plane", &[plane.corners(setup)]));
                    for (name, camera) in plane.cameras(setup) {
                        let shadow = stage.shadow(&model, &setup.light, &camera);
                        let pixels = stage.pixels();
                        for (index, &intensity) in shadow.iter().enumerate() {
                            let position = DVec3::from(pixels.position[index].map(f64::from));
                            let normal = DVec3::from(pixels.normal[index].map(f64::from));
                            let cosine = normal.dot(setup.light.towards_light(position));
                            if !pixels.covered[index] {
                                assert_eq!(intensity, 0.0, "{plane:?} {name}: sky {index}");
                                continue;
                            }
                            // A spot light meets parts of a plane at a steeper angle.
                            if cosine < STEEPEST.to_radians().cos() {
                                continue;
                            }
                            lit += 1;
                            if intensity.is_nan() || intensity > worst.0 {
                                let texel =
                                    setup.light.uv(position).unwrap() * f64::from(stage.desc.map);
                                let case = format!(
                                    "{:?} {plane:?} {name} at pixel {index}, texel {texel}, depth {:.3}",
                                    setup.light.kind(),
                                    setup.light.moment_depth(position)
                                );
                                worst = (intensity, case);
                            }
                        }
                    }
                }
            }
        }
    }
    // The check above has seen something: at least the close cameras' whole pictures.
    assert!(lit > 100_000 * tilts.len() as u64, "{lit}");
    worst
}

fn check(desc: StageDesc, tilts: &[f64]) {
    let stage = Stage::new(desc);
    for light in [sun, spot] {
        let setups = DEPTH_PER_TEXEL.map(|depth| light(desc.map, depth));
        let (intensity, case) = worst(&stage, &setups, tilts);
        println!(
            "{} radius {}, the blur resolves {}: {intensity:.4} {case}",
            desc.storage, desc.radius, desc.blur_resolves
        );
        assert!(intensity <= LARGEST, "{desc:?}: {intensity} at {case}");
    }
}

#[test]
fn planes_are_lit_in_unorm16() {
    check(StageDesc::new(Storage::Unorm16), &TILTS);
}

#[test]
fn planes_are_lit_in_float16() {
    check(StageDesc::new(Storage::Float16), &TILTS);
}

#[test]
fn planes_are_lit_where_texels_are_rounded_inwards() {
    for storage in [Storage::Unorm16, Storage::Float16] {
        let desc = StageDesc {
            blur_resolves: true,
            ..StageDesc::new(storage)
        };
        check(desc, &[0.0, 40.0, 80.0]);
    }
}

#[test]
fn planes_are_lit_in_float32() {
    check(StageDesc::new(Storage::Float32), &TILTS);
}

#[test]
fn planes_are_lit_with_small_and_large_kernels() {
    // With 32 texels the map ends within the kernel almost everywhere.
    for (radius, sigma) in [(1, 0.6), (12, 7.2), (32, 19.2)] {
        let desc = StageDesc {
            radius,
            sigma,
            ..StageDesc::new(Storage::Unorm16)
        };
        check(desc, &[0.0, 20.0, 50.0, 70.0, 80.0]);
    }
}
