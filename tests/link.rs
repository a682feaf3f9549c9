//! The linker: what it joins, in which order, where lines come from, and what it refuses.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use moment_shadows::{LinkError, Linked, Location, Source, imports_super, link, link_module};
use proptest::prelude::*;

fn link_user(text: &str) -> Result<Linked, LinkError> {
    link(
        Source {
            name: "user.wgsl",
            text,
        },
        &[],
    )
}

fn link_with(text: &str, generated: &[(&str, &str)]) -> Result<Linked, LinkError> {
    let generated: Vec<_> = generated
        .iter()
        .map(|&(name, text)| Source { name, text })
        .collect();
    link(
        Source {
            name: "user.wgsl",
            text,
        },
        &generated,
    )
}

/// The line, column and width of the place.
fn place(at: &Location) -> (u32, u32, u32) {
    (at.line, at.column, at.width)
}

/// The place of an import of the wrong form, and the reason.
fn wrong_form(text: &str) -> ((u32, u32, u32), &'static str) {
    match link_user(text).unwrap_err() {
        LinkError::WrongForm { reason, at, form } => {
            assert_eq!(form, "import node::module::{item, item};");
            assert_eq!(at.file, "user.wgsl");
            assert_eq!(at.text, text.lines().nth(at.line as usize - 1).unwrap());
            (place(&at), reason)
        }
        other => panic!("another error: {other}"),
    }
}

#[test]
fn joins_the_closure_once_in_dependency_order() {
    let linked = link_user(
        "import moment_shadows::moments::four_moments::{four_moments_from_depth};\n\
         import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity};\n\
         fn shade() {}\n",
    )
    .unwrap();
    let files: Vec<_> = linked.files().collect();
    let expected = [
        "moment_shadows/map/storage.wgsl",
        "moment_shadows/moments/four_moments.wgsl",
        "moment_shadows/maths/hankel.wgsl",
        "moment_shadows/bounds/hamburger4.wgsl",
        "user.wgsl",
    ];
    assert_eq!(files, expected);
    let headers: Vec<_> = linked
        .wgsl()
        .lines()
        .filter_map(|line| {
            line.strip_prefix("// ")
                .filter(|name| name.ends_with(".wgsl"))
        })
        .collect();
    assert_eq!(headers, expected);
    assert_eq!(linked.wgsl().matches("fn hankel_factor(").count(), 1);
    assert!(
        linked
            .wgsl()
            .lines()
            .all(|line| !line.starts_with("import"))
    );
    assert!(linked.wgsl().ends_with("\n// user.wgsl\nfn shade() {}\n"));
}

#[test]
fn removed_imports_leave_one_blank_line() {
    let text = "// a\n\nimport node::m::{m};\n\n\n\nconst b = m;\n";
    let linked = link_with(text, &[("m", "\nconst m = 1;\n\n\n")]).unwrap();
    let expected = "// m\n\nconst m = 1;\n\n\n// user.wgsl\n// a\n\nconst b = m;\n";
    assert_eq!(linked.wgsl(), expected);
}

#[test]
fn same_input_same_text() {
    let text = "import moment_shadows::bounds::hamburger4::{hamburger4_bounds};\n";
    assert_eq!(link_user(text), link_user(text));
}

#[test]
fn every_line_maps_back() {
    let text = "// A shader.\n\nimport moment_shadows::maths::hankel::{hankel_factor};\n\nenable f16;\n\nfn a() {}\n";
    let linked = link_user(text).unwrap();
    let mut mapped = 0;
    for (number, line) in (1..).zip(linked.wgsl().lines()) {
        let Some(origin) = linked.origin(number) else {
            assert!(
                line.is_empty() || line.starts_with("// "),
                "{number}: {line}"
            );
            continue;
        };
        let file = match origin.file {
            "user.wgsl" => text,
            "moment_shadows/maths/hankel.wgsl" => include_str!("../wgsl/maths/hankel.wgsl"),
            other => panic!("no such file was linked: {other}"),
        };
        let original = file.lines().nth(origin.line as usize - 1).unwrap();
        // The line of a directive appears twice: with it at the top, blank below.
        assert!(
            line == original || line.trim().is_empty(),
            "{number}: {line}"
        );
        mapped += 1;
    }
    assert!(mapped > 20);
    assert_eq!(linked.origin(0), None);
    assert_eq!(linked.origin(u32::MAX), None);
}

