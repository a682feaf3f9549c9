//! An import: the only forms are `import super::super::folder::file::{a, b};` within the library, and
//! `import moment_shadows::folder::file::{a, b};`, `import my_engine::file::{a, b};` or `import node::name::{a, b};` outside it. All are
//! WESL as it stands.

use core::ops::Range;

use super::file::File;
use super::tokens::{Kind, Token, tokens};
use crate::{Rule, ShaderError};

/// Which of the forms a file uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// `import super::super::folder::file::{a, b};`, in modules of the library.
    Inside,
    /// `import moment_shadows::folder::file::{a, b};` and the like with another root, everywhere else.
    Outside,
}

impl Form {
    /// How `text` is written: as a module of the library if its first import starts with `super::`.
    pub(super) fn of(text: &str) -> Self {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        match tokens(text).unwrap_or_default().as_slice() {
            [import, root, ..] if import.is_word("import") && root.is_word("super") => Form::Inside,
            _ => Form::Outside,
        }
    }

    fn example(self) -> &'static str {
        match self {
            Form::Inside => "import super::super::folder::file::{item, item};",
            Form::Outside => "import moment_shadows::folder::file::{item, item};",
        }
    }

    fn wrong_root(self) -> &'static str {
        match self {
            Form::Inside => "within the library an import starts with `super::super::`",
            Form::Outside => {
                "outside the library an import starts with `moment_shadows::`, `node::`, or the name of a project's own modules"
            }
        }
    }

    /// How a file of this form writes the path `module`.
    pub(crate) fn written(self, module: &str) -> String {
        match (self, module.strip_prefix("moment_shadows::")) {
            (Form::Inside, Some(path)) => format!("super::super::{path}"),
            (Form::Inside | Form::Outside, _) => module.to_owned(),
        }
    }
}

/// Roots that say where a module lies from the one that imports it.
const RELATIVE: [&str; 3] = ["super", "package", "self"];

/// The path that a further module of the name `name` is imported by.
pub(super) fn path_of(name: &str) -> Result<String, ShaderError> {
    if !name.contains("::") {
        return Ok(format!("node::{name}"));
    }
    let is_word = |part: &str| {
        matches!(tokens(part).as_deref(), Ok([token])
            if token.kind == Kind::Word && token.text.len() == part.len())
    };
    let root = name.split("::").next().unwrap_or_default();
    if !name.split("::").all(is_word) || RELATIVE.contains(&root) {
        let message = format!(
            "`{name}` is no module's path; write names with `::` between them, the first of which is not {}",
            RELATIVE.join(", ")
        );
        return Err(ShaderError::new(Rule::Import, message));
    }
    Ok(name.to_owned())
}

/// The items that a file imports from one module.
pub(crate) struct Import<'a> {
    /// The module's path from its root (`moment_shadows::folder::file`), however it is written.
    pub(crate) module: String,
    /// The bytes where the path stands.
    pub(crate) path: Range<usize>,
    pub(crate) items: Vec<Token<'a>>,
    /// The bytes of its lines from the word `import` on; they hold nothing else.
    pub(crate) range: Range<usize>,
}

/// Reads the import that `code`, a part of `file`, starts with; returns it and the tokens after it.
pub(crate) fn parse<'a, 'b>(
    file: &File<'a>,
    code: &'b [Token<'a>],
) -> Result<(Import<'a>, &'b [Token<'a>]), ShaderError> {
    let mut reader = Reader {
        file,
        rest: code,
        last: code.first().copied(),
    };
    let import = reader.import()?;
    Ok((import, reader.rest))
}

/// Takes the tokens of one import, and says what is wrong at the first that does not fit.
struct Reader<'a, 'b, 'c> {
    file: &'c File<'a>,
    rest: &'b [Token<'a>],
    last: Option<Token<'a>>,
}

