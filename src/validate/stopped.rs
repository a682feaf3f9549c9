//! Where a fault lies that the WGSL compiler says nothing of: it gives no place for some errors, and panics on a few texts.

use core::ops::Range;

use super::repair;

/// How often the compiler is tried on a part of the text at most, and how many bytes it reads for that: long texts get fewer tries.
const MOST_TRIES: usize = 400;
const MOST_BYTES: usize = 1 << 22;

/// The statement at which `is_wrong` becomes true, or else the function.
pub(super) fn find(text: &str, is_wrong: impl Fn(&str) -> bool) -> Option<Range<usize>> {
    let mut tries = 0..MOST_TRIES.min(MOST_BYTES / text.len().max(1));
    // The last one: without the function that is called wrongly no call stops either.
    let functions = repair::functions(text);
    let function = functions.into_iter().rev().find(|function| {
        let rest = repair::without_function(text, function);
        tries.next().is_some() && rest.is_some_and(|rest| !is_wrong(&rest))
    })?;
    let mut start = function.start;
    for end in repair::statement_ends(text, &function) {
        let head = text.get(..end)?;
        let tail = text.get(function.end..)?;
        // What is left of the function may lack a `return`, which is an error and no stop.
        if tries.next().is_none() {
            break;
        }
        if is_wrong(&[head, tail].concat()) {
            let statement = text.get(start..end)?;
            let blank = statement.len() - statement.trim_start().len();
            return Some(start + blank..end);
        }
        start = end;
    }
    Some(function)
}
