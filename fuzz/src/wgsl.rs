//! Shaders given to `validate`: a user's own, modules of the library, and generated modules that import each other.

use std::sync::LazyLock;

use moment_shadows::{Profile, Source, modules, validate, validate_module};

use crate::text::mutate_bytes;
use crate::{Random, Target};

/// WGSL texts.
pub const TARGET: Target = Target {
    name: "wgsl",
    seeds,
    mutate,
    try_out,
};

/// What separates a shader from the generated modules after it, each named by the rest of the line.
const SEPARATOR: &str = "//# ";

const SHADERS: [&str; 5] = [
    include_str!("../../examples/forward_shading.wgsl"),
    include_str!("../../examples/lab/src/host/shade.wgsl"),
    include_str!("../../examples/lab/src/host/geometry.wgsl"),
    "import moment_shadows::maths::hankel::{hankel_factor};
import node::weights::{WEIGHTS, weight_of};

override FACTOR: f32 = 2.0;
struct Parameters { size: vec2u, scale: array<vec4f, 4>, }
@group(0) @binding(0) var<uniform> parameters: Parameters;
@group(0) @binding(1) var map: texture_storage_2d<rgba16float, write>;
@group(0) @binding(2) var<storage, read_write> counts: array<atomic<u32>>;
var<workgroup> shared_sums: array<vec4f, 64>;

@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3u, @builtin(local_invocation_index) local: u32) {
    var sum = vec4f(0.0);
    for (var i = 0u; i < WEIGHTS; i += 1u) {
        if i % 2u == 0u { sum += weight_of(i) * parameters.scale[i % 4u]; } else if i > 7u { break; } else { continue; }
    }
    shared_sums[local] = sum * FACTOR;
    workgroupBarrier();
    switch local { case 0u, 1u: { atomicAdd(&counts[0], 1u); } default: { loop { sum.x -= 1.0; if sum.x < 0.0 { break; } } } }
    textureStore(map, id.xy, sum + shared_sums[0]);
}
//# weights
import node::more::{more_weight};
const WEIGHTS: u32 = 9u;
fn weight_of(index: u32) -> f32 { return more_weight(index) / f32(WEIGHTS); }
//# more
fn more_weight(index: u32) -> f32 { return 1.0 + select(0.5, f32(index), index > 3u); }
",
    "struct Pair { a: vec2f, b: array<mat2x2f, 3>, }
fn first(p: ptr<function, Pair>, t: texture_2d<f32>, s: sampler) -> Pair {
    (*p).a = textureSampleLevel(t, s, (*p).a, 0.0).xy;
    return *p;
}
fn second(x: i32) -> i32 { let y = x * 3 - (x & 7) << 2u; return select(-y, abs(y), y > 0); }
",
];

fn seeds() -> Vec<Vec<u8>> {
    let modules = modules().iter().map(|module| module.source);
    SHADERS
        .into_iter()
        .chain(modules)
        .map(|text| text.as_bytes().to_vec())
        .collect()
}

/// Words of all seeds, and such as mean something to a compiler.
static WORDS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let mut words: Vec<String> = seeds()
        .iter()
        .flat_map(|seed| {
            tokens(&String::from_utf8_lossy(seed))
                .into_iter()
                .map(str::to_owned)
                .collect::<Vec<_>>()
        })
        .filter(|token| !token.trim().is_empty())
        .collect();
    words.extend(
        [
            "f16",
            "u64",
            "i64",
            "vec4<bool>",
            "mat4x4f",
            "mat2x3<f16>",
            "atomic<i32>",
            "ptr<private, f32>",
            "array<f32>",
            "array<u32, 0>",
            "texture_depth_multisampled_2d",
            "texture_cube_array<f32>",
            "texture_3d<u32>",
            "texture_storage_3d<r32uint, read_write>",
            "sampler_comparison",
            "texture_external",
            "acceleration_structure",
            "binding_array<texture_2d<f32>, 4>",
            "enable f16;",
            "requires x;",
            "diagnostic(off, derivative_uniformity);",
            "@must_use",
            "@id(0)",
            "@builtin(position)",
            "@location(99)",
            "@interpolate(flat)",
            "@align(16)",
            "@size(4294967295)",
            "@group(4294967295)",
            "@workgroup_size(0)",
            "const_assert",
            "discard",
            "continuing",
            "break if",
            "0xffffffffu",
            "-2147483648",
            "2147483648i",
            "1e400",
            "0x1p-500",
            "1e-400h",
            "340282356779733661637539395458142568447.9f",
            "0.0 / 0.0",
            "1 / 0",
            "1u << 32u",
            "-1 % 0",
            "clamp",
            "pow",
            "ldexp",
            "frexp",
            "modf",
            "pack2x16float",
            "extractBits",
            "insertBits",
            "dot4U8Packed",
            "quantizeToF16",
            "determinant",
            "transpose",
            "textureGather",
            "textureSampleGrad",
            "textureSampleCompareLevel",
            "textureNumLevels",
            "arrayLength",
            "workgroupUniformLoad",
            "atomicCompareExchangeWeak",
            "bitcast<u32>",
            "bitcast<vec2<f16>>",
            "subgroupAdd",
            "quadBroadcast",
            "import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity};\n",
            "import super::super::maths::hankel::{hankel_factor};\n",
            "import node::more::{more_weight};\n",
            "import node::weights::{weight_of};\n",
            "\n//# more\n",
            "\n//# weights\n",
            "/*",
            "*/",
            "//",
            "\u{2028}",
            "\u{0}",
            "\u{feff}",
            "ä",
            "__x",
            "_",
        ]
        .map(str::to_owned),
    );
    words
});

