//! The linker: a file and the modules that it needs become one WGSL text.

mod error;
pub(crate) mod file;
mod import;
mod linked;
mod location;
mod module;
mod prune;
pub(crate) mod tokens;

use std::collections::{BTreeMap, BTreeSet};

pub use self::error::LinkError;
use self::file::File;
use self::import::{Form, Import};
pub use self::linked::{Linked, Origin};
pub use self::location::Location;
pub use self::module::{Module, modules};
use crate::nearest::nearest;

/// A WGSL text with the name that errors show for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Source<'a> {
    /// The file's name; for a generated module, the name it is imported by.
    pub name: &'a str,
    /// The text, imports included.
    pub text: &'a str,
}

impl Source<'_> {
    /// Whether the text is written as a module of the library ([`link_module()`]), not as a shader ([`link()`]): its
    /// imports start with `super::`.
    #[must_use]
    pub fn is_library_module(&self) -> bool {
        import::starts_with_super(self.text)
    }
}

/// Links `source`, a shader outside the library, with the modules that it imports, directly or through other modules.
///
/// `generated` are further modules: each can be imported as `node::<name>`, and may itself import modules of
/// the library and other generated ones.
///
/// The rules of imports:
/// - They come first, before directives and declarations, with nothing else on their lines but a `//` comment.
/// - The only forms are `import moment_shadows::maths::hankel::{hankel_factor};` for the file `wgsl/maths/hankel.wgsl`
///   (`super::super` in place of `moment_shadows` within the library) and `import node::name::{item};` for generated modules,
///   with any number of items over any number of lines. No `as`, no `public`, no path within code, no conditional attribute.
/// - Every item is defined at top level by its module, and imported once; a file imports every item that it uses.
///
/// The result holds `source` whole, and of each module what `source` reaches: the declarations whose names stand in what is linked,
/// and entry points, with the comments above them; other comments stay in their files. Files come once, each after those that it
/// imports, headed by a comment that names it; `source` comes last, but its directives come first. Names are not changed, so no two of the files may define
/// the same name, linked or not.
/// The result depends on the input alone: equal input always gives equal text.
///
/// # Errors
/// [`LinkError`] where a rule is broken, in `source`, in a generated module, or between files.
pub fn link(source: Source<'_>, generated: &[Source<'_>]) -> Result<Linked, LinkError> {
    link_as(Form::Outside, source, generated)
}

/// Links `source`, a file written as a module of the library (`import super::super::maths::hankel::{hankel_factor};`), with the modules
/// that it imports, by the rules of [`link()`].
///
/// # Errors
/// [`LinkError`] where a rule is broken.
pub fn link_module(source: Source<'_>) -> Result<Linked, LinkError> {
    link_as(Form::Inside, source, &[])
}

fn link_as(form: Form, source: Source<'_>, generated: &[Source<'_>]) -> Result<Linked, LinkError> {
    let library = Library::new(generated)?;
    let root = File::parse(source.name.to_owned(), source.text, form)?;
    let mut files = library.closure(root)?;
    refuse_collisions(&files)?;
    refuse_unimported(&files)?;
    prune::prune(&mut files);
    files.retain(|file| file.is_reached);
    Ok(Linked::join(&files))
}

/// Every module that can be imported, by name. A module's text is only read once it is imported.
struct Library<'a> {
    modules: BTreeMap<String, (Form, &'a str)>,
}

