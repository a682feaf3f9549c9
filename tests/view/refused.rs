//! What cannot be is refused by name.

use glam::DVec3;
use moment_shadows::{
    Border, CameraView, CascadeSplits, Cascades, ContactShadowParameters, ContactShadows,
    DepthRange, LeakReduction, LightDepth, LightView, MapRegion, PointLight, ReceiverBias, Tile,
    ViewParameters,
};

use crate::camera::{LENSES, Pose};
use crate::point_light::{RANGE, lamp};
use crate::{TILE, cascades};

fn camera() -> CameraView {
    let pose = Pose {
        lens: LENSES[1],
        eye: DVec3::ONE,
        forward: DVec3::new(0.3, 0.2, 1.0).normalize(),
    };
    pose.camera()
}

#[test]
fn cascades_that_cannot_be_are_refused() {
    type Change = fn(&mut Cascades);
    let blend = |count, logarithmic| CascadeSplits::Blend { count, logarithmic };
    let changes: [(&str, Change); 24] = [
        ("near", |it| it.near = -1.0),
        ("near", |it| it.near = f64::NAN),
        ("near", |it| it.near = 200.0),
        ("near", |it| it.near = 0.0),
        ("far", |it| it.far = f64::INFINITY),
        ("overlap", |it| it.overlap = 1.5),
        ("overlap", |it| it.overlap = f64::NAN),
        ("blend", |it| it.blend = 0.6),
        ("blend", |it| it.blend = f64::NAN),
        // More than 4095 texels.
        ("blend", |it| {
            (it.blend, it.tile.texels) = (0.4, 12_000);
        }),
        ("splits", |it| {
            it.splits = CascadeSplits::Given(vec![3.0, 2.0])
        }),
        ("splits", |it| {
            it.splits = CascadeSplits::Given(vec![3.0, 3.0])
        }),
        ("splits", |it| it.splits = CascadeSplits::Given(vec![0.05])),
        ("splits", |it| {
            it.splits = CascadeSplits::Given(vec![f64::NAN])
        }),
        ("light_direction", |it| it.direction = [0.0; 3]),
        ("light_direction", |it| it.direction[1] = f64::INFINITY),
        ("casters", |it| it.casters = Some([[1.0; 3], [0.0; 3]])),
        ("casters", |it| it.casters = Some([[f64::NAN; 3], [0.0; 3]])),
        ("casters", |it| {
            it.casters = Some([[0.0; 3], [f64::INFINITY; 3]])
        }),
        ("casters", |it| it.pancaking = false),
        ("filter_radius", |it| it.tile.filter_radius = -1.0),
        ("filter_radius", |it| it.tile.filter_radius = f64::NAN),
        ("guard", |it| it.tile.texels = 10),
        ("texels", |it| it.tile.texels = 11),
    ];
    for (index, (name, change)) in changes.into_iter().enumerate() {
        let mut cascades = cascades();
        change(&mut cascades);
        let found = cascades.views(&camera()).unwrap_err();
        assert_eq!(found.name, name, "{index}: {found}");
    }
    for (splits, name) in [
        (blend(0, 0.5), "count"),
        (blend(257, 0.5), "count"),
        (blend(3, -0.1), "logarithmic"),
        (blend(3, f64::NAN), "logarithmic"),
    ] {
        let found = Cascades {
            splits,
            ..cascades()
        };
        assert_eq!(found.slices().unwrap_err().name, name);
    }
    let uniform = Cascades {
        splits: blend(3, 0.0),
        near: 0.0,
        ..cascades()
    };
    uniform.views(&camera()).unwrap();
}

#[test]
fn cameras_without_a_frustum_are_refused() {
    let plain = camera().clip_from_world;
    let mut flat = plain;
    flat.iter_mut()
        .for_each(|column| column[1] = column[0] + 1e-12 * column[1]);
    let mut none = plain;
    none[2][2] = f64::NAN;
    let mut far_away = plain;
    let place = [1e14, 0.0, 0.0];
    for row in 0..4 {
        far_away[3][row] -= (0..3)
            .map(|axis| plain[axis][row] * place[axis])
            .sum::<f64>();
    }
    for (clip_from_world, words) in [
        (flat, "singular"),
        (none, "not finite"),
        (far_away, "too far away"),
        ([[0.0; 4]; 4], "singular"),
    ] {
        let camera = CameraView {
            clip_from_world,
            far_depth: 0.0,
        };
        let found = cascades().views(&camera).unwrap_err();
        assert_eq!(found.name, "camera", "{found}");
        assert!(found.message.contains(words), "{words}: {found}");
    }
}

