//! An import line: the only forms are `import node::x::{a, b};` within the library and
//! `import node::x::{a, b};` outside it. Both are WESL as it stands.

use super::file::File;
use super::tokens::{Kind, Token, tokens};
use crate::LinkError;

/// Which of the two forms a file uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// `import node::x::{a, b};`, in modules of the library.
    Inside,
    /// `import node::x::{a, b};`, everywhere else.
    Outside,
}

impl Form {
    fn root(self) -> &'static str {
        match self {
            Form::Inside => "super",
            Form::Outside => "moment_shadows",
        }
    }

    fn example(self) -> &'static str {
        match self {
            Form::Inside => "import node::module::{item, item};",
            Form::Outside => "import node::module::{item, item};",
        }
    }
}

/// The items that a file imports from one module.
pub(crate) struct Import<'a> {
    pub(crate) module: Token<'a>,
    pub(crate) items: Vec<Token<'a>>,
    /// The byte where the statement starts.
    pub(crate) start: usize,
    /// The line of the statement, from 1; it holds nothing else. Filled in by the file, which counts its lines once.
    pub(crate) line: u32,
}

/// Whether `text` starts with an import of the form that modules of the library use, `import node::x::{a};`.
#[must_use]
pub fn imports_super(text: &str) -> bool {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let tokens = tokens(text).unwrap_or_default();
    matches!(tokens.as_slice(), [import, root, ..] if import.is_word("import") && root.is_word("super"))
}

/// Reads the import that `code` starts with; returns it and the tokens after it.
pub(crate) fn parse<'a, 'b>(
    file: &File<'a>,
    code: &'b [Token<'a>],
    form: Form,
) -> Result<(Import<'a>, &'b [Token<'a>]), LinkError> {
    let mut reader = Reader {
        file,
        form,
        rest: code,
        last: code.first().copied(),
        end_of_line: 0,
    };
    let import = reader.import()?;
    Ok((import, reader.rest))
}

/// Takes the tokens of one import, and says what is wrong at the first that does not fit.
struct Reader<'a, 'b, 'c> {
    file: &'c File<'a>,
    form: Form,
    rest: &'b [Token<'a>],
    last: Option<Token<'a>>,
    end_of_line: usize,
}

impl<'a> Reader<'a, '_, '_> {
    fn import(&mut self) -> Result<Import<'a>, LinkError> {
        let text = self.file.text;
        let start = self.last.map_or(0, |import| import.start);
        let line_start = text[..start].rfind('\n').map_or(0, |end| end + 1);
        self.end_of_line = text[start..]
            .find('\n')
            .map_or(text.len(), |end| start + end);
        if !text[line_start..start].trim().is_empty() {
            return Err(self.wrong("something stands before the import"));
        }
        self.take(|token| token.is_word("import"), "an import is expected")?;
        let module = self.module()?;
        self.take(
            |token| token.kind == Kind::Path,
            "`::` is missing after the module's name",
        )?;
        self.take(|token| token.is_symbol("{"), "items are imported in braces")?;
        let mut items = Vec::new();
        loop {
            items.push(self.take(
                |token| token.kind == Kind::Word,
                "an item's name is missing",
            )?);
            let next = self.take(
                |token| token.is_symbol(",") || token.is_symbol("}"),
                "items are plain names with commas between them (no `as`, no path)",
            )?;
            if next.is_symbol("}") {
                break;
            }
        }
        let end = self.take(|token| token.is_symbol(";"), "`;` is missing")?;
        let after = text[end.range().end..self.end_of_line].trim();
        if !after.is_empty() && !after.starts_with("//") {
            return Err(self.wrong("something stands after the import"));
        }
        Ok(Import {
            module,
            items,
            start,
            line: 0,
        })
    }

    /// The module's path: `folder::x` of the library, or `node::x`.
    fn module(&mut self) -> Result<Token<'a>, LinkError> {
        let (form, wrong_root) = match self.form {
            Form::Inside => (
                self.form,
                "within the library an import starts with `super::super::`",
            ),
            Form::Outside => (
                self.form,
                "outside the library an import starts with `moment_shadows::` or `node::`",
            ),
        };
        let root = self.take(
            |token| token.is_word(form.root()) || (form == Form::Outside && token.is_word("node")),
            wrong_root,
        )?;
        self.path()?;
        if form == Form::Inside {
            self.take(|token| token.is_word("super"), wrong_root)?;
            self.path()?;
        }
        let mut name = self.name()?;
        let mut start = root.start;
        if !root.is_word("node") {
            start = name.start;
            self.path()?;
            name = self.name()?;
        }
        Ok(Token {
            text: self
                .file
                .text
                .get(start..name.range().end)
                .unwrap_or_default(),
            start,
            ..name
        })
    }

    fn path(&mut self) -> Result<Token<'a>, LinkError> {
        self.take(|token| token.kind == Kind::Path, "`::` is missing")
    }

    fn name(&mut self) -> Result<Token<'a>, LinkError> {
        self.take(
            |token| token.kind == Kind::Word,
            "the module's name is missing",
        )
    }

    /// The next token of this line, if it `fits`.
    fn take(
        &mut self,
        fits: impl Fn(&Token<'a>) -> bool,
        reason: &'static str,
    ) -> Result<Token<'a>, LinkError> {
        let Some((&token, rest)) = self.rest.split_first() else {
            return Err(self.wrong(reason));
        };
        if token.start >= self.end_of_line {
            return Err(self.wrong("an import is one line"));
        }
        self.last = Some(token);
        if !fits(&token) {
            return Err(self.wrong(reason));
        }
        self.rest = rest;
        Ok(token)
    }

    /// The error, pointing at the token taken last.
    fn wrong(&self, reason: &'static str) -> LinkError {
        LinkError::WrongForm {
            reason,
            form: self.form.example(),
            at: self.file.at(self.last.map_or(0..0, |token| token.range())),
        }
    }
}
