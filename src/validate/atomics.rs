//! Atomics (WGSL specification, section 6.2.8): only builtin functions read and write them, and only where they can be written. naga takes
//! plain uses too.

use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{
    AddressSpace, Expression, Function, Handle, Module, Span, Statement, StorageAccess, Type,
    TypeInner,
};

use super::statements;
use crate::{Linked, Rule, ShaderError};

/// Atomics that are assigned, read or copied as other values are, or lie in memory that is only read.
pub(super) fn check(module: &Module, info: &ModuleInfo, linked: &Linked) -> Vec<ShaderError> {
    if !module
        .types
        .iter()
        .any(|(_, ty)| matches!(ty.inner, TypeInner::Atomic(_)))
    {
        return Vec::new();
    }
    let mut found = Vec::new();
    for (handle, variable) in module.global_variables.iter() {
        let reads = matches!(variable.space, AddressSpace::Storage { access } if !access.contains(StorageAccess::STORE));
        if reads && holds_atomic(module, variable.ty) {
            let span = module.global_variables.get_span(handle);
            let message = "atomics lie in storage that is `read_write`; this variable is only read";
            found.push(refused(linked, span, message));
        }
    }
    for (handle, ty) in module.types.iter() {
        let is_own = matches!(ty.inner, TypeInner::Pointer { base, space: AddressSpace::Function | AddressSpace::Private }
            if holds_atomic(module, base));
        if is_own && is_parameter(module, handle) {
            let span = module.types.get_span(handle);
            let message =
                "there are no atomics in function and private memory for a parameter to point at";
            found.push(refused(linked, span, message));
        }
    }
    for (handle, function) in module.functions.iter() {
        uses(module, function, &info[handle], linked, &mut found);
    }
    for (index, entry_point) in module.entry_points.iter().enumerate() {
        uses(
            module,
            &entry_point.function,
            info.get_entry_point(index),
            linked,
            &mut found,
        );
    }
    found
}

fn uses(
    module: &Module,
    function: &Function,
    info: &FunctionInfo,
    linked: &Linked,
    found: &mut Vec<ShaderError>,
) {
    let is_atomic = |pointer: Handle<Expression>| {
        let inner = info[pointer].ty.inner_with(&module.types);
        matches!(inner, TypeInner::Pointer { base, .. } if holds_atomic(module, *base))
    };
    let written = |span: Span| {
        let text = span.to_range().and_then(|range| linked.wgsl().get(range));
        text.unwrap_or_default()
    };
    for (handle, expression) in function.expressions.iter() {
        let span = function.expressions.get_span(handle);
        if let Expression::Load { pointer } = expression
            && is_atomic(*pointer)
            && !written(span).starts_with("atomicLoad")
        {
            let message = "an atomic is read by `atomicLoad` only";
            found.push(refused(linked, span, message));
        }
    }
    statements::each(&function.body, &mut |statement, span| {
        if let Statement::Store { pointer, .. } = statement
            && is_atomic(*pointer)
            && !written(span).starts_with("atomicStore")
        {
            let message = "an atomic is written by `atomicStore` and the like only";
            found.push(refused(linked, span, message));
        }
    });
}

fn is_parameter(module: &Module, ty: Handle<Type>) -> bool {
    let mut functions = module.functions.iter();
    functions.any(|(_, function)| function.arguments.iter().any(|it| it.ty == ty))
}

fn holds_atomic(module: &Module, ty: Handle<Type>) -> bool {
    match &module.types[ty].inner {
        TypeInner::Atomic(_) => true,
        TypeInner::Array { base, .. } => holds_atomic(module, *base),
        TypeInner::Struct { members, .. } => members.iter().any(|it| holds_atomic(module, it.ty)),
        _ => false,
    }
}

fn refused(linked: &Linked, span: Span, message: &str) -> ShaderError {
    let range = span.to_range();
    ShaderError {
        rule: Rule::Wgsl,
        message: message.to_owned(),
        places: range
            .and_then(|range| linked.location(range))
            .into_iter()
            .collect(),
        notes: Vec::new(),
    }
}
