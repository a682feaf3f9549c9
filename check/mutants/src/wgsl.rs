//! Faults in WGSL.

use std::ops::Range;

use crate::site::{Site, hash, other_number};

/// A word, a number or a symbol, as bytes of the text.
type Token = Range<usize>;

const SYMBOLS: [&str; 25] = [
    "<<=", ">>=", "->", "==", "!=", "<=", ">=", "&&", "||", "<<", ">>", "+=", "-=", "*=", "/=",
    "%=", "|=", "&=", "^=", "++", "--", "//", "/*", "::", "@",
];

/// The tokens of `text` without comments, and without what stands in template lists.
fn tokens(text: &str) -> Vec<Token> {
    let bytes = text.as_bytes();
    let mut found: Vec<Token> = Vec::new();
    let (mut at, mut templates) = (0, 0_usize);
    while at < bytes.len() {
        let rest = &text[at..];
        let first = bytes[at] as char;
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let symbol = SYMBOLS.iter().find(|symbol| rest.starts_with(**symbol));
        let length = match symbol {
            Some(&"//") => {
                at += rest.find('\n').unwrap_or(rest.len());
                continue;
            }
            Some(&"/*") => {
                at += rest.find("*/").map_or(rest.len(), |end| end + 2);
                continue;
            }
            // A template list ends with them.
            Some(&(">>" | ">=")) if templates > 0 => 1,
            Some(symbol) => symbol.len(),
            None if first.is_whitespace() => {
                at += first.len_utf8();
                continue;
            }
            None if first.is_ascii_digit() => {
                let mut end = 0;
                for (index, c) in rest.char_indices() {
                    let exponent = matches!(c, '+' | '-') && rest[..index].ends_with('e');
                    if !(is_word(c) || c == '.' || exponent && !rest.starts_with("0x")) {
                        break;
                    }
                    end = index + 1;
                }
                end
            }
            None if is_word(first) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            None => rest.chars().next().map_or(1, char::len_utf8),
        };
        let token = at..at + length;
        at += length;
        // `array<` opens a list, `a < b` does not.
        let follows = found.last().is_some_and(|last| last.end == token.start);
        match &text[token.clone()] {
            "<" if templates > 0 || follows => templates += 1,
            ">" if templates > 0 => templates -= 1,
            _ if templates == 0 => found.push(token),
            _ => {}
        }
    }
    found
}

/// Where the bracket that opens at `tokens[at]` closes.
fn closing(text: &str, tokens: &[Token], at: usize) -> usize {
    let mut depth = 0_usize;
    for (index, token) in tokens.iter().enumerate().skip(at) {
        match &text[token.clone()] {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => {
                depth -= 1;
                if depth == 0 {
                    return index;
                }
            }
            _ => {}
        }
    }
    tokens.len() - 1
}

/// The faults that can be planted in a file. Constants that `is_shared` are made for host code too when it is built, so they cannot
/// differ afterwards.
pub fn sites(file: &str, text: &str, seed: u64, is_shared: impl Fn(&str) -> bool) -> Vec<Site> {
    let tokens = tokens(text);
    let word = |at: usize| tokens.get(at).map_or("", |token| &text[token.clone()]);
    let mut all = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let (end, body) = match word(at) {
            "fn" => {
                let mut open = at;
                while !matches!(word(open), "{" | "") {
                    open = if word(open) == "(" {
                        closing(text, &tokens, open) + 1
                    } else {
                        open + 1
                    };
                }
                (closing(text, &tokens, open), open)
            }
            "struct" => {
                let open = (at..tokens.len()).find(|&it| word(it) == "{").unwrap_or(at);
                (closing(text, &tokens, open), tokens.len())
            }
            keyword => {
                let end = (at..tokens.len()).find(|&it| word(it) == ";").unwrap_or(at);
                let own = keyword == "const" && !is_shared(word(at + 1));
                let value = (at..end).find(|&it| word(it) == "=").unwrap_or(end);
                let end = if matches!(keyword, "@" | "(" | ")") {
                    at
                } else {
                    end
                };
                (end, if own { value + 1 } else { tokens.len() })
            }
        };
        let declaration = tokens[at].start..tokens[end.min(tokens.len() - 1)].end;
        for index in body..end {
            let choice = hash(&format!("{file}:{}", tokens[index].start), seed);
            for (range, with, what) in faults(text, &tokens, index, choice) {
                let mut site = Site::new(file, text, range, with, what);
                site.declaration = declaration.clone();
                all.push(site);
            }
        }
        at = end.max(at) + 1;
    }
    all
}

