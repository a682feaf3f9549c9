//! A compute shader around an exported file: it reads the inputs of vectors, and writes what the functions give.

use core::fmt::Write;

use moment_shadows::{MapEncoding, Target, Vectors};
use naga::{ArraySize, Handle, Module, ScalarKind, Type, TypeInner};

use super::{exported, name};
use crate::error::LabError;

/// The most words of an input, with the number of the function first.
pub(super) const INPUT_WORDS: usize = 80;

/// The most words that a function gives.
pub(super) const OUTPUT_WORDS: usize = 4;

/// Invocations of one workgroup.
pub(super) const WORKGROUP: usize = 64;

/// The shader: its entry point is `main`, its inputs are binding 0, its outputs are binding 1.
pub fn wrapper(
    encoding: &MapEncoding,
    target: Target,
    vectors: &Vectors,
) -> Result<String, LabError> {
    let functions = exported(encoding, target)?.text;
    let wgsl = exported(encoding, Target::Wgsl)?.text;
    let failed = |reason: String| LabError::unsuitable(name(encoding), reason);
    let module =
        naga::front::wgsl::parse_str(&wgsl).map_err(|error| failed(error.emit_to_string(&wgsl)))?;
    let writer = Writer {
        module: &module,
        target,
    };
    let mut cases = String::new();
    for (number, function) in vectors.functions.iter().enumerate() {
        let case = writer.case(number, &function.name);
        cases += &case.ok_or_else(|| failed(format!("{} takes other types", function.name)))?;
    }
    let rows = vectors.functions.iter().map(|it| it.rows.len()).sum();
    Ok(writer.shader(&functions, &cases, rows))
}

struct Writer<'a> {
    module: &'a Module,
    target: Target,
}

