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
        tries.next().is_some()
            && repair::without_function(text, function).is_some_and(|rest| !is_wrong(&rest))
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

#[cfg(test)]
mod tests {
    use core::cell::Cell;

    use super::{MOST_BYTES, MOST_TRIES, find};

    #[test]
    fn a_text_is_tried_so_often_and_a_long_one_less() {
        let functions =
            (0..MOST_TRIES + 100).map(|index| format!("fn f{index}() {{ let x = 1; }}\n"));
        let short: String = functions.collect();
        let long = format!("{short}// {}\n", "-".repeat(MOST_BYTES / 8));
        for text in [short, long] {
            let tries = Cell::new(0);
            let is_wrong = |_: &str| {
                tries.set(tries.get() + 1);
                true
            };
            assert_eq!(find(&text, is_wrong), None);
            let tries = tries.get();
            assert!((1..=MOST_TRIES).contains(&tries), "{tries}");
            assert!(tries * text.len() <= MOST_BYTES, "{tries}");
        }
    }
}
