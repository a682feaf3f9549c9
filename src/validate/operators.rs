//! Operators that WGSL lets stand beside each other only with parentheses (WGSL specification, section 8.19, "Operator Precedence and
//! Associativity"). naga takes them without; browsers do not.

use core::ops::Range;

use crate::link::tokens::{Kind, Token, tokens};
use crate::{Linked, Rule, ShaderError};

/// A binary operator.
#[derive(Clone, Debug, PartialEq)]
struct Operator<'a> {
    text: &'a str,
    range: Range<usize>,
}

/// Operators that are mixed without parentheses, the first two of each expression.
pub(super) fn check(linked: &Linked) -> Vec<ShaderError> {
    let mut found = Vec::new();
    let text = linked.wgsl();
    let pieces = pieces(text);
    let is_template = templates(&pieces);
    // Operators of the expression that is being read, and of those around it.
    let mut open: Vec<Vec<Operator<'_>>> = vec![Vec::new()];
    let mut before: Option<&str> = None;
    for (index, (piece, is_template)) in pieces.iter().zip(is_template).enumerate() {
        let text = piece.text;
        let follows_value = before.is_some_and(|before| is_value(before) || before == ">>>");
        // What closes a template list is followed as a value is.
        before = Some(if is_template { ">>>" } else { text });
        if is_template {
            continue;
        }
        if text == "-" && !follows_value && is_matrix(pieces.get(index + 1)) {
            found.push(ShaderError {
                rule: Rule::Operator,
                message: "WGSL has no `-` before a matrix; multiply by -1.0".to_owned(),
                places: linked.location(piece.range.clone()).into_iter().collect(),
                notes: Vec::new(),
            });
        }
        match text {
            "(" | "[" => open.push(Vec::new()),
            ")" | "]" => {
                found.extend(mixed(linked, open.pop().unwrap_or_default()).err());
                if open.is_empty() {
                    open.push(Vec::new());
                }
            }
            _ if ends_expression(text) => {
                let ended = open.last_mut().map(core::mem::take);
                found.extend(mixed(linked, ended.unwrap_or_default()).err());
            }
            _ if follows_value && is_operator(text) => {
                let operator = Operator {
                    text,
                    range: piece.range.clone(),
                };
                open.last_mut()
                    .into_iter()
                    .for_each(|last| last.push(operator.clone()));
            }
            _ => {}
        }
    }
    found
}

const BITWISE: [&str; 3] = ["&", "|", "^"];
const SHIFTS: [&str; 2] = ["<<", ">>"];
const RELATIONAL: [&str; 6] = ["<", ">", "<=", ">=", "==", "!="];
const SHORT_CIRCUIT: [&str; 2] = ["&&", "||"];
const ARITHMETIC: [&str; 5] = ["+", "-", "*", "/", "%"];

fn is_operator(text: &str) -> bool {
    let all: [&[&str]; 5] = [&BITWISE, &SHIFTS, &RELATIONAL, &SHORT_CIRCUIT, &ARITHMETIC];
    all.iter().any(|some| some.contains(&text))
}

/// Whether this begins the constructor of a matrix. naga refuses others with a `-`.
fn is_matrix(piece: Option<&Piece<'_>>) -> bool {
    let name = piece.and_then(|piece| piece.text.strip_prefix("mat"));
    name.is_some_and(|size| size.as_bytes().get(1) == Some(&b'x'))
}

/// Words after which an expression begins.
const BEGINNINGS: [&str; 9] = [
    "return",
    "if",
    "while",
    "switch",
    "case",
    "for",
    "else",
    "const_assert",
    "in",
];

/// Whether an operator after this is a binary one.
fn is_value(text: &str) -> bool {
    let is_word = text.starts_with(|first: char| first.is_alphanumeric() || first == '_');
    matches!(text, ")" | "]") || is_word && !BEGINNINGS.contains(&text)
}

/// Whether no expression goes on beyond this: separators, and assignments of any kind.
fn ends_expression(text: &str) -> bool {
    let is_assignment = text.ends_with('=') && !RELATIONAL.contains(&text);
    matches!(text, "," | ";" | ":" | "{" | "}" | "->" | "@" | "++" | "--") || is_assignment
}

