//! Selectors of `switch` (WGSL specification, section 9.4.2): constants. naga takes a `let` for one.

use std::collections::BTreeSet;

use crate::link::tokens::{Kind, Token, tokens};
use crate::{Linked, Rule, ShaderError};

/// Selectors that a `let` or a `var` of the function decides.
pub(super) fn check(linked: &Linked) -> Vec<ShaderError> {
    let tokens = tokens(linked.wgsl()).unwrap_or_default();
    let mut found = Vec::new();
    let mut declared: BTreeSet<&str> = BTreeSet::new();
    for (index, token) in tokens.iter().enumerate() {
        let next = tokens.get(index + 1).map_or("", |next| next.text);
        match token.text {
            "fn" => declared.clear(),
            "let" | "var" => drop(declared.insert(next)),
            "const" => drop(declared.remove(next)),
            "case" => found.extend(of_case(
                tokens.get(index..).unwrap_or_default(),
                &declared,
                linked,
            )),
            _ => {}
        }
    }
    found
}

/// The first selector after `case` that is no constant.
fn of_case(
    tokens: &[Token<'_>],
    declared: &BTreeSet<&str>,
    linked: &Linked,
) -> Option<ShaderError> {
    let mut selectors = tokens.iter().take_while(|it| !matches!(it.text, "{" | ":"));
    let wrong = selectors.find(|it| it.kind == Kind::Word && declared.contains(it.text))?;
    Some(ShaderError {
        rule: Rule::Constant,
        message: format!(
            "the selector `{}` is no constant; declare it as `const`",
            wrong.text
        ),
        places: linked.location(wrong.range()).into_iter().collect(),
        notes: Vec::new(),
    })
}