impl Writer<'_> {
    fn shader(&self, functions: &str, cases: &str, rows: usize) -> String {
        let body = |id: &str, uint: &str, end: &str| {
            format!(
                "    {uint} at = {id} * {INPUT_WORDS}u;
    {uint} to = {id} * {OUTPUT_WORDS}u;
    if ({id} < {rows}u) {{
        switch (inputs[at]) {{
{cases}{end}        }}
    }}
}}
"
            )
        };
        match self.target {
            Target::Glsl => format!(
                "#version 450
layout(local_size_x = {WORKGROUP}) in;
layout(std430, set = 0, binding = 0) readonly buffer Inputs {{ uint inputs[]; }};
layout(std430, set = 0, binding = 1) writeonly buffer Outputs {{ uint outputs[]; }};
{functions}
void main() {{
{}",
                body("gl_GlobalInvocationID.x", "uint", "")
            ),
            Target::Hlsl => format!(
                "{functions}
[[vk::binding(0, 0)]] StructuredBuffer<uint> inputs;
[[vk::binding(1, 0)]] RWStructuredBuffer<uint> outputs;
[numthreads({WORKGROUP}, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {{
{}",
                body("id.x", "uint", "")
            ),
            _ => format!(
                "{functions}
@group(0) @binding(0) var<storage, read> inputs: array<u32>;
@group(0) @binding(1) var<storage, read_write> outputs: array<u32>;
@compute @workgroup_size({WORKGROUP})
fn main(@builtin(global_invocation_id) id: vec3u) {{
{}",
                body("id.x", "let", "            default: {}\n")
            ),
        }
    }

    /// The call of a function.
    fn case(&self, number: usize, name: &str) -> Option<String> {
        let mut functions = self.module.functions.iter();
        let (_, function) = functions.find(|(_, it)| it.name.as_deref() == Some(name))?;
        let mut word = 1;
        let mut declared = String::new();
        let mut arguments = Vec::new();
        for (index, argument) in function.arguments.iter().enumerate() {
            let name = format!("argument_{index}");
            self.declare(&mut declared, &name, argument.ty, &mut word)?;
            arguments.push(name);
        }
        if word > INPUT_WORDS {
            return None;
        }
        let result = function.result.as_ref()?.ty;
        let (ty, _, count) = self.numbers(result)?;
        let keyword = self.keyword(&ty);
        let mut text = format!("            case {number}u: {{\n{declared}");
        let arguments = arguments.join(", ");
        writeln!(
            text,
            "                {keyword} given = {name}({arguments});"
        )
        .ok()?;
        for component in 0..count {
            let of = match count {
                1 => "given".to_owned(),
                _ => format!("given[{component}]"),
            };
            let bits = self.bits(&of);
            writeln!(text, "                outputs[to + {component}u] = {bits};").ok()?;
        }
        let end = if self.target == Target::Wgsl {
            ""
        } else {
            "                break;\n"
        };
        Some(format!("{text}{end}            }}\n"))
    }

    /// Declares a variable of a type that holds the next words.
    fn declare(
        &self,
        text: &mut String,
        name: &str,
        ty: Handle<Type>,
        word: &mut usize,
    ) -> Option<()> {
        let inner = &self.module.types[ty];
        let (ty, parts, suffix) = match &inner.inner {
            TypeInner::Array {
                base,
                size: ArraySize::Constant(count),
                ..
            } => {
                let count = count.get() as usize;
                let parts: Option<Vec<_>> = (0..count).map(|_| self.value(*base, word)).collect();
                (self.numbers(*base)?.0, parts?, format!("[{count}]"))
            }
            TypeInner::Struct { members, .. } => {
                let parts: Option<Vec<_>> =
                    members.iter().map(|it| self.value(it.ty, word)).collect();
                (inner.name.clone()?, parts?, String::new())
            }
            _ => {
                let (name_of_type, ..) = self.numbers(ty)?;
                let value = self.value(ty, word)?;
                let keyword = self.keyword(&name_of_type);
                return writeln!(text, "                {keyword} {name} = {value};").ok();
            }
        };
        let parts = parts.join(", ");
        let declared = match (self.target, suffix.is_empty()) {
            (Target::Hlsl, _) => format!("{ty} {name}{suffix} = {{ {parts} }}"),
            (Target::Glsl, _) => format!("{ty} {name}{suffix} = {ty}{suffix}({parts})"),
            (_, true) => format!("let {name} = {ty}({parts})"),
            (_, false) => format!("let {name} = array({parts})"),
        };
        writeln!(text, "                {declared};").ok()
    }

    fn keyword<'a>(&self, ty: &'a str) -> &'a str {
        if self.target == Target::Wgsl {
            "let"
        } else {
            ty
        }
    }

    /// A scalar or vector that holds the next words.
    fn value(&self, ty: Handle<Type>, word: &mut usize) -> Option<String> {
        let (name, kind, count) = self.numbers(ty)?;
        let mut scalars = Vec::new();
        for _ in 0..count {
            let bits = format!("inputs[at + {word}u]");
            *word += 1;
            scalars.push(match (kind, self.target) {
                (ScalarKind::Float, Target::Hlsl) => format!("asfloat({bits})"),
                (ScalarKind::Float, Target::Glsl) => format!("uintBitsToFloat({bits})"),
                (ScalarKind::Float, _) => format!("bitcast<f32>({bits})"),
                _ => bits,
            });
        }
        let scalars = scalars.join(", ");
        Some(if count == 1 {
            scalars
        } else {
            format!("{name}({scalars})")
        })
    }

    fn bits(&self, of: &str) -> String {
        match self.target {
            Target::Hlsl => format!("asuint({of})"),
            Target::Glsl => format!("floatBitsToUint({of})"),
            _ => format!("bitcast<u32>({of})"),
        }
    }

    /// The name of a type of numbers, what they are, and how many.
    fn numbers(&self, ty: Handle<Type>) -> Option<(String, ScalarKind, usize)> {
        let (kind, count) = match self.module.types[ty].inner {
            TypeInner::Scalar(scalar) => (scalar.kind, 1),
            TypeInner::Vector { size, scalar } => (scalar.kind, size as usize),
            _ => return None,
        };
        let name = match (self.target, kind, count) {
            (_, ScalarKind::Uint, 1) => "uint".to_owned(),
            (_, ScalarKind::Float, 1) => "float".to_owned(),
            (Target::Hlsl, ScalarKind::Float, _) => format!("float{count}"),
            (Target::Glsl, ScalarKind::Float, _) => format!("vec{count}"),
            (_, ScalarKind::Float, _) => format!("vec{count}f"),
            _ => return None,
        };
        Some((name, kind, count))
    }
}