#[test]
fn directives_come_first_at_their_own_column() {
    let linked = link_with(
        "import node::specialization::{A};\n enable f16; /* kept */ fn a() {}\n",
        &[("specialization", "const A = 1;\n")],
    )
    .unwrap();
    assert_eq!(
        linked.wgsl(),
        " enable f16;\n\n// specialization\nconst A = 1;\n\n// user.wgsl\n             /* kept */ fn a() {}\n"
    );
    assert_eq!(linked.origin(1).unwrap().line, 2);
}

#[test]
fn import_lines_may_follow_comments_a_byte_order_mark_and_crlf() {
    let text = "\u{feff}// import node::nothing::{x};\r\n/* import /* nested */ ;\r\n*/\r\n\
                import moment_shadows::maths::hankel::{hankel_factor}; // what is used\r\n\
                fn a() {} // import nothing\r\n";
    let linked = link_user(text).unwrap();
    assert!(!linked.wgsl().contains(['\r', '\u{feff}']));
    let end = "// user.wgsl\n// import node::nothing::{x};\n/* import /* nested */ ;\n*/\n\
               fn a() {} // import nothing\n";
    assert!(linked.wgsl().ends_with(end), "{}", linked.wgsl());
    let last = u32::try_from(linked.wgsl().lines().count()).unwrap();
    assert_eq!(linked.origin(last).unwrap().line, 5);
}

#[test]
fn generated_modules_import_library_modules() {
    let linked = link_with(
        "import node::specialization::{Bias};\nfn f(b: Bias) {}\n",
        &[(
            "specialization",
            "import moment_shadows::moments::four_moments::{FourMomentsBias};\nalias Bias = FourMomentsBias;\n",
        )],
    )
    .unwrap();
    let files: Vec<_> = linked.files().collect();
    assert_eq!(
        files,
        [
            "moment_shadows/map/storage.wgsl",
            "moment_shadows/moments/four_moments.wgsl",
            "specialization",
            "user.wgsl"
        ]
    );
}

#[test]
fn a_module_of_the_library_imports_its_siblings() {
    let text = "import super::super::maths::hankel::{hankel_factor};\nfn mine() {}\n";
    assert!(imports_super(text));
    let linked = link_module(Source {
        name: "mine.wgsl",
        text,
    })
    .unwrap();
    assert_eq!(
        linked.files().collect::<Vec<_>>(),
        ["moment_shadows/maths/hankel.wgsl", "mine.wgsl"]
    );

    let text = "import moment_shadows::maths::hankel::{hankel_factor};\n";
    assert!(!imports_super(text));
    let error = link_module(Source {
        name: "mine.wgsl",
        text,
    })
    .unwrap_err();
    assert!(matches!(
        error,
        LinkError::WrongForm {
            form: "import node::module::{item, item};",
            ..
        }
    ));
}

