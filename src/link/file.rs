//! One WGSL file as the linker sees it: its imports, its directives, and what it declares.

use core::ops::Range;
use std::collections::BTreeSet;

use super::dialect;
use super::import::{self, Form, Import};
use super::prune::{Declaration, declarations};
use super::tokens::{Kind, Token, tokens};
use crate::{Location, Rule, ShaderError};

/// A file whose text follows the import rules.
pub(crate) struct File<'a> {
    /// The name that errors show.
    pub(crate) name: String,
    /// The path that it is imported by; empty for the file that is given to the linker.
    pub(crate) module: String,
    /// The text without a byte order mark.
    pub(crate) text: &'a str,
    /// How its imports are written.
    pub(crate) form: Form,
    pub(crate) imports: Vec<Import<'a>>,
    pub(crate) declarations: Vec<Declaration<'a>>,
    /// The names that it declares anywhere, as a parameter, a member or a variable too.
    pub(crate) declared: BTreeSet<&'a str>,
    /// What is left out when files are joined, as bytes of the text.
    pub(crate) left_out: Vec<Range<usize>>,
}

impl<'a> File<'a> {
    /// Reads a file whose imports must have the form `form`.
    pub(crate) fn parse(
        name: String,
        module: String,
        text: &'a str,
        form: Form,
    ) -> Result<Self, ShaderError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut file = Self {
            name,
            module,
            text,
            form,
            imports: Vec::new(),
            declarations: Vec::new(),
            declared: BTreeSet::new(),
            left_out: Vec::new(),
        };
        let open = "this comment does not end; close it with `*/`";
        let tokens = tokens(text).map_err(|start| ShaderError {
            rule: Rule::Wgsl,
            ..file.error(start..start + 2, open)
        })?;
        dialect::refuse(&file, &tokens)?;
        let mut code = tokens.as_slice();
        while code.first().is_some_and(|token| token.is_word("import")) {
            let (import, rest) = import::parse(&file, code)?;
            file.imports.push(import);
            code = rest;
        }
        file.check_code(code)?;
        file.declared = declared(code);
        let start = file.imports.last().map_or(0, |last| last.range.end);
        file.declarations = declarations(text, start, code);
        Ok(file)
    }

    /// Where the bytes `range` stand.
    pub(crate) fn at(&self, range: Range<usize>) -> Location {
        Location::in_text(&self.name, self.text, range)
    }

    /// What is wrong with an import at the bytes `range`.
    pub(crate) fn error(&self, range: Range<usize>, message: impl Into<String>) -> ShaderError {
        ShaderError::at(Rule::Import, self.at(range), message)
    }

    /// The names that it defines at top level.
    pub(crate) fn definitions(&self) -> impl Iterator<Item = &Token<'a>> {
        self.declarations.iter().flat_map(|of| &of.names)
    }

    /// The directives (`enable`, `requires`, `diagnostic`) at its start, as bytes of the text.
    pub(crate) fn directives(&self) -> impl Iterator<Item = Range<usize>> {
        let declarations = self.declarations.iter();
        declarations
            .take_while(|of| of.is_directive)
            .map(|of| of.code.clone())
    }

    /// Refuses what would be an import in other dialects. All of it is reserved in WGSL, so no valid shader is refused.
    fn check_code(&self, code: &[Token<'_>]) -> Result<(), ShaderError> {
        let mut after_at = false;
        for token in code {
            let is_attribute = core::mem::replace(&mut after_at, token.is_symbol("@"));
            let message = if token.is_word("import") {
                let first = code.first().map_or(1, |first| self.at(first.range()).line);
                format!("imports come first; move this one above line {first}")
            } else if token.is_word("public") {
                "`public` is not supported: every item can be imported; remove the word".to_owned()
            } else if token.kind == Kind::Path {
                "paths within code are not supported; import the item and use its name alone"
                    .to_owned()
            } else if is_attribute && matches!(token.text, "if" | "elif" | "else") {
                format!(
                    "conditional translation (`@{}`) is not supported; use a constant or another file, or validate what the WESL linker makes of it",
                    token.text
                )
            } else {
                continue;
            };
            return Err(self.error(token.range(), message));
        }
        Ok(())
    }
}

/// The words after which a name is declared.
fn declares(word: &str) -> bool {
    matches!(
        word,
        "fn" | "struct" | "alias" | "const" | "override" | "var" | "let"
    )
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
            word if depth == 0 && declares(word) => {
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

/// The words of `code` that declare a name, or may: those after a keyword, and those before a colon.
fn declared<'a>(code: &[Token<'a>]) -> BTreeSet<&'a str> {
    let pairs = code.windows(2).filter_map(|pair| match pair {
        [keyword, name] if declares(keyword.text) => Some(name),
        [name, colon] if colon.is_symbol(":") => Some(name),
        _ => None,
    });
    pairs.map(|name| name.text).collect()
}
