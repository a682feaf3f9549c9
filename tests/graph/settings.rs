//! Settings of techniques that are out of range.

use crate::example::{compiled, native};
use crate::techniques::example;
use moment_shadows::{
    Border, CameraView, DepthRange, Finite, LeakReduction, LightDepth, LightSize, LightView,
    MapRegion, ReceiverBias, Technique, ViewParameters,
};
use moment_shadows_graph::GraphErrorKind;

#[test]
fn settings_out_of_range_are_refused_with_their_range() {
    for (technique, storage, expected) in [
        (
            r#"{ "esm": { "exponent": 88 } }"#,
            "float32",
            "from 1 to 80",
        ),
        (
            r#"{ "esm": { "exponent": 9.8 } }"#,
            "float16",
            "from 1 to 9.7",
        ),
        (
            r#"{ "esm": { "exponent": 3.1 } }"#,
            "unorm16",
            "from 1 to 3",
        ),
        (r#"{ "esm": { "exponent": 0 } }"#, "float32", "from 1 to 80"),
        (
            r#"{ "evsm2": { "exponent": 44.4 } }"#,
            "float32",
            "from 1 to 40",
        ),
        (
            r#"{ "evsm4": { "positive": 5, "negative": 5.6 } }"#,
            "float16",
            "the exponent 5.6",
        ),
        (
            r#"{ "lvsm": { "layers": 0 } }"#,
            "unorm16",
            "0 layers; it can have 1 to 8",
        ),
        (
            r#"{ "lvsm": { "layers": 9 } }"#,
            "unorm16",
            "9 layers; it can have 1 to 8",
        ),
        (
            r#"{ "lvsm": { "layers": 2, "overlap": -0.1 } }"#,
            "unorm16",
            "from 0 to 0.5",
        ),
        (
            r#"{ "lvsm": { "layers": 3, "splits": { "given": [0.5, 0.2] } } }"#,
            "unorm16",
            "2 ascending moment depths",
        ),
        (
            r#"{ "lvsm": { "layers": 3, "splits": { "given": [0.5] } } }"#,
            "unorm16",
            "2 ascending moment depths",
        ),
        (
            r#"{ "convolution": { "terms": 0 } }"#,
            "unorm8",
            "0 terms; it can have 1 to 16",
        ),
        (
            r#"{ "convolution": { "terms": 17 } }"#,
            "unorm8",
            "17 terms; it can have 1 to 16",
        ),
        ("\"binary\"", "float32", "connect the map to 'depth'"),
    ] {
        let error = compiled(&example(technique, storage), &native()).unwrap_err();
        assert_eq!(error.kind, GraphErrorKind::Property, "{technique}: {error}");
        assert!(error.to_string().contains(expected), "{technique}: {error}");
    }
}

#[test]
fn numbers_that_are_none_are_no_settings() {
    for value in [f32::NAN, f32::INFINITY] {
        assert!(Finite::new(value).is_err());
    }
    assert_eq!(Finite::new(-0.0).unwrap(), Finite::ZERO);
    assert_eq!(Technique::default().name(), "hamburger4");
}

#[test]
fn degenerate_views_are_refused() {
    let identity = glam::DMat4::IDENTITY.to_cols_array_2d();
    let flat = glam::DMat4::from_scale(glam::DVec3::new(1.0, 1.0, 0.0)).to_cols_array_2d();
    let not_finite = glam::DMat4::from_scale(glam::DVec3::splat(f64::NAN)).to_cols_array_2d();
    let parameters = |camera: [[f64; 4]; 4], light: [[f64; 4]; 4], depth: LightDepth| {
        ViewParameters::new(
            &CameraView {
                clip_from_world: camera,
                far_depth: 1.0,
            },
            &LightView {
                clip_from_world: light,
                depth,
                layer: 0,
                region: MapRegion::WHOLE,
                guard: 0,
                border: Border::Sharp,
                channel: 0,
                size: LightSize::Point,
            },
            ReceiverBias::NONE,
            LeakReduction::NONE,
        )
    };
    let sun = LightDepth::Orthographic { reversed: false };
    parameters(identity, identity, sun).unwrap();
    for singular in [flat, not_finite] {
        for (camera, light, name) in [
            (singular, identity, "camera"),
            (identity, singular, "light"),
        ] {
            let error = parameters(camera, light, sun).unwrap_err();
            assert_eq!(error.name, name);
            assert!(
                error.message.contains("is singular or not finite"),
                "{error}"
            );
        }
    }
    // A near plane at or behind the light, and invalid ranges.
    for (near, range) in [
        (0.0, [1.0, 10.0]),
        (-1.0, [1.0, 10.0]),
        (f64::NAN, [1.0, 10.0]),
        (0.5, [10.0, 1.0]),
        (0.5, [1.0, f64::INFINITY]),
    ] {
        for reversed in [false, true] {
            let spot = LightDepth::Perspective {
                near,
                far: 20.0,
                reversed,
                range: DepthRange {
                    near: range[0],
                    far: range[1],
                },
            };
            let error = parameters(identity, identity, spot).unwrap_err();
            assert!(
                ["the planes", "the depth range"].contains(&error.name),
                "{spot:?}"
            );
        }
    }
}