impl<'a> Reader<'a, '_, '_> {
    fn import(&mut self) -> Result<Import<'a>, ShaderError> {
        let text = self.file.text;
        let start = self.last.map_or(0, |import| import.start);
        let line_start = text[..start].rfind('\n').map_or(0, |end| end + 1);
        if !text[line_start..start].trim().is_empty() {
            return Err(self.wrong("something stands before the import"));
        }
        self.take(|token| token.is_word("import"), "an import is expected")?;
        let (module, path) = self.module()?;
        let items = self.items()?;
        let brace = self.last;
        let Ok(semicolon) = self.take(|token| token.is_symbol(";"), "") else {
            self.last = brace;
            return Err(self.wrong("`;` is missing"));
        };
        let end = semicolon.range().end;
        let end_of_line = text[end..].find('\n').map_or(text.len(), |at| end + at);
        let after = text[end..end_of_line].trim();
        let comment = after.is_empty() || after.starts_with("//");
        let next = self.rest.first();
        if !comment || next.is_some_and(|next| next.start < end_of_line) {
            return Err(self.wrong("something stands after the import"));
        }
        Ok(Import {
            module,
            path,
            items,
            range: start..end_of_line,
        })
    }

    /// The module's path, up to the brace: its root, then one name or more.
    fn module(&mut self) -> Result<(String, Range<usize>), ShaderError> {
        let root = self.take(
            |token| token.kind == Kind::Word,
            self.file.form.wrong_root(),
        )?;
        let mut module = match (self.file.form, root.text) {
            (Form::Inside, "super") => {
                self.take(|token| token.kind == Kind::Path, "`::` is missing")?;
                self.take(|token| token.is_word("super"), self.file.form.wrong_root())?;
                "moment_shadows".to_owned()
            }
            (Form::Outside, name) if !RELATIVE.contains(&name) => root.text.to_owned(),
            _ => return Err(self.wrong(self.file.form.wrong_root())),
        };
        self.take(|token| token.kind == Kind::Path, "`::` is missing")?;
        let braces = "items are imported in braces";
        let mut missing = "the module's name is missing";
        loop {
            let name = self.take(|token| token.kind == Kind::Word, missing)?;
            module.push_str("::");
            module.push_str(name.text);
            if self.take(|token| token.kind == Kind::Path, "").is_err() {
                self.last = Some(name);
                return Err(self.wrong(braces));
            }
            if self.rest.first().is_some_and(|next| next.is_symbol("{")) {
                return Ok((module, root.start..name.range().end));
            }
            missing = braces;
        }
    }

    /// The items in their braces. A comma may follow the last.
    fn items(&mut self) -> Result<Vec<Token<'a>>, ShaderError> {
        self.take(|token| token.is_symbol("{"), "items are imported in braces")?;
        let mut items = Vec::new();
        loop {
            items.push(self.take(
                |token| token.kind == Kind::Word,
                "an item's name is missing",
            )?);
            let closes = |token: &Token<'_>| token.is_symbol("}");
            let next = self.take(
                |token| token.is_symbol(",") || closes(token),
                "items are plain names with commas between them (no `as`, no path)",
            )?;
            let more = self.rest.first();
            if closes(&next) || more.is_some_and(closes) && self.take(closes, "").is_ok() {
                return Ok(items);
            }
        }
    }

    /// The next token, if it `fits`.
    fn take(
        &mut self,
        fits: impl Fn(&Token<'a>) -> bool,
        reason: &str,
    ) -> Result<Token<'a>, ShaderError> {
        let Some((&token, rest)) = self.rest.split_first() else {
            return Err(self.wrong(reason));
        };
        self.last = Some(token);
        if !fits(&token) {
            return Err(self.wrong(reason));
        }
        self.rest = rest;
        Ok(token)
    }

    /// The error, pointing at the token taken last.
    fn wrong(&self, reason: &str) -> ShaderError {
        let form = self.file.form.example();
        self.file.error(
            self.last.map_or(0..0, |token| token.range()),
            format!("{reason}; write `{form}`, with nothing else on its lines"),
        )
    }
}
