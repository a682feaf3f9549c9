//! What a pointer starts from, and whether an expression is one.

use naga::{
    AddressSpace, Expression, Function, GlobalVariable, Handle, LocalVariable, Module, TypeInner,
};

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

/// The memory that a pointer points into, if `argument` is one.
pub(super) fn memory(
    module: &Module,
    function: &Function,
    argument: Handle<Expression>,
) -> Option<Root> {
    let root = root(function, argument)?;
    let is_pointer = match root {
        Root::Local(_) => true,
        Root::Global(variable) => module.global_variables[variable].space != AddressSpace::Handle,
        Root::Parameter(index) => {
            let parameter = function.arguments.get(index as usize)?;
            matches!(
                module.types[parameter.ty].inner,
                TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. }
            )
        }
    };
    is_pointer.then_some(root)
}
