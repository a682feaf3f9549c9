//! A shader that writes the bits of everything in a module that is, or returns, numbers.

use std::fmt::Write;

use naga::{Handle, Module, ScalarKind, Type, TypeInner};

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
";

/// The shader's text without imports, and how many words each invocation writes.
pub(crate) struct Values {
    pub(crate) wgsl: String,
    pub(crate) words: usize,
    /// Functions that are not called, since they take a texture, a sampler or a pointer.
    pub(crate) left_out: usize,
}

/// The values of the module `source`; `linked` is the module with what it imports.
pub(crate) fn values(source: &str, linked: &str) -> Values {
    let module = naga::front::wgsl::parse_str(linked).unwrap();
    let mut writer = Writer {
        module: &module,
        body: String::new(),
        words: 0,
    };
    let mut left_out = 0;
    for (index, item) in items(source).enumerate() {
        let named = |name: &Option<String>| name.as_deref() == Some(item);
        if let Some((_, constant)) = module.constants.iter().find(|(_, it)| named(&it.name)) {
            writeln!(writer.body, "    let value_{index} = {item};").unwrap();
            writer.store(&format!("value_{index}"), constant.ty);
        }
        if let Some((_, function)) = module.functions.iter().find(|(_, it)| named(&it.name)) {
            let types: Vec<_> = function.arguments.iter().map(|it| it.ty).collect();
            match &function.result {
                Some(result) if types.iter().all(|&ty| writer.is_plain(ty)) => {
                    writer.call(index, item, &types);
                    writer.store(&format!("value_{index}"), result.ty);
                }
                _ => left_out += 1,
            }
        }
    }
    let Writer { body, words, .. } = writer;
    let wgsl = format!(
        "{DRAWN}
@group(0) @binding(0) var<storage, read_write> written: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {{
    var state = id.x;
    let first = {words}u * id.x;
{body}}}
"
    );
    Values {
        wgsl,
        words,
        left_out,
    }
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

    /// Whether values of the type are made of numbers and truth values.
    fn is_plain(&self, ty: Handle<Type>) -> bool {
        match self.inner(ty) {
            TypeInner::Scalar(_) | TypeInner::Vector { .. } | TypeInner::Matrix { .. } => true,
            TypeInner::Array { base, size, .. } => {
                matches!(size, naga::ArraySize::Constant(_)) && self.is_plain(*base)
            }
            TypeInner::Struct { members, .. } => members.iter().all(|it| self.is_plain(it.ty)),
            _ => false,
        }
    }

    /// Declares `value_<index>`, the result of a function for arguments that are drawn.
    fn call(&mut self, index: usize, function: &str, types: &[Handle<Type>]) {
        for (argument, &ty) in types.iter().enumerate() {
            let drawn = self.drawn(ty);
            writeln!(self.body, "    let argument_{index}_{argument} = {drawn};").unwrap();
        }
        let names = (0..types.len()).map(|argument| format!("argument_{index}_{argument}"));
        let arguments = names.collect::<Vec<_>>().join(", ");
        writeln!(
            self.body,
            "    let value_{index} = {function}({arguments});"
        )
        .unwrap();
    }

    /// An expression that draws a value of a type.
    fn drawn(&self, ty: Handle<Type>) -> String {
        let several = |count: usize, one: &str| vec![one; count].join(", ");
        match self.inner(ty) {
            TypeInner::Scalar(scalar) => format!("drawn_{}(&state)", name(scalar.kind)),
            TypeInner::Vector { size, scalar } => {
                let (size, name) = (*size as usize, name(scalar.kind));
                let components = several(size, &format!("drawn_{name}(&state)"));
                format!("vec{size}<{name}>({components})")
            }
            TypeInner::Matrix { columns, rows, .. } => {
                let (columns, rows) = (*columns as usize, *rows as usize);
                let components = several(columns * rows, "drawn_f32(&state)");
                format!("mat{columns}x{rows}<f32>({components})")
            }
            TypeInner::Array { base, .. } => {
                format!("array({})", several(self.count(ty), &self.drawn(*base)))
            }
            TypeInner::Struct { members, .. } => {
                let members: Vec<_> = members.iter().map(|it| self.drawn(it.ty)).collect();
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
