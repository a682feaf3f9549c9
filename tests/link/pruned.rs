//! Pruning: what is linked of an imported module, and what is not.

use std::collections::BTreeSet;

use moment_shadows::{Source, ValidationOptions, link, modules, validate};

use crate::{link_user, link_with, place};

const MODULE: &str = "import node::other::{other};

// What the module computes.

// First.
const FIRST = 1; // one
const SECOND = FIRST;
// Of a \u{fe0f} texel.
struct Texel { x: f32 }

/* A block stays: it may hold

anything. */
@group(0) @binding(0) var<uniform> texel: Texel;
override SIZE: u32 = 4;
alias Sums = array<vec2<f32>, SECOND>;
const_assert FIRST < 2;

// Reads.
fn read() -> f32 { return texel.x + other(); }
// Writes.
@must_use fn write(FIRST: u32) -> f32 { return 0.0; }

@compute @workgroup_size(SIZE) fn main() {}
";

/// The lines of `MODULE` that a shader of `code` gets, without comments and blank lines.
fn kept(code: &str) -> Vec<String> {
    let items = "FIRST, SECOND, SIZE, Sums, Texel, read, texel, write";
    let text = format!("import node::m::{{{items}}};\n{code}");
    let other = "fn other() -> f32 { return 1.0; }\nfn unreached() {}\n";
    let linked = link_with(&text, &[("m", MODULE), ("other", other)]).unwrap();
    let lines = linked
        .wgsl()
        .lines()
        .take_while(|line| *line != "// user.wgsl");
    let starts = ["@", "alias", "const", "fn", "override", "struct"];
    lines
        .filter(|line| starts.iter().any(|start| line.starts_with(start)))
        .map(|line| line.split([';', '{']).next().unwrap().to_owned())
        .collect()
}

#[test]
fn what_is_reached_is_linked_in_the_order_of_the_file() {
    let entry = [
        "override SIZE: u32 = 4",
        "const_assert FIRST < 2",
        "@compute @workgroup_size(SIZE) fn main() ",
    ];
    let with = |more: &[&str]| -> BTreeSet<String> {
        let first = "const FIRST = 1";
        entry
            .iter()
            .chain(more)
            .chain(&[first])
            .map(|line| (*line).to_owned())
            .collect()
    };
    let cases: [(&str, &[&str]); 6] = [
        // Entry points are reached from outside, and what they name with them.
        ("", &[]),
        (
            "const a: Sums = Sums();",
            &[
                "const SECOND = FIRST",
                "alias Sums = array<vec2<f32>, SECOND>",
            ],
        ),
        ("fn f(t: Texel) {}", &["struct Texel "]),
        (
            "fn f() { _ = read(); }",
            &[
                "fn other() -> f32 ",
                "struct Texel ",
                "@group(0) @binding(0) var<uniform> texel: Texel",
                "fn read() -> f32 ",
            ],
        ),
        (
            "fn f() { _ = write(1); }",
            &["@must_use fn write(FIRST: u32) -> f32 "],
        ),
        // A member of that name does not count as a use; a local variable may.
        (
            "struct S { a: f32 }\nfn f(s: S) { let SECOND = s.Sums; }",
            &["const SECOND = FIRST"],
        ),
    ];
    for (code, more) in cases {
        let kept = kept(code);
        assert_eq!(
            kept.iter().cloned().collect::<BTreeSet<_>>(),
            with(more),
            "{code}"
        );
        let order: Vec<_> = kept
            .iter()
            .filter_map(|line| MODULE.find(line.as_str()))
            .collect();
        assert!(order.is_sorted(), "{code}: {kept:?}");
    }
}

#[test]
fn comments_go_with_what_they_stand_above() {
    let module = "// What the file computes.\n\n// Of a.\n// More.\nfn a() {} // behind a\n// Of b.\nfn b() {}\n\n\
                  // Of neither.\n\n// Of c.\nconst c = 1; const d = 2;\n";
    let linked = |item: &str| {
        let text = format!("import node::m::{{{item}}};\nfn f() {{ _ = {item}; }}");
        link_with(&text, &[("m", module)]).unwrap()
    };
    let head = "// m\n";
    let end = |item: &str| format!("\n// user.wgsl\nfn f() {{ _ = {item}; }}\n");
    let a = "// Of a.\n// More.\nfn a() {} // behind a\n";
    assert_eq!(linked("a").wgsl(), format!("{head}{a}{}", end("a")));
    let b = "// Of b.\nfn b() {}\n";
    assert_eq!(linked("b").wgsl(), format!("{head}{b}{}", end("b")));
    let d = linked("d");
    let d_line = "             const d = 2;\n";
    assert_eq!(d.wgsl(), format!("{head}{d_line}{}", end("d")));
    // Lines and columns are those of the file.
    let start = d.wgsl().find("d = 2").unwrap();
    assert_eq!(place(&d.location(start..start + 1).unwrap()), (12, 20, 1));
}

#[test]
fn the_comment_of_a_file_stays_behind() {
    let linked = link_with(
        "import node::m::{b};\nconst c = b;",
        &[("m", "// Both.\nconst a = 1;\nconst b = 2;\n")],
    );
    assert_eq!(
        linked.unwrap().wgsl(),
        "// m\nconst b = 2;\n\n// user.wgsl\nconst c = b;\n"
    );
}

#[test]
fn a_file_that_nothing_reaches_is_not_linked_but_is_checked() {
    let linked =
        link_user("import moment_shadows::maths::hankel::{hankel_factor};\nfn f() {}\n").unwrap();
    assert_eq!(linked.files().collect::<Vec<_>>(), ["user.wgsl"]);
    assert_eq!(linked.wgsl(), "// user.wgsl\nfn f() {}\n");
    // A name that is defined twice in a module stays so, for the WGSL compiler to refuse.
    let linked = link_with(
        "import node::m::{a};\nconst b = a;",
        &[("m", "const a = 1;\nconst a = 2;\n")],
    );
    assert_eq!(linked.unwrap().wgsl().matches("const a").count(), 2);
}

/// The items of `text` that begin with `start`.
fn items<'a>(text: &'a str, start: &str) -> Vec<&'a str> {
    let names = text.lines().filter_map(|line| line.strip_prefix(start));
    names
        .map(|rest| {
            rest.split(|c: char| !c.is_alphanumeric() && c != '_')
                .next()
                .unwrap()
        })
        .collect()
}

#[test]
fn every_item_of_the_library_is_valid_with_what_it_reaches() {
    let mut count = 0;
    for module in modules() {
        let source = Source {
            name: module.name,
            text: module.source,
        };
        let whole = link(source, &[]).unwrap();
        assert!(
            whole
                .wgsl()
                .ends_with(module.source.rsplit("\n\n").next().unwrap())
        );
        let path = format!("moment_shadows::{}::{}", module.folder, module.name);
        for item in items(module.source, "fn ") {
            // A local variable of its name reaches the item, whatever its parameters are.
            let text = format!("import {path}::{{{item}}};\nfn f() {{ let {item} = 1; }}\n");
            let linked = link_user(&text).unwrap();
            assert!(linked.wgsl().contains(&format!("fn {item}(")), "{item}");
            assert!(
                linked.wgsl().len() <= whole.wgsl().len() + text.len(),
                "{item}"
            );
            let user = Source {
                name: "user.wgsl",
                text: &text,
            };
            let report = validate(user, &ValidationOptions::default());
            assert!(report.is_valid(), "{path}::{item}: {report}");
            count += 1;
        }
    }
    assert!(count > 100, "{count} items");
}
