//! Validation: each kind of error with its place before linking, the profiles, and what each backend makes of a shader.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod findings;
mod glsl;
mod limits;
mod nested;
mod operators;
mod pairs;
mod uniformity;

use moment_shadows::{
    Backend, Profile, ShaderError, Source, TextureFormat, ValidationOptions, ValidationReport,
    validate,
};

/// All that is found in a shader.
fn report(text: &str, options: &ValidationOptions<'_>) -> ValidationReport {
    let source = Source {
        name: "user.wgsl",
        text,
    };
    validate(source, options)
}

/// The report of a valid shader, or the first error.
fn validate_user(text: &str, profile: Profile) -> Result<ValidationReport, ShaderError> {
    let options = ValidationOptions {
        profile,
        ..ValidationOptions::default()
    };
    first(report(text, &options))
}

fn first(report: ValidationReport) -> Result<ValidationReport, ShaderError> {
    match report.errors.first() {
        Some(error) => Err(error.clone()),
        None => Ok(report),
    }
}

fn core(text: &str) -> Result<ValidationReport, ShaderError> {
    validate_user(text, Profile::WebgpuCore)
}

/// File, line, column and width of the first place.
fn place(error: &ShaderError) -> (&str, u32, u32, u32) {
    let at = error.places.first().expect("a place");
    (&at.file, at.line, at.column, at.width)
}

fn refused(text: &str) -> ShaderError {
    core(text).unwrap_err()
}

/// The reason why `backend` cannot express the shader; none if it was written.
fn reason(report: &ValidationReport, backend: Backend) -> Option<&str> {
    let found = report.outcomes.iter().find(|(of, _)| *of == backend);
    let (_, outcome) = found.expect("an outcome for each backend");
    outcome.as_ref().err().map(String::as_str)
}

/// A compute shader with one storage texture.
fn storing(format: &str, access: &str) -> String {
    let value = match format {
        f if f.ends_with("uint") => "vec4u(0)",
        f if f.ends_with("sint") => "vec4i(0)",
        _ => "vec4f(0.0)",
    };
    let body = match access {
        "read" => "_ = textureLoad(map, vec2u(0));".to_owned(),
        _ => format!("textureStore(map, vec2u(0), {value});"),
    };
    format!(
        "import moment_shadows::maths::hankel::{{hankel_factor}};\n\n\
         @group(0) @binding(0) var map: texture_storage_2d<{format}, {access}>;\n\
         @compute @workgroup_size(1) fn main() {{ {body} }}\n"
    )
}

#[test]
fn a_users_shader_is_written_for_every_backend() {
    let report = core(
        "import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity};\n\
         import moment_shadows::moments::four_moments::{FourMomentsBias};\n\
         @group(0) @binding(0) var map: texture_2d<f32>;\n\
         @group(0) @binding(1) var map_sampler: sampler;\n\
         @fragment fn main(@location(0) uv: vec2f) -> @location(0) vec4f {\n\
             let moments = textureSampleLevel(map, map_sampler, uv, 0.0);\n\
             return vec4f(hamburger4_shadow_intensity(moments, 0.0, FourMomentsBias(1e-3, 0.6, 0.6)));\n\
         }\n",
    )
    .unwrap();
    assert_eq!(report.written().collect::<Vec<_>>(), Backend::ALL);
}

#[test]
fn parse_errors_point_at_the_line_before_linking() {
    let import = "import moment_shadows::maths::hankel::{hankel_factor};\n";
    let diagnostic = refused(&format!(
        "{import}\r\nfn f() -> f32 {{\r\n\treturn 1.0 + ;\r\n}}\r\n"
    ));
    assert_eq!(place(&diagnostic), ("user.wgsl", 4, 15, 1));
    assert_eq!(
        diagnostic.to_string(),
        "expected expression, found \";\"\n --> user.wgsl:4:15\n  |\n4 | \treturn 1.0 + ;\n  | \
         \t             ^ expected expression"
    );

    let diagnostic = refused(&format!(
        "{import}fn f() -> f32 {{\n    return foo(1.0);\n}}\n"
    ));
    assert_eq!(place(&diagnostic), ("user.wgsl", 3, 12, 3));
    assert!(diagnostic.message.contains("`foo`"), "{diagnostic}");

    // Columns count characters, as editors do.
    let diagnostic = refused("/* é */ fn f() { g(); }");
    assert_eq!(place(&diagnostic), ("user.wgsl", 1, 18, 1));
}

