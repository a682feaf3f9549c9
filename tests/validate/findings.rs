//! What is said: all faults of a file, each by its rule, in words, with places before linking.

use crate::{core, place, refused, report};
use moment_shadows::{Features, Rule, Source, ValidationOptions, validate};

fn rules(text: &str) -> Vec<(&'static str, u32)> {
    let report = report(text, &ValidationOptions::default());
    let found = report.errors.iter();
    found
        .map(|it| (it.rule.name(), it.places[0].line))
        .collect()
}

#[test]
fn all_faults_of_a_file_are_found_at_once() {
    let text = "@group(0) @binding(0) var t: texture_2d<f32>;\n\
        @group(0) @binding(1) var s: sampler;\n\
        fn one(a: f32) -> f32 { return a + 1u; }\n\
        fn two(a: u32) -> f32 { return unknown(a); }\n\
        fn three(a: u32) -> u32 { return a << 1u | 1u; }\n\
        @fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {\n\
            if uv.x > 0.5 { return textureSample(t, s, uv); }\n\
            return vec4f(0.0);\n\
        }\n\
        @compute @workgroup_size(1024) fn large() {}\n";
    let expected = [
        ("wgsl", 3),
        ("wgsl", 4),
        ("operator", 5),
        ("uniformity", 7),
        ("limit", 10),
    ];
    assert_eq!(rules(text), expected);
    // A fault outside of functions ends the search for those of the compiler.
    assert_eq!(
        rules("struct A { x: nothing }\nfn f() { g(); }\n"),
        [("wgsl", 1)]
    );
}

#[test]
fn uniformity_says_what_it_depends_on() {
    let error = refused(
        "@group(0) @binding(0) var t: texture_2d<f32>;\n\
         @group(0) @binding(1) var s: sampler;\n\
         fn colour(uv: vec2f) -> vec4f {\n\
             return textureSample(t, s, uv);\n\
         }\n\
         @fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {\n\
             var lit = vec4f(0.0);\n\
             if uv.x > 0.5 {\n\
                 lit = colour(uv);\n\
             }\n\
             return lit;\n\
         }\n",
    );
    assert_eq!(error.rule, Rule::Uniformity);
    assert!(
        error
            .message
            .starts_with("`textureSample` must be called by all"),
        "{error}"
    );
    assert!(error.message.contains("textureSampleLevel"), "{error}");
    let places: Vec<_> = error
        .places
        .iter()
        .map(|at| (at.line, at.label.as_str()))
        .collect();
    assert_eq!(
        places,
        [
            (4, ""),
            (9, "called here"),
            (8, "decided by this"),
            (6, "an input, which differs between invocations"),
        ]
    );
}

#[test]
fn a_shader_may_ask_for_a_warning() {
    let text = |filter: &str| {
        format!(
            "{filter}@fragment fn main(@location(0) x: f32) -> @location(0) vec4f {{\n\
             if x > 0.5 {{ return vec4f(dpdx(x)); }}\n\
             return vec4f(x); }}\n"
        )
    };
    let found = |filter: &str| {
        let report = report(&text(filter), &ValidationOptions::default());
        (report.errors.len(), report.warnings.len())
    };
    assert_eq!(found(""), (1, 0));
    assert_eq!(
        found("diagnostic(warning, derivative_uniformity);\n"),
        (0, 1)
    );
    assert_eq!(found("diagnostic(off, derivative_uniformity);\n"), (0, 0));
    assert_eq!(found("@diagnostic(info, derivative_uniformity)\n"), (0, 1));
}

#[test]
fn headlines_name_the_fault_in_the_words_of_the_shader() {
    let fragment = |body: &str| {
        format!(
            "struct Light {{ at: vec3f }}\n\
             fn lit(light: Light, x: f32) -> f32 {{ return x; }}\n\
             @fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {{\n{body}\nreturn vec4f(0.0); }}\n"
        )
    };
    for (body, expected) in [
        (
            "let a = uv + 1u;",
            "`uv + 1u` has no meaning for `uv` of type `vec2<f32>` and `1u` of type `vec2<u32>`",
        ),
        (
            "let a = lit(Light(), uv);",
            "argument 2 of `lit` is `uv`, and has to be of type `f32`",
        ),
        (
            "let a = lit(Light());",
            "`lit` takes 2 arguments, and 1 are given",
        ),
        (
            "if uv.x { return vec4f(); }",
            "the condition `uv.x` is no bool",
        ),
        (
            "return uv;",
            "`uv` is returned, and the function gives `vec4<f32>`",
        ),
        (
            "var a = 1.0; a = uv;",
            "`uv` is assigned to `a`, which is of another type",
        ),
        (
            "let a = select(0.0, 1.0, uv.x);",
            "the condition of `select` is of type `f32`, not bool",
        ),
    ] {
        let error = refused(&fragment(body));
        assert_eq!(error.message, expected);
        assert_eq!(place(&error).1, 4, "{error}");
        assert_eq!(error.rule, Rule::Wgsl);
    }
    // Neither handles nor the types of the compiler.
    for text in [
        fragment("var a = 1.0; a();"),
        fragment("let a = uv[2.0];"),
        fragment("let a = all(uv);"),
        "@vertex fn main() -> @location(0) vec4f { return vec4f(); }".to_owned(),
        "struct A { x: array<f32> }\n@group(0) @binding(0) var<uniform> a: A;".to_owned(),
        "var<private> a: f32 = 1u;".to_owned(),
    ] {
        let error = refused(&text).to_string();
        for word in [
            "Scalar {", "Vector {", "Handle", "[0]", "[1]", "[2]", "[3]", "[4]",
        ] {
            assert!(!error.contains(word), "{error}");
        }
    }
}

