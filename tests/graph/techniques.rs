//! Every technique x storage x profile: what is legal compiles, and what is not is refused with the names of what is.

use moment_shadows::{MapEncoding, Profile, Storage};
use moment_shadows_graph::{Capabilities, GraphErrorKind};
use moment_shadows_lab::techniques;

use crate::example::{TEXT, compiled, edited, native};

pub(crate) const STORAGES: [Storage; 6] = [
    Storage::Unorm8,
    Storage::Unorm10,
    Storage::Unorm16,
    Storage::Float16,
    Storage::Float32,
    Storage::Packed64,
];

/// The example made for a technique, in JSON, and a storage.
pub(crate) fn example(technique: &str, storage: &str) -> String {
    edited(
        "\"storage\": \"unorm16\"",
        &format!("\"technique\": {technique}, \"storage\": \"{storage}\""),
    )
}

/// What each technique can be stored as, and under which profile at least.
fn expected(name: &str, storage: Storage) -> Option<Profile> {
    use Profile::{Native, NativeAdapter, WebgpuCore};
    use Storage::{Float16, Float32, Packed64, Unorm8, Unorm10, Unorm16};
    match (name, storage) {
        ("hamburger4" | "hausdorff4" | "hamburger6" | "lvsm", Unorm16) => Some(Native),
        ("hamburger4" | "hausdorff4" | "hamburger6" | "lvsm", Float16 | Float32) => {
            Some(WebgpuCore)
        }
        // Packed into integers that every device writes.
        ("hamburger4", Packed64) => Some(WebgpuCore),
        // Drawn, which takes nothing that core WebGPU lacks.
        ("hamburger6", Unorm10) => Some(WebgpuCore),
        ("vsm" | "esm", Unorm16) => Some(Native),
        // Half-precision textures of one or two channels can be written where the adapter says so.
        ("vsm" | "esm" | "evsm2", Float16) => Some(NativeAdapter),
        ("vsm" | "esm" | "evsm2" | "evsm4", Float32) => Some(WebgpuCore),
        ("evsm4", Float16) => Some(WebgpuCore),
        ("convolution", Unorm8 | Float16) => Some(WebgpuCore),
        ("convolution", Unorm16) => Some(Native),
        _ => None,
    }
}

