//! Functions run on the processor, so that what a port has to give is known without an adapter.

mod maths;
mod operators;
mod rounding;
mod value;

use naga::{Arena, Block, Expression, Function, Handle, Module, Statement, TypeInner};

use operators::{binary, converted, unary};
pub(super) use rounding::{Rounding, Rule};
pub(super) use value::Value;

/// A module whose functions are run.
pub(super) struct Machine<'a> {
    module: &'a Module,
    rounding: Rounding,
}

/// A call: what its expressions and variables hold.
struct Frame<'a> {
    function: &'a Function,
    arguments: Vec<Value>,
    values: Vec<Option<Value>>,
    variables: Vec<Value>,
}

/// What comes after a statement.
enum Flow {
    Next,
    Break,
    Continue,
    Return(Value),
}

impl<'a> Machine<'a> {
    pub(super) fn new(module: &'a Module, rounding: Rounding) -> Self {
        Self { module, rounding }
    }

    /// The value of a function. `None` for what is not implemented here: all that a file without bindings, integers beyond 32 bits and
    /// matrix products has no use for.
    pub(super) fn call(
        &mut self,
        function: Handle<Function>,
        arguments: &[Value],
    ) -> Option<Value> {
        let function = &self.module.functions[function];
        let mut frame = Frame {
            function,
            arguments: arguments.to_vec(),
            values: vec![None; function.expressions.len()],
            variables: Vec::new(),
        };
        for (_, variable) in function.local_variables.iter() {
            let value = match variable.init {
                Some(init) => self.evaluate(&mut frame, init)?,
                None => Value::zero(self.module, variable.ty)?,
            };
            frame.variables.push(value);
        }
        match self.block(&mut frame, &function.body)? {
            Flow::Return(value) => Some(value),
            Flow::Next | Flow::Break | Flow::Continue => None,
        }
    }

    fn block(&mut self, frame: &mut Frame<'a>, block: &'a Block) -> Option<Flow> {
        for statement in block {
            match self.statement(frame, statement)? {
                Flow::Next => {}
                flow => return Some(flow),
            }
        }
        Some(Flow::Next)
    }

