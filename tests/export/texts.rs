//! The texts: whatever WGSL has is in the other languages under its name, with its comment.

use std::collections::BTreeSet;

use moment_shadows::{
    MapEncoding, Source, Storage, Target, Technique, ValidationOptions, export, validate,
};
use moment_shadows_lab::ports::{encodings, name};

/// The comments above what a text defines at top level, and above members, with the name that is defined below each.
fn commented(wgsl: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut comment = String::new();
    let mut is_body = false;
    for line in wgsl.lines() {
        if line.trim_start().starts_with("//") {
            comment += &format!("{line}\n");
            continue;
        }
        let words: Vec<_> = line
            .split(|c: char| !c.is_alphanumeric() && c != '_')
            .collect();
        let is_top = ["fn", "struct", "const"].contains(&words[0]);
        is_body = if is_top { words[0] == "fn" } else { is_body };
        let name = if is_top {
            words[1]
        } else {
            line.trim_start().split(':').next().unwrap()
        };
        if !comment.is_empty() && !line.trim().is_empty() && (is_top || !is_body) {
            found.push((core::mem::take(&mut comment), name.to_owned()));
        }
        comment.clear();
    }
    found
}

fn words(text: &str) -> BTreeSet<&str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_')
        .collect()
}

/// The names that WGSL defines, those of parameters, members and variables too; what a call gives has a number in some languages.
fn defined(wgsl: &str) -> BTreeSet<&str> {
    let code = wgsl
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let mut names = BTreeSet::new();
    for line in code {
        // Constants within functions are values everywhere else.
        if line.starts_with("    const") {
            continue;
        }
        let words: Vec<_> = line.split_whitespace().collect();
        for pair in words.windows(2) {
            if ["fn", "struct", "const", "var"].contains(&pair[0]) {
                names.insert(pair[1].split(['(', ':', '<']).next().unwrap());
            }
        }
        let before_colons = line.split(": ").collect::<Vec<_>>();
        for before in before_colons.iter().rev().skip(1) {
            let name = before
                .rsplit(|c: char| !c.is_alphanumeric() && c != '_')
                .next();
            names.extend(name);
        }
    }
    names.remove("default");
    names
}

#[test]
fn every_name_and_comment_is_in_every_language() {
    let (mut texts, mut names, mut comments) = (0, 0, 0);
    for encoding in encodings() {
        let wgsl = export(&encoding, Target::Wgsl).unwrap();
        let of_wgsl = defined(&wgsl.text);
        let commented = commented(&wgsl.text);
        assert!(of_wgsl.len() > 30 && commented.len() > 20);
        for target in Target::ALL {
            let exported = export(&encoding, target).unwrap();
            let text = &exported.text;
            let place = format!("{} as {target}", name(&encoding));
            let all = words(text);
            for expected in &of_wgsl {
                // A word of the language has an underscore behind it.
                let reserved = format!("{expected}_");
                let is_there = all.contains(expected) || all.contains(reserved.as_str());
                assert!(is_there, "{place}: {expected}");
                names += 1;
            }
            for function in &exported.functions {
                let is_definition = |line: &str| {
                    line.contains(&format!(" {function}(")) && !line.starts_with([' ', '/'])
                };
                assert_eq!(
                    text.lines().filter(|it| is_definition(it)).count(),
                    1,
                    "{place}: {function}"
                );
            }
            for (comment, name) in &commented {
                let places = text.match_indices(comment.as_str());
                let mut below = places.map(|(at, _)| &text[at + comment.len()..]);
                let is_right =
                    |below: &str| words(below.lines().next().unwrap()).contains(name.as_str());
                assert!(below.any(is_right), "{place}: {name} has not {comment}");
                comments += 1;
            }
            for unwanted in [
                "xq",
                "import ",
                "override ",
                "stored_as",
                "@group",
                "void main",
            ] {
                assert!(!text.contains(unwanted), "{place}: {unwanted}");
            }
            texts += 1;
        }
    }
    assert_eq!(texts, 4 * encodings().len());
    println!("{texts} texts with {names} names and {comments} comments");
}

#[test]
fn every_technique_with_a_map_is_exported_in_each_of_its_storages() {
    let exported = encodings();
    for technique in Technique::examples() {
        for storage in Storage::ALL {
            let encoding = MapEncoding::new(technique.clone(), storage);
            let is_storage = technique.row().storages.contains(&storage);
            assert_eq!(encoding.is_ok(), is_storage);
            if let Ok(encoding) = encoding {
                assert!(exported.contains(&encoding), "{encoding}");
            }
        }
    }
}

#[test]
fn exported_wgsl_is_valid_in_browsers() {
    for encoding in encodings() {
        let name = name(&encoding);
        let text = export(&encoding, Target::Wgsl).unwrap().text;
        let source = Source {
            name: &name,
            text: &text,
        };
        // The default profile is core WebGPU.
        let report = validate(source, &ValidationOptions::default());
        assert!(report.is_valid(), "{report}");
    }
}

#[test]
fn nothing_is_left_of_other_storages_and_settings() {
    for storage in Storage::OF_FOUR_MOMENTS {
        let encoding = MapEncoding::new(Technique::Hamburger4, storage).unwrap();
        let text = export(&encoding, Target::Glsl).unwrap().text;
        let biases: Vec<_> = Storage::OF_FOUR_MOMENTS
            .into_iter()
            .filter(|other| {
                text.contains(&format!(
                    "FOUR_MOMENTS_BIAS_{}",
                    other.name().to_uppercase()
                ))
            })
            .collect();
        assert_eq!(biases, [storage]);
        // The function that decodes asks for no storage.
        assert!(
            text.contains("vec4 four_moments_from_texel(vec4 texel)"),
            "{text}"
        );
        assert!(!text.contains("if (STORAGE"), "{text}");
    }
}

#[test]
fn heads_say_what_a_user_needs() {
    let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float16).unwrap();
    let text = export(&encoding, Target::Hlsl).unwrap().text;
    let head: String = text
        .lines()
        .take_while(|line| line.starts_with("//"))
        .collect();
    for expected in [
        concat!(
            "moment-shadows ",
            env!("CARGO_PKG_VERSION"),
            ": hamburger4, stored as float16"
        ),
        "MIT OR Apache-2.0",
        "1 is full shadow",
        "Moment depth is in [-1, 1]",
        "rgba16float",
        "holds (-0.5, -0.5, 0.48112524, 0.5)",
        "`technique_shadow_intensity(value, fragment_depth)`",
        "`hamburger4_bounds`",
        "Peters & Klein, i3D 2015",
    ] {
        assert!(head.contains(expected), "{expected}: {head}");
    }
}
