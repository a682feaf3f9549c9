//! The forms of imports: what is read, what is refused and where.

use moment_shadows::{Source, link};

use crate::{link_user, link_with, place, refused};

const FORM: &str =
    "; write `import moment_shadows::folder::file::{item, item};`, with nothing else on its lines";

/// The place of an import of the wrong form, and the reason.
fn wrong_form(text: &str) -> ((u32, u32, u32), String) {
    let (message, at) = refused(link_user(text));
    assert_eq!(at.file, "user.wgsl");
    assert_eq!(at.text, text.lines().nth(at.line as usize - 1).unwrap());
    let reason = message.strip_suffix(FORM).expect(&message);
    (place(&at), reason.to_owned())
}

#[test]
fn an_import_may_take_several_lines() {
    let text = "// A shader.\n\nimport moment_shadows::maths // where\n  ::hankel::{\n    HankelFactor, /* the\n    type */\n    \
                hankel_factor,\n}; // end\nimport node::a::{\r\n\ta\r\n};\n\nconst b = a;\nfn f(f: HankelFactor) {}\n";
    let linked = link_with(text, &[("a", "const a = 1;\n")]).unwrap();
    let end = "\n// user.wgsl\n// A shader.\n\nconst b = a;\nfn f(f: HankelFactor) {}\n";
    assert!(linked.wgsl().ends_with(end), "{}", linked.wgsl());
    let lines = u32::try_from(linked.wgsl().lines().count()).unwrap();
    assert_eq!(linked.origin(lines - 1).unwrap().1, 13);
    assert_eq!(linked.origin(lines).unwrap().1, 14);
    let at = linked.location(linked.wgsl().rfind("HankelFactor").unwrap()..linked.wgsl().len());
    assert_eq!(place(&at.unwrap()), (14, 9, 16));

    // Errors after it, and within it, stand where they stand.
    let text = "import moment_shadows::maths::hankel::{\n  HankelFactor,\n  hankel_facto,\n};\n";
    let (message, at) = refused(link_user(text));
    assert!(
        message.contains("does not define `hankel_facto`"),
        "{message}"
    );
    assert_eq!(place(&at), (3, 3, 12));
    let text = "import moment_shadows::maths::hankel::{\n  HankelFactor,\n};\nimport\nmoment_shadows::maths::hankel::{HankelFactor};";
    let (message, at) = refused(link_user(text));
    assert!(message.contains("imported already in line 1"), "{message}");
    assert_eq!(place(&at), (5, 33, 12));
}

#[test]
fn a_module_of_the_library_imports_its_siblings() {
    let text =
        "import super::super::maths::hankel::{hankel_factor};\nfn mine() { _ = hankel_factor; }\n";
    let source = Source {
        name: "mine.wgsl",
        text,
    };
    let linked = link(source, &[]).unwrap();
    assert_eq!(
        linked.files().collect::<Vec<_>>(),
        ["moment_shadows/maths/hankel.wgsl", "mine.wgsl"]
    );

    // A folder's own files are imported from the root too: one form is enough.
    let short = "import super::hankel::{hankel_factor};\n";
    let mixed = "import super::super::maths::hankel::{hankel_factor};\nimport moment_shadows::maths::angle::{angle_wrapped};\n";
    for text in [short, mixed] {
        let (message, _) = refused(link(Source { text, ..source }, &[]));
        let expected = "within the library an import starts with `super::super::`; \
                        write `import super::super::folder::file::{item, item};`";
        assert!(message.starts_with(expected), "{message}");
    }
}

#[test]
fn refuses_other_forms_of_import() {
    let outside = "outside the library an import starts with `moment_shadows::`, `node::`, or the name of a project's own modules";
    let braces = "items are imported in braces, or one by its name";
    let plain = "items are plain names with commas between them (no `as`, no path)";
    let after = "something stands after the import";
    let cases = [
        (
            "import moment_shadows::maths::hankel::{a};\nimport super::super::maths::hankel::{b};",
            (2, 8, 5),
            outside,
        ),
        (
            "\nimport self::hankel::{hankel_factor};",
            (2, 8, 4),
            outside,
        ),
        (
            "import moment_shadows::hankel;",
            (1, 24, 6),
            "the item's name is missing",
        ),
        (
            "import moment_shadows::maths::hankel as h;",
            (1, 31, 6),
            "`;` is missing",
        ),
        (
            "import moment_shadows::maths::hankel::*;",
            (1, 39, 1),
            braces,
        ),
        (
            "import moment_shadows::{hankel};",
            (1, 24, 1),
            "the module's name is missing",
        ),
        ("import node;", (1, 12, 1), "`::` is missing"),
        (
            "import moment_shadows::maths::hankel::{};",
            (1, 40, 1),
            "an item's name is missing",
        ),
        (
            "import moment_shadows::maths::hankel::{a,,};",
            (1, 42, 1),
            "an item's name is missing",
        ),
        (
            "import moment_shadows::maths::hankel::{hankel_factor as f};",
            (1, 54, 2),
            plain,
        ),
        (
            "import moment_shadows::maths::hankel::{a::b};",
            (1, 41, 2),
            plain,
        ),
        (
            "import moment_shadows::maths::hankel::{\n  a\n  b\n};",
            (3, 3, 1),
            plain,
        ),
        (
            "import moment_shadows::maths::hankel::{a}",
            (1, 41, 1),
            "`;` is missing",
        ),
        (
            "import moment_shadows::maths::hankel::{a,\n}\nfn f() {}",
            (2, 1, 1),
            "`;` is missing",
        ),
        ("import", (1, 1, 6), outside),
        (
            "/* a */ import moment_shadows::maths::hankel::{a};",
            (1, 9, 6),
            "something stands before the import",
        ),
        (
            "import moment_shadows::maths::hankel::{a}; fn f() {}",
            (1, 42, 1),
            after,
        ),
        (
            "import moment_shadows::maths::hankel::{\na}; fn f() {}",
            (2, 3, 1),
            after,
        ),
        (
            "import moment_shadows::maths::hankel::{a}; // b\u{2028}fn f() {}",
            (1, 42, 1),
            after,
        ),
        (
            "import moment_shadows::maths::hankel::{a}; /* a\n*/",
            (1, 42, 1),
            after,
        ),
    ];
    for (text, at, reason) in cases {
        assert_eq!(wrong_form(text), (at, reason.to_owned()), "{text}");
    }
}

