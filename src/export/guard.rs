//! What naga writes wrongly, so that no exported file may hold it.

use naga::{Expression, Function, MathFunction, Module, Type, TypeInner, VectorSize};

/// Refuses members that are matrices of two rows, to which naga's HLSL loses stores, and the sign of an integer or a float, of which it stores
/// the bits of another type.
pub(super) fn check(module: &Module) -> Result<(), String> {
    for (_, ty) in module.types.iter() {
        let TypeInner::Struct { members, .. } = &ty.inner else {
            continue;
        };
        for member in members {
            if has_two_rows(module, &module.types[member.ty]) {
                return Err(format!(
                    "member `{}` is a matrix of two rows, to which stores are lost in HLSL",
                    member.name.as_deref().unwrap_or_default()
                ));
            }
        }
    }
    let functions = module.functions.iter();
    functions
        .into_iter()
        .try_for_each(|(_, function)| check_function(function))
}

fn has_two_rows(module: &Module, ty: &Type) -> bool {
    match &ty.inner {
        TypeInner::Matrix { rows, .. } => *rows == VectorSize::Bi,
        TypeInner::Array { base, .. } => has_two_rows(module, &module.types[*base]),
        _ => false,
    }
}

fn check_function(function: &Function) -> Result<(), String> {
    let signs = function.expressions.iter();
    let mut signs = signs.filter(|(_, it)| {
        matches!(
            it,
            Expression::Math {
                fun: MathFunction::Sign,
                ..
            }
        )
    });
    match signs.next() {
        None => Ok(()),
        Some(_) => Err(format!(
            "`{}` takes a sign, which is stored with an integer's bits in HLSL",
            function.name.as_deref().unwrap_or_default()
        )),
    }
}
