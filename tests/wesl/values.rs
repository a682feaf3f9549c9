//! A shader that writes the bits of everything in a module that is, or returns, numbers.

use std::fmt::Write;

use naga::{Handle, ImageClass, Module, ScalarKind, Type, TypeInner};

use crate::roots::items;

/// Arguments that are plausible and arguments that are not (any bits at all, NaN among them), from a state that each one
/// changes. Few integers are large, since loops run over counts.
const DRAWN: &str = "
fn drawn_word(state: ptr<function, u32>) -> u32 {
    *state = *state * 747796405u + 2891336453u;
    let word = ((*state >> ((*state >> 28u) + 4u)) ^ *state) * 277803737u;
    return (word >> 22u) ^ word;
}

fn drawn_f32(state: ptr<function, u32>) -> f32 {
    let word = drawn_word(state);
    let unit = f32(word >> 8u) / 16777216.0;
    switch drawn_word(state) % 8u {
        case 0u, 1u, 2u: {
            return unit;
        }
        case 3u, 4u: {
            return 2.0 * unit - 1.0;
        }
        case 5u: {
            return exp2(60.0 * unit - 40.0);
        }
        case 6u: {
            return f32(word % 16u) - 4.0;
        }
        default: {
            return bitcast<f32>(select(word, word | 0x7f800000u, word % 4u == 0u));
        }
    }
}

fn drawn_u32(state: ptr<function, u32>) -> u32 {
    let word = drawn_word(state);
    return select(word % 8u, word, drawn_word(state) % 16u == 0u);
}

fn drawn_i32(state: ptr<function, u32>) -> i32 {
    return bitcast<i32>(drawn_u32(state)) - 4;
}

fn drawn_bool(state: ptr<function, u32>) -> bool {
    return drawn_word(state) % 2u == 0u;
}

fn small_f32(state: ptr<function, u32>) -> f32 {
    return clamp(drawn_f32(state), -16.0, 16.0);
}

fn small_u32(state: ptr<function, u32>) -> u32 {
    return drawn_u32(state) % 16u;
}

fn small_i32(state: ptr<function, u32>) -> i32 {
    return drawn_i32(state) % 16;
}

fn small_bool(state: ptr<function, u32>) -> bool {
    return drawn_bool(state);
}
";

/// The resources that functions may take, by binding in group 1: the first two are those of the example.
pub(crate) const RESOURCES: [&str; 7] = [
    "texture_2d_array<f32>",
    "sampler",
    "texture_2d<f32>",
    "texture_2d_array<u32>",
    "texture_depth_2d_array",
    "sampler_comparison",
    "texture_depth_multisampled_2d",
];

/// The shader's text without imports and without what `source` defines.
pub(crate) struct Values {
    pub(crate) wgsl: String,
    /// How many words each invocation writes.
    pub(crate) words: usize,
}

/// The values of `source`, a module or a shader; `linked` is `source` with what it imports.
pub(crate) fn values(source: &str, linked: &str) -> Values {
    let module = naga::front::wgsl::parse_str(linked).unwrap();
    let mut writer = Writer {
        module: &module,
        body: String::new(),
        words: 0,
    };
    for (index, item) in items(source).enumerate() {
        let named = |name: &Option<String>| name.as_deref() == Some(item);
        if let Some((_, constant)) = module.constants.iter().find(|(_, it)| named(&it.name)) {
            writeln!(writer.body, "    let value_{index} = {item};").unwrap();
            writer.store(&format!("value_{index}"), constant.ty);
        }
        if let Some((_, function)) = module.functions.iter().find(|(_, it)| named(&it.name)) {
            let types: Vec<_> = function.arguments.iter().map(|it| it.ty).collect();
            writer.call(index, item, &types);
            let result = function.result.as_ref().unwrap();
            writer.store(&format!("value_{index}"), result.ty);
        }
    }
    let Writer { body, words, .. } = writer;
    let mut resources = String::new();
    for (binding, ty) in RESOURCES.iter().enumerate() {
        let name = format!("resource_{binding}");
        if body.contains(&name) {
            writeln!(resources, "@group(1) @binding({binding}) var {name}: {ty};").unwrap();
        }
    }
    let wgsl = format!(
        "{DRAWN}
{resources}@group(2) @binding(0) var<storage, read_write> written: array<u32>;

@compute @workgroup_size(64)
fn write_values(@builtin(global_invocation_id) id: vec3u) {{
    var state = id.x;
    let first = {words}u * id.x;
{body}}}
"
    );
    Values { wgsl, words }
}

struct Writer<'a> {
    module: &'a Module,
    body: String,
    words: usize,
}

