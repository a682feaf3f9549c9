//! `let` declarations, which are no constants, whatever their values are. naga takes their values for constants.

use core::ops::Range;

use naga::{Expression, Function, Handle};

use crate::link::tokens::{Kind, Token, tokens};

/// The name of a `let` of `function` that an expression is.
pub(super) fn named<'a>(
    function: &'a Function,
    handle: Handle<Expression>,
    text: &str,
) -> Option<&'a str> {
    let name = function.named_expressions.get(&handle)?;
    is_let(text, name).then_some(name)
}

/// The name of a `let` of `function` that naga takes for a constant, and that stands in the bytes `range` of the text.
pub(super) fn within<'a>(
    function: &'a Function,
    range: Option<Range<usize>>,
    text: &str,
) -> Option<&'a str> {
    let words = tokens(text.get(range?)?).unwrap_or_default();
    let stands = |name: &str| {
        let mut words = words.iter().filter(|token| token.kind == Kind::Word);
        words.any(|word| word.text == name)
    };
    let mut named = function.named_expressions.iter();
    let found = named.find(|(handle, name)| {
        // Parameters and local constants have names, too.
        let is_constant = matches!(
            function.expressions[**handle],
            Expression::Literal(_)
                | Expression::Constant(_)
                | Expression::Override(_)
                | Expression::ZeroValue(_)
                | Expression::Compose { .. }
                | Expression::Splat { .. }
        );
        is_constant && stands(name) && is_let(text, name)
    });
    found.map(|(_, name)| name.as_str())
}

/// Whether a text declares the name by `let`.
fn is_let(text: &str, name: &str) -> bool {
    let tokens: Vec<Token<'_>> = tokens(text).unwrap_or_default();
    tokens
        .windows(2)
        .any(|pair| matches!(pair, [keyword, of] if keyword.is_word("let") && of.is_word(name)))
}
