//! A place in the sources where a fault can be planted.

use std::ops::Range;

/// Stands for "this fault is planted" in the text that replaces Rust.
pub const ON: &str = "\u{1}";

/// A fault that can be planted.
#[derive(Clone, Debug)]
pub struct Site {
    /// The file, from the root of the tree.
    pub file: String,
    /// What it replaces, as bytes of the file.
    pub range: Range<usize>,
    /// What stands there instead: in Rust both the original and the fault, chosen by [`ON`]; in WGSL the fault alone.
    pub with: String,
    /// The line, from 1.
    pub line: usize,
    /// The text of that line.
    pub code: String,
    /// What it changes, in words.
    pub what: String,
    /// How many places of the file before it have the same words.
    pub nth: usize,
    /// In WGSL: the declaration around it, as bytes of the file.
    pub declaration: Range<usize>,
}

impl Site {
    pub fn new(file: &str, text: &str, range: Range<usize>, with: String, what: String) -> Self {
        let before = &text[..range.start];
        let line = before.matches('\n').count() + 1;
        let code = text.lines().nth(line - 1).unwrap_or_default();
        Self {
            file: file.to_owned(),
            declaration: range.clone(),
            range,
            with,
            line,
            code: code.trim().to_owned(),
            what,
            nth: 0,
        }
    }

    pub fn key(&self) -> String {
        key(&self.file, &self.code, &self.what, self.nth)
    }
}

/// Names a fault, wherever it lies in its file and whatever else the tree holds.
pub fn key(file: &str, code: &str, what: &str, nth: usize) -> String {
    format!("{file}: {what} in `{code}`, {nth}")
}

/// A number that looks random and depends on `text` and `seed` alone.
pub fn hash(text: &str, seed: u64) -> u64 {
    let mut state = seed ^ 0xcbf2_9ce4_8422_2325;
    for byte in text.bytes() {
        state = (state ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    }
    state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    state = (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    state ^ (state >> 31)
}

/// A different number in place of a literal.
pub fn other_number(literal: &str, choice: u64) -> Option<String> {
    let suffix_at = if literal.starts_with("0x") {
        literal.find(['u', 'i']).unwrap_or(literal.len())
    } else {
        literal
            .find(|c: char| c.is_alphabetic() && c != 'e')
            .unwrap_or(literal.len())
    };
    let (digits, suffix) = literal.split_at(suffix_at);
    let digits = digits.trim_end_matches('_').replace('_', "");
    if let Some(hex) = digits.strip_prefix("0x") {
        let number = u64::from_str_radix(hex, 16).ok()?;
        return Some(format!("{:#x}{suffix}", number + 1));
    }
    if !digits.contains(['.', 'e']) {
        let number: u64 = digits.parse().ok()?;
        let other = match number {
            0 => 1,
            _ if choice.is_multiple_of(2) => number + 1,
            _ => number - 1,
        };
        // A float's literal may be written without a point where it has a suffix.
        return Some(format!("{other}{suffix}"));
    }
    let number: f64 = digits.parse().ok()?;
    let other = match choice % 2 {
        _ if number == 0.0 => 1.0,
        0 => number * 2.0,
        _ => number * 0.5,
    };
    Some(format!("{other:?}{suffix}"))
}
