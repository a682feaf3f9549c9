//! Linked text without what machines do not read.

use std::collections::{BTreeMap, BTreeSet};

use super::Source;
use super::file::File;
use super::import::Form;
use super::tokens::tokens;
use crate::ShaderError;

/// WGSL without comments, empty lines, and declarations that nothing among `roots` reaches: entry points by their names, and
/// `override`s that are given values. Directives stay. What is kept is not changed: it means the same, and lines keep their indents.
///
/// # Errors
/// [`ShaderError`] if the text imports something, or a comment does not end.
pub fn compact(source: Source<'_>, roots: &[&str]) -> Result<String, ShaderError> {
    let form = Form::of(source.text);
    let file = File::parse(source.name.to_owned(), String::new(), source.text, form)?;
    if let Some(import) = file.imports.first() {
        let message = "only linked text is made compact; link it first";
        return Err(file.error(import.path.clone(), message));
    }
    let kept = reached(&file, |name| roots.contains(&name));
    let mut text = String::new();
    let declarations = kept
        .iter()
        .filter_map(|&index| file.declarations.get(index));
    for declaration in declarations {
        let code = file.text.get(declaration.code.clone());
        without_comments(code.unwrap_or_default(), &mut text);
        text.push('\n');
    }
    Ok(text)
}

/// The declarations that those of which `is_root` says so reach by their words, and those without a name, by index.
pub(crate) fn reached(file: &File<'_>, is_root: impl Fn(&str) -> bool) -> BTreeSet<usize> {
    let mut owners: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    let mut waiting = Vec::new();
    for (index, declaration) in file.declarations.iter().enumerate() {
        for name in &declaration.names {
            owners.entry(name.text).or_default().push(index);
        }
        let named = declaration.names.iter().any(|it| is_root(it.text));
        if named || declaration.names.is_empty() {
            waiting.push(index);
        }
    }
    let mut kept = BTreeSet::new();
    while let Some(index) = waiting.pop() {
        if let Some(declaration) = file.declarations.get(index)
            && kept.insert(index)
        {
            let words = declaration.words.iter();
            waiting.extend(words.filter_map(|word| owners.get(word.text)).flatten());
        }
    }
    kept
}

/// Adds code, with a line break and the indent for whatever has one between two tokens.
fn without_comments(code: &str, text: &mut String) {
    let mut end = 0;
    for token in tokens(code).unwrap_or_default() {
        let gap = code.get(end..token.start).unwrap_or_default();
        match gap.rfind('\n') {
            Some(last) => {
                let indent = gap.get(last..).unwrap_or_default();
                // A comment may stand between the indent and the token.
                let spaces = indent.trim_start_matches('\n');
                let spaces = spaces.len() - spaces.trim_start_matches([' ', '\t']).len();
                text.push_str(indent.get(..=spaces).unwrap_or_default());
            }
            None if gap.is_empty() => {}
            None => text.push(' '),
        }
        text.push_str(token.text);
        end = token.range().end;
    }
}