/// Settings that suit every storage.
pub(crate) const TECHNIQUES: [(&str, &str); 10] = [
    ("hamburger4", "\"hamburger4\""),
    ("hausdorff4", "\"hausdorff4\""),
    ("hamburger6", "\"hamburger6\""),
    ("vsm", "\"vsm\""),
    ("esm", r#"{ "esm": { "exponent": 2 } }"#),
    (
        "esm",
        r#"{ "esm": { "exponent": 2, "filtering": "logarithmic" } }"#,
    ),
    ("evsm2", r#"{ "evsm2": { "exponent": 5 } }"#),
    ("evsm4", r#"{ "evsm4": { "positive": 5, "negative": 5 } }"#),
    ("lvsm", r#"{ "lvsm": { "layers": 5, "overlap": 0.01 } }"#),
    ("convolution", r#"{ "convolution": { "terms": 7 } }"#),
];

#[test]
fn the_whole_matrix_is_accepted_or_refused_as_the_table_says() {
    let mut legal = 0;
    for (name, json) in TECHNIQUES {
        for storage in STORAGES {
            for profile in Profile::ALL {
                let capabilities = Capabilities::of_profile(profile);
                let result = compiled(&example(json, storage.name()), &capabilities);
                let least = expected(name, storage);
                let case = format!("{name}, {storage}, {profile}");
                // The last profile stores whatever the others do.
                let reached = |least| {
                    let place = |wanted| Profile::ALL.iter().position(|p| *p == wanted);
                    place(profile) >= place(least)
                };
                match (least, result) {
                    (Some(least), Ok(_)) => {
                        assert!(reached(least), "{case} is accepted");
                        legal += 1;
                    }
                    (Some(least), Err(error)) => {
                        assert!(!reached(least), "{case}: {error}");
                        assert_eq!(error.kind, GraphErrorKind::Capability, "{case}: {error}");
                        // The storage that is named instead works.
                        let text = error.to_string();
                        let other = STORAGES
                            .into_iter()
                            .find(|other| text.contains(&format!("'{other}'")))
                            .unwrap();
                        compiled(&example(json, other.name()), &capabilities).unwrap();
                    }
                    (None, Ok(_)) => panic!("{case} is accepted"),
                    (None, Err(error)) => {
                        assert_eq!(error.kind, GraphErrorKind::Property, "{case}: {error}");
                        assert_eq!(error.node.as_deref(), Some("resolve"));
                        // All legal ones are named, and no other.
                        let text = error.to_string();
                        let (_, named) = text.split_once("it can as").unwrap();
                        for other in STORAGES {
                            let is_named = named.contains(other.name());
                            assert_eq!(is_named, expected(name, other).is_some(), "{text}");
                        }
                    }
                }
            }
        }
    }
    // 74 under the profiles of wgpu, and the 30 of the most demanding one again in browsers.
    assert_eq!(legal, 74 + 30);
}

/// Packed texels come last, and are none that anything is blended into.
#[test]
fn a_map_that_casters_are_blended_into_has_a_storage_that_is_blended() {
    let text = edited("\"storage\": \"unorm16\"", "\"blends\": 4");
    compiled(&text, &native()).unwrap();
}

#[test]
fn the_best_storage_is_legal_and_writable() {
    for encoding in techniques::filterable() {
        let technique = encoding.technique();
        for profile in Profile::ALL {
            let best = technique.best_storage(profile).unwrap();
            let limits = MapEncoding::new(technique.clone(), best);
            // Exponents may be too large for another storage.
            if let Ok(best) = limits {
                best.check(profile).unwrap();
            }
        }
    }
    for technique in techniques::reading_depth() {
        assert_eq!(technique.best_storage(Profile::Native), None);
        let error = MapEncoding::new(technique, Storage::Float32).unwrap_err();
        assert!(
            error.message.contains("reads the plain depth map"),
            "{error}"
        );
    }
}

/// Shading with the plain depth map.
fn reading_depth(technique: &str) -> String {
    TEXT.replace("\"samples\": 4", "\"samples\": 1")
        .replace(
            "\"type\": \"shade_hard\"",
            &format!("\"type\": \"shade_hard\", \"properties\": {{ \"technique\": {technique} }}"),
        )
        .replace(
            "{ \"from\": \"blur.blurred\", \"to\": \"shade.map\" }",
            "{ \"from\": \"light_depth\", \"to\": \"shade.depth\" }",
        )
}

#[test]
fn tests_on_the_plain_depth_map_need_no_other_node() {
    for technique in techniques::reading_depth() {
        let json = serde_json::to_string(&technique).unwrap();
        let plan = compiled(&reading_depth(&json), &native()).unwrap();
        // What nobody reads is not recorded.
        assert_eq!(plan.passes.len(), 1, "{technique}");
        assert_eq!(plan.memory.len(), 1, "{technique}");
    }
    for (technique, expected) in [
        (r#"{ "pcf": { "box": { "radius": 65 } } }"#, "from 0 to 64"),
        (
            r#"{ "pcf": { "gaussian": { "radius": 4, "sigma": 0 } } }"#,
            "positive",
        ),
        (
            r#"{ "pcf": { "weights": [1, 2] } }"#,
            "2 weights are no filter",
        ),
        (
            r#"{ "pcf": { "weights": [1, -1, 1] } }"#,
            "3 weights are no filter",
        ),
        (
            r#"{ "pcss": { "search_taps": 0, "filter_taps": 1 } }"#,
            "0 search taps",
        ),
        (
            r#"{ "pcss": { "search_taps": 1, "filter_taps": 5000 } }"#,
            "5000 filter taps",
        ),
    ] {
        let error = compiled(&reading_depth(technique), &native()).unwrap_err();
        assert_eq!(error.kind, GraphErrorKind::Property, "{technique}: {error}");
        assert!(error.to_string().contains(expected), "{technique}: {error}");
    }
    // Several samples cannot be compared.
    let text = reading_depth("\"binary\"").replace("\"samples\": 1", "\"samples\": 4");
    let error = compiled(&text, &native()).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Format);
}

#[test]
fn a_map_is_shaded_by_the_technique_it_was_made_for() {
    let with = |technique: &str| {
        TEXT.replace(
            "\"type\": \"shade_hard\"",
            &format!("\"type\": \"shade_hard\", \"properties\": {{ \"technique\": {technique} }}"),
        )
    };
    // Four moments serve both.
    compiled(&with("\"hausdorff4\""), &native()).unwrap();
    let error = compiled(&with("\"vsm\""), &native()).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Format);
    let text = error.to_string();
    assert!(
        text.contains("made for hamburger4 as unorm16") && text.contains("'vsm' cannot read it")
    );
    // The exponent is part of the map.
    let esm = example(r#"{ "esm": { "exponent": 80 } }"#, "float32").replace(
        "\"type\": \"shade_hard\"",
        "\"type\": \"shade_hard\", \"properties\": { \"technique\": { \"esm\": { \"exponent\": 81 } } }",
    );
    let error = compiled(&esm, &native()).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Format, "{error}");
}

#[test]
fn planes_are_texture_layers() {
    let lvsm = example(r#"{ "lvsm": { "layers": 7 } }"#, "unorm16");
    let plan = compiled(&lvsm, &native()).unwrap();
    let map = plan
        .resources
        .iter()
        .find(|resource| resource.name == "blur.blurred")
        .unwrap();
    let map = map.desc.texture().unwrap();
    assert_eq!((map.planes, map.layers, map.array_layers()), (4, 1, 4));
    assert_eq!(map.bytes(), 4 * 8 * 1024 * 1024);
    // The blur's planes have intermediate maps of their own, which take turns in one texture.
    let mut memory = plan.memory.iter();
    let half = memory.find(|memory| memory.label.starts_with("blur.half_blurred_0"));
    let half = half.unwrap();
    assert_eq!(half.label.matches(" | blur.half_blurred_").count(), 3);
    assert_eq!(half.desc.texture().unwrap().array_layers(), 1);
    let labels: Vec<&str> = plan.passes.iter().map(|pass| pass.label.as_str()).collect();
    assert_eq!(labels[..2], ["plane 0: resolve", "plane 1: resolve"]);
    assert_eq!(
        labels[4..6],
        ["plane 0: blur along x", "plane 0: blur along y"]
    );
    assert_eq!(labels.len(), 4 + 8 + 1);
    // As many layers as the device has, planes included.
    let many = lvsm.replace("\"samples\": 4", "\"layers\": 65");
    let error = compiled(&many, &native()).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("260 layers; the device allows 256"),
        "{error}"
    );
}

#[test]
fn placed_layers_come_from_an_input() {
    let lvsm = example(
        r#"{ "lvsm": { "layers": 4, "splits": "lloyd" } }"#,
        "unorm16",
    );
    let error = compiled(&lvsm, &native()).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::MissingInput, "{error}");
    assert_eq!(error.slot.as_deref(), Some("splits"));
}

#[test]
fn logarithms_have_no_mip_levels() {
    let text = example(
        r#"{ "esm": { "exponent": 80, "filtering": "logarithmic" } }"#,
        "unorm16",
    )
    .replace("\"sigma\": 2.4 }", "\"sigma\": 2.4 }, \"mip_levels\": 4")
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
    let error = compiled(&text, &native()).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Property, "{error}");
    assert!(error.to_string().contains("no mip levels"), "{error}");
}

#[test]
fn a_name_alone_stands_for_what_its_storage_takes() {
    let exponents = |technique: &str, storage: &str| {
        let plan = compiled(&example(technique, storage), &native()).unwrap();
        let mut maps = plan.resources.iter().filter_map(|it| it.desc.texture());
        let encoding = maps.find_map(|map| map.encoding.clone()).unwrap();
        serde_json::to_value(encoding.technique()).unwrap()
    };
    for (technique, storage, expected) in [
        (r#""evsm4""#, "float32", [40.0, 5.0]),
        (r#""evsm4""#, "float16", [5.54, 5.0]),
        (r#"{ "evsm4": { "positive": 3 } }"#, "float16", [3.0, 5.0]),
        (r#"{ "evsm4": { "negative": 3 } }"#, "float32", [40.0, 3.0]),
    ] {
        let found = exponents(technique, storage);
        for (name, expected) in ["positive", "negative"].into_iter().zip(expected) {
            let found = found["evsm4"][name].as_f64().unwrap();
            assert!(
                (found - expected).abs() < 0.01,
                "{technique} {storage}: {found}"
            );
        }
    }
    // What shades takes the exponents of the map where it has none of its own, and refuses others.
    let shaded = |technique: &str| {
        let text = example(
            r#"{ "evsm4": { "positive": 20, "negative": 4 } }"#,
            "float32",
        )
        .replace(
            "\"type\": \"shade_hard\"",
            &format!("\"type\": \"shade_hard\", \"properties\": {{ \"technique\": {technique} }}"),
        );
        compiled(&text, &native())
    };
    shaded(r#""evsm4""#).unwrap();
    shaded(r#"{ "evsm4": { "negative": 4 } }"#).unwrap();
    let error = shaded(r#"{ "evsm4": { "negative": 5 } }"#).unwrap_err();
    assert_eq!(error.kind, GraphErrorKind::Format, "{error}");
    let error = compiled(&example(r#""evsm5""#, "float32"), &native()).unwrap_err();
    assert!(error.to_string().contains("nearest are `evsm"), "{error}");
    assert_eq!(error.kind, GraphErrorKind::Syntax, "{error}");
}
