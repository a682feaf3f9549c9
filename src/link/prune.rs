//! Pruning: of the modules that a file imports, only what it reaches is linked.
//!
//! What a declaration reaches is read off its words, so a local variable or parameter of that name keeps the declaration too: never
//! too little is kept, at times a little more than is needed.

use core::ops::Range;
use std::collections::{BTreeMap, BTreeSet};

use super::file::{File, definitions};
use super::tokens::{Kind, Token};

/// A declaration at top level, with its attributes.
pub(crate) struct Declaration<'a> {
    /// The bytes from its first word on.
    pub(crate) code: Range<usize>,
    /// The bytes that go if nothing reaches it: those of its comments too.
    pub(crate) range: Range<usize>,
    /// The names it defines: one, but for directives, `const_assert`, and text that is not WGSL.
    pub(crate) names: Vec<Token<'a>>,
    /// Every word in it that may name another: no member (`.name`).
    pub(crate) words: Vec<Token<'a>>,
    is_entry_point: bool,
    pub(crate) is_directive: bool,
}

/// The declarations of `code`, which are the tokens of `text` from the byte `start` on.
pub(crate) fn declarations<'a>(
    text: &str,
    start: usize,
    code: &[Token<'a>],
) -> Vec<Declaration<'a>> {
    let mut found = Vec::new();
    let mut rest = code;
    let mut previous_end = start;
    while let Some(first) = rest.first() {
        let (tokens, after) = rest.split_at(length(rest));
        let end = tokens.last().map_or(first.start, |last| last.range().end);
        let next = after.first().map_or(text.len(), |next| next.start);
        let start = with_comments_above(text, previous_end..first.start, found.is_empty());
        found.push(Declaration {
            code: first.start..end,
            range: start..with_comment_behind(text, end, next),
            names: definitions(tokens),
            words: words(tokens),
            is_directive: matches!(first.text, "enable" | "requires" | "diagnostic")
                && tokens.last().is_some_and(|last| last.is_symbol(";")),
            is_entry_point: tokens.windows(2).any(|pair| {
                matches!(pair, [at, stage] if at.is_symbol("@")
                    && matches!(stage.text, "vertex" | "fragment" | "compute"))
            }),
        });
        previous_end = end;
        rest = after;
    }
    found
}

/// How many of `tokens` the first declaration has: up to a semicolon or a closing brace outside every bracket.
fn length(tokens: &[Token<'_>]) -> usize {
    let mut depth = 0_usize;
    let end = tokens.iter().position(|token| {
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth == 0 && matches!(token.text, ";" | "}")
    });
    let end = end.map_or(tokens.len(), |end| end + 1);
    let semicolon = tokens.get(end).is_some_and(|next| next.is_symbol(";"));
    end + usize::from(semicolon)
}

/// The words of `tokens` but for members (`.name`).
fn words<'a>(tokens: &[Token<'a>]) -> Vec<Token<'a>> {
    let mut after_dot = false;
    let words = tokens.iter().filter(|token| {
        let member = core::mem::replace(&mut after_dot, token.is_symbol("."));
        token.kind == Kind::Word && !member
    });
    words.copied().collect()
}

/// Where the `//` comments begin that stand on the lines right above a declaration, `gap` being the bytes between it and the code
/// before it. The first comment of a file is the file's.
fn with_comments_above(text: &str, gap: Range<usize>, is_first: bool) -> usize {
    let between = text.get(gap.clone()).unwrap_or_default();
    let Some(last_break) = between.rfind('\n').filter(|_| !between.contains("/*")) else {
        return gap.end;
    };
    // What stands on the line of the code before belongs to that.
    let own = match between.find('\n') {
        Some(first_break) if gap.start > 0 => first_break + 1,
        _ => 0,
    };
    let lines = between.get(own..=last_break).unwrap_or_default();
    let comments = lines.split_inclusive('\n').rev();
    let above: usize = comments
        .take_while(|line| !line.trim().is_empty())
        .map(str::len)
        .sum();
    let before = lines.get(..lines.len() - above).unwrap_or_default();
    if is_first && before.trim().is_empty() {
        gap.end
    } else {
        gap.start + last_break + 1 - above
    }
}

/// The end of a declaration with the `//` comment that follows it on its line.
fn with_comment_behind(text: &str, end: usize, next: usize) -> usize {
    let gap = text.get(end..next).unwrap_or_default();
    let line = gap.split('\n').next().unwrap_or_default();
    if line.trim_start().starts_with("//") && !line.contains("/*") {
        end + line.len()
    } else {
        end
    }
}

/// Leaves out of each of `files` but the last, which is the one that was given to the linker, what that one does not reach, and the
/// comments that belong to no declaration: the file's name above its part says where to read them. Files that it does not reach go.
/// Entry points are reached from outside; what has no name (`const_assert`) by anything of its file.
pub(crate) fn prune(files: &mut Vec<File<'_>>) {
    let root = files.len().saturating_sub(1);
    let mut owners: BTreeMap<&str, Vec<(usize, usize)>> = BTreeMap::new();
    let mut waiting = Vec::new();
    for (file, of) in files.iter().enumerate() {
        for (index, declaration) in of.declarations.iter().enumerate() {
            for name in &declaration.names {
                owners.entry(name.text).or_default().push((file, index));
            }
            if file == root || declaration.is_entry_point {
                waiting.push((file, index));
            }
        }
    }
    let mut kept: BTreeSet<(usize, usize)> = BTreeSet::new();
    let mut entered = BTreeSet::from([root]);
    while let Some((file, index)) = waiting.pop() {
        if !kept.insert((file, index)) {
            continue;
        }
        let declarations = files.get(file).map_or(&[][..], |of| &of.declarations);
        if entered.insert(file) {
            let unnamed = declarations.iter().enumerate();
            let unnamed = unnamed.filter(|(_, declaration)| declaration.names.is_empty());
            waiting.extend(unnamed.map(|(index, _)| (file, index)));
        }
        let words = declarations
            .get(index)
            .map(|declaration| &declaration.words);
        let words = words.into_iter().flatten();
        waiting.extend(words.filter_map(|word| owners.get(word.text)).flatten());
    }
    for (file, of) in files.iter_mut().enumerate() {
        of.left_out = if file == root {
            let imports = of.imports.iter().map(|import| import.range.clone());
            imports.chain(of.directives()).collect()
        } else {
            let declarations = of.declarations.iter().enumerate();
            let kept = declarations.filter(|(index, _)| kept.contains(&(file, *index)));
            gaps(kept.map(|(_, kept)| kept.range.clone()), of.text.len())
        };
    }
    let mut index = 0..;
    files.retain(|_| index.next().is_some_and(|index| entered.contains(&index)));
}

/// What lies between ranges in order, from 0 to `length`.
pub(super) fn gaps(ranges: impl Iterator<Item = Range<usize>>, length: usize) -> Vec<Range<usize>> {
    let mut end = 0;
    let mut gaps: Vec<_> = ranges
        .map(|range| core::mem::replace(&mut end, range.end)..range.start)
        .collect();
    gaps.push(end..length);
    gaps
}
