//! The members of uniform structs, as shaders declare them.

use naga::{Handle, Module, ScalarKind, Type, TypeInner};

use crate::PlannedField;

/// The members of the struct of a name and a size in bytes; `None` if the shader has none.
pub(super) fn of(module: &Module, name: &str, bytes: u32) -> Option<Vec<PlannedField>> {
    let mut types = module.types.iter();
    let (_, ty) = types.find(|(_, ty)| {
        let is_struct = matches!(ty.inner, TypeInner::Struct { span, .. } if span == bytes);
        is_struct && ty.name.as_deref() == Some(name)
    })?;
    let mut fields = Vec::new();
    add(module, ty, "", 0, &mut fields);
    Some(fields)
}

/// Adds the members of a struct that lies `start` bytes into the whole.
fn add(module: &Module, ty: &Type, prefix: &str, start: u32, fields: &mut Vec<PlannedField>) {
    let TypeInner::Struct { members, .. } = &ty.inner else {
        return;
    };
    for member in members {
        let name = format!("{prefix}{}", member.name.as_deref().unwrap_or_default());
        let offset = start + member.offset;
        let (element, count, stride) = if let TypeInner::Array {
            base,
            size: naga::ArraySize::Constant(count),
            stride,
        } = module.types[member.ty].inner
        {
            (base, count.get(), stride)
        } else {
            (member.ty, 1, 0)
        };
        let inner = &module.types[element];
        if let TypeInner::Struct { .. } = inner.inner {
            for index in 0..count {
                let place = match count {
                    1 => format!("{name}."),
                    _ => format!("{name}[{index}]."),
                };
                add(module, inner, &place, offset + index * stride, fields);
            }
        } else {
            fields.push(PlannedField {
                name,
                ty: type_name(module, element),
                offset,
                count,
                stride,
            });
        }
    }
}

/// The WGSL name of a type that uniform data can have, short where WGSL has a short one.
fn type_name(module: &Module, ty: Handle<Type>) -> String {
    let letter = |kind: ScalarKind| match kind {
        ScalarKind::Float => "f",
        ScalarKind::Sint => "i",
        ScalarKind::Uint => "u",
        ScalarKind::Bool | ScalarKind::AbstractInt | ScalarKind::AbstractFloat => "?",
    };
    let inner = &module.types[ty].inner;
    if let TypeInner::Scalar(scalar) = *inner {
        format!("{}{}", letter(scalar.kind), 8 * scalar.width)
    } else if let TypeInner::Vector { size, scalar } = *inner {
        format!("vec{}{}", size as u8, letter(scalar.kind))
    } else if let TypeInner::Matrix {
        columns,
        rows,
        scalar,
    } = *inner
    {
        let (columns, rows) = (columns as u8, rows as u8);
        format!("mat{columns}x{rows}{}", letter(scalar.kind))
    } else {
        // An array of arrays, which no node has.
        "?".to_owned()
    }
}
