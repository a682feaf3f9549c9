//! Modules and items by their names: what is found, and what is refused.

use moment_shadows::{Source, link, nearest};

use crate::{link_user, link_with, place, refused};

#[test]
fn names_unknown_modules_and_items_with_the_nearest() {
    // The path asked for, the first of the nearest, and where the path stands.
    let cases = [
        (
            "\n import moment_shadows::bounds::hambruger4::{a};",
            "moment_shadows::bounds::hambruger4",
            "`moment_shadows::bounds::hamburger4`, ",
            (2, 9, 34),
        ),
        (
            "import moment_shadows::hankel::{a};",
            "moment_shadows::hankel",
            "`moment_shadows::maths::hankel`",
            (1, 8, 22),
        ),
        (
            "import node::hankel::{a};",
            "node::hankel",
            "`moment_shadows::maths::hankel`",
            (1, 8, 12),
        ),
        (
            "import moment_shadows::specialization::{a};",
            "moment_shadows::specialization",
            "`node::specialization`",
            (1, 8, 30),
        ),
        (
            "import node::specialisation::{a};",
            "node::specialisation",
            "`node::specialization`, ",
            (1, 8, 20),
        ),
    ];
    for (text, path, first, expected) in cases {
        let (message, at) = refused(link_with(text, &[("specialization", "")]));
        let start = format!("there is no module `{path}`; the nearest are {first}");
        assert!(message.starts_with(&start), "{message}");
        assert_eq!(place(&at), expected);
    }
    // Within the library, paths are shown as they are written there.
    let text = "import super::super::bounds::hankel::{a};";
    let source = Source {
        name: "mine.wgsl",
        text,
    };
    let (message, _) = refused(link(source, &[]));
    let expected = "there is no module `super::super::bounds::hankel`; the nearest are `super::super::maths::hankel`";
    assert_eq!(message, expected);
    let text = "import moment_shadows::maths::hankel::{hankel_factor, hankel_facto};";
    let (message, at) = refused(link_user(text));
    let expected = "module `moment_shadows::maths::hankel` does not define `hankel_facto`; the nearest names are `hankel_factor`";
    assert!(message.starts_with(expected), "{message}");
    assert_eq!(place(&at), (1, 55, 12));
}

/// How many letters are put in, left out or changed, by the definition.
fn edits(from: &[u8], to: &[u8]) -> usize {
    match (from, to) {
        ([], rest) | (rest, []) => rest.len(),
        ([a, after_a @ ..], [b, after_b @ ..]) => {
            let changed = edits(after_a, after_b) + usize::from(a != b);
            let moved = edits(after_a, to).min(edits(from, after_b)) + 1;
            changed.min(moved)
        }
    }
}

#[test]
fn the_nearest_names_have_the_fewest_edits() {
    // Every word of two letters up to three long.
    let mut words = vec![String::new()];
    let mut longest = words.clone();
    for _ in 0..3 {
        longest = longest
            .iter()
            .flat_map(|word| [format!("{word}a"), format!("{word}b")])
            .collect();
        words.extend_from_slice(&longest);
    }
    for name in &words {
        for pair in words.iter().flat_map(|a| words.iter().map(move |b| [a, b])) {
            let mut expected = pair.map(|word| (edits(name.as_bytes(), word.as_bytes()), word));
            expected.sort();
            let mut quoted = Vec::from(expected.map(|(_, word)| format!("`{word}`")));
            quoted.dedup();
            let found = nearest(name, pair.map(String::as_str));
            assert_eq!(found, quoted.join(", "), "{name}");
        }
    }
}

#[test]
fn only_names_at_top_level_are_items() {
    let module = "struct S { member: f32 }\nalias T = f32;\nconst C = vec2f(1.0, (2.0));\n\
                  var<private> v: array<f32, 2>;\n@group(0) @binding(0) var<storage, read_write> w: f32;\n\
                  override o: f32;\nfn f(parameter: f32) { let local = 1; const inner = 2; }\n";
    for item in ["S", "T", "C", "v", "w", "o", "f"] {
        let text = format!("import node::m::{{{item}}};");
        link_with(&text, &[("m", module)]).unwrap();
    }
    for item in [
        "member",
        "parameter",
        "local",
        "inner",
        "private",
        "storage",
        "f32",
        "fn",
    ] {
        let text = format!("import node::m::{{{item}}};");
        let (message, _) = refused(link_with(&text, &[("m", module)]));
        assert!(
            message.contains(&format!("does not define `{item}`")),
            "{message}"
        );
    }
}

