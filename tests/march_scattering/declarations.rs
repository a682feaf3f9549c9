//! What the nodes refuse, and hosts' values that cannot be.

use moment_shadows::{
    AirLight, CameraView, HeightFog, LeakReduction, LightSize, MapEncoding,
    MarchScatteringParameters, MarchedAir, Profile, Resolution, ScatteringWay, SpotCone, Storage,
    Technique, TextureFormat, UpsampleScatteringParameters, ValueError,
};
use moment_shadows_graph::nodes::{MarchScattering, UpsampleScattering};
use moment_shadows_graph::{
    Capabilities, Connected, GraphError, GraphErrorKind, Node, NodeDesc, ResourceDesc, TextureDesc,
};

use crate::scene::{CONE, FAR, Lamp, Scene};

fn describe(node: &dyn Node, scattering: [u32; 2]) -> Result<NodeDesc, GraphError> {
    let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float32).unwrap();
    let inputs = [
        ("map", TextureDesc::of_map(encoding, [64, 64])),
        (
            "depth",
            TextureDesc::new(TextureFormat::Depth32Float, [64, 64]),
        ),
        (
            "scattering",
            TextureDesc::new(TextureFormat::Rgba16Float, scattering),
        ),
        (
            "camera_depth",
            TextureDesc::new(TextureFormat::Depth32Float, [101, 63]),
        ),
    ];
    let inputs = inputs
        .map(|(name, desc)| (name.to_owned(), ResourceDesc::Texture(desc)))
        .into();
    let capabilities = Capabilities::of_profile(Profile::WebgpuCore);
    node.describe(&Connected::new(&inputs, &capabilities))
}

#[test]
fn properties_that_do_not_fit_are_named() {
    let march = MarchScattering::default;
    let with = |density: &str| MarchScattering {
        density: Some(density.to_owned()),
        ..march()
    };
    let cases = [
        (
            MarchScattering {
                steps: Some(0),
                ..march()
            },
            GraphErrorKind::Property,
            "'steps' is 0",
        ),
        (
            MarchScattering {
                steps: Some(1025),
                ..march()
            },
            GraphErrorKind::Property,
            "1 to 1024",
        ),
        (
            MarchScattering {
                views: 0,
                ..march()
            },
            GraphErrorKind::Property,
            "'views' is 0",
        ),
        (
            MarchScattering {
                views: 17,
                ..march()
            },
            GraphErrorKind::Property,
            "1 to 16",
        ),
        (
            MarchScattering {
                anisotropy: 17,
                ..march()
            },
            GraphErrorKind::Property,
            "'anisotropy' is 17",
        ),
        (
            MarchScattering {
                format: Some(TextureFormat::Rgba8Unorm),
                ..march()
            },
            GraphErrorKind::Property,
            "radiance has no upper limit",
        ),
        (
            MarchScattering {
                technique: Some(Technique::Vsm),
                ..march()
            },
            GraphErrorKind::Format,
            "'vsm' cannot read it",
        ),
        (
            with("fn thickness() -> f32 { return 1.0; }"),
            GraphErrorKind::Shader,
            "density",
        ),
    ];
    for (node, kind, says) in cases {
        let error = describe(&node, [51, 32]).unwrap_err();
        assert_eq!(error.kind, kind, "{error}");
        assert!(error.to_string().contains(says), "{error}");
    }
    for technique in [None, Some(Technique::Binary)] {
        assert!(
            describe(
                &MarchScattering {
                    technique,
                    ..march()
                },
                [51, 32]
            )
            .is_ok()
        );
    }
}

#[test]
fn upsampling_takes_half_and_a_quarter_rounded_up() {
    for size in [[101, 63], [51, 32], [26, 16]] {
        assert!(describe(&UpsampleScattering {}, size).is_ok(), "{size:?}");
    }
    for size in [[50, 31], [51, 31], [25, 16], [26, 32]] {
        let error = describe(&UpsampleScattering {}, size).unwrap_err();
        assert_eq!(error.kind, GraphErrorKind::Size, "{error}");
        assert!(
            error
                .to_string()
                .contains("neither 101x63 nor half or a quarter"),
            "{error}"
        );
    }
}

fn parameters(
    scene: &Scene,
    air: MarchedAir,
    far: f64,
) -> Result<MarchScatteringParameters, ValueError> {
    let light = &scene.views[0];
    MarchScatteringParameters::new(
        &scene.camera(),
        far,
        light,
        scene.medium,
        &air,
        LeakReduction::NONE,
    )
}