    fn statement(&mut self, frame: &mut Frame<'a>, statement: &'a Statement) -> Option<Flow> {
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    let value = self.expression(frame, handle)?;
                    frame.values[handle.index()] = Some(value);
                }
            }
            Statement::Block(block) => return self.block(frame, block),
            Statement::If {
                condition,
                accept,
                reject,
            } => {
                let chosen = self.evaluate(frame, *condition)?.bool()?;
                return self.block(frame, if chosen { accept } else { reject });
            }
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => loop {
                match self.block(frame, body)? {
                    Flow::Break => break,
                    Flow::Return(value) => return Some(Flow::Return(value)),
                    Flow::Next | Flow::Continue => {}
                }
                self.block(frame, continuing)?;
                if let Some(condition) = break_if
                    && self.evaluate(frame, *condition)?.bool()?
                {
                    break;
                }
            },
            Statement::Break => return Some(Flow::Break),
            Statement::Continue => return Some(Flow::Continue),
            Statement::Return { value } => {
                return Some(Flow::Return(self.evaluate(frame, (*value)?)?));
            }
            Statement::Store { pointer, value } => {
                let value = self.evaluate(frame, *value)?;
                let pointer = self.evaluate(frame, *pointer)?;
                *pointer.place(&mut frame.variables)? = value;
            }
            Statement::Call {
                function,
                arguments,
                result,
            } => {
                let arguments = arguments.iter().map(|it| self.evaluate(frame, *it));
                let arguments: Vec<Value> = arguments.collect::<Option<_>>()?;
                let value = self.call(*function, &arguments)?;
                frame.values[(*result)?.index()] = Some(value);
            }
            _ => return None,
        }
        Some(Flow::Next)
    }

    /// What an expression holds, or is where it need not be emitted.
    fn evaluate(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>) -> Option<Value> {
        match &frame.values[handle.index()] {
            Some(value) => Some(value.clone()),
            None => self.expression(frame, handle),
        }
    }

    fn expression(&mut self, frame: &mut Frame<'a>, handle: Handle<Expression>) -> Option<Value> {
        let module = self.module;
        match &frame.function.expressions[handle] {
            Expression::FunctionArgument(index) => frame.arguments.get(*index as usize).cloned(),
            Expression::LocalVariable(handle) => Some(Value::Pointer(handle.index(), Vec::new())),
            Expression::Load { pointer } => {
                let pointer = self.evaluate(frame, *pointer)?;
                pointer.place(&mut frame.variables).cloned()
            }
            Expression::Access { base, index } => {
                let base = self.evaluate(frame, *base)?;
                let index = match self.evaluate(frame, *index)? {
                    Value::U(index) => index as usize,
                    Value::I(index) => usize::try_from(index).ok()?,
                    _ => return None,
                };
                base.part(index)
            }
            Expression::AccessIndex { base, index } => {
                self.evaluate(frame, *base)?.part(*index as usize)
            }
            Expression::Swizzle {
                size,
                vector,
                pattern,
            } => {
                let vector = self.evaluate(frame, *vector)?;
                let parts = pattern.iter().take(*size as usize);
                let parts = parts.map(|component| vector.part(*component as usize));
                Some(Value::Many(parts.collect::<Option<_>>()?))
            }
            Expression::Unary { op, expr } => {
                let value = self.evaluate(frame, *expr)?;
                value.map(&mut |it| unary(*op, it))
            }
            Expression::Binary { op, left, right } => {
                let left = self.evaluate(frame, *left)?;
                let right = self.evaluate(frame, *right)?;
                let rounding = &mut self.rounding;
                Value::zip(&[left, right], &mut |it| {
                    binary(*op, it[0], it[1], rounding)
                })
            }
            Expression::Select {
                condition,
                accept,
                reject,
            } => {
                let condition = self.evaluate(frame, *condition)?;
                let accept = self.evaluate(frame, *accept)?;
                let reject = self.evaluate(frame, *reject)?;
                match condition {
                    Value::B(chosen) => Some(if chosen { accept } else { reject }),
                    _ => Value::zip(&[condition, accept, reject], &mut |it| {
                        Some(if it[0].bool()? { it[1] } else { it[2] }.clone())
                    }),
                }
            }
            Expression::Relational { fun, argument } => {
                let Value::Many(parts) = self.evaluate(frame, *argument)? else {
                    return None;
                };
                let mut parts = parts.iter().map(|part| part.bool().unwrap_or_default());
                match fun {
                    naga::RelationalFunction::All => Some(Value::B(parts.all(|it| it))),
                    naga::RelationalFunction::Any => Some(Value::B(parts.any(|it| it))),
                    _ => None,
                }
            }
            Expression::Math {
                fun,
                arg,
                arg1,
                arg2,
                ..
            } => {
                let mut arguments = vec![self.evaluate(frame, *arg)?];
                for argument in [arg1, arg2].into_iter().flatten() {
                    arguments.push(self.evaluate(frame, *argument)?);
                }
                maths::apply(*fun, &arguments, &mut self.rounding)
            }
            Expression::As {
                expr,
                kind,
                convert,
            } => {
                let value = self.evaluate(frame, *expr)?;
                value.map(&mut |it| match convert {
                    None => Some(Value::of_bits(it.bits()?, *kind)),
                    Some(_) => converted(it, *kind),
                })
            }
            _ => {
                let expressions = &frame.function.expressions;
                let mut of = |handle| self.evaluate(frame, handle);
                composed(module, expressions, handle, &mut of)
            }
        }
    }

    fn constant(module: &Module, handle: Handle<Expression>) -> Option<Value> {
        let expressions = &module.global_expressions;
        let mut of = |handle| Self::constant(module, handle);
        composed(module, expressions, handle, &mut of)
    }
}

/// Expressions that constants may be, too.
fn composed(
    module: &Module,
    expressions: &Arena<Expression>,
    handle: Handle<Expression>,
    of: &mut dyn FnMut(Handle<Expression>) -> Option<Value>,
) -> Option<Value> {
    match &expressions[handle] {
        Expression::Literal(literal) => Value::of_literal(*literal),
        Expression::Constant(constant) => {
            Machine::constant(module, module.constants[*constant].init)
        }
        Expression::ZeroValue(ty) => Value::zero(module, *ty),
        Expression::Splat { size, value } => {
            let value = of(*value)?;
            Some(Value::Many(vec![value; *size as usize]))
        }
        Expression::Compose { ty, components } => {
            let parts = components.iter().map(|component| of(*component));
            let parts: Vec<Value> = parts.collect::<Option<_>>()?;
            // A vector is made of vectors too.
            let is_vector = matches!(module.types[*ty].inner, TypeInner::Vector { .. });
            let parts = parts.into_iter().flat_map(|part| match part {
                Value::Many(parts) if is_vector => parts,
                part => vec![part],
            });
            Some(Value::Many(parts.collect()))
        }
        _ => None,
    }
}
