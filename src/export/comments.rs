//! Comments of declarations and of members, which naga does not carry.

use std::collections::BTreeMap;

use crate::link::file::File;

/// The comments above each declaration by its name, and above each member of a struct as `Struct.member`, with their line breaks.
pub(super) fn comments(wgsl: &str, file: &File<'_>) -> BTreeMap<String, String> {
    let mut comments = BTreeMap::new();
    for declaration in &file.declarations {
        let Some(name) = declaration.names.first() else {
            continue;
        };
        let part = |range| wgsl.get(range).unwrap_or_default();
        let above = part(declaration.range.start..declaration.code.start);
        comments.insert(name.text.to_owned(), above.to_owned());
        let code = part(declaration.code.clone());
        if !code.starts_with("struct ") {
            continue;
        }
        let mut above = String::new();
        for line in code.lines().skip(1) {
            if line.trim_start().starts_with("//") {
                above += &format!("{line}\n");
            } else if let Some((member, _)) = line.trim_start().split_once(':') {
                comments.insert(
                    format!("{}.{member}", name.text),
                    core::mem::take(&mut above),
                );
            }
        }
    }
    comments.retain(|_, comment| !comment.is_empty());
    comments
}
