//! The linker: a file and the modules that it needs become one WGSL text.

mod compact;
mod dialect;
mod error;
pub(crate) mod file;
pub(crate) mod import;
mod linked;
mod location;
mod module;
mod prune;
mod rule;
pub(crate) mod tokens;

use std::collections::{BTreeMap, BTreeSet};

pub use self::compact::compact;
#[cfg(feature = "validate")]
pub(crate) use self::compact::reached;
pub use self::error::ShaderError;
use self::file::File;
use self::import::Form;
pub use self::linked::Linked;
pub use self::location::Location;
pub(crate) use self::module::ITEMS;
pub use self::module::{Module, modules};
pub use self::rule::Rule;
use crate::nearest::nearest;

/// A WGSL text with the name that errors show for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Source<'a> {
    /// The file's name; for a module, the path that it is imported by: `my_engine::lights`, or a name alone for `node::<name>`.
    pub name: &'a str,
    /// The text, imports included.
    pub text: &'a str,
}

/// Links `source`, a shader outside the library, with the modules that it imports, directly or through other modules.
///
/// `modules` are further modules, of an engine or generated: each is imported by the path that is its name, or as `node::<name>` if
/// that is a name alone, and may itself import modules of the library and others of `modules`.
///
/// The rules of imports:
/// - They come first, before directives and declarations, with nothing else on their lines but a `//` comment.
/// - The forms are `import moment_shadows::maths::hankel::{hankel_factor};` for the file `wgsl/maths/hankel.wgsl`
///   (`super::super` in place of `moment_shadows` within the library), and for further modules `import my_engine::lights::{item};` and
///   `import node::name::{item};`, with any number of items over any number of lines; one item needs no braces. Further modules may
///   write `package` for the first name of their own path, and `super` for their path without its last. In `source` `package` is a
///   name as any other: that of modules named `package::lights`. No `as`, no `public`, no path within code, no conditional attribute.
/// - Every item is defined at top level by its module, and imported once; a file imports every item that it uses.
///
/// The result holds `source` whole, and of each module what `source` reaches: the declarations whose names stand in what is linked,
/// and entry points, with the comments above them; other comments stay in their files. Files come once, each after those that it
/// imports, headed by a comment that names it; `source` comes last, but its directives come first. Names are not changed, so no two of the files may define
/// the same name, linked or not.
/// The result depends on the input alone: equal input always gives equal text.
///
/// A text whose first import starts with `super::` is a module of the library, and is linked as such.
///
/// # Errors
/// [`ShaderError`] where a rule is broken, in `source`, in one of `modules`, or between files.
pub fn link(source: Source<'_>, modules: &[Source<'_>]) -> Result<Linked, ShaderError> {
    let library = Library::new(modules)?;
    let form = Form::of(source.text);
    let root = File::parse(source.name.to_owned(), String::new(), source.text, form)?;
    let mut files = library.closure(root)?;
    check_names(&files)?;
    prune::prune(&mut files);
    Ok(Linked::join(&files))
}

/// Every module that can be imported, by name. A module's text is only read once it is imported.
struct Library<'a> {
    modules: BTreeMap<String, (Form, &'a str)>,
}