impl Writer<'_> {
    fn inner(&self, ty: Handle<Type>) -> &TypeInner {
        &self.module.types[ty].inner
    }

    /// The binding of a texture or sampler.
    fn resource(&self, ty: Handle<Type>) -> Option<usize> {
        let kind = match self.inner(ty) {
            TypeInner::Sampler { comparison: false } => "sampler",
            TypeInner::Sampler { comparison: true } => "sampler_comparison",
            TypeInner::Image { arrayed, class, .. } => match (arrayed, class) {
                (_, ImageClass::Depth { multi: true }) => "texture_depth_multisampled_2d",
                (_, ImageClass::Depth { multi: false }) => "texture_depth_2d_array",
                (false, _) => "texture_2d<f32>",
                (true, ImageClass::Sampled { kind, .. }) if *kind == ScalarKind::Uint => {
                    "texture_2d_array<u32>"
                }
                (true, _) => "texture_2d_array<f32>",
            },
            _ => return None,
        };
        RESOURCES.iter().position(|&it| it == kind)
    }

    /// Declares `value_<index>`, the result of a function for arguments that are drawn: small ones for a function that reads
    /// textures, which may read as many texels as an argument says.
    fn call(&mut self, index: usize, function: &str, types: &[Handle<Type>]) {
        let reads = types.iter().any(|&ty| self.resource(ty).is_some());
        let draw = if reads { "small" } else { "drawn" };
        let mut arguments = Vec::new();
        for (argument, &ty) in types.iter().enumerate() {
            let name = format!("argument_{index}_{argument}");
            let (keyword, passed, ty) = match (self.resource(ty), self.inner(ty)) {
                (Some(binding), _) => {
                    arguments.push(format!("resource_{binding}"));
                    continue;
                }
                (None, TypeInner::Pointer { base, .. }) => ("var", format!("&{name}"), *base),
                (None, _) => ("let", name.clone(), ty),
            };
            let drawn = self.drawn(draw, ty);
            writeln!(self.body, "    {keyword} {name} = {drawn};").unwrap();
            arguments.push(passed);
        }
        let arguments = arguments.join(", ");
        writeln!(
            self.body,
            "    let value_{index} = {function}({arguments});"
        )
        .unwrap();
    }

    /// An expression for a value of a type by the functions `<draw>_<scalar>`.
    fn drawn(&self, draw: &str, ty: Handle<Type>) -> String {
        let several = |count: usize, one: &str| vec![one; count].join(", ");
        match self.inner(ty) {
            TypeInner::Scalar(scalar) => format!("{draw}_{}(&state)", name(scalar.kind)),
            TypeInner::Vector { size, scalar } => {
                let (size, name) = (*size as usize, name(scalar.kind));
                let components = several(size, &format!("{draw}_{name}(&state)"));
                format!("vec{size}<{name}>({components})")
            }
            TypeInner::Matrix { columns, rows, .. } => {
                let (columns, rows) = (*columns as usize, *rows as usize);
                let components = several(columns * rows, &format!("{draw}_f32(&state)"));
                format!("mat{columns}x{rows}<f32>({components})")
            }
            TypeInner::Array { base, .. } => {
                let elements = several(self.count(ty), &self.drawn(draw, *base));
                format!("array({elements})")
            }
            TypeInner::Struct { members, .. } => {
                let members: Vec<_> = members.iter().map(|it| self.drawn(draw, it.ty)).collect();
                let name = self.module.types[ty].name.as_ref().unwrap();
                format!("{name}({})", members.join(", "))
            }
            other => unreachable!("{other:?} is not drawn"),
        }
    }

    /// Writes the bits of the value `of`.
    fn store(&mut self, of: &str, ty: Handle<Type>) {
        match self.inner(ty).clone() {
            TypeInner::Scalar(scalar) => self.store_scalar(of, scalar.kind),
            TypeInner::Vector { size, scalar } => {
                for component in 0..size as usize {
                    self.store_scalar(&format!("{of}[{component}]"), scalar.kind);
                }
            }
            TypeInner::Matrix { columns, rows, .. } => {
                for column in 0..columns as usize {
                    for row in 0..rows as usize {
                        self.store_scalar(&format!("{of}[{column}][{row}]"), ScalarKind::Float);
                    }
                }
            }
            TypeInner::Array { base, .. } => {
                for index in 0..self.count(ty) {
                    self.store(&format!("{of}[{index}]"), base);
                }
            }
            TypeInner::Struct { members, .. } => {
                for member in members {
                    self.store(&format!("{of}.{}", member.name.unwrap()), member.ty);
                }
            }
            other => unreachable!("{other:?} is not written"),
        }
    }

    fn store_scalar(&mut self, of: &str, kind: ScalarKind) {
        let bits = match kind {
            ScalarKind::Bool => "u32",
            _ => "bitcast<u32>",
        };
        let word = self.words;
        writeln!(self.body, "    written[first + {word}u] = {bits}({of});").unwrap();
        self.words += 1;
    }

    fn count(&self, array: Handle<Type>) -> usize {
        match self.inner(array) {
            TypeInner::Array {
                size: naga::ArraySize::Constant(count),
                ..
            } => count.get() as usize,
            other => unreachable!("{other:?} has no count"),
        }
    }
}

fn name(kind: ScalarKind) -> &'static str {
    match kind {
        ScalarKind::Float => "f32",
        ScalarKind::Sint => "i32",
        ScalarKind::Uint => "u32",
        ScalarKind::Bool => "bool",
        other => unreachable!("WGSL has no variables of kind {other:?}"),
    }
}
