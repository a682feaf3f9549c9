//! Limits on a shader's size and depth. The WGSL compiler recurses over long chains, and a stack that overflows takes the
//! whole process down; nothing that a GPU should run comes near.

use super::{ValidateError, constants};
use crate::link::file::definitions;
use crate::link::tokens::{Kind, Token, tokens};
use crate::{Linked, Location};

/// The longest text that is validated, in bytes, before and after linking.
pub const LONGEST_SHADER: usize = 1 << 20;

/// The most words, numbers and symbols of one definition. The compiler takes time that grows with the square of a
/// function's length.
pub const LONGEST_DEFINITION: usize = 32_768;

/// The most operators in one expression, branches in one chain of `else`, and definitions, each of which the compiler
/// follows by recursion.
pub const LONGEST_CHAIN: usize = 2_000;

/// A level of the longest chain takes up to 2 KiB in an optimised build, and several times that in others.
const STACK_BYTES: usize = 64 << 20;

/// Runs `work` on a thread with room for the longest chain. `None` if the thread cannot be started, or `work` panics.
pub(super) fn on_large_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Option<T> {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK_BYTES);
        thread.spawn_scoped(scope, work).ok()?.join().ok()
    })
}

pub(super) fn refuse_too_long(file: &str, text: &str) -> Result<(), ValidateError> {
    if text.len() > LONGEST_SHADER {
        return Err(ValidateError::TooLong {
            file: file.to_owned(),
            bytes: text.len(),
        });
    }
    Ok(())
}

pub(super) fn refuse_long_chains(linked: &Linked) -> Result<(), ValidateError> {
    let tokens = tokens(linked.wgsl()).unwrap_or_default();
    let too_many = |limit, what, token: &Token<'_>| ValidateError::TooMany {
        limit,
        what,
        at: at(linked, token),
    };
    let too_long = |what, token: &Token<'_>| too_many(LONGEST_CHAIN, what, token);
    if let Some(token) = definitions(&tokens).get(LONGEST_CHAIN) {
        return Err(too_long("definitions", token));
    }
    constants::check(&tokens)
        .map_err(|too_large| too_many(too_large.limit, too_large.what, &too_large.at))?;
    let mut open = 0_usize;
    let mut length = 0_usize;
    let mut operators = Nested::default();
    let mut branches = Nested::default();
    let mut previous: Option<&Token<'_>> = None;
    for token in &tokens {
        match token.text {
            "{" => (operators, _) = (Nested::default(), branches.enter()),
            "}" => (operators, _) = (Nested::default(), branches.leave()),
            ";" => operators = Nested::default(),
            "," => operators.restart(),
            "(" | "[" => {
                operators.count();
                operators.enter();
            }
            ")" | "]" => operators.leave(),
            "else" => branches.count(),
            "if" if !previous.is_some_and(|token| token.is_word("else")) => branches.restart(),
            _ if token.kind == Kind::Symbol => operators.count(),
            _ => {}
        }
        match token.text {
            "(" | "[" | "{" => open += 1,
            ")" | "]" | "}" => open = open.saturating_sub(1),
            _ => {}
        }
        let ends = open == 0 && matches!(token.text, ";" | "}");
        length = if ends { 0 } else { length + 1 };
        if length > LONGEST_DEFINITION {
            let what = "words, numbers and symbols in one definition";
            return Err(too_many(LONGEST_DEFINITION, what, token));
        }
        if operators.total > LONGEST_CHAIN {
            return Err(too_long("operators in one expression", token));
        }
        if branches.total > LONGEST_CHAIN {
            return Err(too_long("branches in one chain of `else`", token));
        }
        previous = Some(token);
    }
    Ok(())
}

fn at(linked: &Linked, token: &Token<'_>) -> Box<Location> {
    let at = linked.location(token.range());
    Box::new(at.unwrap_or_else(|| Location::in_text("", linked.wgsl(), token.range())))
}

/// A count for each open bracket, and their sum: how deep the compiler is when it reads the innermost.
#[derive(Default)]
struct Nested {
    outer: Vec<usize>,
    innermost: usize,
    total: usize,
}

impl Nested {
    fn enter(&mut self) {
        self.outer.push(core::mem::take(&mut self.innermost));
    }

    fn leave(&mut self) {
        self.restart();
        self.innermost = self.outer.pop().unwrap_or_default();
    }

    fn restart(&mut self) {
        self.total -= core::mem::take(&mut self.innermost);
    }

    fn count(&mut self) {
        self.innermost += 1;
        self.total += 1;
    }
}
