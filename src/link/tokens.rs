//! The tokens of WGSL, as far as linking needs them: words, numbers, `::` and single symbols, without comments.

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// An identifier or keyword.
    Word,
    /// A number, without its sign.
    Number,
    /// `::`
    Path,
    /// Any other single character.
    Symbol,
}

/// A token and where it starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Token<'a> {
    pub(crate) kind: Kind,
    pub(crate) text: &'a str,
    /// Byte offset in the file.
    pub(crate) start: usize,
}

impl Token<'_> {
    pub(crate) fn range(&self) -> core::ops::Range<usize> {
        self.start..self.start + self.text.len()
    }

    pub(crate) fn is_word(&self, word: &str) -> bool {
        self.kind == Kind::Word && self.text == word
    }

    pub(crate) fn is_symbol(&self, symbol: &str) -> bool {
        self.kind == Kind::Symbol && self.text == symbol
    }
}

/// The tokens of `text` in order; as an error, the byte offset where a block comment starts that does not end.
pub(crate) fn tokens(text: &str) -> Result<Vec<Token<'_>>, usize> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let start = text.len() - rest.len();
        let (kind, length) = if rest.starts_with("//") {
            (None, rest.find(is_line_break).unwrap_or(rest.len()))
        } else if rest.starts_with("/*") {
            let length = block_comment_length(rest).ok_or(start)?;
            (None, length)
        } else if first.is_whitespace() {
            (None, first.len_utf8())
        } else if first == '_' || first.is_alphabetic() {
            let end = rest.find(|c: char| !is_word_part(c));
            (Some(Kind::Word), end.unwrap_or(rest.len()))
        } else if first.is_ascii_digit() {
            let end = rest.find(|c: char| !is_word_part(c) && c != '.');
            (Some(Kind::Number), end.unwrap_or(rest.len()))
        } else if rest.starts_with("::") {
            (Some(Kind::Path), 2)
        } else {
            (Some(Kind::Symbol), first.len_utf8())
        };
        let (text, after) = rest.split_at(length);
        found.extend(kind.map(|kind| Token { kind, text, start }));
        rest = after;
    }
    Ok(found)
}

fn is_word_part(c: char) -> bool {
    c == '_' || c.is_alphanumeric()
}

/// The characters that end a line, and so a `//` comment, in WGSL.
fn is_line_break(c: char) -> bool {
    matches!(
        c,
        '\n' | '\r' | '\u{b}' | '\u{c}' | '\u{85}' | '\u{2028}' | '\u{2029}'
    )
}

/// Block comments nest.
fn block_comment_length(rest: &str) -> Option<usize> {
    let bytes = rest.as_bytes();
    let (mut depth, mut at) = (0_usize, 0);
    loop {
        match bytes.get(at..at + 2)? {
            b"/*" => (depth, at) = (depth + 1, at + 2),
            b"*/" => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
        if depth == 0 {
            return Some(at);
        }
    }
}
