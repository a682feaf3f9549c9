//! What naga's validator says, in words: the fault first, expressions as they stand in the text, types by their names.

use naga::common::wgsl::TryToWgsl;
use naga::valid::{
    CallError, Disalignment, EntryPointError, ExpressionError, FunctionError, GlobalVariableError,
    LiteralError, TypeError, ValidationError, VaryingError, WidthError,
};
use naga::{Expression, Function, Handle, Span, Statement, Type};

use super::words::{Words, innermost};
use super::{features, flow, stage, statements};
use crate::Rule;

/// A fault in words.
pub(super) struct Said {
    pub(super) rule: Rule,
    pub(super) message: String,
    /// The place of the fault, where naga's own is that of all around it.
    pub(super) span: Option<Span>,
    /// The name of the declaration that holds the fault.
    pub(super) within: Option<String>,
    pub(super) notes: Vec<String>,
}

impl Said {
    fn new(rule: Rule, message: impl Into<String>) -> Self {
        Self {
            rule,
            message: message.into(),
            span: None,
            within: None,
            notes: Vec::new(),
        }
    }

    fn wgsl(message: impl Into<String>) -> Self {
        Self::new(Rule::Wgsl, message)
    }

    fn noted(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }
}

impl Words<'_> {
    /// The fault in words.
    pub(super) fn of(&self, error: &ValidationError) -> Said {
        use ValidationError as E;
        let (mut said, within) = match error {
            E::Function {
                handle,
                name,
                source,
            } => (self.function(&self.module.functions[*handle], source), name),
            E::EntryPoint { name, source, .. } => (self.entry_point(name, source), name),
            E::GlobalVariable { name, source, .. } => (self.variable(name, source), name),
            E::Type {
                handle,
                name,
                source,
            } => (self.type_error(*handle, source), name),
            E::Constant { name, source, .. } => (
                Said::wgsl(format!("constant `{name}`: {}", innermost(source))),
                name,
            ),
            E::Override { name, source, .. } => (
                Said::wgsl(format!("override `{name}`: {}", innermost(source))),
                name,
            ),
            E::ConstExpression { handle, source } => {
                let span = self.module.global_expressions.get_span(*handle);
                let mut said = Said::wgsl(format!(
                    "{} has no value: {}",
                    self.quoted(span),
                    innermost(source)
                ));
                said.span = Some(span);
                return said;
            }
            E::ArraySizeError { handle } => {
                let span = self.module.global_expressions.get_span(*handle);
                let mut said = Said::wgsl(format!(
                    "{} is the size of an array, and not above 0",
                    self.quoted(span)
                ));
                said.span = Some(span);
                return said;
            }
            E::InvalidHandle(_) | E::Layouter(_) | E::Corrupted => {
                return Said::wgsl(innermost(error));
            }
        };
        said.within = Some(within.clone()).filter(|name| !name.is_empty());
        if let E::Type { handle, .. } = error
            && said.within.is_none()
        {
            let scalar = self.module.types[*handle].inner.scalar();
            said.within = scalar.and_then(TryToWgsl::try_to_wgsl).map(str::to_owned);
        }
        said
    }

    fn entry_point(&self, name: &str, error: &EntryPointError) -> Said {
        use EntryPointError as E;
        let found = self.module.entry_points.iter().find(|it| it.name == name);
        match (error, found) {
            (E::Function(error), Some(found)) => self.function(&found.function, error),
            (E::Argument(index, error), Some(found)) => {
                let argument = found.function.arguments.get(*index as usize);
                let argument = argument
                    .and_then(|it| it.name.as_deref())
                    .unwrap_or_default();
                self.varying(
                    &format!("parameter `{argument}` of entry point `{name}`"),
                    error,
                )
            }
            (E::Result(error), _) => {
                self.varying(&format!("the result of entry point `{name}`"), error)
            }
            (E::InvalidGlobalUsage(handle, _), _)
                if self.is_storage_texture(self.module.global_variables[*handle].ty)
                    && self.takes_storage_texture() =>
            {
                let mut said = Said::new(Rule::Unsupported, PARAMETER);
                said.span = Some(self.module.global_variables.get_span(*handle));
                said
            }
            (E::BindingCollision(handle) | E::InvalidGlobalUsage(handle, _), _) => {
                let variable = &self.module.global_variables[*handle];
                let of = variable.name.as_deref().unwrap_or_default();
                let mut said = match error {
                    E::BindingCollision(_) => Said::wgsl(format!(
                        "variable `{of}` has the group and binding of another variable that entry point `{name}` uses"
                    )),
                    _ => Said::wgsl(format!(
                        "entry point `{name}` uses variable `{of}` in a way that its address space does not allow"
                    )),
                };
                said.span = Some(self.module.global_variables.get_span(*handle));
                said
            }
            (E::UnsupportedCapability(needed), _) => feature(*needed),
            (E::ForbiddenStageOperations, found) => {
                let forbidden = found.and_then(|it| stage::forbidden(self.module, it));
                let what = forbidden.map_or("operations", |(what, _)| what);
                let mut said = Said::new(
                    Rule::Stage,
                    format!("entry point `{name}` uses {what}, which its stage does not have"),
                );
                said.span = forbidden.map(|(_, span)| span);
                said
            }
            _ => Said::wgsl(format!("entry point `{name}`: {}", self.plain(error, None))),
        }
    }

    fn varying(&self, what: &str, error: &VaryingError) -> Said {
        match error {
            VaryingError::InvalidType(ty) | VaryingError::NotIOShareableType(ty) => {
                Said::wgsl(format!(
                    "{what} has type {}, which cannot go from stage to stage: numbers and vectors of them can",
                    self.ty(*ty)
                ))
            }
            VaryingError::UnsupportedCapability(needed) => feature(*needed),
            VaryingError::InvalidBuiltInStage(_) => {
                Said::new(Rule::Stage, format!("{what}: {error}"))
            }
            _ => Said::wgsl(format!("{what}: {}", self.plain(error, None))),
        }
    }

    fn variable(&self, name: &str, error: &GlobalVariableError) -> Said {
        use GlobalVariableError as E;
        match error {
            E::UnsupportedCapability(needed) => feature(*needed),
            E::Alignment(_, ty, Disalignment::NonHostShareable) => Said::wgsl(format!(
                "variable `{name}` is a buffer, and {} holds what buffers cannot, such as `bool`",
                self.ty(*ty)
            )),
            E::Alignment(_, ty, _) if self.is_unsized(*ty) => Said::wgsl(format!(
                "variable `{name}` is of type {}, which has no fixed size: only storage buffers hold it",
                self.ty(*ty)
            )),
            E::Alignment(_, ty, why) => Said::new(
                Rule::Unsupported,
                format!(
                    "variable `{name}` is a uniform buffer, whose layout {} does not have: {why}",
                    self.ty(*ty)
                ),
            )
            .noted("arrays and structs in uniform buffers lie at multiples of 16 bytes; browsers with the language feature `uniform_buffer_standard_layout` do without"),
            E::InvalidBinding => Said::wgsl(format!(
                "variable `{name}` needs `@group` and `@binding`, or is of an address space that has none"
            )),
            _ => Said::wgsl(format!("variable `{name}`: {}", self.plain(error, None))),
        }
    }

    fn type_error(&self, handle: Handle<Type>, error: &TypeError) -> Said {
        match error {
            TypeError::MissingCapability(needed) => feature(*needed),
            TypeError::WidthError(WidthError::Abstract) => Said::new(
                Rule::Unsupported,
                "naga cannot give a type to a vector or matrix of numbers without one; give them a suffix (`1.0f`)",
            ),
            TypeError::WidthError(WidthError::MissingCapability { name, flag }) => {
                let allowed = naga::valid::Capabilities::from_name(flag);
                let mut said = feature(allowed.unwrap_or(naga::valid::Capabilities::empty()));
                said.message = format!("type `{name}` is optional; {}", said.message);
                said
            }
            _ => Said::wgsl(format!(
                "type {}: {}",
                self.ty(handle),
                self.plain(error, None)
            )),
        }
    }

    fn function(&self, function: &Function, error: &FunctionError) -> Said {
        use FunctionError as E;
        let quoted = |handle: Handle<Expression>| self.expression(function, handle);
        match error {
            E::Expression { handle, source } => {
                let mut said = self.of_expression(function, *handle, source);
                said.span = self.span(function, *handle);
                said
            }
            E::InvalidCall { function: callee, error } => {
                let callee = &self.module.functions[*callee];
                self.call(function, callee, error)
            }
            E::InvalidArgumentPointerSpace { name, space, .. } => Said::new(
                Rule::Unsupported,
                format!(
                    "parameter `{name}` is a pointer to {} memory, which naga does not pass to functions yet",
                    space_name(*space)
                ),
            )
            .noted("use the variable itself in the function, or give it a value"),
            E::InvalidReturnType { expression: None, expected_ty } => {
                let ty = expected_ty.map_or(String::new(), |ty| format!(" of {}", self.ty(ty)));
                if self.at.starts_with("return") {
                    Said::wgsl(format!("this `return` has no value, and the function gives one{ty}"))
                } else if flow::never_ends(function) {
                    Said::new(
                        Rule::Unsupported,
                        "naga wants a `return` at the end of a function, even after a loop that is never left for it",
                    )
                } else {
                    Said::wgsl(format!(
                        "the end of the function is reached without `return`{ty}"
                    ))
                }
            }
            E::InvalidReturnType { expression: Some(value), expected_ty } => {
                let mut said = Said::wgsl(match expected_ty {
                    Some(ty) => format!("{} is returned, and the function gives {}", quoted(*value), self.ty(*ty)),
                    None => format!("{} is returned, and the function gives nothing", quoted(*value)),
                });
                let span = self.span(function, *value);
                said.span = span.or_else(|| Some(statement_with(function, *value)));
                said
            }
            E::InvalidStoreTypes { pointer, value } => {
                let mut said = Said::wgsl(format!(
                "{} is assigned to {}, which is of another type",
                quoted(*value),
                quoted(*pointer)
            ));
                let span = self.span(function, *value);
                said.span = span.or_else(|| Some(statement_with(function, *value)));
                said
            }
            E::InvalidStorePointer(pointer) => {
                Said::wgsl(format!("{} cannot be assigned to", quoted(*pointer)))
            }
            E::InvalidIfType(condition) => {
                Said::wgsl(format!("the condition {} is no bool", quoted(*condition)))
            }
            E::InvalidSwitchType(selector) => {
                Said::wgsl(format!("the selector {} is no integer", quoted(*selector)))
            }
            E::InvalidStoreValue { actual, expected_ty, .. } => Said::wgsl(format!(
                "{} is stored in a texture that takes {}",
                quoted(*actual),
                self.inner(expected_ty)
            )),
            E::MissingCapability(needed) => feature(*needed),
            E::InvalidImageStore(ExpressionError::ExpectedGlobalVariable) => {
                Said::new(Rule::Unsupported, PARAMETER)
            }
            E::InvalidImageStore(error) | E::InvalidImageAtomic(error) => {
                Said::wgsl(self.plain(error, Some(function)))
            }
            E::InvalidAtomic(error) => Said::wgsl(self.plain(error, Some(function))),
            _ => Said::wgsl(self.plain(error, Some(function))),
        }
    }

    fn of_expression(
        &self,
        function: &Function,
        handle: Handle<Expression>,
        error: &ExpressionError,
    ) -> Said {
        use ExpressionError as E;
        let quoted = |handle: Handle<Expression>| self.expression(function, handle);
        match error {
            E::InvalidBinaryOperandTypes {
                lhs_expr,
                lhs_type,
                rhs_expr,
                rhs_type,
                ..
            } => Said::wgsl(format!(
                "{} has no meaning for {} of type {} and {} of type {}",
                quoted(handle),
                quoted(*lhs_expr),
                self.inner(lhs_type),
                quoted(*rhs_expr),
                self.inner(rhs_type)
            )),
            E::SelectValuesTypeMismatch { accept, reject } => Said::wgsl(format!(
                "`select` has values of type {} and {}; both are of one type",
                self.inner(reject),
                self.inner(accept)
            )),
            E::SelectConditionNotABool { actual } => Said::wgsl(format!(
                "the condition of `select` is of type {}, not bool",
                self.inner(actual)
            )),
            E::InvalidZeroValue(ty) => {
                Said::wgsl(format!("type {} has no zero value", self.ty(*ty)))
            }
            E::MissingCapabilities(needed) => feature(*needed),
            E::Literal(LiteralError::Width(WidthError::Abstract))
                if function.result.is_none() && statement_with(function, handle).is_defined() =>
            {
                Said::wgsl(format!(
                    "{} is returned, and the function gives nothing",
                    quoted(handle)
                ))
            }
            E::ExpectedGlobalVariable => Said::new(Rule::Unsupported, PARAMETER),
            E::DivideByZero
            | E::ShiftAmountTooLarge { .. }
            | E::IndexOutOfBounds(..)
            | E::NegativeIndex(_)
                if self.let_in(function, handle).is_some() =>
            {
                let name = self.let_in(function, handle).unwrap_or_default();
                Said::new(
                    Rule::Unsupported,
                    format!("naga takes `{name}` for a constant, with which {} has no value; WGSL has none in a `let`", quoted(handle)),
                )
                .noted("declare it as `var`")
            }
            E::Literal(LiteralError::Width(WidthError::Abstract))
                if is_argument(function, handle) =>
            {
                Said::new(
                    Rule::Unsupported,
                    format!(
                        "{} is an argument of a builtin function that naga cannot give a type to",
                        quoted(handle)
                    ),
                )
                .noted("give one of the arguments a suffix (`1.0f`)")
            }
            E::ShiftAmountTooLarge { lhs_type, rhs_expr } => Said::wgsl(format!(
                "{} is more than a value of type {} can be shifted by",
                quoted(*rhs_expr),
                self.inner(lhs_type)
            )),
            _ => Said::wgsl(format!(
                "{}: {}",
                quoted(handle),
                self.plain(error, Some(function))
            )),
        }
    }

    fn call(&self, function: &Function, callee: &Function, error: &CallError) -> Said {
        let name = callee.name.as_deref().unwrap_or_default();
        match error {
            CallError::ArgumentCount { required, seen } => Said::wgsl(format!(
                "`{name}` takes {required} arguments, and {seen} are given"
            )),
            CallError::ArgumentType {
                index,
                required,
                seen_expression,
            } => {
                let mut said = Said::wgsl(format!(
                    "argument {} of `{name}` is {}, and has to be of type {}",
                    index + 1,
                    self.expression(function, *seen_expression),
                    self.ty(*required)
                ));
                said.span = self.span(function, *seen_expression);
                said
            }
            CallError::Argument { index, source } => Said::wgsl(format!(
                "argument {} of `{name}`: {}",
                index + 1,
                self.plain(source, Some(function))
            )),
            _ => Said::wgsl(format!(
                "call of `{name}`: {}",
                self.plain(error, Some(function))
            )),
        }
    }
}