#[test]
fn lights_that_cannot_shine_from_a_point_are_refused() {
    let planes = |near, far| LightDepth::Perspective {
        near,
        far,
        reversed: false,
        range: RANGE,
    };
    let ranged = |near, far| LightDepth::Linear {
        range: DepthRange { near, far },
    };
    let faces = |light: PointLight| light.faces().map(|_| ()).map_err(|error| error.name);
    for (depth, name) in [
        (planes(2.0, 2.0), "the planes"),
        (planes(3.0, 2.0), "the planes"),
        (planes(0.0, 2.0), "the planes"),
        (planes(f64::NAN, 2.0), "the planes"),
        (ranged(0.0, 2.0), "the planes"),
        (ranged(2.0, 2.0), "the depth range"),
        (ranged(1.0, f64::INFINITY), "the depth range"),
        (LightDepth::Orthographic { reversed: false }, "depth"),
    ] {
        assert_eq!(
            faces(PointLight { depth, ..lamp() }),
            Err(name),
            "{depth:?}"
        );
    }
    let tile = |texels, filter_radius| PointLight {
        tile: Tile {
            texels,
            filter_radius,
        },
        ..lamp()
    };
    assert_eq!(faces(tile(0, 1.0)), Err("texels"));
    assert_eq!(faces(tile(64, 31.4)), Err("guard"));
    assert_eq!(faces(tile(64, 1e300)), Err("guard"));
    assert_eq!(faces(tile(65, 31.4)), Ok(()));
    for nearest in [0.5, 0.0, -1.0, f64::NAN] {
        let nearest_caster = Some(nearest);
        let light = PointLight {
            nearest_caster,
            ..lamp()
        };
        assert_eq!(faces(light), Err("nearest_caster"), "{nearest}");
    }
    let position = [0.0, f64::NAN, 0.0];
    assert_eq!(faces(PointLight { position, ..lamp() }), Err("position"));
    let spot = |direction, angle| lamp().spot(direction, angle).unwrap_err().name;
    assert_eq!(spot([0.0; 3], 1.0), "light_direction");
    for angle in [0.0, -1.0, core::f64::consts::PI, f64::NAN] {
        assert_eq!(spot([1.0; 3], angle), "angle");
    }
}

#[test]
fn a_border_is_told_to_the_shader_or_refused() {
    let told = |border| {
        let view = LightView {
            region: MapRegion::new([5, 7], [40, 20]),
            guard: 2,
            border,
            ..lamp().faces().unwrap()[0]
        };
        let (bias, reduction) = (ReceiverBias::NONE, LeakReduction::NONE);
        let told = ViewParameters::new(&camera(), &view, bias, reduction);
        told.map(|it| it.channel).map_err(|error| error.name)
    };
    assert_eq!(told(Border::Sharp), Ok(0));
    assert_eq!(told(Border::Blend(8.0)), Ok(128 << 16));
    assert_eq!(told(Border::Fade(8.0)), Ok(128 << 16 | 16));
    assert_eq!(told(Border::Cone(7.52)), Ok(120 << 16 | 48));
    let view = LightView {
        channel: 16,
        ..lamp().faces().unwrap()[0]
    };
    let told_channel =
        ViewParameters::new(&camera(), &view, ReceiverBias::NONE, LeakReduction::NONE);
    assert_eq!(told_channel.unwrap_err().name, "channel");
    // Between the guard bands are 16 texels.
    for width in [8.1, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(told(Border::Blend(width)), Err("border"), "{width}");
    }
}

#[test]
fn a_guard_band_is_told_to_the_shader_or_refused() {
    let told = |region, guard| {
        let view = LightView {
            region,
            guard,
            ..lamp().faces().unwrap()[0]
        };
        let (bias, reduction) = (ReceiverBias::NONE, LeakReduction::NONE);
        let told = ViewParameters::new(&camera(), &view, bias, reduction);
        told.map(|it| it.guard).map_err(|error| error.name)
    };
    let region = MapRegion::new([5, 7], [40, 20]);
    assert_eq!(TILE.guard(), Ok(5));
    // A sixteenth of a texel less, for the rounding of places.
    assert_eq!(told(region, 9), Ok(9.0 - 0.0625));
    assert_eq!(told(region, 10), Err("guard"));
    assert_eq!(told(region, u32::MAX), Err("guard"));
    assert_eq!(told(MapRegion::WHOLE, 100), Ok(100.0 - 0.0625));
    assert_eq!(told(region, 0), Ok(0.0));
    assert_eq!(told(MapRegion::NONE, 0), Ok(0.0));
}

#[test]
fn contact_shadows_without_a_length_or_a_light_are_refused() {
    let sun = LightView::orthographic(sun_clip());
    let usual = ContactShadows::default();
    let with = |contact| ContactShadowParameters::new(&camera(), &sun, contact);
    let lengths = [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-60, 1e60];
    for wrong in lengths {
        for (name, contact) in [
            (
                "length",
                ContactShadows {
                    length: wrong,
                    ..usual
                },
            ),
            (
                "thickness",
                ContactShadows {
                    thickness: wrong,
                    ..usual
                },
            ),
        ] {
            let found = with(contact).unwrap_err();
            assert_eq!(found.name, name, "{found}");
            assert!(found.message.contains("above 0"), "{found}");
        }
    }
    let flat = LightView::orthographic([[0.0; 4]; 4]);
    let refused = |camera: &CameraView, light| {
        ContactShadowParameters::new(camera, light, usual)
            .unwrap_err()
            .name
    };
    assert_eq!(refused(&camera(), &flat), "light");
    let blind = CameraView {
        clip_from_world: [[0.0; 4]; 4],
        far_depth: 0.0,
    };
    assert_eq!(refused(&blind, &sun), "camera");
    let range = DepthRange {
        near: 1.0,
        far: 2.0,
    };
    let depth = LightDepth::Linear { range };
    assert_eq!(refused(&camera(), &LightView { depth, ..sun }), "depth");
    with(usual).unwrap();
}

/// That of a sun over the origin.
fn sun_clip() -> [[f64; 4]; 4] {
    let pose = Pose {
        lens: LENSES[3],
        eye: DVec3::ONE,
        forward: DVec3::new(0.3, -0.9, 0.2).normalize(),
    };
    pose.camera().clip_from_world
}
