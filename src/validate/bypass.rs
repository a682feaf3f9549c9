//! `continue` past a declaration that the `continuing` block uses (WGSL specification, section 9.4.9). naga takes it.

use crate::link::tokens::{Kind, Token, tokens};
use crate::{Linked, Rule, ShaderError};

/// Declarations that a `continue` leaves out and the loop's `continuing` block uses.
pub(super) fn check(linked: &Linked) -> Vec<ShaderError> {
    let tokens = tokens(linked.wgsl()).unwrap_or_default();
    let loops = tokens.iter().enumerate();
    let loops = loops.filter(|(_, token)| token.is_word("loop"));
    loops
        .filter_map(|(at, _)| of_loop(&tokens, at, linked))
        .collect()
}

fn of_loop(tokens: &[Token<'_>], at: usize, linked: &Linked) -> Option<ShaderError> {
    let body = braces(tokens, at)?;
    let continuing = direct(body).find(|index| is_word(body, *index, "continuing"))?;
    let used = braces(body, continuing)?;
    let leaving = (0..continuing)
        .find(|index| is_word(body, *index, "continue") && !in_inner_loop(body, *index))?;
    let declared = direct(body).filter(|index| {
        let keyword = body.get(*index).map_or("", |token| token.text);
        (leaving..continuing).contains(index) && matches!(keyword, "let" | "var" | "const")
    });
    let names = declared.filter_map(|index| {
        let after = body.get(index + 1..)?;
        after.iter().find(|token| token.kind == Kind::Word)
    });
    let name = names
        .into_iter()
        .find(|name| used.iter().any(|token| token.is_word(name.text)))?;
    let place =
        |token: &Token<'_>, label: &str| Some(linked.location(token.range())?.labelled(label));
    Some(ShaderError {
        rule: Rule::Wgsl,
        message: format!(
            "this `continue` goes past the declaration of `{}`, which `continuing` uses; declare it before",
            name.text
        ),
        places: [place(body.get(leaving)?, ""), place(name, "declared here")]
            .into_iter()
            .flatten()
            .collect(),
        notes: Vec::new(),
    })
}

fn is_word(tokens: &[Token<'_>], index: usize, word: &str) -> bool {
    tokens.get(index).is_some_and(|token| token.is_word(word))
}

/// The tokens in the first braces after `at`.
fn braces<'a, 'b>(tokens: &'b [Token<'a>], at: usize) -> Option<&'b [Token<'a>]> {
    let rest = tokens.get(at..)?;
    let open = rest.iter().position(|token| token.is_symbol("{"))?;
    let mut depth = 0_usize;
    let length = rest.get(open..)?.iter().position(|token| {
        match token.text {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        depth == 0
    })?;
    rest.get(open + 1..open + length)
}

/// The tokens outside of inner braces, by their places.
fn direct<'b>(tokens: &'b [Token<'_>]) -> impl Iterator<Item = usize> + 'b {
    let mut depth = 0_usize;
    tokens.iter().enumerate().filter_map(move |(index, token)| {
        match token.text {
            "{" => depth += 1,
            "}" => depth = depth.saturating_sub(1),
            _ => {}
        }
        (depth == 0).then_some(index)
    })
}

/// Whether the token stands in a loop within `tokens`.
fn in_inner_loop(tokens: &[Token<'_>], index: usize) -> bool {
    let loops = (0..index).filter(|at| {
        let word = tokens.get(*at).map_or("", |token| token.text);
        matches!(word, "loop" | "for" | "while")
    });
    let start = tokens.get(index).map_or(0, |token| token.start);
    loops
        .filter_map(|at| braces(tokens, at))
        .any(|inner| inner.iter().any(|token| token.start == start))
}
