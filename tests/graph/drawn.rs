//! Maps in a format that no compute shader writes: what a plan draws, and which nodes refuse them or six moments.

use moment_shadows::{MapEncoding, Profile, Storage, Technique, TextureFormat};
use moment_shadows_graph::nodes::{
    CompositeScattering, DebugMoments, IntegrateScattering, RectifyMoments, ShadeHard,
    SummedAreaTable,
};
use moment_shadows_graph::{
    Capabilities, Connected, GraphError, GraphErrorKind, Node, NodeDesc, Plan,
    PlannedBindingResource, PlannedWork, ResourceDesc, TextureDesc, Usage,
};

use crate::example::{compiled, edited};

/// The example with six moments, blurred, with two mip levels, under the least demanding profile.
fn plan(storage: &str) -> Plan {
    let text = edited(
        "\"storage\": \"unorm16\"",
        &format!("\"technique\": \"hamburger6\", \"storage\": \"{storage}\""),
    )
    .replace("\"sigma\": 2.4 }", "\"sigma\": 2.4 }, \"mip_levels\": 2")
    .replace(
        "{ \"from\": \"blur.blurred\", \"to\": \"shade.map\" }",
        "{ \"from\": \"blur.blurred\", \"to\": \"downsample.map\" },
    { \"from\": \"downsample.map\", \"to\": \"shade.map\" }",
    )
    .replace(
        "{ \"name\": \"shade\"",
        "{ \"name\": \"downsample\", \"type\": \"downsample\" },
    { \"name\": \"shade\"",
    );
    compiled(&text, &Capabilities::of_profile(Profile::WebgpuCore)).unwrap()
}

#[test]
fn ten_bits_are_drawn_plane_by_plane_and_level_by_level() {
    let plan = plan("unorm10");
    let drawn: Vec<(&str, String, u32, u32, bool)> = plan
        .passes
        .iter()
        .map(|pass| match pass.work {
            PlannedWork::Fullscreen {
                target,
                part,
                keeps,
            } => (
                pass.label.as_str(),
                plan.resources[target].name.clone(),
                part.level,
                part.plane,
                keeps,
            ),
            _ => panic!("'{}' is no draw", pass.label),
        })
        .collect();
    let of = |label, target: &str, level, plane| (label, target.to_owned(), level, plane, true);
    assert_eq!(
        drawn[..8],
        [
            of("plane 0: resolve", "resolve.map", 0, 0),
            of("plane 1: resolve", "resolve.map", 0, 1),
            // Each plane has an intermediate map of its own, of one plane.
            of("plane 0: blur along x", "blur.half_blurred_0", 0, 0),
            of("plane 0: blur along y", "blur.blurred", 0, 0),
            of("plane 1: blur along x", "blur.half_blurred_1", 0, 0),
            of("plane 1: blur along y", "blur.blurred", 0, 1),
            of("plane 0: mip level 1", "blur.blurred", 1, 0),
            of("plane 1: mip level 1", "blur.blurred", 1, 1),
        ]
    );
    // The picture is drawn whole.
    assert!(!drawn[8].4 && drawn.len() == 9);
    for resource in &plan.resources {
        let stored = resource.usage.contains(&Usage::StorageBinding);
        assert!(!stored, "{}", resource.name);
    }
    let map = plan
        .resources
        .iter()
        .find(|resource| resource.name == "blur.blurred")
        .unwrap();
    assert_eq!(map.usage, [Usage::TextureBinding, Usage::RenderAttachment]);
    let map = map.desc.texture().unwrap();
    assert_eq!((map.format, map.planes), (TextureFormat::Rgb10a2Unorm, 2));
    // Every layer that is dirty, in its own region.
    for pass in &plan.passes[..8] {
        assert!(pass.each_layer, "{}", pass.label);
        let reads_regions = pass
            .bindings
            .iter()
            .any(|binding| matches!(binding.resource, PlannedBindingResource::Regions { .. }));
        assert!(reads_regions, "{}", pass.label);
    }
}

#[test]
fn ten_bits_take_and_move_half_of_what_sixteen_do() {
    let [ten, sixteen] = ["unorm10", "float16"].map(plan);
    let map = |plan: &Plan| {
        let map = plan.resources.iter().find(|map| map.name == "blur.blurred");
        map.unwrap().desc.bytes()
    };
    assert_eq!(2 * map(&ten), map(&sixteen));
    let written = |plan: &Plan| -> u64 {
        let passes = plan.passes[..8].iter();
        passes.map(|pass| pass.bytes_written).sum()
    };
    assert_eq!(2 * written(&ten), written(&sixteen));
}

#[test]
fn a_plan_from_elsewhere_draws_to_planes_and_levels_that_are_there() {
    for (wrong, says) in [
        ((2, 0), "refers to mip level 2, but there are 2"),
        ((0, 2), "refers to plane 2, but there are "),
    ] {
        let mut plan = plan("unorm10");
        plan.check().unwrap();
        if let PlannedWork::Fullscreen { part, .. } = &mut plan.passes[3].work {
            (part.level, part.plane) = wrong;
        }
        let error = plan.check().unwrap_err();
        assert_eq!(error.kind, GraphErrorKind::Plan);
        assert!(error.message.contains(says), "{error}");
    }
}

fn described(node: &dyn Node, slot: &str, map: TextureDesc) -> Result<NodeDesc, GraphError> {
    let inputs = [(slot.to_owned(), ResourceDesc::Texture(map))].into();
    let capabilities = Capabilities::of_profile(Profile::Native);
    node.describe(&Connected::new(&inputs, &capabilities))
}

fn map(technique: Technique, storage: Storage) -> TextureDesc {
    TextureDesc::of_map(MapEncoding::new(technique, storage).unwrap(), [64, 64])
}

#[test]
fn prefix_sums_are_not_drawn() {
    let rectify = RectifyMoments {
        technique: Technique::Hamburger6,
        storage: Storage::Unorm10,
        extent: [64, 64],
    };
    let four = map(Technique::Hamburger4, Storage::Float16);
    let error = described(&rectify, "map", four).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Property, "{error}");
    let rectified = map(Technique::Hamburger6, Storage::Unorm10);
    let other = described(&IntegrateScattering {}, "rectified", rectified).unwrap_err();
    assert_eq!(other.kind, GraphErrorKind::Format, "{other}");
    assert_eq!(other.slot.as_deref(), Some("rectified"));
    let integrated = map(Technique::Hamburger6, Storage::Unorm10);
    let last = described(&CompositeScattering::default(), "integrated", integrated).unwrap_err();
    assert_eq!(last.kind, GraphErrorKind::Format, "{last}");
    assert_eq!(last.slot.as_deref(), Some("integrated"));
    for error in [error, other, last] {
        let text = error.to_string();
        assert!(
            text.contains("prefix sums of a row are written by compute shaders"),
            "{text}"
        );
        assert!(
            text.contains(
                "rgb10a2unorm, the format of 'unorm10'; use one of 'unorm16', 'float16', 'float32', 'unorm8'"
            ),
            "{text}"
        );
    }
}

#[test]
fn nodes_of_four_moments_refuse_six_by_name() {
    let table = SummedAreaTable {
        largest_kernel: [9; 2],
    };
    let debug = DebugMoments::default();
    for &storage in Technique::Hamburger6.row().storages {
        let six = || map(Technique::Hamburger6, storage);
        let error = described(&debug, "map", six()).unwrap_err();
        assert_eq!(error.kind, GraphErrorKind::Format, "{error}");
        assert_eq!(error.slot.as_deref(), Some("map"));
        assert!(
            error.message.contains("hamburger6 as") && error.message.contains("'hamburger4'"),
            "{error}"
        );
        let error = described(&table, "map", six()).unwrap_err();
        assert_eq!(error.kind, GraphErrorKind::Property, "{error}");
        let why = match storage {
            Storage::Unorm10 => "stored as unorm10",
            _ => "for 'hamburger6'",
        };
        let expected = format!("no summed-area table is made of a map {why}");
        assert!(error.message.contains(&expected), "{error}");
    }
}

#[test]
fn ten_bits_without_an_encoding_are_no_moments() {
    let bare = TextureDesc::new(TextureFormat::Rgb10a2Unorm, [64, 64]);
    let error = described(&DebugMoments::default(), "map", bare).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Format);
    assert!(
        error
            .message
            .contains("say in its description how it is encoded")
    );
}