#[test]
fn several_labels_are_all_mapped_back() {
    let diagnostic = refused(
        "import moment_shadows::maths::hankel::{hankel_factor};\nfn f() {}\n\n  fn f() {}\n",
    );
    let places: Vec<_> = diagnostic
        .places
        .iter()
        .map(|label| (label.line, label.column))
        .collect();
    assert_eq!(places, [(4, 6), (2, 4)]);
    assert_eq!(diagnostic.places[1].label, "previous definition of `f`");
}

#[test]
fn errors_in_generated_modules_name_them() {
    let generated = Source {
        name: "specialization",
        text: "// Made by a node.\nalias A = nothing;\n",
    };
    let source = Source {
        name: "user.wgsl",
        text: "import node::specialization::{A};\nfn f(a: A) {}\n",
    };
    let options = ValidationOptions {
        modules: &[generated],
        ..ValidationOptions::default()
    };
    let error = first(validate(source, &options)).unwrap_err();
    assert_eq!(place(&error), ("specialization", 2, 11, 7));
}

#[test]
fn invalid_shaders_point_at_the_innermost_place() {
    let diagnostic = refused(
        "import moment_shadows::maths::hankel::{hankel_factor};\nfn f() -> f32 {\n    return 1u;\n}\n",
    );
    assert_eq!(place(&diagnostic), ("user.wgsl", 3, 12, 2));
    assert_eq!(
        diagnostic.message,
        "`1u` is returned, and the function gives `f32`"
    );

    let diagnostic = refused("\n@fragment fn shade() { workgroupBarrier(); }\n");
    assert_eq!(place(&diagnostic), ("user.wgsl", 2, 24, 16));
    assert_eq!(
        diagnostic.message,
        "entry point `shade` uses a barrier, which its stage does not have"
    );
}

#[test]
fn what_the_core_lacks_is_refused_where_it_stands() {
    let enable = "import moment_shadows::maths::hankel::{hankel_factor};\nenable f16;\nfn f() {}\n";
    assert_eq!(place(&refused(enable)), ("user.wgsl", 2, 8, 3));
    let subgroups = "enable subgroups;\nfn f() {}\n";
    assert_eq!(place(&refused(subgroups)), ("user.wgsl", 1, 8, 9));

    let subgroup_add = "@compute @workgroup_size(1) fn f() {\n    let x = subgroupAdd(1u);\n}\n";
    let diagnostic = refused(subgroup_add);
    assert_eq!(place(&diagnostic), ("user.wgsl", 2, 13, 11));
    assert!(diagnostic.message.contains("`subgroups`"), "{diagnostic}");
    assert_eq!(place(&refused("fn f(x: f64) {}")), ("user.wgsl", 1, 9, 3));

    // Part of the core: 16-bit floats packed in 32 bits, sample shading, arrays of cubes.
    for text in [
        "fn f(x: vec2f) -> vec2f { return unpack2x16float(pack2x16float(x)); }",
        "@fragment fn f(@builtin(sample_index) i: u32) -> @location(0) vec4f { return vec4f(f32(i)); }",
        "fn f(t: texture_depth_cube_array, s: sampler_comparison) -> f32 {\n\
             return textureSampleCompareLevel(t, s, vec3f(1.0), 0, 0.5);\n}",
    ] {
        core(text).unwrap_or_else(|error| panic!("{error}"));
    }
}

