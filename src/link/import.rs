//! An import: the only form is `import super::super::folder::file::{a, b};` within the library. Outside it the path's root is
//! `moment_shadows`, `node` or the name of a project's own modules; its own modules may say `package` and `super`, and one item
//! needs no braces. All are WESL as it stands.

use core::ops::Range;

use super::file::File;
use super::tokens::{Kind, Token, tokens};
use crate::{Rule, ShaderError};

/// Which of the forms a file uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// `import super::super::folder::file::{a, b};`, in modules of the library.
    Inside,
    /// `import moment_shadows::folder::file::{a, b};` and the like, everywhere else.
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

/// Roots that say where a module lies from the one that imports it, and so name none.
const RELATIVE: [&str; 2] = ["super", "self"];

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

/// Adds `names` to a path.
fn push(path: &mut String, names: &[Token<'_>]) {
    for name in names {
        path.push_str("::");
        path.push_str(name.text);
    }
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
        let (module, path, items) = self.path()?;
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

    /// The module's path and the items that are imported from it: its root, one name or more, and the items in braces or one
    /// without.
    fn path(&mut self) -> Result<(String, Range<usize>, Vec<Token<'a>>), ShaderError> {
        let root = self.take(
            |token| token.kind == Kind::Word,
            self.file.form.wrong_root(),
        )?;
        let mut module = self.root(root)?;
        self.take(|token| token.kind == Kind::Path, "`::` is missing")?;
        let mut names: Vec<Token<'a>> = Vec::new();
        loop {
            let braces = self.rest.first().is_some_and(|next| next.is_symbol("{"));
            if braces && let Some(last) = names.last() {
                let path = root.start..last.range().end;
                push(&mut module, &names);
                return Ok((module, path, self.items()?));
            }
            let missing = match names.as_slice() {
                [] => "the module's name is missing",
                _ => "items are imported in braces, or one by its name",
            };
            let name = self.take(|token| token.kind == Kind::Word, missing)?;
            names.push(name);
            if self.take(|token| token.kind == Kind::Path, "").is_ok() {
                continue;
            }
            self.last = Some(name);
            let Some((item, of @ [.., last])) = names.split_last() else {
                return Err(self.wrong("the item's name is missing"));
            };
            if self.file.form == Form::Inside {
                return Err(self.wrong("items are imported in braces"));
            }
            push(&mut module, of);
            return Ok((module, root.start..last.range().end, vec![*item]));
        }
    }

    /// The path that `root`, the first name of an import, stands for.
    fn root(&mut self, root: Token<'a>) -> Result<String, ShaderError> {
        let own = self.file.module.as_str();
        match (self.file.form, root.text) {
            (Form::Inside, "super") => {
                self.take(|token| token.kind == Kind::Path, "`::` is missing")?;
                self.take(|token| token.is_word("super"), self.file.form.wrong_root())?;
                Ok("moment_shadows".to_owned())
            }
            (Form::Outside, "package") if !own.is_empty() => {
                Ok(own.split("::").next().unwrap_or_default().to_owned())
            }
            (Form::Outside, "super") if !own.is_empty() => self.above(own),
            (Form::Outside, name) if !RELATIVE.contains(&name) => Ok(name.to_owned()),
            _ => Err(self.wrong(self.file.form.wrong_root())),
        }
    }

    /// The path above `own`, by one part for each `super`; the first of them is taken already.
    fn above(&mut self, own: &str) -> Result<String, ShaderError> {
        let mut above = own;
        loop {
            let Some((shorter, _)) = above.rsplit_once("::") else {
                return Err(self.wrong("there is nothing above the root of the modules"));
            };
            above = shorter;
            let [path, next, ..] = self.rest else {
                return Ok(above.to_owned());
            };
            if path.kind != Kind::Path || !next.is_word("super") {
                return Ok(above.to_owned());
            }
            self.rest = self.rest.get(2..).unwrap_or_default();
            self.last = Some(*next);
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
