//! Attributes of declarations where they mean nothing (WGSL specification, section 12). naga ignores them.

use core::ops::Range;

use crate::link::tokens::{Kind, Token, tokens};
use crate::{Linked, Rule, ShaderError};

/// What may stand before each kind of declaration. What naga refuses itself is left to it.
const ALLOWED: [(&str, &[&str]); 4] = [
    ("const", &[]),
    ("alias", &[]),
    ("struct", &[]),
    ("override", &["id"]),
];

/// Attributes of declarations that cannot have them.
pub(super) fn check(linked: &Linked) -> Vec<ShaderError> {
    let tokens = tokens(linked.wgsl()).unwrap_or_default();
    let mut found = Vec::new();
    let mut depth = 0_usize;
    let mut attributes: Vec<&Token<'_>> = Vec::new();
    for pair in tokens.windows(2) {
        let [token, next] = pair else { continue };
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth = depth.saturating_sub(1),
            _ => {}
        }
        if matches!(token.text, "{" | "}") {
            attributes.clear();
        }
        if depth > 0 {
            continue;
        }
        if token.is_symbol("@") {
            attributes.push(next);
        }
        if let Some((kind, allowed)) = ALLOWED.iter().find(|(kind, _)| token.is_word(kind)) {
            let wrong = attributes.iter().filter(|it| !allowed.contains(&it.text));
            found.extend(wrong.map(|it| {
                let message = format!(
                    "`{kind}` does not take the attribute `@{}`; remove it",
                    it.text
                );
                refused(linked, it.range(), message)
            }));
        }
        if token.is_word("workgroup_size") && has_both_integers(&tokens, token) {
            let message = "the sizes of a workgroup are all of one type, `i32` or `u32`";
            found.push(refused(linked, token.range(), message.to_owned()));
        }
        if token.is_word("fn") {
            let has = |name: &str| attributes.iter().find(|it| it.text == name);
            if let Some(size) = has("workgroup_size")
                && has("compute").is_none()
            {
                let message =
                    "`@workgroup_size` is of compute shaders only; add `@compute`, or remove it";
                found.push(refused(linked, size.range(), message.to_owned()));
            }
        }
        if matches!(
            token.text,
            "fn" | "const" | "alias" | "struct" | "override" | "var" | ";"
        ) {
            attributes.clear();
        }
    }
    found
}

/// Whether the numbers in the brackets after `attribute` are of both integer types.
fn has_both_integers(tokens: &[Token<'_>], attribute: &Token<'_>) -> bool {
    let after = tokens
        .iter()
        .skip_while(|token| token.start <= attribute.start);
    let inside = after.take_while(|token| !token.is_symbol(")"));
    let numbers = inside.filter(|token| token.kind == Kind::Number);
    let ends = |end: char| numbers.clone().any(|number| number.text.ends_with(end));
    ends('i') && ends('u')
}

fn refused(linked: &Linked, range: Range<usize>, message: String) -> ShaderError {
    ShaderError {
        rule: Rule::Stage,
        message,
        places: linked.location(range).into_iter().collect(),
        notes: Vec::new(),
    }
}