/// Texels that are rounded inwards are valid on the real line alone, and no others are known to be.
#[test]
fn texels_that_are_rounded_inwards_are_those_of_one_technique() {
    let encoding = |technique: Technique, storage| {
        let encoding = MapEncoding::new(technique, storage).unwrap();
        encoding.rounded_inwards()
    };
    let inwards = encoding(Technique::Hamburger4, Storage::Unorm16).unwrap();
    let hausdorff = ShadeHard {
        technique: Some(Technique::Hausdorff4),
        ..ShadeHard::default()
    };
    let map = TextureDesc::of_map(inwards.clone(), [64, 64]);
    let error = described(&hausdorff, "map", map).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Format, "{error}");
    assert!(
        error
            .to_string()
            .contains("give that blur the technique 'hausdorff4'"),
        "{error}"
    );
    for (technique, storage) in [
        (Technique::Hamburger4, Storage::Float32),
        (Technique::Hausdorff4, Storage::Unorm16),
        (Technique::Hamburger6, Storage::Unorm16),
    ] {
        let error = encoding(technique, storage).unwrap_err();
        assert!(
            error.to_string().contains("maps for 'hamburger4'"),
            "{error}"
        );
    }
    // Each blend rounds to all sides.
    let blended = inwards.clone().with_blends(1).unwrap();
    assert!(inwards.is_rounded_inwards() && !blended.is_rounded_inwards());
    let text = serde_json::to_string(&inwards).unwrap();
    assert_eq!(serde_json::from_str::<MapEncoding>(&text).unwrap(), inwards);
}

#[test]
fn nodes_that_read_channels_as_they_are_refuse_packed_texels_by_name() {
    for storage in [Storage::Packed64, Storage::Packed32] {
        refuse_packed(storage);
    }
}

fn refuse_packed(storage: Storage) {
    let packed = || map(Technique::Hamburger4, storage);
    let table = SummedAreaTable {
        largest_kernel: [9; 2],
    };
    let rectify = RectifyMoments {
        technique: Technique::Hamburger6,
        storage: Storage::Float16,
        extent: [64, 64],
    };
    let refused = [
        described(&table, "map", packed()),
        described(&rectify, "map", packed()),
        described(&DebugMoments::default(), "map", packed()),
    ];
    for error in refused.map(Result::unwrap_err) {
        assert_eq!(error.kind, GraphErrorKind::Format, "{error}");
        assert!(
            error
                .to_string()
                .contains(&format!("'{storage}', in packed texels")),
            "{error}"
        );
    }
    let into_packed = RectifyMoments {
        technique: Technique::Hamburger4,
        storage,
        extent: [64, 64],
    };
    let four = map(Technique::Hamburger4, Storage::Float16);
    let error = described(&into_packed, "map", four).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Property, "{error}");
    assert!(
        error
            .to_string()
            .contains(&format!("those of '{storage}' are none")),
        "{error}"
    );
}