/// Words, numbers, symbols and white space, each as it stands in the text.
fn tokens(text: &str) -> Vec<&str> {
    let kind = |c: char| {
        if c.is_alphanumeric() || c == '_' {
            1
        } else if c.is_whitespace() {
            2
        } else {
            0
        }
    };
    let mut found = Vec::new();
    let mut start = 0;
    let mut before = 0;
    for (at, c) in text.char_indices() {
        let here = kind(c);
        if at > start && (here != before || here == 0) {
            found.push(&text[start..at]);
            start = at;
        }
        before = here;
    }
    found.push(&text[start..]);
    found
}

fn mutate(data: &[u8], seeds: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let Ok(text) = std::str::from_utf8(data) else {
        return mutate_bytes(data, seeds, random);
    };
    match random.below(16) {
        0 => return mutate_bytes(data, seeds, random),
        1 => return [data, scaled(random).as_bytes()].concat(),
        2 => return scaled(random).into_bytes(),
        _ => {}
    }
    let mut tokens = tokens(text);
    let span = random.span(tokens.len());
    let other;
    match random.below(8) {
        0 => drop(tokens.drain(span)),
        1 => {
            let part = tokens[span.clone()].to_vec();
            let times = random.count(20_000 / (part.len() + 1)) + 1;
            tokens.splice(span.end..span.end, part.repeat(times));
        }
        2 => {
            let to = random.below(tokens.len() + 1);
            let part: Vec<&str> = tokens.drain(span).collect();
            let to = to.min(tokens.len());
            tokens.splice(to..to, part);
        }
        3 => {
            other = random.pick(seeds).cloned().unwrap_or_default();
            let theirs = self::tokens(std::str::from_utf8(&other).unwrap_or_default());
            let part = random.span(theirs.len());
            tokens.splice(span, theirs[part].iter().copied());
        }
        4 => {
            // The span within many brackets or signs.
            let (open, close) = [
                ("(", ")"),
                ("{", "}"),
                ("[", "]"),
                ("-", ""),
                ("!", ""),
                ("f32(", ")"),
                ("array<", ">"),
                ("if true {", "}"),
            ][random.below(8)];
            let times = random.count(4000);
            tokens.splice(span.end..span.end, std::iter::repeat_n(close, times));
            tokens.splice(span.start..span.start, std::iter::repeat_n(open, times));
        }
        _ => {
            let word = random.pick(&WORDS).map_or("", String::as_str);
            let at = span.start;
            if random.once_in(2) && at < tokens.len() {
                tokens[at] = word;
            } else {
                tokens.splice(at..at, [" ", word, " "]);
            }
        }
    }
    tokens.concat().into_bytes()
}

