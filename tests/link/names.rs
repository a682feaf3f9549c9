//! Modules and items by their names: what is found, and what is refused.

use moment_shadows::{LinkError, Source, link_module};

use crate::{link_user, link_with, place};

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
        match link_with(text, &[("specialization", "")]).unwrap_err() {
            LinkError::UnknownModule {
                module,
                nearest,
                at,
            } => {
                assert_eq!((module.as_str(), place(&at)), (path, expected));
                assert!(nearest.starts_with(first), "{nearest}");
            }
            other => panic!("another error: {other}"),
        }
    }
    // Within the library, paths are shown as they are written there.
    let text = "import super::super::bounds::hankel::{a};";
    let source = Source {
        name: "mine.wgsl",
        text,
    };
    match link_module(source).unwrap_err() {
        LinkError::UnknownModule {
            module, nearest, ..
        } => {
            assert_eq!(module, "super::super::bounds::hankel");
            assert_eq!(nearest, "`super::super::maths::hankel`");
        }
        other => panic!("another error: {other}"),
    }
    match link_user("import moment_shadows::maths::hankel::{hankel_factor, hankel_facto};")
        .unwrap_err()
    {
        LinkError::UnknownItem {
            item,
            module,
            nearest,
            at,
        } => {
            assert_eq!(
                (item.as_str(), module.as_str()),
                ("hankel_facto", "moment_shadows::maths::hankel")
            );
            assert!(nearest.starts_with("`hankel_factor`"), "{nearest}");
            assert_eq!(place(&at), (1, 55, 12));
        }
        other => panic!("another error: {other}"),
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
        let error = link_with(&text, &[("m", module)]).unwrap_err();
        assert!(matches!(error, LinkError::UnknownItem { .. }), "{item}");
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
        match link_user(&text).unwrap_err() {
            LinkError::DuplicateImport { item, first, at } => {
                assert_eq!(
                    (item.as_str(), first, place(&at)),
                    ("hankel_factor", 1, expected)
                );
            }
            other => panic!("another error: {other}"),
        }
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
    match link_with("import node::a::{a};", &[("a", a), ("b", b)]).unwrap_err() {
        LinkError::Cycle { cycle, at } => {
            assert_eq!(
                (cycle.as_str(), at.file.as_str()),
                ("node::a -> node::b -> node::a", "b")
            );
            assert_eq!(place(&at), (2, 8, 7));
        }
        other => panic!("another error: {other}"),
    }
    let own = "import node::a::{a};\nconst a = 1;";
    let error = link_with(own, &[("a", own)]).unwrap_err();
    assert!(matches!(error, LinkError::Cycle { cycle, .. } if cycle == "node::a -> node::a"));
}

#[test]
fn refuses_names_that_collide() {
    let text = "import moment_shadows::bounds::hamburger4::{hamburger4_bounds};\n\nfn hankel_factor() {}\n";
    match link_user(text).unwrap_err() {
        LinkError::Collision { name, at, first } => {
            assert_eq!(name, "hankel_factor");
            assert_eq!((at.file.as_str(), place(&at)), ("user.wgsl", (3, 4, 13)));
            assert_eq!(first.file, "moment_shadows/maths/hankel.wgsl");
            assert!(first.text.contains("fn hankel_factor("), "{}", first.text);
        }
        other => panic!("another error: {other}"),
    }
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
    match link_user(text).unwrap_err() {
        LinkError::NotImported { item, owner, at } => {
            assert_eq!(item, "hankel_factor");
            assert_eq!(owner, "moment_shadows/maths/hankel.wgsl");
            assert_eq!((at.file.as_str(), place(&at)), ("user.wgsl", (4, 12, 13)));
        }
        other => panic!("another error: {other}"),
    }
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
    match link_with("", &[("one", ""), ("one", "")]).unwrap_err() {
        LinkError::GeneratedName { module } => assert_eq!(module, "one"),
        other => panic!("another error: {other}"),
    }
    // A file of the library has another root.
    link_with("import node::hankel::{a};", &[("hankel", "const a = 1;")]).unwrap();
}