#[test]
fn what_naga_lacks_is_said_to_be_no_fault_of_the_shader() {
    for (text, line) in [
        (
            "@fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {\nvar a = vec4f(); a.xy = uv; return a; }",
            2,
        ),
        ("requires unrestricted_pointer_parameters;\nfn f() {}", 1),
        (
            "fn f() {\n@diagnostic(off, derivative_uniformity) if true { } }",
            2,
        ),
        (
            "fn f() {\nloop @diagnostic(off, derivative_uniformity) { break; } }",
            2,
        ),
        (
            "fn f(n: u32) -> u32 {\nloop { if n > 2u { return n; } } }",
            1,
        ),
        (
            "var<workgroup> w: array<u32, 4>;\nfn f(p: ptr<workgroup, array<u32, 4>>) {}",
            2,
        ),
        ("fn f() {\nconst_assert (1u << 5u) == 32u; }", 2),
        // The compiler panics.
        (
            "fn put(at: ptr<function, f32>) { *at = 0.0; }\n\
             @compute @workgroup_size(1) fn main() {\n    var a: array<f32, 4>;\n    put(&a[1]);\n}\n",
            4,
        ),
    ] {
        let error = refused(text);
        assert_eq!(error.rule, Rule::Unsupported, "{error}");
        assert_eq!(place(&error).1, line, "{error}");
        let said = [&error.message].into_iter().chain(&error.notes);
        let said =
            said.filter(|it| it.contains("no fault of the shader") || it.contains("report it to"));
        assert_eq!(said.count(), 1, "{error}");
    }
    // A real fault is none of naga's.
    for text in [
        "fn f(n: u32) -> u32 { if n > 2u { return n; } }",
        "@fragment fn main() -> @location(0) vec4f { var a = vec4f(); a.xx = vec2f(); return a; }",
        "fn f() { let n = 4; var a: array<f32, n>; }",
        "struct A { x: bool }\n@group(0) @binding(0) var<uniform> a: A;",
    ] {
        let error = refused(text);
        assert_eq!(error.rule, Rule::Wgsl, "{text}");
        let excused = |it: &String| it.contains("no fault of the shader");
        assert!(!error.notes.iter().any(excused), "{error}");
    }
}

#[test]
fn external_textures_are_of_the_core() {
    let report = core(
        "@group(0) @binding(0) var t: texture_external;\n@group(0) @binding(1) var s: sampler;\n\
         @fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {\n\
         return textureSampleBaseClampToEdge(t, s, uv); }\n",
    )
    .unwrap();
    let written: Vec<_> = report
        .written()
        .map(moment_shadows::Backend::name)
        .collect();
    assert_eq!(written, ["hlsl", "msl"]);
}

#[test]
fn features_are_allowed_by_name() {
    let half = "enable f16;\nfn f(x: f16) -> f16 { return x * 2h; }\n";
    let error = refused(half);
    assert_eq!(error.rule, Rule::Feature);
    let allowed = |name: &str| ValidationOptions {
        features: name.parse().unwrap(),
        ..ValidationOptions::default()
    };
    assert!(report(half, &allowed("f16")).is_valid());
    assert!(!report(half, &allowed("subgroups")).is_valid());
    let error = "f61".parse::<Features>().unwrap_err().to_string();
    assert!(
        error.contains("`f61`") && error.contains("`f16`"),
        "{error}"
    );
    // What every device has is no feature, and each name is read again.
    for name in Features::names() {
        assert!(name.parse::<Features>().is_ok(), "{name}");
        assert_ne!(name, "cube_array_textures");
    }
}

#[test]
fn own_modules_are_imported_by_their_paths() {
    let lights = Source {
        name: "my_engine::lights",
        text: "import moment_shadows::maths::hankel::{hankel_factor};\nfn lit(x: f32) -> f32 {\n    return x + y;\n}\n",
    };
    let user = Source {
        name: "user.wgsl",
        text: "import my_engine::lights::{lit};\nfn f() -> f32 { return lit(1.0); }\n",
    };
    let options = ValidationOptions {
        modules: &[lights],
        ..ValidationOptions::default()
    };
    let report = validate(user, &options);
    assert_eq!(place(&report.errors[0]), ("my_engine::lights", 3, 16, 1));
    for name in ["my engine::x", "super::x", "a::", "::a"] {
        let module = Source { name, text: "" };
        let options = ValidationOptions {
            modules: &[module],
            ..ValidationOptions::default()
        };
        let report = validate(user, &options);
        assert!(
            report.errors[0].message.contains("is no module's path"),
            "{report}"
        );
    }
}