/// Shaders that are valid or nearly so, and large in one way.
fn scaled(random: &mut Random) -> String {
    let n = random.count(30_000).max(1);
    let few = n.min(3000);
    let small = 1 + random.below(40);
    let list = |of: &dyn Fn(usize) -> String, count: usize| (0..count).map(of).collect::<String>();
    match random.below(18) {
        0 => format!(
            "fn large() -> u32 {{ var a: array<u32, {}>; return a[3]; }}",
            random.bits() >> random.below(64)
        ),
        1 => format!(
            "{} fn doubled(s: S{small}) -> S{small} {{ return s; }}",
            list(
                &|i| match i {
                    0 => "struct S0 { a: f32, b: f32 }".to_owned(),
                    _ => format!("struct S{i} {{ a: S{0}, b: S{0} }}\n", i - 1),
                },
                small + 1
            )
        ),
        2 => format!(
            "{} fn arrays() {{ var a: A{small}; a = A{small}(); }}",
            list(
                &|i| match i {
                    0 => "alias A0 = f32;".to_owned(),
                    _ => format!("alias A{i} = array<A{}, {}>;\n", i - 1, 1 + n % 9),
                },
                small + 1
            )
        ),
        3 => format!(
            "{} fn constants() -> f32 {{ return C{small}{}.x; }}",
            list(
                &|i| match i {
                    0 => "const C0 = vec2(1.0, 2.0);".to_owned(),
                    _ => format!("const C{i} = array(C{0}, C{0});\n", i - 1),
                },
                small + 1
            ),
            "[1]".repeat(small)
        ),
        4 => list(
            &|i| format!("fn f{i}(x: f32) -> f32 {{ return x + {i}.0; }}\n"),
            few,
        ),
        5 => format!(
            "fn f0(x: f32) -> f32 {{ return x; }}\n{}",
            list(
                &|i| format!(
                    "fn f{}(x: f32) -> f32 {{ return f{i}(x) + f{i}(x); }}\n",
                    i + 1
                ),
                few
            )
        ),
        6 => format!(
            "fn statements() -> f32 {{ var x = 1.0; {} return x; }}",
            list(&|i| format!("x = x * {i}.5 + 1.0;"), n)
        ),
        7 => format!(
            "fn lets(x: f32) -> f32 {{ let a0 = x; {} return a{few}; }}",
            list(&|i| format!("let a{} = a{i} * a{i};", i + 1), few)
        ),
        8 => format!(
            "fn vectors(x: vec4f) -> vec4f {{ return x{}; }}",
            ".wzyx".repeat(n)
        ),
        9 => format!(
            "fn switches(x: u32) -> u32 {{ switch x {{ {} default: {{ return 1u; }} }} }}",
            list(&|i| format!("case {i}u: {{ return {i}u; }}"), n)
        ),
        10 => format!(
            "fn nested(x: u32) {{ {} {} }}",
            "if x > 1u { ".repeat(few),
            "}".repeat(few)
        ),
        11 => format!(
            "fn loops() {{ {} {} }}",
            "loop { ".repeat(few),
            "break; }".repeat(few)
        ),
        12 => format!(
            "struct Wide {{ {} }}\nfn wide(w: Wide) -> Wide {{ var a = w; return a; }}",
            list(&|i| format!("m{i}: vec3f,"), n)
        ),
        13 => format!("fn many({}) {{}}", list(&|i| format!("p{i}: f32,"), n)),
        14 => format!(
            "var<private> data: array<f32, {n}> = array<f32, {n}>({});\nfn read(i: u32) -> f32 {{ return data[i]; }}",
            list(&|i| format!("{i}.0,"), n)
        ),
        15 => format!(
            "{} @fragment fn main() -> @location(0) vec4f {{ return vec4f(0.0); }}",
            list(
                &|i| format!(
                    "@group({}) @binding({i}) var t{i}: texture_2d<f32>;\n",
                    i % 5
                ),
                few
            )
        ),
        16 => list(
            &|i| format!("@compute @workgroup_size(1) fn main{i}() {{ }}\n"),
            few,
        ),
        _ => format!(
            "fn sums(x: f32) -> f32 {{ return x{}; }}",
            " + x * 2.0".repeat(n)
        ),
    }
}

/// Validates a text under every profile, as the command does.
pub fn try_out(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };
    let mut parts = text.split(SEPARATOR);
    let source = Source {
        name: "user.wgsl",
        text: parts.next().unwrap_or_default(),
    };
    let generated: Vec<Source<'_>> = parts
        .take(16)
        .map(|part| {
            let (name, text) = part.split_once('\n').unwrap_or((part, ""));
            Source { name, text }
        })
        .collect();
    for profile in Profile::ALL {
        let result = if source.is_library_module() {
            validate_module(source, profile)
        } else {
            validate(source, &generated, profile)
        };
        match result {
            Ok(report) => assert_eq!(report.outcomes.len(), 5, "an outcome for every backend"),
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
}
