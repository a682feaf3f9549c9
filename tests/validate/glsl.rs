//! What naga writes and compilers of GLSL refuse: `./run check` gives the texts that are called good to glslang.

use moment_shadows::Backend;

use crate::{core, reason};

fn fragment(declarations: &str, inputs: &str, value: &str) -> String {
    format!(
        "{declarations}@fragment fn main({inputs}) -> @location(0) vec4f {{ return {value}; }}\n"
    )
}

#[test]
fn what_es_300_lacks_is_named() {
    let texture =
        "@group(0) @binding(0) var t: texture_2d<f32>;\n@group(0) @binding(1) var s: sampler;\n";
    let uv = "@location(0) uv: vec2f";
    for (text, word) in [
        (
            fragment(
                "",
                "@location(0) @interpolate(flat) i: vec2i",
                "vec4f(vec2f(select(i, -i, i < vec2i(0))), 0.0, 0.0)",
            ),
            "`select`",
        ),
        (
            fragment(texture, uv, "textureGather(0, t, s, uv)"),
            "gathers",
        ),
        (
            fragment("", "@builtin(sample_index) i: u32", "vec4f(f32(i))"),
            "sample_index",
        ),
    ] {
        let report = core(&text).unwrap();
        assert_eq!(reason(&report, Backend::Glsl450), None, "{word}");
        let why = reason(&report, Backend::GlslEs300).expect(word);
        assert!(why.contains(word) && why.contains("`main`"), "{why}");
    }
    // What it has stays good.
    for (declarations, value) in [
        ("", "select(vec4f(0.0), vec4f(1.0), uv.xyxy < vec4f(0.5))"),
        ("", "vec4f(f32(select(1, 2, uv.x < 0.5)))"),
        (texture, "textureSampleLevel(t, s, uv, 0.0)"),
    ] {
        let report = core(&fragment(declarations, uv, value)).unwrap();
        assert_eq!(reason(&report, Backend::GlslEs300), None, "{value}");
    }
}

#[test]
fn functions_that_es_300_lacks_are_named() {
    for (name, arguments) in [
        ("countOneBits", "i"),
        ("countTrailingZeros", "i"),
        ("dot4I8Packed", "i, i"),
        ("dot4U8Packed", "i, i"),
        ("extractBits", "i, 1u, 2u"),
        ("firstLeadingBit", "i"),
        ("firstTrailingBit", "i"),
        ("insertBits", "i, i, 1u, 2u"),
        ("ldexp", "1.5, i32(i)"),
        ("reverseBits", "i"),
        ("unpack4xI8", "i"),
        ("unpack4xU8", "i"),
    ] {
        let made = if name.starts_with("unpack") {
            "vec4f"
        } else {
            "f32"
        };
        let text = fragment(
            "",
            "@location(0) @interpolate(flat) i: u32",
            &format!("vec4f({made}({name}({arguments})))"),
        );
        let report = core(&text).unwrap();
        assert_eq!(reason(&report, Backend::Glsl450), None, "{name}");
        let why = reason(&report, Backend::GlslEs300).expect(name);
        assert!(why.contains(&format!("calls `{name}`")), "{why}");
    }
}

#[test]
fn what_naga_writes_wrongly_is_named() {
    let depth =
        "@group(0) @binding(0) var t: texture_depth_2d;\n@group(0) @binding(1) var s: sampler;\n";
    let uv = "@location(0) uv: vec2f";
    for (text, word) in [
        (
            fragment(depth, uv, "vec4f(textureSample(t, s, uv))"),
            "depth",
        ),
        (fragment(depth, uv, "textureGather(t, s, uv)"), "depth"),
        (
            fragment("", "@builtin(sample_mask) m: u32", "vec4f(f32(m))"),
            "sample_mask",
        ),
    ] {
        let report = core(&text).unwrap();
        for backend in [Backend::SpirV, Backend::Hlsl, Backend::Msl] {
            assert_eq!(reason(&report, backend), None, "{word}");
        }
        let why = reason(&report, Backend::Glsl450).expect(word);
        assert!(why.contains(word), "{why}");
    }
}

#[test]
fn depth_at_level_zero_is_compared_in_all_but_arrays_of_cubes() {
    for (of, at, taken) in [
        ("2d", "uv", true),
        ("2d_array", "uv, 1", true),
        ("cube", "uv.xyx", true),
        ("cube_array", "uv.xyx, 1", false),
    ] {
        let declarations = format!(
            "@group(0) @binding(0) var t: texture_depth_{of};\n@group(0) @binding(1) var s: sampler_comparison;\n"
        );
        let value = format!("vec4f(textureSampleCompareLevel(t, s, {at}, 0.5))");
        let report = core(&fragment(&declarations, "@location(0) uv: vec2f", &value)).unwrap();
        let why = reason(&report, Backend::Glsl450);
        assert_eq!(why.is_none(), taken, "{of}: {why:?}");
    }
}

/// GLSL ES 3.00 has no `textureOffset` of a `sampler2DArrayShadow`, and its `textureGradOffset`, which level zero becomes.
#[test]
fn depth_of_layers_is_compared_beside_an_offset_at_level_zero_only() {
    let declarations = "@group(0) @binding(0) var t: texture_depth_2d_array;\n@group(0) @binding(1) var s: sampler_comparison;\n";
    for (function, taken) in [
        ("textureSampleCompare", false),
        ("textureSampleCompareLevel", true),
    ] {
        let value = format!("vec4f({function}(t, s, uv, 1, 0.5, vec2i(1, 2)))");
        let report = core(&fragment(declarations, "@location(0) uv: vec2f", &value)).unwrap();
        assert_eq!(reason(&report, Backend::Glsl450), None, "{function}");
        let why = reason(&report, Backend::GlslEs300);
        assert_eq!(why.is_none(), taken, "{function}: {why:?}");
    }
}

#[test]
fn each_entry_point_is_written_without_what_none_needs() {
    let report = core(
        "fn signs(i: vec2i) -> vec2i { return select(i, -i, i < vec2i(0)); }\n\
         @vertex fn place() -> @builtin(position) vec4f { return vec4f(1.0); }\n\
         @fragment fn main() -> @location(0) vec4f { return vec4f(1.0); }\n",
    )
    .unwrap();
    assert_eq!(reason(&report, Backend::GlslEs300), None);
}
