//! One WGSL file as the linker sees it: its imports, its directives, and the names it defines.

use core::ops::Range;
use std::collections::BTreeSet;

use super::import::{self, Form, Import};
use super::location::line_ends;
use super::prune::{Declaration, declarations};
use super::tokens::{Kind, Token, UnterminatedComment, tokens};
use crate::{LinkError, Location};

/// A file whose text follows the import rules.
pub(crate) struct File<'a> {
    /// The name that errors show.
    pub(crate) name: String,
    /// The text without a byte order mark.
    pub(crate) text: &'a str,
    /// How its imports are written.
    pub(crate) form: Form,
    pub(crate) imports: Vec<Import<'a>>,
    /// The directives (`enable`, `requires`, `diagnostic`), as bytes of the text: they stay first when files are joined.
    pub(crate) directives: Vec<Range<usize>>,
    /// The names that the file defines at top level.
    pub(crate) definitions: Vec<Token<'a>>,
    /// The names that its code refers to, without those that it declares itself.
    pub(crate) uses: Vec<Token<'a>>,
    pub(crate) declarations: Vec<Declaration<'a>>,
    /// The declarations that are left out when files are joined, as bytes of the text.
    pub(crate) unreached: Vec<Range<usize>>,
    /// Whether anything of the file is linked.
    pub(crate) is_reached: bool,
}

impl<'a> File<'a> {
    /// Reads a file whose imports must have the form `form`.
    pub(crate) fn parse(name: String, text: &'a str, form: Form) -> Result<Self, LinkError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut file = Self {
            name,
            text,
            form,
            imports: Vec::new(),
            directives: Vec::new(),
            definitions: Vec::new(),
            uses: Vec::new(),
            declarations: Vec::new(),
            unreached: Vec::new(),
            is_reached: true,
        };
        let tokens = tokens(text).map_err(|UnterminatedComment(start)| {
            let at = file.at(start..start + 2);
            LinkError::UnterminatedComment { at }
        })?;
        let mut code = tokens.as_slice();
        let (mut line, mut counted) = (1, 0);
        while code.first().is_some_and(|token| token.is_word("import")) {
            let (mut import, rest) = import::parse(&file, code, form)?;
            let mut line_of = |byte: usize| {
                line += line_ends(text.get(counted..byte).unwrap_or_default());
                counted = byte;
                line
            };
            import.lines = line_of(import.range.start)..=line_of(import.range.end);
            file.imports.push(import);
            code = rest;
        }
        file.check_code(code)?;
        file.directives = directives(code);
        file.definitions = definitions(code);
        file.uses = uses(code);
        let start = file.imports.last().map_or(0, |last| last.range.end);
        file.declarations = declarations(text, start, code);
        Ok(file)
    }

    /// Where the bytes `range` stand.
    pub(crate) fn at(&self, range: Range<usize>) -> Box<Location> {
        Box::new(Location::in_text(&self.name, self.text, range))
    }

    /// Refuses what would be an import in other dialects. All of it is reserved in WGSL, so no valid shader is refused.
    fn check_code(&self, code: &[Token<'_>]) -> Result<(), LinkError> {
        let mut previous = None;
        for token in code {
            let at = || self.at(token.range());
            let attribute = previous.is_some_and(|token: &Token<'_>| token.is_symbol("@"));
            if token.is_word("import") {
                let first_code = code.first().map_or(1, |first| self.at(first.range()).line);
                return Err(LinkError::ImportAfterCode {
                    first_code,
                    at: at(),
                });
            } else if token.is_word("public") {
                return Err(LinkError::Public { at: at() });
            } else if token.kind == Kind::Path {
                return Err(LinkError::InlinePath { at: at() });
            } else if attribute && matches!(token.text, "if" | "elif" | "else") {
                return Err(LinkError::Conditional {
                    attribute: token.text.to_owned(),
                    at: at(),
                });
            }
            previous = Some(token);
        }
        Ok(())
    }
}

/// The directives at the start of `code`, each from its first word to its semicolon.
fn directives(code: &[Token<'_>]) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut rest = code;
    while let Some(first) = rest.first() {
        if !matches!(first.text, "enable" | "requires" | "diagnostic") {
            break;
        }
        let Some(end) = rest.iter().position(|token| token.is_symbol(";")) else {
            break;
        };
        let (directive, after) = rest.split_at(end + 1);
        found.push(
            first.start
                ..directive
                    .last()
                    .map_or(first.start, |last| last.range().end),
        );
        rest = after;
    }
    found
}

/// The names after `fn`, `struct`, `alias`, `const`, `override` and `var` outside every bracket.
pub(crate) fn definitions<'a>(code: &[Token<'a>]) -> Vec<Token<'a>> {
    let mut found = Vec::new();
    let mut depth = 0_usize;
    let mut tokens = code.iter().peekable();
    while let Some(token) = tokens.next() {
        match token.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth = depth.saturating_sub(1),
            "fn" | "struct" | "alias" | "const" | "override" | "var" if depth == 0 => {
                if tokens.next_if(|next| next.is_symbol("<")).is_some() {
                    // The address space of a variable.
                    tokens.by_ref().find(|next| next.is_symbol(">"));
                }
                found.extend(tokens.next_if(|next| next.kind == Kind::Word));
            }
            _ => {}
        }
    }
    found
}

/// The words of `code` that refer to something declared elsewhere: no member (`.name`), and no name that is declared
/// anywhere in the file, as a parameter, a member or a variable, since that may be what is meant.
fn uses<'a>(code: &[Token<'a>]) -> Vec<Token<'a>> {
    let before = |index: usize| index.checked_sub(1).and_then(|index| code.get(index));
    let declares = |index: usize| {
        let keyword = before(index).is_some_and(|token| {
            matches!(
                token.text,
                "fn" | "struct" | "alias" | "const" | "override" | "var" | "let"
            )
        });
        keyword || code.get(index + 1).is_some_and(|next| next.is_symbol(":"))
    };
    let words = || {
        code.iter()
            .enumerate()
            .filter(|(_, token)| token.kind == Kind::Word)
    };
    let declared: BTreeSet<&str> = words()
        .filter(|(index, _)| declares(*index))
        .map(|(_, token)| token.text)
        .collect();
    words()
        .filter(|(index, token)| {
            !declared.contains(token.text)
                && !before(*index).is_some_and(|token| token.is_symbol("."))
        })
        .map(|(_, token)| *token)
        .collect()
}
