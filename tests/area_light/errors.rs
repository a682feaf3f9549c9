//! Lights that cannot be, by name.

use moment_shadows_lab::light::LightShape;
use moment_shadows_lab::scene;
use moment_shadows_lab::soft::{LightSize, NamedGraph, SoftLightChoice};
use moment_shadows_lab::truth::area_light::{AreaLight, MOST_PLACES};
use moment_shadows_lab::view::View;

use crate::light;

#[test]
fn sizes_that_are_negative_or_no_numbers_are_named() {
    use SoftLightChoice::{Directional, Rectangle, Spot};
    let scene = scene::load("edge").unwrap();
    let view = View::numbered(&scene, 0);
    let rows = [
        (Directional, "-1", "angular diameter"),
        (Directional, "nan", "angular diameter"),
        (Directional, "180", "angular diameter"),
        (Directional, "1x2", "angular diameter"),
        (Spot, "-0.1", "diameter"),
        (Spot, "NaN", "diameter"),
        (Spot, "inf", "diameter"),
        (Spot, "1x2", "diameter"),
        (Rectangle, "-1x1", "width"),
        (Rectangle, "1x-1", "height"),
        (Rectangle, "1xnan", "height"),
        (Rectangle, "infx1", "width"),
    ];
    for (choice, text, name) in rows {
        let size: LightSize = text.parse().unwrap();
        let made = choice.light(&scene, &view, [64; 2], 4.0, Some(size));
        let error = made.unwrap_err().to_string();
        let named = format!("the light's {name} is ");
        assert!(error.starts_with(&named), "{choice:?} {text}: {error}");
    }
    for text in ["", "x", "1x", "two", "1x2x3"] {
        assert!(
            text.parse::<LightSize>().unwrap_err().contains("1.2x0.6"),
            "{text}"
        );
    }
    // No size at all is a size: hard shadows.
    for choice in [Directional, Spot, Rectangle] {
        assert!(light(&scene, choice, [0.0; 2]).1.is_point());
    }
}

#[test]
fn shapes_and_places_that_do_not_fit_are_refused() {
    let scene = scene::load("edge").unwrap();
    let (sun, angle) = light(&scene, SoftLightChoice::Directional, [2.0; 2]);
    let (lamp, disk) = light(&scene, SoftLightChoice::Spot, [2.0; 2]);
    let refused = |light, shape, places| {
        let truth = AreaLight::new(&scene, light, shape, places);
        truth.err().unwrap().to_string()
    };
    for (light, shape) in [(&sun, disk), (&lamp, angle)] {
        assert!(refused(light, shape, 256).contains("cannot have the shape"));
    }
    let negative = LightShape::Disk { diameter: -1.0 };
    assert!(refused(&lamp, negative, 256).contains("diameter is -1"));
    for count in [0, MOST_PLACES + 1] {
        let error = refused(&sun, angle, count);
        assert!(error.ends_with(&format!("not at {count}")), "{error}");
    }
    for text in ["", "=", "a=", "=b.json"] {
        assert!(text.parse::<NamedGraph>().is_err(), "{text}");
    }
    let named: NamedGraph = "soft=examples/soft.json".parse().unwrap();
    assert_eq!(
        (named.name.as_str(), named.path.as_str()),
        ("soft", "examples/soft.json")
    );
    assert_eq!(
        "examples/soft.json".parse::<NamedGraph>().unwrap().name,
        "soft"
    );
}

#[test]
fn the_range_reaches_to_where_shadows_fall() {
    let scene = scene::load("edge").unwrap();
    for (choice, size) in crate::LIGHTS {
        let (light, _) = light(&scene, choice, size);
        for caster in scene.casters() {
            let depth = light.moment_depth(caster);
            assert!(depth.abs() <= 1.0, "{choice:?}: caster at {depth}");
            // Down the light's ray to the ground.
            let (origin, direction) = light.ray(light.uv(caster).unwrap());
            let place = origin - direction * (origin.y / direction.y);
            let depth = light.moment_depth(place);
            assert!(depth <= 1.0 + 1e-9, "{choice:?}: ground at {depth}");
            let stored = light.clip_from_world() * place.extend(1.0);
            let stored = light.moment_depth_of_stored(stored.z / stored.w);
            assert!(
                (stored - depth.min(1.0)).abs() < 1e-6,
                "{choice:?}: {stored} for {depth}"
            );
        }
    }
}
