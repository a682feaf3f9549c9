//! Parameters that have the same value wherever a file's functions are called become that value.

use core::ops::Range;
use std::collections::BTreeMap;

use crate::link::tokens::{Kind, Token, tokens};

/// A parameter by the name that the library gives it everywhere, and the constant that is passed for it.
pub(super) type Baked<'a> = [(&'a str, &'a str)];

/// The list between two parentheses: one range of tokens for each item.
struct List {
    items: Vec<Range<usize>>,
    /// The token of the closing parenthesis.
    end: usize,
}

/// `text` without the parameters of `baked`, in functions and where they are called. `values` has the literals that may be passed for
/// a constant as well.
///
/// # Errors
/// What is passed for a parameter, where that is another value.
pub(super) fn bake(
    text: &str,
    baked: &Baked<'_>,
    values: &BTreeMap<&str, &str>,
) -> Result<String, String> {
    let tokens = tokens(text).unwrap_or_default();
    let mut functions: BTreeMap<&str, Vec<Option<&str>>> = BTreeMap::new();
    for at in 0..tokens.len() {
        if let Some(name) = function(&tokens, at) {
            let list = list(&tokens, at + 2);
            let parameters = list.items.iter().map(|item| {
                let parameter = tokens.get(item.start).map_or("", |token| token.text);
                constant(baked, parameter)
            });
            functions.insert(name, parameters.collect());
        }
    }
    let mut edits: Vec<(Range<usize>, &str)> = Vec::new();
    let mut own: Vec<&str> = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        if let Some(name) = function(&tokens, at) {
            let list = list(&tokens, at + 2);
            let first = |item: &Range<usize>| tokens.get(item.start).map_or("", |it| it.text);
            own = list.items.iter().map(first).collect();
            remove(&tokens, &list, functions.get(name), &mut edits);
            continue;
        }
        let after_dot = at > 0 && tokens[at - 1].is_symbol(".");
        if token.kind != Kind::Word || after_dot {
            continue;
        }
        let is_definition = at > 0 && tokens[at - 1].is_word("fn");
        let is_called = tokens.get(at + 1).is_some_and(|next| next.is_symbol("("));
        if let Some(parameters) = functions.get(token.text)
            && is_called
            && !is_definition
        {
            let list = list(&tokens, at + 1);
            for (item, constant) in list.items.iter().zip(parameters) {
                let passed = tokens.get(item.clone()).unwrap_or_default();
                if let Some(constant) = constant {
                    check(token.text, passed, constant, baked, values)?;
                }
            }
            remove(&tokens, &list, Some(parameters), &mut edits);
        } else if own.contains(&token.text)
            && let Some(constant) = constant(baked, token.text)
        {
            edits.push((token.range(), constant));
        }
    }
    edits.sort_by_key(|(range, _)| (range.start, core::cmp::Reverse(range.end)));
    let mut written = String::with_capacity(text.len());
    let mut end = 0;
    for (range, by) in edits {
        // What goes as a whole needs no edit.
        if range.start >= end {
            written.push_str(text.get(end..range.start).unwrap_or_default());
            written.push_str(by);
            end = range.end;
        }
    }
    written.push_str(text.get(end..).unwrap_or_default());
    Ok(written)
}

/// The name of the function whose definition starts with the token `at`.
fn function<'a>(tokens: &[Token<'a>], at: usize) -> Option<&'a str> {
    let [keyword, name] = tokens.get(at..at + 2)? else {
        return None;
    };
    keyword.is_word("fn").then_some(name.text)
}

fn constant<'a>(baked: &Baked<'a>, parameter: &str) -> Option<&'a str> {
    let mut baked = baked.iter();
    baked.find(|(name, _)| *name == parameter).map(|it| it.1)
}