#[test]
fn storage_formats_follow_the_profile() {
    use Profile::{Native, NativeAdapter, WebgpuCore};
    let cases = [
        ("rgba8unorm", "write", Some(WebgpuCore)),
        ("rgba16float", "read", Some(WebgpuCore)),
        ("rgba16float", "write", Some(WebgpuCore)),
        ("rgba16float", "read_write", Some(NativeAdapter)),
        ("rg32float", "write", Some(WebgpuCore)),
        ("rgba32float", "write", Some(WebgpuCore)),
        ("r32float", "read_write", Some(WebgpuCore)),
        ("r32uint", "read_write", Some(WebgpuCore)),
        ("rgba16unorm", "write", Some(Native)),
        ("rgba16unorm", "read_write", Some(NativeAdapter)),
        ("rg16snorm", "read", Some(Native)),
        ("r16unorm", "write", Some(Native)),
        ("rgb10a2unorm", "write", Some(NativeAdapter)),
        ("rg16float", "write", Some(NativeAdapter)),
        ("r16float", "write", Some(NativeAdapter)),
        ("r8unorm", "write", Some(NativeAdapter)),
        ("bgra8unorm", "write", Some(NativeAdapter)),
        ("rg11b10ufloat", "write", Some(NativeAdapter)),
    ];
    let mut failures = Vec::new();
    for (format, access, least) in cases {
        let mut accepted = None;
        for profile in Profile::ALL.into_iter().rev() {
            match validate_user(&storing(format, access), profile) {
                Ok(_) => accepted = Some(profile),
                Err(diagnostic) if diagnostic.message.contains("storage texture") => {
                    let width = u32::try_from(format.len()).unwrap();
                    assert_eq!(place(&diagnostic), ("user.wgsl", 3, 51, width), "{format}");
                    assert!(
                        diagnostic.message.contains(&format!("`{format}`")),
                        "{diagnostic}"
                    );
                    assert!(diagnostic.message.contains(profile.name()), "{diagnostic}");
                }
                Err(other) => failures.push(format!("{format} {access} under {profile}: {other}")),
            }
        }
        if accepted != least {
            failures.push(format!(
                "{format} {access}: accepted from {accepted:?}, not {least:?}"
            ));
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

#[test]
fn the_table_of_formats_says_the_same() {
    let colour = TextureFormat::ALL
        .into_iter()
        .filter(|format| !format.is_depth());
    for format in colour {
        // `native-adapter` adds what one adapter can do, which no table knows.
        for profile in [Profile::WebgpuCore, Profile::Native] {
            let valid = validate_user(&storing(format.name(), "write"), profile).is_ok();
            let expected = format.support(profile).storage_write;
            assert_eq!(valid, expected, "{format} under {profile}");
        }
    }
}

#[test]
fn every_use_of_a_refused_format_is_shown() {
    let text = "alias A = texture_storage_2d<rgb10a2unorm, write>;\n\
                @group(0) @binding(0) var a: A;\n\
                // texture_storage_2d<rgb10a2unorm, write>\n\
                @group(0) @binding(1) var b: texture_storage_2d<rgb10a2unorm, write>;\n\
                @group(0) @binding(2) var c: texture_storage_2d<rgba8unorm, write>;\n";
    let error = refused(text);
    let lines: Vec<_> = error.places.iter().map(|place| place.line).collect();
    assert_eq!(lines, [1, 4]);
    assert!(error.notes[0].contains("native-adapter"), "{error}");
}

#[test]
fn glsl_says_what_it_cannot_express() {
    let report = core("@compute @workgroup_size(1) fn go() {}\n").unwrap();
    assert_eq!(reason(&report, Backend::Glsl450), None);
    let es = reason(&report, Backend::GlslEs300).unwrap();
    assert!(es.contains("`go`") && es.contains("COMPUTE_SHADER"), "{es}");

    // Only written because the function is called: GLSL leaves out what no entry point reaches.
    let report =
        core("fn f(t: texture_depth_2d) -> f32 { return textureLoad(t, vec2u(0), 0); }").unwrap();
    for backend in [Backend::SpirV, Backend::Hlsl, Backend::Msl] {
        assert_eq!(reason(&report, backend), None, "{backend}");
    }
    assert!(
        reason(&report, Backend::Glsl450)
            .unwrap()
            .contains("textureLoad")
    );
}

#[test]
fn functions_without_entry_point_are_called_with_arguments_of_every_kind() {
    let report = core(
        "struct Parameters { size: vec2u, weights: array<f32, 4>, matrix: mat4x4f }\n\
         fn all(p: Parameters, map: texture_2d_array<f32>, s: sampler, sum: ptr<function, vec4f>) -> f32 {\n\
             *sum += textureSampleLevel(map, s, vec2f(p.size), 0, 0.0) * p.weights[1];\n\
             return dpdx(p.matrix[0].x);\n\
         }\n\
         fn nothing() {}\n",
    )
    .unwrap();
    assert_eq!(report.written().collect::<Vec<_>>(), Backend::ALL);

    // Barriers are for compute shaders, which GLSL ES 300 does not have.
    let report = core("fn wait() { workgroupBarrier(); }").unwrap();
    assert_eq!(reason(&report, Backend::Glsl450), None);
    assert!(
        reason(&report, Backend::GlslEs300)
            .unwrap()
            .contains("COMPUTE_SHADER")
    );

    let report = core("fn f(counter: ptr<private, u32>) { *counter += 1; }").unwrap();
    let why = reason(&report, Backend::Glsl450).unwrap();
    assert!(why.contains("`counter`") && why.contains("`f`"), "{why}");
}

#[test]
fn overrides_are_tried_with_several_values() {
    let dividing = |expression: &str| {
        format!(
            "override STEPS: i32;\noverride SCALE: i32 = {expression};\n\
             @fragment fn main() -> @location(0) vec4f {{ return vec4f(f32(SCALE)); }}\n"
        )
    };
    for expression in [
        "8 / STEPS",
        "8 / (STEPS - 1)",
        "8 / ((STEPS - 1) * (STEPS - 2))",
    ] {
        core(&dividing(expression)).unwrap();
    }
    let error = refused(&dividing("8 / (STEPS - STEPS)"));
    assert!(
        error.message.contains("`STEPS`") && error.message.contains("without a default"),
        "{error}"
    );
}

#[test]
fn other_dialects_are_told_by_name() {
    let fragment = "@fragment fn main() -> @location(0) vec4f { return vec4f(1.0); }\n";
    for (line, expected, width) in [
        (
            "#import bevy_pbr::forward_io::VertexOutput",
            "a preprocessor's: that of naga_oil",
            7,
        ),
        (
            "#define_import_path my::module",
            "a preprocessor's: that of naga_oil",
            19,
        ),
        ("#ifdef SHADOWS", "preprocessor", 6),
        ("  #include \"common.wgsl\"", "includes no files", 8),
        ("#pragma once", "another language", 7),
    ] {
        let error = refused(&format!(
            "// a comment with #import in it\n{line}\n{fragment}"
        ));
        assert!(error.message.contains(expected), "{error}");
        let (_, at, _, found) = place(&error);
        assert_eq!((at, found), (2, width), "{error}");
    }
    core(&format!("/* #ifdef */ {fragment}")).unwrap();
}

#[test]
fn overrides_without_default_have_a_value() {
    let report = core(
        "override group_size: u32;\n@id(7) override scaled: bool;\noverride scale = 2.0;\n\
         @compute @workgroup_size(group_size) fn main() { var x = scale; if scaled { x += 1.0; } }\n",
    )
    .unwrap();
    assert_eq!(reason(&report, Backend::SpirV), None);
    assert_eq!(reason(&report, Backend::Glsl450), None);
}

#[test]
fn link_errors_come_through() {
    let error = refused("import moment_shadows::maths::hankle::{hankel_factor};\n");
    assert!(error.message.starts_with("there is no module"), "{error}");
    let source = Source {
        name: "m.wgsl",
        text: "import super::super::maths::hankel::{hankel};\n",
    };
    let error = first(validate(source, &ValidationOptions::default())).unwrap_err();
    assert!(
        error.message.contains("does not define `hankel`"),
        "{error}"
    );
}

#[test]
fn a_text_that_is_too_long_is_refused() {
    let bytes = ValidationReport::LONGEST_SHADER + 1;
    let error = refused(&" ".repeat(bytes)).to_string();
    assert!(error.contains(&format!("has {bytes} bytes")), "{error}");
    assert!(error.ends_with(" --> user.wgsl"), "{error}");
}

#[test]
fn long_chains_are_validated() {
    // The compiler recurses over the first two, and a usual stack of 2 MiB overflows.
    core(&format!(
        "fn f(x: f32) -> f32 {{ return x{}; }}",
        "+x".repeat(5_000)
    ))
    .unwrap();
    core(&format!(
        "fn f() {{ {} {{}} }}",
        "if true {} else ".repeat(2_000)
    ))
    .unwrap();
    let constants: String = (0..2_000).map(|i| format!("const c{i} = 1;\n")).collect();
    core(&constants).unwrap();
    // naga refuses deep brackets by itself.
    refused(&format!(
        "fn f() -> f32 {{ return {}1.0{}; }}",
        "(".repeat(900),
        ")".repeat(900)
    ));
}

#[test]
fn large_values_are_validated() {
    core("const c0 = 1; const c1 = c0 + c0; const c2 = c1 + c1; fn f() -> i32 { return c2; }")
        .unwrap();
    core("fn f() -> u32 { var a: array<u32, 16384>; return a[3]; }").unwrap();
    core("@group(0) @binding(0) var<storage> b: array<vec4f, 10000000>; fn f(i: u32) -> f32 { return b[i].x; }").unwrap();
}