#[test]
fn refuses_an_item_imported_twice() {
    let one = "import moment_shadows::maths::hankel::{hankel_factor};\n";
    for (text, expected) in [
        (format!("{one}{one}"), (2, 40, 13)),
        (
            "import moment_shadows::maths::hankel::{hankel_factor, hankel_factor};".to_owned(),
            (1, 55, 13),
        ),
    ] {
        let (message, at) = refused(link_user(&text));
        let start = "`hankel_factor` is imported already in line 1;";
        assert!(message.starts_with(start), "{message}");
        assert_eq!(place(&at), expected);
    }
    // Two lines with different items of one module are two imports.
    link_user(&format!(
        "{one}import moment_shadows::maths::hankel::{{HankelFactor}};\n"
    ))
    .unwrap();
}

#[test]
fn refuses_cycles() {
    let a = "import node::b::{b};\nconst a = 1;";
    let b = "// b\nimport node::a::{a};\nconst b = 1;";
    let (message, at) = refused(link_with("import node::a::{a};", &[("a", a), ("b", b)]));
    assert!(
        message.contains("cycle: node::a -> node::b -> node::a;"),
        "{message}"
    );
    assert_eq!((at.file.as_str(), place(&at)), ("b", (2, 8, 7)));
    let own = "import node::a::{a};\nconst a = 1;";
    let (message, _) = refused(link_with(own, &[("a", own)]));
    assert!(message.contains("cycle: node::a -> node::a;"), "{message}");
}

#[test]
fn refuses_names_that_collide() {
    let text = "import moment_shadows::bounds::hamburger4::{hamburger4_bounds};\n\nfn hankel_factor() {}\n";
    let error = link_user(text).unwrap_err();
    assert!(
        error
            .message
            .starts_with("`hankel_factor` is defined twice"),
        "{error}"
    );
    let [at, first] = error.places.as_slice() else {
        panic!("one place, or more than two: {error}");
    };
    assert_eq!((at.file.as_str(), place(at)), ("user.wgsl", (3, 4, 13)));
    assert_eq!(first.file, "moment_shadows/maths/hankel.wgsl");
    assert_eq!(first.label, "defined already");
    assert!(first.text.contains("fn hankel_factor("), "{}", first.text);
    // A local variable of that name shadows it, as in WGSL.
    link_user(
        "import moment_shadows::maths::hankel::{hankel_factor};\nfn f() { let hankel_factor = 1; }",
    )
    .unwrap();
    // A name defined twice in one file is for the WGSL compiler to refuse.
    link_user("const a = 1;\nconst a = 1;").unwrap();
}

#[test]
fn refuses_names_that_are_used_without_being_imported() {
    // `hankel_factor` comes along with `hamburger4_bounds`, but only tools that join files would find it.
    let text = "import moment_shadows::bounds::hamburger4::{hamburger4_bounds};\n\nfn f(b: vec4f) -> f32 {\n    return hankel_factor(b, 1.0).variance;\n}\n";
    let (message, at) = refused(link_user(text));
    let expected = "`hankel_factor` is used, but not imported; add it to the imports (it is defined in moment_shadows/maths/hankel.wgsl)";
    assert_eq!(message, expected);
    assert_eq!((at.file.as_str(), place(&at)), ("user.wgsl", (4, 12, 13)));
    // A parameter, a variable and a member of that name belong to the shader itself.
    for code in [
        "fn f(hankel_factor: f32) -> f32 { return hankel_factor; }",
        "fn f() -> f32 { let hankel_factor = 1.0; return hankel_factor; }",
        "struct S { hankel_factor: f32 }\nfn f(s: S) -> f32 { return s.hankel_factor; }",
    ] {
        link_user(&format!(
            "import moment_shadows::bounds::hamburger4::{{hamburger4_bounds}};\n{code}"
        ))
        .unwrap();
    }
}

#[test]
fn refuses_generated_modules_with_a_name_in_use() {
    let error = link_with("", &[("one", ""), ("one", "")]).unwrap_err();
    assert!(
        error.message.contains("two modules are named `one`"),
        "{error}"
    );
    // A file of the library has another root.
    link_with("import node::hankel::{a};", &[("hankel", "const a = 1;")]).unwrap();
}
