//! `let` declarations, which are no constants, whatever their values are. naga takes their values for constants.

use naga::{Expression, Function, Handle};

use crate::link::tokens::{Kind, tokens};

/// The name of a `let` of `function` that an expression is, or that stands in its text.
pub(super) fn named<'a>(
    function: &'a Function,
    handle: Handle<Expression>,
    text: &str,
) -> Option<&'a str> {
    if let Some(name) = function.named_expressions.get(&handle) {
        return Some(name);
    }
    let tokens = tokens(text).unwrap_or_default();
    let mut names = function.named_expressions.values();
    let name = names.find(|name| {
        tokens
            .iter()
            .any(|token| token.kind == Kind::Word && token.text == name.as_str())
    });
    name.map(String::as_str)
}
