//! Lights that no soft shadows can be made of.

use moment_shadows::{AreaLight, DepthRange, LightSize, ValueError};

const RANGE: DepthRange = DepthRange {
    near: 1.0,
    far: 9.0,
};
const RADII: std::ops::RangeInclusive<f64> = 0.5..=16.0;

#[track_caller]
fn culprit(light: Result<AreaLight, ValueError>) -> &'static str {
    let ValueError { name, message } = light.unwrap_err();
    let sentence = message.starts_with(&format!("a light's soft shadows: {name} is "));
    assert!(sentence && message.contains("but must be"), "{message}");
    name
}

#[test]
fn each_number_out_of_range_is_named() {
    let directional = |angle, texel, range, radii| {
        AreaLight::new(LightSize::AngularDiameter(angle), texel, range, radii)
    };
    let spot = |diameter, texel, range, radii| {
        AreaLight::new(LightSize::Disk(diameter), texel, range, radii)
    };
    let rectangle = |size| AreaLight::new(LightSize::Rectangle(size), [0.1; 2], RANGE, RADII);
    for wrong in [-0.1, f64::NAN, f64::INFINITY, 3.2] {
        assert_eq!(
            culprit(directional(wrong, [0.1; 2], RANGE, RADII)),
            "the angular diameter"
        );
    }
    for wrong in [-0.1, f64::NAN, f64::INFINITY] {
        assert_eq!(culprit(spot(wrong, [0.1; 2], RANGE, RADII)), "the diameter");
        assert_eq!(culprit(rectangle([wrong, 1.0])), "the width");
        assert_eq!(culprit(rectangle([1.0, wrong])), "the height");
    }
    for wrong in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        assert_eq!(
            culprit(spot(1.0, [wrong, 0.1], RANGE, RADII)),
            "a texel's width"
        );
        assert_eq!(
            culprit(directional(1.0, [0.1, wrong], RANGE, RADII)),
            "a texel's height"
        );
    }
    for near in [0.0, -1.0, f64::NAN] {
        assert_eq!(
            culprit(spot(1.0, [0.1; 2], DepthRange { near, far: 9.0 }, RADII)),
            "the distance of the range's near end"
        );
    }
    for smallest in [-1.0, 17.0, f64::NAN] {
        assert_eq!(
            culprit(spot(1.0, [0.1; 2], RANGE, smallest..=16.0)),
            "the smallest radius"
        );
    }
    for largest in [0.0, 4097.0, f64::INFINITY] {
        assert_eq!(
            culprit(spot(1.0, [0.1; 2], RANGE, 0.0..=largest)),
            "the largest radius"
        );
    }
    assert_eq!(
        culprit(spot(1e30, [1e-30; 2], RANGE, RADII)),
        "the light's size in texels"
    );
    assert_eq!(
        culprit(directional(1e-30, [1e30; 2], RANGE, RADII)),
        "the light's size in texels"
    );
    assert_eq!(
        culprit(directional(
            0.1,
            [1.0; 2],
            DepthRange {
                near: 0.0,
                far: 1e39
            },
            RADII
        )),
        "the range's far end"
    );
    let empty = DepthRange {
        near: 9.0,
        far: 9.0,
    };
    for light in [
        directional(0.1, [0.1; 2], empty, RADII),
        spot(0.1, [0.1; 2], empty, RADII),
    ] {
        let error = light.unwrap_err();
        assert_eq!(error.name, "the depth range");
        assert!(error.message.contains("9 to 9 is empty"), "{error}");
    }
}

#[test]
fn sizes_are_in_texels() {
    // Half a right angle: 2 tan(pi / 8) wide per unit of distance.
    let eighth = LightSize::AngularDiameter(std::f64::consts::FRAC_PI_4);
    let sun = AreaLight::new(eighth, [0.5, 0.25], RANGE, RADII).unwrap();
    let width = 2.0 * (2.0_f32.sqrt() - 1.0);
    assert!((sun.size[0] - 2.0 * width).abs() < 1e-6 && (sun.size[1] - 4.0 * width).abs() < 1e-6);
    let spot = AreaLight::new(LightSize::Disk(0.5), [0.5, 0.25], RANGE, RADII).unwrap();
    assert_eq!((spot.size, spot.perspective), ([1.0, 2.0], 1));
    assert_eq!(
        (
            spot.near,
            spot.far,
            spot.smallest_radius,
            spot.largest_radius
        ),
        (1.0, 9.0, 0.5, 16.0)
    );
}
