//! A limit on constants of constants. The compiler copies a constant into each place that names it, so that
//! `const B = array(A, A); const C = array(B, B);` and so on takes memory that doubles with each line.

use std::collections::BTreeMap;

use crate::link::tokens::{Kind, Token};

/// The most words, numbers and symbols of a constant, with those of the constants that it names in their places.
pub const LARGEST_CONSTANT: usize = 65_536;

/// The most words, numbers and symbols of all constants, each counted as often as it is named.
pub const MOST_CONSTANTS: usize = 1 << 20;

/// A constant, by the words of its definition.
struct Constant<'a> {
    name: Token<'a>,
    /// Words, numbers and symbols.
    length: usize,
    /// The constants that it names, each as often as it is named.
    names: Vec<&'a str>,
}

/// The place where constants become too large.
pub(super) struct TooLarge<'a> {
    pub(super) limit: usize,
    pub(super) what: &'static str,
    pub(super) at: Token<'a>,
}

/// Whether the constants of a text are within [`LARGEST_CONSTANT`] and [`MOST_CONSTANTS`].
pub(super) fn check<'a>(tokens: &[Token<'a>]) -> Result<(), TooLarge<'a>> {
    let constants = constants(tokens);
    let mut by_name: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (index, constant) in constants.iter().enumerate() {
        by_name.entry(constant.name.text).or_default().push(index);
    }
    let mut sizes: Vec<Option<usize>> = vec![None; constants.len()];
    for start in 0..constants.len() {
        // Without recursion: a chain has any length. Constants that name each other are refused by the compiler.
        let mut open = vec![(start, false)];
        while let Some((index, inner_known)) = open.pop() {
            let Some(constant) = constants.get(index) else {
                continue;
            };
            // Functions may have constants of the same name; the largest is taken.
            let inner = || constant.names.iter().filter_map(|name| by_name.get(name));
            if !inner_known {
                if sizes.get(index).is_some_and(Option::is_none) {
                    set(&mut sizes, index, constant.length);
                    open.push((index, true));
                    let unknown = |of: &&usize| sizes.get(**of).is_some_and(Option::is_none);
                    open.extend(inner().flatten().filter(unknown).map(|of| (*of, false)));
                }
                continue;
            }
            let largest = |of: &Vec<usize>| of.iter().filter_map(|of| *sizes.get(*of)?).max();
            let size = inner()
                .filter_map(largest)
                .fold(constant.length, usize::saturating_add);
            if size > LARGEST_CONSTANT {
                return Err(TooLarge {
                    limit: LARGEST_CONSTANT,
                    what: "words, numbers and symbols in one constant, with those of the constants that it names",
                    at: constant.name,
                });
            }
            set(&mut sizes, index, size);
        }
    }
    let mut sum = 0_usize;
    for token in tokens.iter().filter(|token| token.kind == Kind::Word) {
        let of_name = by_name.get(token.text).into_iter().flatten();
        let size = of_name.filter_map(|index| *sizes.get(*index)?).max();
        sum = sum.saturating_add(size.unwrap_or_default());
        if sum > MOST_CONSTANTS {
            return Err(TooLarge {
                limit: MOST_CONSTANTS,
                what: "words, numbers and symbols in all constants, each counted as often as it is named",
                at: *token,
            });
        }
    }
    Ok(())
}

fn set(sizes: &mut [Option<usize>], index: usize, size: usize) {
    if let Some(place) = sizes.get_mut(index) {
        *place = Some(size);
    }
}

/// All constants, those within functions among them.
fn constants<'a>(tokens: &[Token<'a>]) -> Vec<Constant<'a>> {
    let mut found = Vec::new();
    let mut rest = tokens;
    while let Some(at) = rest.iter().position(|token| token.is_word("const")) {
        rest = rest.get(at + 1..).unwrap_or_default();
        let Some((name, after)) = rest.split_first() else {
            break;
        };
        let ends = |token: &Token<'_>| token.is_symbol(";") || token.is_word("const");
        let end = after.iter().position(ends).unwrap_or(after.len());
        let (definition, _) = after.split_at(end);
        let words = definition.iter().filter(|token| token.kind == Kind::Word);
        found.push(Constant {
            name: *name,
            length: definition.len(),
            names: words.map(|token| token.text).collect(),
        });
    }
    // Only constants matter among the words.
    let names: std::collections::BTreeSet<&str> =
        found.iter().map(|constant| constant.name.text).collect();
    for constant in &mut found {
        constant.names.retain(|name| names.contains(name));
    }
    found
}