#[test]
fn refuses_other_forms_of_import() {
    let outside = "outside the library an import starts with `moment_shadows::`";
    let cases = [
        (
            "import super::super::maths::hankel::{hankel_factor};",
            (1, 8, 5),
            outside,
        ),
        (
            "\nimport bevy::hankel::{hankel_factor};",
            (2, 8, 4),
            outside,
        ),
        (
            "import moment_shadows::hankel;",
            (1, 30, 1),
            "`::` is missing after the module's name",
        ),
        (
            "import moment_shadows::hankel::hankel_factor;",
            (1, 32, 13),
            "items are imported in braces",
        ),
        (
            "import moment_shadows::hankel::*;",
            (1, 32, 1),
            "items are imported in braces",
        ),
        (
            "import moment_shadows::{hankel};",
            (1, 24, 1),
            "the module's name is missing",
        ),
        (
            "import moment_shadows::maths::hankel::{};",
            (1, 33, 1),
            "an item's name is missing",
        ),
        (
            "import moment_shadows::maths::hankel::{a,};",
            (1, 35, 1),
            "an item's name is missing",
        ),
        (
            "import moment_shadows::maths::hankel::{hankel_factor as f};",
            (1, 47, 2),
            "items are plain names with commas between them (no `as`, no path)",
        ),
        (
            "import moment_shadows::maths::hankel::{a::b};",
            (1, 34, 2),
            "items are plain names with commas between them (no `as`, no path)",
        ),
        (
            "import moment_shadows::maths::hankel::{a}",
            (1, 34, 1),
            "`;` is missing",
        ),
        (
            "import moment_shadows::maths::hankel::{\n  a,\n};",
            (1, 32, 1),
            "an import is one line",
        ),
        ("import", (1, 1, 6), outside),
        (
            "/* a */ import moment_shadows::maths::hankel::{a};",
            (1, 9, 6),
            "something stands before the import",
        ),
        (
            "import moment_shadows::maths::hankel::{a}; fn f() {}",
            (1, 35, 1),
            "something stands after the import",
        ),
        (
            "import moment_shadows::maths::hankel::{a}; /* a\n*/",
            (1, 35, 1),
            "something stands after the import",
        ),
    ];
    for (text, at, reason) in cases {
        assert_eq!(wrong_form(text), (at, reason), "{text}");
    }
}

#[test]
fn refuses_imports_after_code() {
    let cases = [
        (
            "\nconst A = 1;\n  import moment_shadows::maths::hankel::{hankel_factor};",
            (3, 3, 6),
            2,
        ),
        (
            "enable f16;\nimport moment_shadows::maths::hankel::{hankel_factor};",
            (2, 1, 6),
            1,
        ),
        (
            "@if(x) import moment_shadows::maths::hankel::{hankel_factor};",
            (1, 2, 2),
            0,
        ),
    ];
    for (text, expected, line) in cases {
        match link_user(text).unwrap_err() {
            LinkError::ImportAfterCode { first_code, at } => {
                assert_eq!((place(&at), first_code), (expected, line));
            }
            LinkError::Conditional { attribute, at } if line == 0 => {
                assert_eq!((place(&at), attribute.as_str()), (expected, "if"));
            }
            other => panic!("another error: {other}"),
        }
    }
}

#[test]
fn refuses_paths_conditions_and_public_in_code() {
    match link_user("fn f() {\n\tlet a = super::hankel::hankel_factor();\n}").unwrap_err() {
        LinkError::InlinePath { at } => assert_eq!(place(&at), (2, 15, 2)),
        other => panic!("another error: {other}"),
    }
    match link_user("@else fn f() {}").unwrap_err() {
        LinkError::Conditional { attribute, at } => {
            assert_eq!((attribute.as_str(), place(&at)), ("else", (1, 2, 4)));
        }
        other => panic!("another error: {other}"),
    }
    match link_user("public import moment_shadows::maths::hankel::{hankel_factor};").unwrap_err() {
        LinkError::Public { at } => assert_eq!(place(&at), (1, 1, 6)),
        other => panic!("another error: {other}"),
    }
    // A plain `if` is no attribute.
    link_user("fn f() { if true { return; } else { return; } }").unwrap();
}