#[test]
fn one_item_needs_no_braces() {
    let text =
        "import moment_shadows::maths::hankel::hankel_factor;\nfn f() { _ = hankel_factor; }\n";
    let braces = text.replace("hankel_factor;\nfn", "{hankel_factor};\nfn");
    assert_eq!(link_user(text), link_user(&braces));

    let (message, at) = refused(link_user("import moment_shadows::maths::hankel;"));
    assert_eq!(
        message,
        "`moment_shadows::maths::hankel` is a module, of which items are imported; \
         write `import moment_shadows::maths::hankel::{item, item};`"
    );
    assert_eq!(place(&at), (1, 31, 6));

    let inside = "import super::super::maths::hankel::hankel_factor;\n";
    let (message, _) = refused(link_user(inside));
    assert!(
        message.starts_with("items are imported in braces;"),
        "{message}"
    );
}

#[test]
fn own_modules_import_each_other_from_where_they_lie() {
    let modules = [
        (
            "my_engine::sky::sun",
            "import package::light::SUN;\nimport super::moon::{MOON};\nconst BOTH = SUN + MOON;\n",
        ),
        (
            "my_engine::sky::moon",
            "import super::super::light::{DIM};\nconst MOON = DIM;\n",
        ),
        ("my_engine::light", "const SUN = 1;\nconst DIM = 2;\n"),
    ];
    let text = "import my_engine::sky::sun::BOTH;\nconst c = BOTH;\n";
    let linked = link_with(text, &modules).unwrap();
    let files: Vec<_> = linked.files().collect();
    let expected = [
        "my_engine::light",
        "my_engine::sky::moon",
        "my_engine::sky::sun",
        "user.wgsl",
    ];
    assert_eq!(files, expected);

    // In a shader that is no module `package` is a name as any other.
    let text = "import package::light::SUN;\nconst c = SUN;\n";
    let (message, at) = refused(link_with(text, &modules));
    assert!(
        message
            .starts_with("there is no module `package::light`; the nearest are `my_engine::light`"),
        "{message}"
    );
    assert_eq!(place(&at), (1, 8, 14));
    link_with(text, &[("package::light", "const SUN = 1;\n")]).unwrap();

    let above = [("my_engine::light", "import super::super::x::{a};\n")];
    let (message, at) = refused(link_with("import my_engine::light::{b};\n", &above));
    assert!(
        message.starts_with("there is nothing above the root of the modules"),
        "{message}"
    );
    assert_eq!(place(&at), (1, 15, 5));
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
        let (message, at) = refused(link_user(text));
        let sentence = match line {
            0 => "conditional translation (`@if`) is not supported".to_owned(),
            _ => format!("imports come first; move this one above line {line}"),
        };
        assert!(message.starts_with(&sentence), "{message}");
        assert_eq!(place(&at), expected);
    }
}

#[test]
fn refuses_paths_conditions_and_public_in_code() {
    for (text, start, expected) in [
        (
            "fn f() {\n\tlet a = super::hankel::hankel_factor();\n}",
            "paths within code",
            (2, 15, 2),
        ),
        (
            "@else fn f() {}",
            "conditional translation (`@else`)",
            (1, 2, 4),
        ),
        (
            "public import moment_shadows::maths::hankel::{hankel_factor};",
            "`public` is not supported",
            (1, 1, 6),
        ),
    ] {
        let (message, at) = refused(link_user(text));
        assert!(message.starts_with(start), "{message}");
        assert_eq!(place(&at), expected);
    }
    // A plain `if` is not an attribute.
    link_user("fn f() { if true { return; } else { return; } }").unwrap();
}

#[test]
fn refuses_comments_without_end() {
    let (message, at) = refused(link_user("fn f() {}\n /* /* */"));
    assert!(
        message.starts_with("this comment does not end"),
        "{message}"
    );
    assert_eq!(place(&at), (2, 2, 2));
}

#[test]
fn errors_show_the_line_with_carets() {
    let text = "// é\nimport\tmoment_shadows::maths::hankel::{hankel_facto};";
    let shown = link_user(text).unwrap_err().to_string();
    let indent = " ".repeat(32);
    let expected = format!(
        " --> user.wgsl:2:40\n  |\n2 | {}\n  |       \t{indent}^^^^^^^^^^^^",
        "import\tmoment_shadows::maths::hankel::{hankel_facto};"
    );
    assert!(shown.ends_with(&expected), "{shown}");
    let start = "module `moment_shadows::maths::hankel` does not define `hankel_facto`; the nearest names are";
    assert!(shown.starts_with(start), "{shown}");
}
