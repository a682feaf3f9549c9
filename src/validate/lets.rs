//! `let` declarations, which are no constants, whatever their values are. naga takes their values for constants.

use naga::{Expression, Function, Handle};

use crate::link::tokens::{Kind, tokens};

/// Whether an expression is a `let` of `function`, or one stands in its text.
pub(super) fn decide(function: &Function, handle: Handle<Expression>, text: &str) -> bool {
    function.named_expressions.contains_key(&handle) || within(function, text).is_some()
}

/// The name of a `let` of `function` that stands in the text of an expression.
pub(super) fn within<'a>(function: &'a Function, text: &str) -> Option<&'a str> {
    let tokens = tokens(text).unwrap_or_default();
    let mut names = function.named_expressions.values();
    let name = names.find(|name| {
        tokens
            .iter()
            .any(|token| token.kind == Kind::Word && token.text == name.as_str())
    });
    name.map(String::as_str)
}
