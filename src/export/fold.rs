//! Branches that a constant decides.

use core::ops::Range;

use crate::link::tokens::{Token, tokens};

/// `text` without what stands behind conditions that are never true. `known` decides a condition, by its tokens.
pub(super) fn fold(text: &str, known: &impl Fn(&[&str]) -> Option<bool>) -> String {
    let mut text = text.to_owned();
    while let Some((range, by)) = first_edit(&text, known) {
        text.replace_range(range, &by);
    }
    text
}

/// An `if` that is decided: the bytes that change, and into what.
fn first_edit(
    text: &str,
    known: &impl Fn(&[&str]) -> Option<bool>,
) -> Option<(Range<usize>, String)> {
    let tokens = tokens(text).ok()?;
    for (at, token) in tokens.iter().enumerate() {
        if !token.is_word("if") {
            continue;
        }
        let open = at + tokens.iter().skip(at).position(|it| it.is_symbol("{"))?;
        let condition: Vec<&str> = tokens.get(at + 1..open)?.iter().map(|it| it.text).collect();
        if let Some(value) = known(&condition) {
            return edit(text, &tokens, at, open, value);
        }
    }
    None
}

fn edit(
    text: &str,
    tokens: &[Token<'_>],
    at: usize,
    open: usize,
    value: bool,
) -> Option<(Range<usize>, String)> {
    let close = closing(tokens, open)?;
    let token = |index: usize| tokens.get(index);
    let is_else = |index: usize| token(index).is_some_and(|it| it.is_word("else"));
    let follows = at.checked_sub(1).is_some_and(is_else);
    let has_else = is_else(close + 1);
    // The last token of the whole chain.
    let mut end = close;
    while is_else(end + 1) {
        let next = tokens
            .iter()
            .skip(end + 1)
            .position(|it| it.is_symbol("{"))?;
        end = closing(tokens, end + 1 + next)?;
    }
    let byte = |index: usize| token(index).map(|it| it.start);
    let after = |index: usize| token(index).map(|it| it.range().end);
    match (value, follows, has_else) {
        // The condition goes, and all that is asked after it.
        (true, true, _) => {
            let block = text.get(byte(open)?..after(close)?)?;
            Some((byte(at)?..after(end)?, block.to_owned()))
        }
        (true, false, _) => {
            let body = body(text, tokens, open, close)?;
            let start = line_start(text, byte(at)?);
            // Nothing is reached behind a return.
            let last = tokens
                .get(open..close)?
                .iter()
                .rposition(|it| it.is_word("return"));
            let returns = last.is_some_and(|last| {
                let rest = tokens.get(open + last..close).unwrap_or_default();
                let inner = rest.iter().any(|it| it.is_symbol("}"));
                !inner
            });
            let end = if returns {
                line_start(text, byte(enclosing(tokens, at)?)?)
            } else {
                after(end)? + 1
            };
            Some((start..end, body))
        }
        (false, _, true) if follows || token(close + 2).is_some_and(|it| it.is_word("if")) => {
            Some((byte(at)?..byte(close + 2)?, String::new()))
        }
        (false, _, true) => {
            let body = body(text, tokens, close + 2, end)?;
            Some((line_start(text, byte(at)?)..after(end)? + 1, body))
        }
        (false, true, false) => Some((after(at - 2)?..after(close)?, String::new())),
        (false, false, false) => Some((
            line_start(text, byte(at)?)..after(close)? + 1,
            String::new(),
        )),
    }
}

/// The lines between two braces, less one indent.
fn body(text: &str, tokens: &[Token<'_>], open: usize, close: usize) -> Option<String> {
    let start = tokens.get(open)?.range().end + 1;
    let end = line_start(text, tokens.get(close)?.start);
    let lines = text.get(start..end)?.lines();
    let lines = lines.map(|line| line.strip_prefix("    ").unwrap_or(line).to_owned() + "\n");
    Some(lines.collect())
}

fn line_start(text: &str, byte: usize) -> usize {
    let before = text.get(..byte).unwrap_or_default();
    before.rfind('\n').map_or(0, |at| at + 1)
}

/// The brace that closes the one at the token `open`.
fn closing(tokens: &[Token<'_>], open: usize) -> Option<usize> {
    let mut depth = 0_usize;
    for (at, token) in tokens.iter().enumerate().skip(open) {
        match token.text {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(at);
        }
    }
    None
}

/// The brace that closes the block which the token `at` is in.
fn enclosing(tokens: &[Token<'_>], at: usize) -> Option<usize> {
    let mut depth = 1_usize;
    for (index, token) in tokens.iter().enumerate().skip(at) {
        match token.text {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(index);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::fold;

    fn folded(body: &str) -> String {
        let known = |condition: &[&str]| match condition {
            ["YES"] => Some(true),
            ["NO"] => Some(false),
            _ => None,
        };
        let text = fold(&format!("fn f() {{\n{body}}}\n"), &known);
        let text = text.strip_prefix("fn f() {\n").unwrap_or_default();
        text.strip_suffix("}\n").unwrap_or_default().to_owned()
    }

    #[test]
    fn branches_that_are_decided_go() {
        let [a, b, c] = ["        a();\n", "        b();\n", "        c();\n"];
        let other = |chain: &str| format!("    if x {{\n{a}    }}{chain}\n    d();\n");
        for (body, expected) in [
            (format!("    if NO {{\n{a}    }}\n    d();\n"), "    d();\n".to_owned()),
            (format!("    if YES {{\n{a}    }}\n    d();\n"), "    a();\n    d();\n".to_owned()),
            (format!("    if NO {{\n{a}    }} else {{\n{b}    }}\n    d();\n"), "    b();\n    d();\n".to_owned()),
            (format!("    if YES {{\n{a}    }} else {{\n{b}    }}\n    d();\n"), "    a();\n    d();\n".to_owned()),
            (
                format!("    if NO {{\n{b}    }} else if x {{\n{a}    }}\n    d();\n"),
                other(""),
            ),
            (other(&format!(" else if NO {{\n{b}    }}")), other("")),
            (
                other(&format!(" else if NO {{\n{b}    }} else {{\n{c}    }}")),
                other(&format!(" else {{\n{c}    }}")),
            ),
            (
                other(&format!(" else if YES {{\n{b}    }} else {{\n{c}    }}")),
                other(&format!(" else {{\n{b}    }}")),
            ),
            // What comes behind a return.
            ("    if YES {\n        return 1;\n    }\n    return 2;\n".to_owned(), "    return 1;\n".to_owned()),
            (
                "    if YES {\n        if x {\n            return 1;\n        }\n    }\n    return 2;\n".to_owned(),
                "    if x {\n        return 1;\n    }\n    return 2;\n".to_owned(),
            ),
        ] {
            assert_eq!(folded(&body), expected, "{body}");
        }
    }
}
