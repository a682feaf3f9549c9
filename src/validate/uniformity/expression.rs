//! What an expression depends on, and where a pointer points.

use naga::{AddressSpace, Expression, Function, Handle, SampleLevel, StorageAccess, TypeInner};

use super::function::Walk;
use super::graph::{Label, Node};
use super::names::{derivative_name, sample_name};
use super::severity::Rule;

/// Where a pointer points.
pub(super) struct Place {
    /// The place in `variables`; none for memory that is not the function's.
    pub(super) variable: Option<usize>,
    /// Whether it points at a part.
    pub(super) is_part: bool,
    /// What the indices on the way depend on.
    pub(super) indices: Vec<Node>,
    /// Whether other memory is read as the same value by every invocation.
    pub(super) is_constant: bool,
}

impl<'a> Walk<'a> {
    /// The value of an expression where it is used.
    pub(super) fn value(&mut self, handle: Handle<Expression>, control: Node) -> Node {
        let known = self.values.get(handle.index()).copied().flatten();
        match (known, &self.function.expressions[handle]) {
            (Some(value), _) => self.graph.node(&[control, value]),
            (None, Expression::FunctionArgument(index)) => {
                match self.arguments.get(*index as usize) {
                    Some(argument) => self.graph.node(&[control, *argument]),
                    None => control,
                }
            }
            // Literals, constants, and the names of variables.
            (None, _) => control,
        }
    }

    /// An expression where it is evaluated.
    pub(super) fn evaluate(&mut self, handle: Handle<Expression>, control: Node) -> Node {
        let function: &'a Function = self.function;
        let expression = &function.expressions[handle];
        let span = self.function.expressions.get_span(handle);
        let mut depends = vec![control];
        match expression {
            Expression::Load { pointer } => {
                let place = self.place(*pointer, control);
                depends.extend(&place.indices);
                if let Some(variable) = place.variable {
                    depends.push(self.variables[variable]);
                } else if !place.is_constant {
                    depends.push(self.memory(handle));
                }
            }
            Expression::ImageSample { level, .. } => {
                if matches!(level, SampleLevel::Auto | SampleLevel::Bias(_)) {
                    let by = sample_name(expression);
                    self.require_uniform(control, by, Rule::Derivatives, span);
                    depends.push(self.graph.labelled(&[self.differs], Label::Result(span)));
                }
                self.operands(expression, control, &mut depends);
            }
            Expression::Derivative { axis, ctrl, .. } => {
                let by = derivative_name(*axis, *ctrl);
                self.require_uniform(control, by, Rule::Derivatives, span);
                depends.push(self.graph.labelled(&[self.differs], Label::Result(span)));
                self.operands(expression, control, &mut depends);
            }
            Expression::ImageLoad { image, .. } => {
                if self.is_written(*image) {
                    depends.push(self.memory(handle));
                }
                self.operands(expression, control, &mut depends);
            }
            _ => self.operands(expression, control, &mut depends),
        }
        self.graph.node(&depends)
    }

    pub(super) fn operands(
        &mut self,
        expression: &Expression,
        control: Node,
        depends: &mut Vec<Node>,
    ) {
        for operand in super::operands::of(expression) {
            depends.push(self.value(operand, control));
        }
    }

    /// Memory that is not the same for all invocations, read by `reader`.
    pub(super) fn memory(&mut self, reader: Handle<Expression>) -> Node {
        self.graph.labelled(&[self.differs], Label::Memory(reader))
    }

    /// Whether an image can be written while it is read.
    pub(super) fn is_written(&self, image: Handle<Expression>) -> bool {
        let ty = match &self.function.expressions[image] {
            Expression::GlobalVariable(variable) => self.module.global_variables[*variable].ty,
            Expression::FunctionArgument(index) => {
                match self.function.arguments.get(*index as usize) {
                    Some(argument) => argument.ty,
                    None => return false,
                }
            }
            _ => return false,
        };
        matches!(self.module.types[ty].inner,
            TypeInner::Image { class: naga::ImageClass::Storage { access, .. }, .. }
                if access.contains(StorageAccess::STORE))
    }

    /// Where a pointer points.
    pub(super) fn place(&mut self, pointer: Handle<Expression>, control: Node) -> Place {
        let mut place = Place {
            variable: None,
            is_part: false,
            indices: Vec::new(),
            is_constant: false,
        };
        let mut at = pointer;
        loop {
            match self.function.expressions[at] {
                Expression::Access { base, index } => {
                    let index = self.value(index, control);
                    place.indices.push(index);
                    place.is_part = true;
                    at = base;
                }
                Expression::AccessIndex { base, .. } => {
                    place.is_part = true;
                    at = base;
                }
                Expression::LocalVariable(variable) => {
                    place.variable = Some(variable.index());
                    return place;
                }
                Expression::FunctionArgument(index) => {
                    place.variable = self.pointed.get(index as usize).copied().flatten();
                    return place;
                }
                Expression::GlobalVariable(variable) => {
                    place.is_constant = match self.module.global_variables[variable].space {
                        AddressSpace::Uniform | AddressSpace::Handle | AddressSpace::Immediate => {
                            true
                        }
                        AddressSpace::Storage { access } => !access.contains(StorageAccess::STORE),
                        _ => false,
                    };
                    return place;
                }
                _ => return place,
            }
        }
    }
}
