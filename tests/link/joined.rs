//! What is joined, in which order, and where lines come from.

use moment_shadows::{Source, link};

use crate::{link_user, link_with};

#[test]
fn joins_the_closure_once_in_dependency_order() {
    let linked = link_user(
        "import moment_shadows::moments::four_moments::{four_moments_from_depth};\n\
         import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity};\n\
         fn shade() { _ = four_moments_from_depth(0.5); _ = hamburger4_shadow_intensity; }\n",
    )
    .unwrap();
    let files: Vec<_> = linked.files().collect();
    let expected = [
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
    assert!(linked.wgsl().contains("\n// user.wgsl\nfn shade() {"));
}

#[test]
fn removed_imports_leave_one_blank_line() {
    let text = "// a\n\nimport node::m::{m};\n\n\n\nconst b = m;\n";
    let linked = link_with(text, &[("m", "\nconst m = 1;\n\n\n")]).unwrap();
    let expected = "// m\nconst m = 1;\n\n// user.wgsl\n// a\n\nconst b = m;\n";
    assert_eq!(linked.wgsl(), expected);
}

#[test]
fn same_input_same_text() {
    let text = "import moment_shadows::bounds::hamburger4::{hamburger4_bounds};\n";
    assert_eq!(link_user(text), link_user(text));
}

#[test]
fn every_line_maps_back() {
    let text = "// A shader.\n\nimport moment_shadows::maths::hankel::{hankel_factor};\n\nenable f16;\n\nfn a() { _ = hankel_factor; }\n";
    let linked = link_user(text).unwrap();
    let mut mapped = 0;
    for (number, line) in (1..).zip(linked.wgsl().lines()) {
        let Some((file, number)) = linked.origin(number) else {
            assert!(
                line.is_empty() || line.starts_with("// "),
                "{number}: {line}"
            );
            continue;
        };
        let file = match file {
            "user.wgsl" => text,
            "moment_shadows/maths/hankel.wgsl" => include_str!("../../wgsl/maths/hankel.wgsl"),
            other => panic!("no such file was linked: {other}"),
        };
        let original = file.lines().nth(number as usize - 1).unwrap();
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
        "import node::specialization::{A};\n enable f16; /* kept */ fn a() { _ = A; }\n",
        &[("specialization", "const A = 1;\n")],
    )
    .unwrap();
    assert_eq!(
        linked.wgsl(),
        " enable f16;\n\n// specialization\nconst A = 1;\n\n// user.wgsl\n             /* kept */ fn a() { _ = A; }\n"
    );
    assert_eq!(linked.origin(1).unwrap().1, 2);
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
    assert_eq!(linked.origin(last).unwrap().1, 5);
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
            "moment_shadows/moments/four_moments.wgsl",
            "specialization",
            "user.wgsl"
        ]
    );
}

#[test]
fn a_long_chain_of_modules_needs_no_deep_stack() {
    let texts: Vec<_> = (0..2_000)
        .map(|i| {
            let next = i + 1;
            (
                format!("m{i}"),
                format!("import node::m{next}::{{c{next}}};\nconst c{i} = c{next};"),
            )
        })
        .collect();
    let mut generated: Vec<_> = texts
        .iter()
        .map(|(name, text)| (name.as_str(), text.as_str()))
        .collect();
    generated.push(("m2000", "const c2000 = 1;"));
    let linked = link_with("import node::m0::{c0};\nconst c = c0;", &generated).unwrap();
    assert_eq!(linked.files().len(), 2_002);
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
