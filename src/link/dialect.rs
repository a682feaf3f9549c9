//! Dialects of WGSL, told by lines that begin with `#`: no WGSL has that symbol outside of comments.

use super::file::File;
use super::tokens::Token;
use crate::{Rule, ShaderError};

/// Words after the `#`, whose dialect they are, and what makes WGSL of it.
const DIALECTS: [(&[&str], &str, &str); 3] = [
    (
        &["import", "define_import_path"],
        "a preprocessor's: that of naga_oil, Vello or another",
        "validate what it makes of the file; imports of this library are `import moment_shadows::folder::file::{item};`",
    ),
    (
        &[
            "ifdef", "ifndef", "if", "else", "elif", "endif", "define", "undef",
        ],
        "a preprocessor's",
        "WGSL has no conditional text: validate what the preprocessor makes of it, once for each set of definitions in use",
    ),
    (
        &["include"],
        "a preprocessor's",
        "WGSL includes no files: validate what the preprocessor makes of it, or give the file as a module and import it",
    ),
];

/// Refuses a file of another dialect, and says which it is.
pub(super) fn refuse(file: &File<'_>, tokens: &[Token<'_>]) -> Result<(), ShaderError> {
    let Some(place) = tokens.iter().position(|token| token.is_symbol("#")) else {
        return Ok(());
    };
    let Some(word) = tokens.get(place + 1) else {
        return Err(refused(file, tokens[place].range(), "WGSL has no `#`"));
    };
    let range = tokens[place].start..word.range().end;
    let dialect = DIALECTS
        .iter()
        .find(|(words, ..)| words.contains(&word.text));
    let Some((_, whose, remedy)) = dialect else {
        return Err(refused(
            file,
            range,
            "WGSL has no `#`; this is another language's line",
        ));
    };
    let message = format!("`#{}` is no WGSL but {whose}; {remedy}", word.text);
    Err(refused(file, range, &message))
}

fn refused(file: &File<'_>, range: core::ops::Range<usize>, message: &str) -> ShaderError {
    ShaderError {
        rule: Rule::Dialect,
        ..file.error(range, message)
    }
}