/// Where the expression is returned or assigned.
fn statement_with(function: &Function, handle: Handle<Expression>) -> Span {
    let mut found = Span::UNDEFINED;
    statements::each(&function.body, &mut |statement, span| {
        let value = match statement {
            Statement::Return { value } => *value,
            Statement::Store { value, .. } => Some(*value),
            _ => None,
        };
        if value == Some(handle) {
            found = span;
        }
    });
    found
}

/// What naga does not do with storage textures.
pub(super) const PARAMETER: &str =
    "naga uses storage textures by their variables only, not by the parameter of a function";

/// Whether a builtin function is called with the expression.
fn is_argument(function: &Function, handle: Handle<Expression>) -> bool {
    let mut expressions = function.expressions.iter();
    expressions.any(|(_, expression)| match expression {
        Expression::Math {
            arg,
            arg1,
            arg2,
            arg3,
            ..
        } => *arg == handle || [arg1, arg2, arg3].contains(&&Some(handle)),
        _ => false,
    })
}

/// A shader that needs features beyond the profile's.
fn feature(needed: naga::valid::Capabilities) -> Said {
    let names = features::names_of(needed);
    Said::new(
        Rule::Feature,
        format!("this needs {names}, which the profile does not have"),
    )
    .noted("allow the feature (`--allow`) if all devices that the shader is for have it")
}

fn space_name(space: naga::AddressSpace) -> &'static str {
    use naga::AddressSpace as S;
    match space {
        S::Function => "function",
        S::Private => "private",
        S::WorkGroup => "workgroup",
        S::Uniform => "uniform",
        S::Storage { .. } => "storage",
        S::Handle => "texture or sampler",
        S::Immediate => "immediate",
        S::TaskPayload | S::RayPayload | S::IncomingRayPayload => "payload",
    }
}