/// Refuses what an expression's binary operators have no rule for.
fn mixed(linked: &Linked, operators: Vec<Operator<'_>>) -> Result<(), ShaderError> {
    let is = |kind: &'static [&'static str]| move |it: &&Operator<'_>| kind.contains(&it.text);
    // Operands of bitwise operators are of no other operator.
    if let Some(bitwise) = operators.iter().find(is(&BITWISE)) {
        differs(linked, bitwise, &operators)?;
    }
    if let Some(first) = operators.iter().find(is(&SHORT_CIRCUIT)) {
        let all: Vec<_> = operators
            .iter()
            .filter(is(&SHORT_CIRCUIT))
            .cloned()
            .collect();
        differs(linked, first, &all)?;
    }
    for compared in operators.split(|it| SHORT_CIRCUIT.contains(&it.text)) {
        let mut relational = compared.iter().filter(is(&RELATIONAL));
        if let (Some(first), Some(second)) = (relational.next(), relational.next()) {
            return refused(linked, first, second);
        }
        // So are those of shifts.
        for shifted in compared.split(|it| RELATIONAL.contains(&it.text)) {
            if let Some(shift) = shifted.iter().find(is(&SHIFTS))
                && let Some(other) = shifted.iter().find(|it| it.range != shift.range)
            {
                return refused(linked, shift, other);
            }
        }
    }
    Ok(())
}

/// Refuses an operator among `all` that is another one than `first`.
fn differs(linked: &Linked, first: &Operator<'_>, all: &[Operator<'_>]) -> Result<(), ShaderError> {
    match all.iter().find(|it| it.text != first.text) {
        Some(other) => refused(linked, first, other),
        None => Ok(()),
    }
}

fn refused<T>(linked: &Linked, one: &Operator<'_>, other: &Operator<'_>) -> Result<T, ShaderError> {
    let mut both = [one, other];
    both.sort_by_key(|it| it.range.start);
    let [first, second] = both;
    Err(ShaderError {
        rule: Rule::Operator,
        message: format!(
            "`{}` and `{}` stand in one expression, which WGSL has no order for; put parentheses around what belongs together",
            first.text, second.text
        ),
        places: both
            .iter()
            .filter_map(|it| linked.location(it.range.clone()))
            .collect(),
        notes: Vec::new(),
    })
}

/// A word, a number, or symbols that stand together.
#[derive(Debug)]
struct Piece<'a> {
    text: &'a str,
    range: Range<usize>,
}

/// The longest first: what is joined is one operator.
const JOINED: [&str; 18] = [
    ">>=", "<<=", "->", "&&", "||", "==", "!=", "<=", ">=", "<<", ">>", "+=", "-=", "*=", "/=",
    "%=", "++", "--",
];
const JOINED_ASSIGNMENTS: [&str; 3] = ["&=", "|=", "^="];

fn pieces(text: &str) -> Vec<Piece<'_>> {
    let tokens: Vec<Token<'_>> = tokens(text).unwrap_or_default();
    let mut found: Vec<Piece<'_>> = Vec::new();
    let mut until = 0;
    for token in tokens {
        if token.start < until {
            continue;
        }
        let mut range = token.range();
        if token.kind == Kind::Symbol {
            let rest = &text[token.start..];
            let mut known = JOINED.iter().chain(&JOINED_ASSIGNMENTS);
            if let Some(joined) = known.find(|joined| rest.starts_with(**joined)) {
                range.end = range.start + joined.len();
            }
        }
        until = range.end;
        let text = &text[range.clone()];
        found.push(Piece { text, range });
    }
    found
}

/// Which pieces begin, end or stand in the list of a template (WGSL specification, section 3.9, "Template Lists"): there `<` and `>` compare
/// nothing, and a closing `>>` or `>=` is several.
fn templates(pieces: &[Piece<'_>]) -> Vec<bool> {
    let mut found = vec![false; pieces.len()];
    let mut pending: Vec<(usize, usize)> = Vec::new();
    let mut depth = 0_usize;
    for (at, piece) in pieces.iter().enumerate() {
        let name_before = at > 0
            && pieces[at - 1]
                .text
                .starts_with(|it: char| it.is_alphabetic() || it == '_');
        match piece.text {
            "<" if name_before => pending.push((at, depth)),
            ">" | ">>" | ">>=" | ">=" => {
                let closing = piece.text.matches('>').count();
                for _ in 0..closing {
                    if let Some((begin, _)) = pending.pop_if(|(_, of)| *of == depth) {
                        found[begin] = true;
                        found[at] = true;
                    }
                }
            }
            "(" | "[" => depth += 1,
            ")" | "]" => {
                pending.retain(|(_, of)| *of < depth);
                depth = depth.saturating_sub(1);
            }
            "&&" | "||" => pending.retain(|(_, of)| *of < depth),
            ";" | "{" | ":" | "=" => {
                pending.clear();
                depth = 0;
            }
            _ => {}
        }
    }
    found
}