impl<'a> Library<'a> {
    fn new(generated: &[Source<'a>]) -> Result<Self, LinkError> {
        module::check_edited_folder()?;
        let library = modules().iter().map(|module| {
            let path = format!("moment_shadows::{}::{}", module.folder, module.name);
            (path, (Form::Inside, module.source))
        });
        let mut known: BTreeMap<_, _> = library.collect();
        for source in generated {
            let path = format!("node::{}", source.name);
            if known.insert(path, (Form::Outside, source.text)).is_some() {
                return Err(LinkError::GeneratedName {
                    module: source.name.to_owned(),
                });
            }
        }
        Ok(Self { modules: known })
    }

    /// `root` and the files it needs, each after those that it imports. Walks without recursion: generated modules may
    /// form a chain of any length.
    fn closure(&self, root: File<'a>) -> Result<Vec<File<'a>>, LinkError> {
        let mut finished: Vec<File<'a>> = Vec::new();
        let mut position: BTreeMap<String, usize> = BTreeMap::new();
        let mut path = vec![Visit {
            module: String::new(),
            file: root,
            next: 0,
        }];
        while let Some(visit) = path.last_mut() {
            if let Some(import) = visit.file.imports.get(visit.next) {
                if let Some(imported) = position.get(&import.module) {
                    if let Some(imported) = finished.get(*imported) {
                        check_items(&visit.file, import, imported)?;
                    }
                    visit.next += 1;
                    continue;
                }
                let module = import.module.clone();
                let at = visit.file.at(import.path.clone());
                let form = visit.file.form;
                if path.iter().any(|above| above.module == module) {
                    return Err(cycle(&path, &module, at));
                }
                let file = self.open(&module, form, at)?;
                path.push(Visit {
                    module,
                    file,
                    next: 0,
                });
            } else if let Some(visit) = path.pop() {
                refuse_duplicates(&visit.file)?;
                position.insert(visit.module, finished.len());
                finished.push(visit.file);
            }
        }
        Ok(finished)
    }

    /// Reads the module that is imported at `at`, by a file of form `form`.
    fn open(&self, module: &str, form: Form, at: Box<Location>) -> Result<File<'a>, LinkError> {
        match self.modules.get(module) {
            Some(&(Form::Inside, text)) => {
                let name = format!("{}.wgsl", module.replace("::", "/"));
                File::parse(name, text, Form::Inside)
            }
            Some(&(Form::Outside, text)) => {
                let name = module.strip_prefix("node::").unwrap_or(module).to_owned();
                File::parse(name, text, Form::Outside)
            }
            None => Err(LinkError::UnknownModule {
                module: form.written(module),
                nearest: self.nearest(module, form),
                at,
            }),
        }
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

/// A file on the way from the root to the file being read.
struct Visit<'a> {
    module: String,
    file: File<'a>,
    /// The import to follow next.
    next: usize,
}

fn cycle(path: &[Visit<'_>], module: &str, at: Box<Location>) -> LinkError {
    let mut names: Vec<_> = path
        .iter()
        .map(|visit| visit.module.as_str())
        .skip_while(|name| *name != module)
        .collect();
    names.push(module);
    LinkError::Cycle {
        cycle: names.join(" -> "),
        at,
    }
}

fn check_items(file: &File<'_>, import: &Import<'_>, imported: &File<'_>) -> Result<(), LinkError> {
    let names = || imported.definitions.iter().map(|name| name.text);
    match import
        .items
        .iter()
        .find(|item| !names().any(|name| name == item.text))
    {
        None => Ok(()),
        Some(item) => Err(LinkError::UnknownItem {
            item: item.text.to_owned(),
            module: import.module.clone(),
            nearest: nearest(item.text, names()),
            at: file.at(item.range()),
        }),
    }
}

fn refuse_duplicates(file: &File<'_>) -> Result<(), LinkError> {
    let mut seen = BTreeMap::new();
    for import in &file.imports {
        for item in &import.items {
            if let Some(first) = seen.insert((&import.module, item.text), *import.lines.start()) {
                return Err(LinkError::DuplicateImport {
                    item: item.text.to_owned(),
                    first,
                    at: file.at(item.range()),
                });
            }
        }
    }
    Ok(())
}

/// Refuses a name that two files define. A name defined twice in one file is left to the WGSL compiler.
fn refuse_collisions(files: &[File<'_>]) -> Result<(), LinkError> {
    let mut seen: BTreeMap<&str, (usize, &File<'_>, _)> = BTreeMap::new();
    for (index, file) in files.iter().enumerate() {
        for name in &file.definitions {
            let (first_index, first_file, first) =
                *seen.entry(name.text).or_insert((index, file, name));
            if first_index != index {
                return Err(LinkError::Collision {
                    name: name.text.to_owned(),
                    at: file.at(name.range()),
                    first: first_file.at(first.range()),
                });
            }
        }
    }
    Ok(())
}

/// Refuses a name that another file defines and this one does not import. Joined files would see it all the same; tools
/// that keep modules apart would not.
fn refuse_unimported(files: &[File<'_>]) -> Result<(), LinkError> {
    let owners: BTreeMap<&str, &File<'_>> = files
        .iter()
        .flat_map(|file| file.definitions.iter().map(move |name| (name.text, file)))
        .collect();
    for file in files {
        let imported: BTreeSet<&str> = file
            .imports
            .iter()
            .flat_map(|import| &import.items)
            .map(|item| item.text)
            .collect();
        let missing = file.uses.iter().find_map(|used| {
            let owner = owners.get(used.text)?;
            (owner.name != file.name && !imported.contains(used.text)).then_some((used, owner))
        });
        if let Some((used, owner)) = missing {
            return Err(LinkError::NotImported {
                item: used.text.to_owned(),
                owner: owner.name.clone(),
                at: file.at(used.range()),
            });
        }
    }
    Ok(())
}