/// The list whose opening parenthesis is the token `open`. Commas between angle brackets are those of a type.
fn list(tokens: &[Token<'_>], open: usize) -> List {
    let mut items = Vec::new();
    let (mut depth, mut angles) = (0_usize, 0_usize);
    let mut start = open + 1;
    for (at, token) in tokens.iter().enumerate().skip(open) {
        match token.text {
            "(" | "[" => depth += 1,
            ")" | "]" => depth -= 1,
            "<" if at > 0 && tokens[at - 1].is_word("array") => angles += 1,
            ">" => angles = angles.saturating_sub(1),
            _ => {}
        }
        let is_end = depth == 0;
        if is_end || (depth == 1 && angles == 0 && token.is_symbol(",")) {
            if at > start {
                items.push(start..at);
            }
            start = at + 1;
        }
        if is_end {
            return List { items, end: at };
        }
    }
    List {
        items,
        end: tokens.len(),
    }
}

/// Removes items of a list that are baked, each with a comma beside it.
fn remove(
    tokens: &[Token<'_>],
    list: &List,
    parameters: Option<&Vec<Option<&str>>>,
    edits: &mut Vec<(Range<usize>, &str)>,
) {
    let parameters = parameters.map_or(&[][..], Vec::as_slice);
    let starts_at = |at: usize| tokens.get(at).map_or(0, |token| token.start);
    let ends_at = |at: usize| tokens.get(at).map_or(0, |token| token.range().end);
    let mut kept_before = false;
    for (index, (item, constant)) in list.items.iter().zip(parameters).enumerate() {
        if constant.is_none() {
            kept_before = true;
            continue;
        }
        let range = if kept_before {
            // From the end of the item before.
            let before = list.items.get(index - 1).map_or(0, |it| it.end - 1);
            ends_at(before)..ends_at(item.end - 1)
        } else {
            let next = list.items.get(index + 1).map_or(list.end, |it| it.start);
            starts_at(item.start)..starts_at(next)
        };
        edits.push((range, ""));
    }
}

/// Refuses what is passed for a parameter unless it is the constant.
fn check(
    function: &str,
    passed: &[Token<'_>],
    wanted: &str,
    baked: &Baked<'_>,
    values: &BTreeMap<&str, &str>,
) -> Result<(), String> {
    if let [one] = passed
        && (one.text == wanted
            || constant(baked, one.text) == Some(wanted)
            || values.get(wanted) == Some(&one.text))
    {
        return Ok(());
    }
    let passed: Vec<_> = passed.iter().map(|token| token.text).collect();
    let passed = passed.join(" ");
    Err(format!(
        "`{function}` is passed `{passed}` where `{wanted}` is baked in"
    ))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that fails says where")]

    use std::collections::BTreeMap;

    use super::bake;

    const BAKED: [(&str, &str); 2] = [("stored_as", "STORAGE"), ("both", "BOTH")];

    #[test]
    fn parameters_go_from_functions_and_calls() {
        let text = "
fn a(stored_as: u32) -> u32 { return stored_as + x.stored_as; }
fn b(t: array<f32, 2>, stored_as: u32, both: bool, u: f32) -> u32 { return c(max(1, 2), a(stored_as), both); }
fn c(x: u32, y: u32, both: bool,) -> u32 { return select(x, y, both); }
fn d() -> u32 { return b(array<f32, 2>(1.0, 2.0), STORAGE, true, 3.0); }
";
        let expected = "
fn a() -> u32 { return STORAGE + x.stored_as; }
fn b(t: array<f32, 2>, u: f32) -> u32 { return c(max(1, 2), a()); }
fn c(x: u32, y: u32,) -> u32 { return select(x, y, BOTH); }
fn d() -> u32 { return b(array<f32, 2>(1.0, 2.0), 3.0); }
";
        let values = BTreeMap::from([("BOTH", "true")]);
        assert_eq!(bake(text, &BAKED, &values).unwrap(), expected);
    }

    #[test]
    fn another_value_than_the_baked_one_is_refused() {
        for passed in ["STORAGE_FLOAT16", "1u", "stored_as + 1u", "false"] {
            let text =
                format!("fn a(stored_as: u32) {{}}\nfn b(stored_as: u32) {{ a({passed}); }}");
            let error = bake(&text, &BAKED, &BTreeMap::new()).unwrap_err();
            assert!(error.contains("`a` is passed"), "{error}");
        }
    }
}
