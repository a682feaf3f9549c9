//! Shaders that a user could write, for linkers to start from.

use std::collections::BTreeSet;
use std::fmt::Write;

use moment_shadows::{Source, link, modules};

use crate::values::values;

/// Where a user has the modules.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// In a package of the library's name.
    Package,
    /// Copied into a folder of the user's own tree, where imports were spread over several lines.
    Copied,
}

impl Place {
    pub(crate) const ALL: [Place; 2] = [Place::Package, Place::Copied];

    /// The path that the library's folders lie in.
    pub(crate) fn path(self) -> &'static str {
        match self {
            Place::Package => "moment_shadows",
            Place::Copied => "package::shadows",
        }
    }

    /// A name that can be a folder's.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Place::Package => "package",
            Place::Copied => "copied",
        }
    }
}

/// A shader of a user that writes values, but for the path that the modules lie in.
pub(crate) struct Root {
    /// A name that can be a file's.
    pub(crate) name: String,
    /// The text, which imports from the package.
    text: String,
    /// How many words each invocation writes.
    pub(crate) words: usize,
}

impl Root {
    /// The text for modules that lie in `place`.
    pub(crate) fn text(&self, place: Place) -> String {
        match place {
            Place::Package => self.text.clone(),
            Place::Copied => {
                let import = format!("import {}::", Place::Package.path());
                let copied = self
                    .text
                    .replace(&import, &format!("import {}::", place.path()));
                spread_imports(&copied)
            }
        }
    }
}

/// The text with each item that it imports on a line of its own.
pub(crate) fn spread_imports(text: &str) -> String {
    let spread = |line: &str| match line.starts_with("import ") {
        true => line
            .replace('{', "{\n    ")
            .replace(", ", ",\n    ")
            .replace('}', ",\n}"),
        false => line.to_owned(),
    };
    text.lines().map(|line| spread(line) + "\n").collect()
}

/// For each module a shader that writes the values of its constants and functions; and the example, which writes those of its own.
pub(crate) fn roots() -> Vec<Root> {
    let mut roots = Vec::new();
    for module in modules() {
        let (name, text) = (module.name, module.source);
        let linked = link(Source { name, text }, &[]).unwrap();
        let values = values(text, linked.wgsl());
        roots.push(Root {
            name: name.to_owned(),
            text: with_imports(&values.wgsl),
            words: values.words,
        });
    }
    let (name, text) = (
        "forward_shading",
        include_str!("../../examples/forward_shading.wgsl"),
    );
    let linked = link(Source { name, text }, &[]).unwrap();
    let values = values(text, linked.wgsl());
    roots.push(Root {
        name: name.to_owned(),
        text: format!("{text}{}", values.wgsl),
        words: values.words,
    });
    roots
}

/// `code` below imports of what it uses of the library.
fn with_imports(code: &str) -> String {
    let used: BTreeSet<&str> = code
        .split(|c: char| !c.is_alphanumeric() && c != '_')
        .collect();
    let mut text = String::new();
    for module in modules() {
        let items: Vec<_> = items(module.source)
            .filter(|item| used.contains(item))
            .collect();
        if !items.is_empty() {
            let (folder, name, items) = (module.folder, module.name, items.join(", "));
            writeln!(
                text,
                "import moment_shadows::{folder}::{name}::{{{items}}};"
            )
            .unwrap();
        }
    }
    text + code
}

/// The names that a module defines: each begins a line.
pub(crate) fn items(source: &str) -> impl Iterator<Item = &str> {
    source.lines().filter_map(|line| {
        let (kind, rest) = line.split_once(' ')?;
        let name = rest
            .split(|c: char| !c.is_alphanumeric() && c != '_')
            .next();
        name.filter(|_| ["fn", "struct", "alias", "const"].contains(&kind))
    })
}

#[test]
fn every_function_has_a_value() {
    for module in modules() {
        let root = roots().into_iter().find(|it| it.name == module.name);
        let text = root.unwrap().text;
        let functions = module
            .source
            .lines()
            .filter_map(|it| it.strip_prefix("fn "));
        for function in functions.map(|it| it.split('(').next().unwrap()) {
            assert!(text.contains(&format!(" = {function}(")), "{function}");
        }
    }
}
