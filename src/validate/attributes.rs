//! Attributes of declarations where they mean nothing (WGSL specification, section 12). naga ignores them.

use core::ops::Range;

use crate::link::tokens::{Kind, Token, tokens};
use crate::{Linked, Rule, ShaderError};

/// What may stand before each kind of declaration.
const ALLOWED: [(&str, &[&str]); 8] = [
    ("const", &[]),
    ("alias", &[]),
    ("struct", &[]),
    ("const_assert", &[]),
    (";", &[]),
    ("override", &["id"]),
    ("var", &["group", "binding", "coherent", "volatile"]),
    (
        "fn",
        &[
            "vertex",
            "fragment",
            "compute",
            "workgroup_size",
            "must_use",
            "diagnostic",
            // naga's own, which need a feature.
            "early_depth_test",
            "task",
            "mesh",
            "payload",
            "ray_generation",
            "miss",
            "any_hit",
            "closest_hit",
            "incoming_payload",
        ],
    ),
];

/// Attributes of declarations that cannot have them.
pub(super) fn check(linked: &Linked) -> Vec<ShaderError> {
    let tokens = tokens(linked.wgsl()).unwrap_or_default();
    let mut found = Vec::new();
    let mut depth = 0_usize;
    let mut attributes: Vec<&Token<'_>> = Vec::new();
    for (index, token) in tokens.iter().enumerate() {
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth = depth.saturating_sub(1),
            _ => {}
        }
        // Those of a function's result stand before its body.
        if matches!(token.text, "{" | "}") {
            attributes.clear();
        }
        if depth > 0 {
            continue;
        }
        if token.is_symbol("@") {
            attributes.extend(tokens.get(index + 1));
        }
        if token.is_word("workgroup_size") && has_both_integers(&tokens, token) {
            let message = "the sizes of a workgroup are all of one type, `i32` or `u32`";
            found.push(refused(linked, token.range(), message.to_owned()));
        }
        let Some((kind, allowed)) = ALLOWED.iter().find(|(kind, _)| token.text == *kind) else {
            continue;
        };
        let wrong = attributes.iter().filter(|it| !allowed.contains(&it.text));
        found.extend(wrong.map(|it| {
            let message = format!(
                "`{kind}` does not take the attribute `@{}`; remove it",
                it.text
            );
            refused(linked, it.range(), message)
        }));
        let has = |name: &str| attributes.iter().find(|it| it.text == name);
        if let Some(size) = has("workgroup_size")
            && token.is_word("fn")
            && has("compute").or(has("task")).or(has("mesh")).is_none()
        {
            let message =
                "`@workgroup_size` is of compute shaders only; add `@compute`, or remove it";
            found.push(refused(linked, size.range(), message.to_owned()));
        }
        attributes.clear();
    }
    found.extend(attributes.first().map(|attribute| {
        let message = format!("no declaration follows the attribute `@{}`", attribute.text);
        refused(linked, attribute.range(), message)
    }));
    found
}

/// Whether the numbers and constants in the brackets after `attribute` are of both integer types.
fn has_both_integers(tokens: &[Token<'_>], attribute: &Token<'_>) -> bool {
    let after = tokens
        .iter()
        .skip_while(|token| token.start <= attribute.start);
    let inside = after.take_while(|token| !token.is_symbol(")"));
    let types: Vec<char> = inside
        .filter_map(|token| integer_type(tokens, token))
        .collect();
    types.contains(&'i') && types.contains(&'u')
}

/// `i` or `u` for a number with that suffix, and for a constant or override that is declared of that type.
fn integer_type(tokens: &[Token<'_>], of: &Token<'_>) -> Option<char> {
    let suffix = |token: &Token<'_>| token.text.chars().last().filter(|end| "iu".contains(*end));
    if of.kind == Kind::Number {
        return suffix(of);
    }
    let declared = tokens.windows(4).find_map(|window| match window {
        [keyword, name, next, value]
            if matches!(keyword.text, "const" | "override") && name.text == of.text =>
        {
            Some((next, value))
        }
        _ => None,
    });
    match declared? {
        (colon, ty) if colon.is_symbol(":") => match ty.text {
            "i32" => Some('i'),
            "u32" => Some('u'),
            _ => None,
        },
        (_, value) if value.kind == Kind::Number => suffix(value),
        _ => None,
    }
}

fn refused(linked: &Linked, range: Range<usize>, message: String) -> ShaderError {
    ShaderError {
        rule: Rule::Stage,
        message,
        places: linked.location(range).into_iter().collect(),
        notes: Vec::new(),
    }
}
