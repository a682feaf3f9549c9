//! The storage that suffices in rectified coordinates alone: single scattering makes and reads it, and nothing else does.

use moment_shadows::{MapEncoding, Profile, Storage, Technique, TextureFormat};
use moment_shadows_graph::nodes::{
    Blur, CompositeScattering, DebugMoments, Downsample, IntegrateScattering, MarchScattering,
    RectifyMoments, ShadeHard, SummedAreaTable,
};
use moment_shadows_graph::{
    Capabilities, Connected, GraphError, GraphErrorKind, Node, NodeDesc, Off, ResourceDesc,
    TextureDesc,
};

fn described(node: &dyn Node, slot: &str, map: TextureDesc) -> Result<NodeDesc, GraphError> {
    let depth = TextureDesc::new(TextureFormat::Depth32Float, [64, 64]);
    let inputs = [(slot, map), ("camera_depth", depth)]
        .map(|(name, desc)| (name.to_owned(), ResourceDesc::Texture(desc)))
        .into();
    let capabilities = Capabilities::of_profile(Profile::WebgpuCore);
    node.describe(&Connected::new(&inputs, &capabilities))
}

fn encoding() -> MapEncoding {
    MapEncoding::rectified(Technique::Hamburger6, Storage::Unorm8).unwrap()
}

fn map() -> TextureDesc {
    TextureDesc::of_map(encoding(), [64, 64])
}

fn rectify(technique: Technique) -> RectifyMoments {
    RectifyMoments {
        technique,
        storage: Storage::Unorm8,
        extent: [64, 64],
    }
}

#[test]
fn six_moments_in_64_bits_are_made_summed_up_and_looked_up_on_every_device() {
    let four = MapEncoding::new(Technique::Hamburger4, Storage::Float16).unwrap();
    let four = || TextureDesc::of_map(four.clone(), [64, 64]);
    let made = described(&rectify(Technique::Hamburger6), "map", four()).unwrap();
    // A weight of one at the far end.
    let off = made.off.get("rectified");
    assert!(matches!(off, Some(Off::Fill(texels)) if texels.len() == 2 && texels[1][3] == 1.0));
    assert_eq!(encoding().bits_per_texel(), 64);
    encoding().check(Profile::WebgpuCore).unwrap();
    let summed = described(&IntegrateScattering {}, "rectified", map()).unwrap();
    assert_eq!(summed.passes.len(), 2);
    let composite = CompositeScattering::default();
    let last = described(&composite, "integrated", map()).unwrap();
    assert!(
        last.passes[0]
            .wgsl
            .contains("ENCLOSED_MOMENTS_ALPHA_UNORM8")
    );
    assert!(last.passes[0].wgsl.contains("textureSampleLevel"));
    // Four moments have no bias for so few bits.
    let error = described(&rectify(Technique::Hamburger4), "map", four()).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Property, "{error}");
    assert!(error.message.contains("cannot be stored as unorm8"));
}

#[test]
fn other_nodes_refuse_it_by_name() {
    let blur: Blur = serde_json::from_str(r#"{ "kernel": { "radius": 2 } }"#).unwrap();
    let nodes: [Box<dyn Node>; 6] = [
        Box::new(blur),
        Box::new(Downsample::default()),
        Box::new(ShadeHard::default()),
        Box::new(MarchScattering::default()),
        Box::new(DebugMoments::default()),
        Box::new(SummedAreaTable {
            largest_kernel: [9; 2],
        }),
    ];
    for node in nodes {
        let error = described(node.as_ref(), "map", map()).unwrap_err();
        assert_eq!(error.kind, GraphErrorKind::Format, "{error}");
        assert_eq!(error.slot.as_deref(), Some("map"), "{error}");
        assert!(error.message.contains("'composite_scattering' read"));
    }
}

#[test]
fn an_encoding_of_it_says_so_in_files_and_takes_no_casters() {
    let text = serde_json::to_string(&encoding()).unwrap();
    assert_eq!(
        serde_json::from_str::<MapEncoding>(&text).unwrap(),
        encoding()
    );
    assert!(encoding().is_rectified());
    let error = encoding().with_blends(1).unwrap_err();
    assert!(error.message.contains("a map in rectified coordinates"));
    let error = MapEncoding::new(Technique::Hamburger6, Storage::Unorm8).unwrap_err();
    assert!(error.message.contains("cannot be stored as unorm8"));
    let float16 = MapEncoding::rectified(Technique::Hamburger6, Storage::Float16).unwrap();
    assert!(!float16.is_rectified());
    assert_eq!(
        float16,
        MapEncoding::new(Technique::Hamburger6, Storage::Float16).unwrap()
    );
}
