//! What the nodes of single scattering refuse, and what a plan of them moves.

use moment_shadows::{MapEncoding, Profile, Storage, Technique, TextureFormat};
use moment_shadows_graph::nodes::{CompositeScattering, IntegrateScattering, RectifyMoments};
use moment_shadows_graph::{
    Capabilities, Connected, GraphError, GraphErrorKind, Node, NodeDesc, ResourceDesc, TextureDesc,
};

fn describe(node: &dyn Node, slot: &str, map: TextureDesc) -> Result<NodeDesc, GraphError> {
    let depth = TextureDesc::new(TextureFormat::Depth32Float, [64, 64]);
    let inputs = [(slot, map), ("camera_depth", depth)]
        .map(|(name, desc)| (name.to_owned(), ResourceDesc::Texture(desc)))
        .into();
    let capabilities = Capabilities::of_profile(Profile::WebgpuCore);
    node.describe(&Connected::new(&inputs, &capabilities))
}

fn map(technique: Technique) -> TextureDesc {
    let encoding = MapEncoding::new(technique, Storage::Float32).unwrap();
    TextureDesc::of_map(encoding, [64, 64])
}

fn rectify(technique: Technique, extent: [u32; 2]) -> RectifyMoments {
    RectifyMoments {
        technique,
        storage: Storage::Float16,
        extent,
    }
}

/// A node, a slot with what is connected to it, and the error with a part of its text.
type Case = (
    Box<dyn Node>,
    &'static str,
    TextureDesc,
    GraphErrorKind,
    &'static str,
);

#[test]
fn maps_and_properties_that_do_not_fit_are_named() {
    let four = || map(Technique::Hamburger4);
    let cases: [Case; 8] = [
        (
            Box::new(rectify(Technique::Vsm, [64, 64])),
            "map",
            four(),
            GraphErrorKind::Property,
            "'technique' is 'vsm'",
        ),
        (
            Box::new(rectify(Technique::Hamburger4, [1, 64])),
            "map",
            four(),
            GraphErrorKind::Property,
            "'extent' is 1x64",
        ),
        (
            Box::new(rectify(Technique::Hamburger4, [64, 8193])),
            "map",
            four(),
            GraphErrorKind::Property,
            "columns and rows are 2 to 8192",
        ),
        (
            Box::new(rectify(Technique::Hamburger4, [64, 64])),
            "map",
            map(Technique::Vsm),
            GraphErrorKind::Format,
            "resamples four moments",
        ),
        (
            Box::new(CompositeScattering::default()),
            "integrated",
            map(Technique::Vsm),
            GraphErrorKind::Format,
            "connect the output of a node 'integrate_scattering'",
        ),
        (
            Box::new(CompositeScattering {
                format: Some(TextureFormat::Rgba8Unorm),
                ..CompositeScattering::default()
            }),
            "integrated",
            four(),
            GraphErrorKind::Property,
            "radiance has no upper limit",
        ),
        (
            Box::new(CompositeScattering {
                overestimation: [1.5, 0.5],
                ..CompositeScattering::default()
            }),
            "integrated",
            four(),
            GraphErrorKind::Property,
            "'towards' of 'overestimation' is 1.5; it is from 0",
        ),
        (
            Box::new(CompositeScattering {
                overestimation: [0.5, f32::NAN],
                ..CompositeScattering::default()
            }),
            "integrated",
            four(),
            GraphErrorKind::Property,
            "'away' of 'overestimation' is NaN",
        ),
    ];
    for (node, slot, map, kind, says) in cases {
        let error = describe(node.as_ref(), slot, map).unwrap_err();
        assert_eq!(error.kind, kind, "{error}");
        assert!(error.to_string().contains(says), "{error}");
    }
}

#[test]
fn six_moments_are_rectified_in_one_pass_and_take_two_lookups() {
    let six = || map(Technique::Hamburger6);
    let rectified = rectify(Technique::Hamburger6, [64, 64]);
    let rectified = describe(&rectified, "map", map(Technique::Hamburger4)).unwrap();
    // The camera's depth is connected, too.
    let labels = rectified.passes.iter().map(|pass| pass.label.as_str());
    assert_eq!(
        labels.collect::<Vec<_>>(),
        ["clear codes", "find ends", "bound rays", "rectify"]
    );
    let integrated = describe(&IntegrateScattering {}, "rectified", six()).unwrap();
    assert_eq!(integrated.passes.len(), 2);
    for (technique, lookups) in [(Technique::Hamburger4, 1), (Technique::Hamburger6, 2)] {
        let node = CompositeScattering::default();
        let desc = describe(&node, "integrated", map(technique)).unwrap();
        let [pass] = &desc.passes[..] else {
            panic!("one pass");
        };
        let bounds = pass.wgsl.split("fn scattering_bounds(").nth(1).unwrap();
        let body = bounds.split("\n}").next().unwrap();
        assert_eq!(body.matches("scattering_lookup(").count(), lookups);
    }
}
