//! Expressions and types in the words of the shader.

use core::error::Error;
use core::ops::Range;

use naga::common::wgsl::TypeContext;
use naga::{ArraySize, Expression, Function, Handle, ImageClass, Module, Span, Type, TypeInner};

use super::lets;

/// A text and what naga made of it.
pub(super) struct Words<'a> {
    pub(super) module: &'a Module,
    pub(super) text: &'a str,
    /// What stands at naga's innermost place.
    pub(super) at: &'a str,
}

impl Words<'_> {
    /// The innermost cause in naga's words, with expressions and types in place of their numbers.
    pub(super) fn plain(
        &self,
        error: &(dyn Error + 'static),
        function: Option<&Function>,
    ) -> String {
        let said = innermost(error);
        let mut plain = String::new();
        let mut rest = said.as_str();
        while let Some(open) = rest.find('[') {
            let (before, from) = rest.split_at(open);
            let close = from.find(']').unwrap_or(0);
            let number = from
                .get(1..close)
                .and_then(|number| number.parse::<usize>().ok());
            plain += before;
            match (number, function) {
                (Some(index), Some(function)) => {
                    let mut expressions = function.expressions.iter();
                    plain += &match expressions.nth(index) {
                        Some((handle, _)) => self.expression(function, handle),
                        None => "an expression".to_owned(),
                    };
                }
                (Some(index), None) => {
                    let mut types = self.module.types.iter();
                    plain += &types
                        .nth(index)
                        .map_or("a type".to_owned(), |(ty, _)| self.ty(ty));
                }
                (None, _) => plain.push('['),
            }
            rest = match number {
                Some(_) => from.get(close + 1..).unwrap_or_default(),
                None => from.get(1..).unwrap_or_default(),
            };
        }
        plain + rest.trim_end_matches('.')
    }

    /// Where an expression stands; `None` for variables and parameters, of which naga knows their declarations only.
    pub(super) fn span(&self, function: &Function, handle: Handle<Expression>) -> Option<Span> {
        let is_declared = matches!(
            function.expressions[handle],
            Expression::FunctionArgument(_)
                | Expression::LocalVariable(_)
                | Expression::GlobalVariable(_)
        );
        (!is_declared).then(|| function.expressions.get_span(handle))
    }

    /// The name of a `let` in an expression.
    pub(super) fn let_in<'b>(
        &self,
        function: &'b Function,
        handle: Handle<Expression>,
    ) -> Option<&'b str> {
        let range = function.expressions.get_span(handle).to_range()?;
        let text = self.text.get(range.clone())?;
        // Of an access only its index has to be a constant in its range.
        let index = text.ends_with(']').then(|| text.rfind('[')).flatten();
        let range = range.start + index.unwrap_or_default()..range.end;
        lets::within(function, Some(range), self.text)
    }

    pub(super) fn is_storage_texture(&self, ty: Handle<Type>) -> bool {
        let inner = &self.module.types[ty].inner;
        matches!(
            inner,
            TypeInner::Image {
                class: ImageClass::Storage { .. },
                ..
            }
        )
    }

    /// Whether a function has a storage texture among its parameters.
    pub(super) fn takes_storage_texture(&self) -> bool {
        let functions = self.module.functions.iter();
        let mut parameters = functions.flat_map(|(_, function)| &function.arguments);
        parameters.any(|parameter| self.is_storage_texture(parameter.ty))
    }

    pub(super) fn is_unsized(&self, ty: Handle<Type>) -> bool {
        matches!(
            self.module.types[ty].inner,
            TypeInner::Array {
                size: ArraySize::Dynamic,
                ..
            }
        )
    }

    /// An expression as it stands in the text.
    pub(super) fn expression(&self, function: &Function, handle: Handle<Expression>) -> String {
        let variable = match function.expressions[handle] {
            Expression::LocalVariable(handle) => function.local_variables[handle].name.clone(),
            Expression::GlobalVariable(handle) => self.module.global_variables[handle].name.clone(),
            Expression::FunctionArgument(index) => {
                let argument = function.arguments.get(index as usize);
                argument.and_then(|it| it.name.clone())
            }
            _ => None,
        };
        match variable {
            Some(name) => format!("`{name}`"),
            None => self.quoted(function.expressions.get_span(handle)),
        }
    }

    pub(super) fn quoted(&self, span: Span) -> String {
        let range = span.to_range().unwrap_or(Range { start: 0, end: 0 });
        let text = self.text.get(range).unwrap_or_default();
        let words: Vec<&str> = text.split_whitespace().collect();
        let text = words.join(" ");
        const LONGEST: usize = 60;
        match text.char_indices().nth(LONGEST) {
            _ if text.is_empty() => "an expression".to_owned(),
            Some((end, _)) => format!("`{}…`", text.get(..end).unwrap_or_default()),
            None => format!("`{text}`"),
        }
    }

    pub(super) fn ty(&self, ty: Handle<Type>) -> String {
        format!("`{}`", self.module.to_ctx().type_to_string(ty))
    }

    pub(super) fn inner(&self, inner: &TypeInner) -> String {
        let mut name = String::new();
        // Writing to a string cannot fail.
        let _ = self.module.to_ctx().write_type_inner(inner, &mut name);
        format!("`{name}`")
    }
}

/// What the innermost cause says.
pub(super) fn innermost(error: &(dyn Error + 'static)) -> String {
    let mut at = error;
    while let Some(source) = at.source() {
        at = source;
    }
    at.to_string()
}
