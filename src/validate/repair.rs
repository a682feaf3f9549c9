//! A text without the function in which a fault was found, so that the next can be found.

use core::ops::Range;

use crate::link::tokens::{Token, tokens};

/// `text` with `return` of a zero in place of all that the function around `place` does. Lines stay. `None` if no function has the place
/// in its braces.
pub(super) fn without_function(text: &str, place: &Range<usize>) -> Option<String> {
    let tokens = tokens(text).ok()?;
    let body = bodies(&tokens).into_iter().find(|body| {
        tokens
            .get(body.open)
            .is_some_and(|open| open.start < place.start)
            && tokens
                .get(body.close)
                .is_some_and(|close| place.start < close.start)
    })?;
    let (inside, end) = (
        tokens.get(body.open)?.range().end,
        tokens.get(body.close)?.start,
    );
    let result = result_of(&tokens, &body, text);
    let statement = result.map_or(String::new(), |ty| format!("return {ty}();"));
    let old = text.get(inside..end)?;
    if old.trim() == statement {
        return None;
    }
    let breaks: String = old.chars().filter(|c| *c == '\n').collect();
    Some([text.get(..inside)?, &statement, &breaks, text.get(end..)?].concat())
}

/// What stands in the braces of each function of a text.
pub(super) fn functions(text: &str) -> Vec<Range<usize>> {
    let tokens = tokens(text).unwrap_or_default();
    let inside =
        |body: &Body| Some(tokens.get(body.open)?.range().end..tokens.get(body.close)?.start);
    bodies(&tokens).iter().filter_map(inside).collect()
}

/// Where each statement of a function ends that stands in no other.
pub(super) fn statement_ends(text: &str, function: &Range<usize>) -> Vec<usize> {
    let tokens = text
        .get(function.clone())
        .and_then(|inside| tokens(inside).ok());
    let mut depth = 0_usize;
    let mut ends = Vec::new();
    for token in tokens.unwrap_or_default() {
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 && matches!(token.text, ";" | "}") {
            ends.push(function.start + token.range().end);
        }
    }
    ends
}

/// A function, by the places of its tokens.
struct Body {
    /// The word `fn`.
    function: usize,
    open: usize,
    close: usize,
}

/// The functions of a text, if its braces match.
fn bodies(tokens: &[Token<'_>]) -> Vec<Body> {
    let mut found = Vec::new();
    let mut depth = 0_usize;
    let mut function = None;
    let mut open = 0;
    for (index, token) in tokens.iter().enumerate() {
        match token.text {
            "fn" if depth == 0 => function = Some(index),
            "{" => {
                if depth == 0 {
                    open = index;
                }
                depth += 1;
            }
            "}" => {
                let Some(outer) = depth.checked_sub(1) else {
                    return Vec::new();
                };
                depth = outer;
                if depth == 0
                    && let Some(function) = function.take()
                {
                    let close = index;
                    found.push(Body {
                        function,
                        open,
                        close,
                    });
                }
            }
            _ => {}
        }
    }
    if depth == 0 { found } else { Vec::new() }
}

/// The type that a function gives, without its attributes.
fn result_of<'a>(tokens: &[Token<'_>], body: &Body, text: &'a str) -> Option<&'a str> {
    let header = tokens.get(body.function..body.open)?;
    let arrow = header.windows(2).rposition(
        |pair| matches!(pair, [minus, more] if minus.is_symbol("-") && more.is_symbol(">")),
    )?;
    let mut rest = header.get(arrow + 2..)?;
    while let [at, _, after @ ..] = rest {
        if !at.is_symbol("@") {
            break;
        }
        rest = after;
        if rest.first().is_some_and(|next| next.is_symbol("(")) {
            let close = rest.iter().position(|token| token.is_symbol(")"))?;
            rest = rest.get(close + 1..)?;
        }
    }
    let (first, last) = (rest.first()?, rest.last()?);
    text.get(first.start..last.range().end)
}
