//! Parameters that naga's validator takes, and its backends do not: pointers to parts of variables (WGSL language feature
//! `unrestricted_pointer_parameters`), and storage textures.

use naga::{Expression, Function, ImageClass, Module, Statement, TypeInner};

use super::diagnostic::NOT_YET;
use super::message::PARAMETER;
use super::pointer::memory;
use super::statements;
use crate::{Linked, Rule, ShaderError};

/// Calls that are given a pointer to an element or a member, and functions that take a storage texture.
pub(super) fn check(module: &Module, linked: &Linked) -> Vec<ShaderError> {
    let functions = module.functions.iter().map(|(_, function)| function);
    let entry_points = module.entry_points.iter().map(|it| &it.function);
    let mut found = Vec::new();
    for (handle, function) in module.functions.iter() {
        let takes = function.arguments.iter().any(|it| {
            let inner = &module.types[it.ty].inner;
            matches!(
                inner,
                TypeInner::Image {
                    class: ImageClass::Storage { .. },
                    ..
                }
            )
        });
        let range = module.functions.get_span(handle).to_range();
        let place = range.and_then(|range| linked.location(range));
        found.extend(takes.then(|| ShaderError {
            rule: Rule::Unsupported,
            message: PARAMETER.to_owned(),
            places: place.into_iter().collect(),
            notes: vec![NOT_YET.to_owned()],
        }));
    }
    for function in functions.chain(entry_points) {
        of(module, function, linked, &mut found);
    }
    found
}

fn of(module: &Module, function: &Function, linked: &Linked, found: &mut Vec<ShaderError>) {
    statements::each(&function.body, &mut |statement, span| {
        let Statement::Call { arguments, .. } = statement else {
            return;
        };
        let is_part = arguments.iter().any(|argument| {
            let expression = &function.expressions[*argument];
            matches!(
                expression,
                Expression::Access { .. } | Expression::AccessIndex { .. }
            ) && memory(module, function, *argument).is_some()
        });
        let place = span.to_range().and_then(|range| linked.location(range));
        if is_part {
            let message = "this call is given a pointer to a part of a variable, which naga cannot write yet; give it a variable of \
                           its own, and copy";
            found.push(ShaderError {
                rule: Rule::Unsupported,
                message: message.to_owned(),
                places: place.into_iter().collect(),
                notes: vec![NOT_YET.to_owned()],
            });
        }
    });
}
