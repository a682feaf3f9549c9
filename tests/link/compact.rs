//! Text for machines: comments and what nothing reaches are left out, and the rest means the same.

use moment_shadows::{Source, compact, link, modules};

fn compacted(text: &str, roots: &[&str]) -> String {
    compact(
        Source {
            name: "shader",
            text,
        },
        roots,
    )
    .unwrap()
}

#[test]
fn comments_and_unreached_declarations_go() {
    let text = "// A file.\n\nenable f16; // needed\n\n/* a /* b */ */\nconst A = 1; // one\nconst B = A\n    + 2;\n\n\
                override scale: f32; // given\noverride other: f32;\n\n// Not called.\nfn unused() -> i32 { return B; }\n\
                fn used(/* x */ x: i32) -> i32 {\n    // Adds.\n\n    return x /* plus */ + A;\n}\n\
                const_assert A == 1;\n@compute @workgroup_size(1) // small\nfn main() { _ = used(1); }\n\
                @compute @workgroup_size(1) fn second() {}\n";
    let expected = "enable f16;\nconst A = 1;\noverride scale: f32;\n\
                    fn used( x: i32) -> i32 {\n    return x + A;\n}\n\
                    const_assert A == 1;\n@compute @workgroup_size(1)\nfn main() { _ = used(1); }\n";
    assert_eq!(compacted(text, &["main", "scale"]), expected);
    // Again there is nothing to leave out.
    assert_eq!(compacted(expected, &["main", "scale"]), expected);
    // Without a root only what has no name stays, and what it names.
    assert_eq!(
        compacted(text, &[]),
        "enable f16;\nconst A = 1;\nconst_assert A == 1;\n"
    );
}

#[test]
fn tokens_stay_apart() {
    let text = "const A = 1/**/-/**/-1;\nconst B = A/* x\n y */.x;\nfn f()/*a*/{return/*b*/;}\n";
    assert_eq!(
        compacted(text, &["B", "f"]),
        "const A = 1 - -1;\nconst B = A\n .x;\nfn f() {return ;}\n"
    );
}

#[test]
fn what_is_not_linked_is_refused() {
    let source = Source {
        name: "user.wgsl",
        text: "import moment_shadows::maths::hankel::{a};\n",
    };
    let error = compact(source, &[]).unwrap_err();
    assert!(error.message.contains("link it first"), "{error}");
    compact(
        Source {
            name: "user.wgsl",
            text: "/* ",
        },
        &[],
    )
    .unwrap_err();
}

/// Every function of the library on its own: naga reads the same functions out of both texts.
#[test]
fn what_is_left_is_valid_and_the_same() {
    for module in modules() {
        let name = module.name;
        let source = Source {
            name,
            text: module.source,
        };
        let linked = link(source, &[]).unwrap().into_wgsl();
        let whole = naga::front::wgsl::parse_str(&linked).unwrap();
        let names: Vec<&str> = whole
            .functions
            .iter()
            .filter_map(|(_, it)| it.name.as_deref())
            .collect();
        for function in names {
            let text = compacted(&linked, &[function]);
            let read = naga::front::wgsl::parse_str(&text).unwrap();
            let of = |module: &naga::Module| {
                let found = module
                    .functions
                    .iter()
                    .find(|(_, it)| it.name.as_deref() == Some(function));
                let function = found.unwrap().1;
                (
                    function.arguments.len(),
                    function.expressions.len(),
                    function.body.len(),
                )
            };
            assert_eq!(of(&read), of(&whole), "{function}");
            assert!(
                text.len() <= linked.len() && !text.contains("//"),
                "{function}"
            );
        }
    }
}
