//! What naga writes wrongly, so that no exported file may hold it.

use naga::{Expression, Function, MathFunction, Module, Type, TypeInner, VectorSize};

/// Refuses members that are matrices of two rows, to which naga's HLSL loses stores, and the sign of a number, of which it stores the
/// bits of another type.
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that fails says where")]

    use super::check;
    use crate::export::translate::parse;

    #[test]
    fn what_naga_writes_wrongly_is_refused() {
        for (wgsl, expected) in [
            (
                "struct S { m: mat3x2f }\nfn f(s: S) -> S { return s; }",
                Some("`m` is a matrix of two rows"),
            ),
            (
                "struct S { m: array<mat2x2f, 3> }\nfn f(s: S) -> S { return s; }",
                Some("`m` is a matrix"),
            ),
            (
                "struct S { m: mat2x3f }\nfn f(s: S) -> S { return s; }",
                None,
            ),
            (
                "fn f(x: f32) -> f32 { return sign(x); }",
                Some("`f` takes a sign"),
            ),
            ("fn f(m: mat2x2f) -> vec2f { return m[0]; }", None),
        ] {
            let found = check(&parse(wgsl).unwrap());
            match expected {
                None => assert_eq!(found, Ok(())),
                Some(expected) => assert!(found.unwrap_err().contains(expected), "{wgsl}"),
            }
        }
    }
}