impl<'a> Library<'a> {
    fn new(further: &[Source<'a>]) -> Result<Self, ShaderError> {
        module::check_edited_folder()?;
        let library = modules().iter().map(|module| {
            let path = format!("moment_shadows::{}::{}", module.folder, module.name);
            (path, (Form::Inside, module.source))
        });
        let mut known: BTreeMap<_, _> = library.collect();
        for source in further {
            let path = import::path_of(source.name)?;
            if known.insert(path, (Form::Outside, source.text)).is_some() {
                let name = source.name;
                let message = format!("two modules are named `{name}`; give one another name");
                return Err(ShaderError::new(Rule::Import, message));
            }
        }
        Ok(Self { modules: known })
    }

    /// `root` and the files it needs, each after those that it imports. Walks without recursion: modules may
    /// form a chain of any length.
    fn closure(&self, root: File<'a>) -> Result<Vec<File<'a>>, ShaderError> {
        let mut finished: Vec<File<'a>> = Vec::new();
        let mut known = BTreeSet::new();
        // Files on the way from the root to the one being read, with the import of each to follow next.
        let mut path = vec![(root, 0)];
        while let Some((file, next)) = path.last_mut() {
            if let Some(import) = file.imports.get(*next) {
                if known.contains(&import.module) {
                    *next += 1;
                    continue;
                }
                let (module, at) = (import.module.clone(), file.at(import.path.clone()));
                if let [item] = import.items.as_slice()
                    && !self.modules.contains_key(&module)
                    && self
                        .modules
                        .contains_key(&format!("{module}::{}", item.text))
                {
                    let written = file.form.written(&format!("{module}::{}", item.text));
                    let message = format!(
                        "`{written}` is a module, of which items are imported; write `import {written}::{{item, item}};`"
                    );
                    return Err(file.error(item.range(), message));
                }
                let form = file.form;
                if let Some(first) = path.iter().position(|(above, _)| above.module == module) {
                    let cycle = path
                        .iter()
                        .skip(first)
                        .map(|(file, _)| file.module.as_str());
                    let cycle: Vec<_> = cycle.chain([module.as_str()]).collect();
                    let message = format!(
                        "the imports form a cycle: {}; move what both need to a third module",
                        cycle.join(" -> ")
                    );
                    return Err(ShaderError::at(Rule::Import, at, message));
                }
                path.push((self.open(module, form, at)?, 0));
            } else if let Some((file, _)) = path.pop() {
                known.insert(file.module.clone());
                finished.push(file);
            }
        }
        Ok(finished)
    }

    /// Reads the module that is imported at `at`, by a file of form `form`.
    fn open(&self, module: String, form: Form, at: Location) -> Result<File<'a>, ShaderError> {
        let Some(&(of, text)) = self.modules.get(&module) else {
            let message = format!(
                "there is no module `{}`; the nearest are {}",
                form.written(&module),
                self.nearest(&module, form)
            );
            return Err(ShaderError::at(Rule::Import, at, message));
        };
        let name = match of {
            Form::Inside => format!("{}.wgsl", module.replace("::", "/")),
            Form::Outside => module.strip_prefix("node::").unwrap_or(&module).to_owned(),
        };
        File::parse(name, module, text, of)
    }

    /// The paths nearest to `module` that a file of form `form` can import; those that end alike, if there are any.
    fn nearest(&self, module: &str, form: Form) -> String {
        let file = |path: &str| path.rsplit("::").next().unwrap_or_default().to_owned();
        let all: Vec<_> = self
            .modules
            .iter()
            .filter(|(_, (of, _))| *of == Form::Inside || form == Form::Outside)
            .map(|(path, _)| path)
            .collect();
        let alike: Vec<_> = all
            .iter()
            .copied()
            .filter(|path| file(path) == file(module))
            .collect();
        let candidates = if alike.is_empty() { all } else { alike };
        let written: Vec<_> = candidates.iter().map(|path| form.written(path)).collect();
        nearest(&form.written(module), written.iter().map(String::as_str))
    }
}

/// Refuses names that two files define, imports of names that their module does not define or that are imported already, and
/// names of other files that are used without being imported: joined files would see them all the same, tools that keep
/// modules apart would not. A name defined twice in one file is left to the WGSL compiler.
fn check_names(files: &[File<'_>]) -> Result<(), ShaderError> {
    let mut owners = BTreeMap::new();
    for file in files {
        for name in file.definitions() {
            let (owner, first) = *owners.entry(name.text).or_insert((file, name));
            if !core::ptr::eq(owner, file) {
                let message = format!(
                    "`{}` is defined twice; rename the one in `{}`",
                    name.text, file.name
                );
                let mut error = file.error(name.range(), message);
                let first = owner.at(first.range()).labelled("defined already");
                error.places.push(first);
                return Err(error);
            }
        }
    }
    let modules: BTreeMap<_, _> = files.iter().map(|it| (it.module.as_str(), it)).collect();
    for file in files {
        let mut imported = BTreeMap::new();
        for import in &file.imports {
            let of = modules.get(import.module.as_str());
            let names = || of.into_iter().flat_map(|of| of.definitions());
            for item in &import.items {
                let message = if !names().any(|name| name.text == item.text) {
                    let nearest = nearest(item.text, names().map(|name| name.text));
                    format!(
                        "module `{}` does not define `{}`; the nearest names are {nearest}",
                        import.module, item.text
                    )
                } else if let Some(first) = imported.insert(item.text, import) {
                    let line = file.at(first.range.clone()).line;
                    format!(
                        "`{}` is imported already in line {line}; remove one of the two",
                        item.text
                    )
                } else {
                    continue;
                };
                return Err(file.error(item.range(), message));
            }
        }
        for used in file.declarations.iter().flat_map(|of| &of.words) {
            let Some((owner, _)) = owners.get(used.text) else {
                continue;
            };
            let known = file.declared.contains(used.text) || imported.contains_key(used.text);
            if !core::ptr::eq(*owner, file) && !known {
                let message = format!(
                    "`{}` is used, but not imported; add it to the imports (it is defined in {})",
                    used.text, owner.name
                );
                return Err(file.error(used.range(), message));
            }
        }
    }
    Ok(())
}