#[test]
fn names_unknown_modules_and_items_with_the_nearest() {
    match link_user("\n import moment_shadows::bounds::hambruger4::{a};").unwrap_err() {
        LinkError::UnknownModule {
            module,
            nearest,
            at,
        } => {
            assert_eq!(module, "bounds::hambruger4");
            assert!(nearest.starts_with("`hamburger`, "), "{nearest}");
            assert_eq!(place(&at), (2, 25, 9));
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
            assert_eq!((item.as_str(), module.as_str()), ("hankel_facto", "hankel"));
            assert!(nearest.starts_with("`hankel_factor`"), "{nearest}");
            assert_eq!(place(&at), (1, 48, 12));
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
        (format!("{one}{one}"), (2, 33, 13)),
        (
            "import moment_shadows::maths::hankel::{hankel_factor, hankel_factor};".to_owned(),
            (1, 48, 13),
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
            assert_eq!((cycle.as_str(), at.file.as_str()), ("a -> b -> a", "b"));
            assert_eq!(place(&at), (2, 24, 1));
        }
        other => panic!("another error: {other}"),
    }
    let own = "import node::a::{a};\nconst a = 1;";
    let error = link_with(own, &[("a", own)]).unwrap_err();
    assert!(matches!(error, LinkError::Cycle { cycle, .. } if cycle == "a -> a"));
}

#[test]
fn a_long_chain_of_modules_needs_no_deep_stack() {
    let texts: Vec<_> = (0..2_000)
        .map(|i| {
            let next = i + 1;
            (
                format!("m{i}"),
                format!("import moment_shadows::m{next}::{{c{next}}};\nconst c{i} = c{next};"),
            )
        })
        .collect();
    let mut generated: Vec<_> = texts
        .iter()
        .map(|(name, text)| (name.as_str(), text.as_str()))
        .collect();
    generated.push(("m2000", "const c2000 = 1;"));
    let linked = link_with("import node::m0::{c0};", &generated).unwrap();
    assert_eq!(linked.files().len(), 2_002);
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
    // A parameter, a variable and a member of that name are one's own.
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
    for generated in [&[("hankel", "")][..], &[("one", ""), ("one", "")]] {
        match link_with("", generated).unwrap_err() {
            LinkError::GeneratedName { module } => assert_eq!(module, generated[0].0),
            other => panic!("another error: {other}"),
        }
    }
}

#[test]
fn refuses_comments_without_end() {
    match link_user("fn f() {}\n /* /* */").unwrap_err() {
        LinkError::UnterminatedComment { at } => assert_eq!(place(&at), (2, 2, 2)),
        other => panic!("another error: {other}"),
    }
}

#[test]
fn errors_show_the_line_with_carets() {
    let text = "// é\nimport\tmoment_shadows::hankel::{hankel_facto};";
    let shown = link_user(text).unwrap_err().to_string();
    let expected = " --> user.wgsl:2:33\n  |\n2 | import\tmoment_shadows::hankel::{hankel_facto};\n  \
                    |       \t                         ^^^^^^^^^^^^";
    assert!(shown.ends_with(expected), "{shown}");
    assert!(
        shown.starts_with("module `hankel` does not define `hankel_facto`; the nearest names are")
    );
}

#[test]
fn names_of_files_cannot_leave_their_comment() {
    let linked = link(
        Source {
            name: "a\nb\u{2028}c",
            text: "const x = 1;\n",
        },
        &[],
    )
    .unwrap();
    assert_eq!(linked.wgsl(), "// abc\nconst x = 1;\n");
}

proptest! {
    /// Whatever the text, linking returns, and errors name a place within it.
    #[test]
    fn arbitrary_text_never_panics(
        parts in proptest::collection::vec(
            prop_oneof![
                Just("import "), Just("moment_shadows"), Just("super"), Just("::"), Just("hankel"),
                Just("{"), Just("}"), Just("hankel_factor"), Just(","), Just(";"), Just("\n"), Just("\r\n"),
                Just("//"), Just("/*"), Just("*/"), Just("fn "), Just("var<"), Just("@if"), Just("é"),
                Just("\u{feff}"), Just("enable "), Just("1.0e5"), Just("\u{2028}"), Just("public "),
            ],
            0..24,
        ),
        noise in any::<String>(),
        at in 0_usize..24,
    ) {
        let mut parts: Vec<&str> = parts;
        parts.insert(at.min(parts.len()), &noise);
        let text = parts.concat();
        for result in [link_user(&text), link_module(Source { name: "user.wgsl", text: &text }),
            link_with("import node::m::{a};", &[("m", &text)])] {
            match result {
                Ok(linked) => {
                    let lines = linked.wgsl().lines().count();
                    prop_assert!((1..=lines).all(|line| linked.origin(u32::try_from(line).unwrap())
                        .is_none_or(|origin| origin.line >= 1)));
                }
                Err(error) => prop_assert!(!error.to_string().is_empty()),
            }
        }
    }
}