#[test]
fn hosts_values_that_cannot_be_are_named() {
    let spot = Scene::new(Lamp::Spot);
    let air = spot.air;
    let name = |air: MarchedAir, far: f64| parameters(&spot, air, far).unwrap_err().name;
    for far in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e10] {
        assert_eq!(name(air, far), "far", "{far}");
    }
    let cone = |inner, outer| MarchedAir {
        cone: Some(SpotCone { inner, outer }),
        ..air
    };
    for (inner, outer, of) in [
        (-0.1, 1.0, "inner"),
        (f64::NAN, 1.0, "inner"),
        (1.0, 1.0, "outer"),
        (1.0, f64::NAN, "outer"),
        (1.0, 3.2, "outer"),
    ] {
        assert_eq!(name(cone(inner, outer), FAR), of, "{inner} {outer}");
    }
    let fog = HeightFog {
        falloff: f64::NAN,
        ..HeightFog::NONE
    };
    assert_eq!(name(MarchedAir { fog, ..air }, FAR), "falloff");
    // A sun has no cone, a lamp without one shines to all sides.
    let sun = Scene::new(Lamp::Sun);
    let with_cone = MarchedAir {
        cone: Some(CONE),
        ..sun.air
    };
    assert_eq!(parameters(&sun, with_cone, FAR).unwrap_err().name, "cone");
    let bare = parameters(&spot, MarchedAir { cone: None, ..air }, FAR).unwrap();
    assert_eq!(
        (bare.light.cone_axis, bare.light.cone_offset),
        ([0.0; 3], 1.0)
    );
    // Cameras without a point that their rays meet in.
    let parallel = CameraView {
        clip_from_world: sun.views[0].clip_from_world,
        far_depth: 1.0,
    };
    let refused = UpsampleScatteringParameters::new(&parallel, FAR).unwrap_err();
    assert_eq!(refused.name, "camera");
    assert!(refused.message.contains("orthographic"), "{refused}");
}

#[test]
fn air_is_even_and_its_steps_are_not_shifted_where_nothing_is_said() {
    let sun = Scene::new(Lamp::Sun);
    let plain = parameters(&sun, MarchedAir::default(), FAR).unwrap();
    assert_eq!((plain.fog.gradient, plain.fog.log_density), ([0.0; 3], 0.0));
    assert_eq!((plain.offset, plain.own), (0.0, [0.0; 4]));
}

#[test]
fn a_light_is_as_large_as_its_size_or_as_single_precision_asks() {
    let mut scene = Scene::new(Lamp::Spot);
    let radius = |scene: &Scene| parameters(scene, scene.air, FAR).unwrap().light.radius;
    assert_eq!(radius(&scene), (FAR / 1024.0) as f32);
    scene.views[0].size = LightSize::Disk(1.0);
    assert_eq!(radius(&scene), 0.5);
    scene.views[0].size = LightSize::Rectangle([0.8, 2.0]);
    assert_eq!(radius(&scene), 0.4);
    assert_eq!(radius(&Scene::new(Lamp::Sun)), 0.0);
    for sides in [[0.8, f64::NAN], [-1.0, 1.0], [1e10, 1.0]] {
        scene.views[0].size = LightSize::Rectangle(sides);
        let refused = parameters(&scene, scene.air, FAR).unwrap_err();
        assert_eq!(refused.name, "size", "{sides:?}");
    }
}

#[test]
fn the_best_steps_are_those_of_the_record_and_say_what_is_missing() {
    let best = |light, lookups| MarchScattering {
        steps: None,
        light,
        lookups,
        ..MarchScattering::default()
    };
    for light in [AirLight::Sun, AirLight::Spot, AirLight::Point] {
        for lookups in [0.5_f32, 2.0, 4.0, 16.0, 100.0] {
            let chosen = best(Some(light), Some(lookups)).chosen().unwrap();
            let (steps, resolution) = chosen;
            let way = ScatteringWay::Marched { steps, resolution };
            assert_eq!(ScatteringWay::best(light, false, lookups.into()), Some(way));
        }
    }
    let sun = Some(AirLight::Sun);
    let with_resolution = MarchScattering {
        resolution: Some(Resolution::Half),
        ..best(sun, Some(4.0))
    };
    let beside_steps = MarchScattering {
        lookups: Some(4.0),
        ..MarchScattering::default()
    };
    for (node, says) in [
        (best(None, Some(4.0)), "say which 'light'"),
        (best(sun, None), "how many 'lookups'"),
        (best(sun, Some(0.1)), "'lookups' is 0.1"),
        (best(sun, Some(f32::NAN)), "'lookups' is NaN"),
        (with_resolution, "which choose it"),
        (beside_steps, "they go with \"best\""),
    ] {
        let error = describe(&node, [51, 32]).unwrap_err();
        assert_eq!(error.kind, GraphErrorKind::Property, "{error}");
        assert!(error.to_string().contains(says), "{error}");
    }
}
