//! `bitcast` between types of one size, and constants that have another form (WGSL specification, section 17.2). naga takes any size.

use naga::valid::FunctionInfo;
use naga::{Expression, Function, Handle, Module, TypeInner};

use crate::Linked;

/// What is wrong with a bitcast, if `expression` is one.
pub(super) fn objection(
    module: &Module,
    function: &Function,
    info: &FunctionInfo,
    linked: &Linked,
    handle: Handle<Expression>,
) -> Option<String> {
    let Expression::As {
        expr,
        convert: None,
        ..
    } = function.expressions[handle]
    else {
        return None;
    };
    let range = function.expressions.get_span(handle).to_range()?;
    let text = linked.wgsl().get(range.start..)?;
    let (to, _) = text
        .strip_prefix("bitcast")?
        .trim_start()
        .strip_prefix('<')?
        .split_once('(')?;
    let to = to.trim_end().strip_suffix('>')?.trim();
    let wanted = bytes(to)?;
    let given = match info[expr].ty.inner_with(&module.types) {
        TypeInner::Scalar(scalar) => scalar.width.into(),
        TypeInner::Vector { size, scalar } => *size as u32 * u32::from(scalar.width),
        TypeInner::Matrix { .. } => {
            return Some("`bitcast` takes numbers and vectors, and this is a matrix".to_owned());
        }
        _ => return None,
    };
    (wanted != given).then(|| {
        format!("`bitcast` makes `{to}`, which has {wanted} bytes, of a value that has {given}")
    })
}

/// How many bytes a type has, by its usual names.
fn bytes(name: &str) -> Option<u32> {
    let (count, scalar) = match name.strip_prefix("vec") {
        Some(rest) => {
            let mut rest = rest.chars();
            let count = rest.next()?.to_digit(10)?;
            (count, rest.as_str().trim().trim_matches(['<', '>']).trim())
        }
        None => (1, name),
    };
    match scalar {
        "f32" | "i32" | "u32" | "f" | "i" | "u" => Some(count * 4),
        "f16" | "h" => Some(count * 2),
        _ => None,
    }
}
