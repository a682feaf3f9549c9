//! Shaders given to `validate`: a user's own, modules of the library, and generated modules that import each other.

use std::sync::LazyLock;

use moment_shadows::{Profile, Source, ValidationOptions, modules, validate};

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
    const FURTHER: &str = "f16 u64 vec4<bool> mat2x3<f16> atomic<i32> ptr<private,f32> array<f32> array<u32,0> \
        texture_depth_multisampled_2d texture_storage_3d<r32uint,read_write> sampler_comparison texture_external \
        binding_array<texture_2d<f32>,4> enable requires diagnostic @must_use @id(0) @builtin(position) @location(99) \
        @align(16) @size(4294967295) @group(4294967295) @workgroup_size(0) const_assert discard continuing \
        0xffffffffu -2147483648 1e400 0x1p-500 1e-400h 0.0/0.0 1/0 1u<<32u -1%0 ldexp pack2x16float extractBits \
        quantizeToF16 textureGather textureSampleGrad arrayLength bitcast<vec2<f16>> subgroupAdd \
        import super moment_shadows //#more //#weights /* */ // \u{2028} \u{0} \u{feff} \u{e4} __x _";
    let seeds = seeds();
    let known = seeds.iter().map(|seed| String::from_utf8_lossy(seed));
    known
        .flat_map(|seed| {
            tokens(&seed)
                .into_iter()
                .map(str::to_owned)
                .collect::<Vec<_>>()
        })
        .chain(FURTHER.split_whitespace().map(str::to_owned))
        .filter(|token| !token.trim().is_empty())
        .collect()
});

/// Words and numbers, and what stands between them, each as it stands in the text.
fn tokens(text: &str) -> Vec<&str> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    text.split_inclusive(|c| !is_word(c))
        .flat_map(|part| {
            let end = part.trim_end_matches(|c| !is_word(c)).len();
            [&part[..end], &part[end..]]
        })
        .filter(|token| !token.is_empty())
        .collect()
}

fn mutate(data: &[u8], seeds: &[Vec<u8>], times: usize, random: &mut Random) -> Vec<u8> {
    (0..times).fold(data.to_vec(), |data, _| mutate_once(&data, seeds, random))
}

fn mutate_once(data: &[u8], seeds: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
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
            let times = random.count(2000 / (part.len() + 1)) + 1;
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
            let times = random.count(1000);
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

/// Shaders that are valid, and long or deep, but not so that the compiler takes more than a second.
fn scaled(random: &mut Random) -> String {
    let n = random.count(1000).max(1);
    let list = |of: &dyn Fn(usize) -> String| (0..n).map(of).collect::<String>();
    match random.below(7) {
        0 => list(&|i| format!("fn f{i}(x: f32) -> f32 {{ return x + {i}.0; }}\n")),
        1 => format!(
            "fn f0(x: f32) -> f32 {{ return x; }}\n{}",
            list(&|i| format!(
                "fn f{}(x: f32) -> f32 {{ return f{i}(x) + f{i}(x); }}\n",
                i + 1
            ))
        ),
        2 => format!(
            "fn statements() -> f32 {{ var x = 1.0; {} return x; }}",
            list(&|i| format!("x = x * {i}.5 + 1.0;"))
        ),
        3 => format!(
            "fn switches(x: u32) -> u32 {{ switch x {{ {} default: {{ return 1u; }} }} }}",
            list(&|i| format!("case {i}u: {{ return {i}u; }}"))
        ),
        4 => format!(
            "fn nested(x: u32) {{ {} {} }}",
            "if x > 1u { ".repeat(n),
            "}".repeat(n)
        ),
        5 => format!(
            "struct Wide {{ {} }}\nfn wide(w: Wide) -> Wide {{ var a = w; return a; }}",
            list(&|i| format!("m{i}: vec3f,"))
        ),
        _ => format!(
            "fn sums(x: f32) -> f32 {{ return x{}; }}",
            " + x * 2.0".repeat(n)
        ),
    }
}

/// Validates a text under every profile, as the command does.
pub fn try_out(data: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(data) else {
        return false;
    };
    let mut valid = false;
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
        let options = ValidationOptions {
            profile,
            modules: &generated,
            ..ValidationOptions::default()
        };
        let report = validate(source, &options);
        valid |= report.is_valid();
        if report.is_valid() {
            assert_eq!(report.outcomes.len(), 5, "an outcome for every backend");
        } else {
            assert!(!report.to_string().is_empty());
        }
    }
    valid
}