fn faults(
    text: &str,
    tokens: &[Token],
    at: usize,
    choice: u64,
) -> Vec<(Range<usize>, String, String)> {
    let word = |at: usize| tokens.get(at).map_or("", |token| &text[token.clone()]);
    let (token, here) = (tokens[at].clone(), word(at));
    let before = at.checked_sub(1).map_or("", word);
    let mut found = Vec::new();
    let mut other = |range: Range<usize>, with: String| {
        let what = format!("`{}` becomes `{with}`", &text[range.clone()]);
        found.push((range, with, what));
    };
    let either = |a: &'static str, b: &'static str| if choice.is_multiple_of(2) { a } else { b };
    let is_operand = before
        .ends_with(|c: char| c.is_alphanumeric() || matches!(c, '_' | ')' | ']'))
        && before != "return";
    let replaced = match here {
        "+" => "-",
        "-" if is_operand => "+",
        "-" => "",
        "*" if is_operand => either("/", "+"),
        "/" | "%" => "*",
        "+=" => "-=",
        "-=" => "+=",
        "*=" => "/=",
        "/=" => "*=",
        "<" => either("<=", ">="),
        ">" => either(">=", "<="),
        "<=" => either("<", ">"),
        ">=" => either(">", "<"),
        "==" => "!=",
        "!=" => "==",
        "&&" => "||",
        "||" => "&&",
        "&" if is_operand => "|",
        "|" => "&",
        "<<" => ">>",
        ">>" => "<<",
        "!" => "",
        "min" => "max",
        "max" => "min",
        "floor" => "ceil",
        "ceil" => "floor",
        "sin" => "cos",
        "cos" => "sin",
        "any" => "all",
        "all" => "any",
        "abs" | "saturate" => "",
        "sqrt" => "abs",
        "true" => "false",
        "false" => "true",
        _ => here,
    };
    let is_call = here.starts_with(char::is_alphabetic) && !matches!(here, "true" | "false");
    if replaced != here && (!is_call || word(at + 1) == "(") {
        other(token.clone(), replaced.to_owned());
    }
    if here.starts_with(|c: char| c.is_ascii_digit())
        && let Some(number) = other_number(here, choice)
    {
        other(token.clone(), number);
    }
    if before == "." && here.chars().all(|c| "xyzw".contains(c)) {
        let swapped: String = match here {
            "x" => "y".to_owned(),
            "y" | "z" | "w" => "x".to_owned(),
            _ => {
                let mut letters: Vec<_> = here.chars().collect();
                letters.swap(0, 1);
                letters.into_iter().collect()
            }
        };
        if swapped != here {
            other(token.clone(), swapped);
        }
    }
    if matches!(here, "select" | "mix" | "step") && word(at + 1) == "(" {
        let mut depth = 0_usize;
        let mut commas = Vec::new();
        for index in at + 1..closing(text, tokens, at + 1) {
            match word(index) {
                "(" | "[" => depth += 1,
                ")" | "]" => depth -= 1,
                "," if depth == 1 => commas.push(index),
                _ => {}
            }
        }
        if let [first, second, ..] = commas[..] {
            let a = &text[tokens[at + 1].end..tokens[first].start];
            let b = text[tokens[first].end..tokens[second].start].trim();
            let range = tokens[at + 1].end..tokens[second].start;
            let what = format!("the first two arguments of `{here}` are swapped");
            found.push((range, format!("{b}, {}", a.trim()), what));
        }
    }
    if here == "if" {
        let mut open = at + 1;
        while !matches!(word(open), "{" | "") {
            open = if word(open) == "(" {
                closing(text, tokens, open) + 1
            } else {
                open + 1
            };
        }
        let range = tokens[at + 1].start..tokens[open - 1].end;
        let condition = &text[range.clone()];
        let (with, holds) = match choice % 2 {
            0 => (format!("false && ({condition})"), "never"),
            _ => (format!("true || ({condition})"), "always"),
        };
        found.push((range, with, format!("the condition of `if` {holds} holds")));
    }
    found
}
