//! What a pointer starts from.

use naga::{Expression, Function, GlobalVariable, Handle, LocalVariable};

/// A variable, or a parameter that is a pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Root {
    Local(Handle<LocalVariable>),
    Global(Handle<GlobalVariable>),
    Parameter(u32),
}

/// The root of a pointer; `None` for expressions that are none.
pub(super) fn root(function: &Function, pointer: Handle<Expression>) -> Option<Root> {
    let mut at = pointer;
    loop {
        at = match function.expressions[at] {
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => base,
            Expression::LocalVariable(variable) => return Some(Root::Local(variable)),
            Expression::GlobalVariable(variable) => return Some(Root::Global(variable)),
            Expression::FunctionArgument(index) => return Some(Root::Parameter(index)),
            _ => return None,
        };
    }
}
