//! A spot as the air sees it: its place and its cone, however its map stores depth.

use glam::DVec3;
use glam::dcamera::rh::proj::directx::perspective;
use glam::dcamera::rh::view::look_at_mat4;
use moment_shadows::{DepthRange, LightDepth, LightView, PunctualLight, SpotCone};
use rand::RngExt as _;

use crate::{direction, random};

#[test]
fn a_spot_shines_along_its_view_however_depth_is_stored() {
    let mut random = random();
    let (near, far) = (0.5, 20.0);
    let range = DepthRange { near, far };
    let cone = SpotCone {
        inner: 0.6,
        outer: 0.9,
    };
    for reversed in [false, true] {
        let (axis, aside) = (direction(&mut random), direction(&mut random));
        let [position, eye] =
            [0; 2].map(|_| direction(&mut random) * random.random_range(1.0..9.0));
        let [first, last] = if reversed { [far, near] } else { [near, far] };
        let clip =
            perspective(1.0, 1.0, first, last) * look_at_mat4(position, position + axis, aside);
        let view = LightView {
            depth: LightDepth::Perspective {
                near,
                far,
                reversed,
                range,
            },
            ..LightView::perspective(clip.to_cols_array_2d(), near, far, range)
        };
        let light = PunctualLight::new(&view, Some(cone), eye.to_array(), 50.0).unwrap();
        let place = DVec3::from(light.place.map(f64::from));
        assert!((place - (position - eye)).length() < 1e-5, "{light:?}");
        // The part of its light that it sends at an angle to its axis, at any side.
        let across = axis.cross(aside).normalize();
        let sent = |angle: f64| {
            let ray = axis * angle.cos() + across * angle.sin();
            DVec3::from(light.cone_axis.map(f64::from)).dot(ray) + f64::from(light.cone_offset)
        };
        assert!((sent(0.3) - 1.0).abs() < 1e-5, "{}", sent(0.3));
        assert!(sent(0.45).abs() < 1e-5, "{}", sent(0.45));
        assert!(sent(0.0) > 1.0 && sent(3.0) < 0.0);
    }
}
