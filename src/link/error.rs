//! What can be wrong with the imports of a file.

use std::path::PathBuf;

use crate::Location;

/// An import that does not follow the rules of [`link`](crate::link()), with the place where it stands.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LinkError {
    /// An import that is not of the one form that is allowed where it stands.
    #[error("{reason}; write `{form}`, with nothing else on its lines\n{at}")]
    WrongForm {
        /// What is wrong.
        reason: &'static str,
        /// The form that is allowed in this file.
        form: &'static str,
        /// The import, or the part of it that is wrong.
        at: Box<Location>,
    },
    /// An import after a directive or declaration, or within one.
    #[error("imports come first; move this one above line {first_code}\n{at}")]
    ImportAfterCode {
        /// The line where the code of the file starts, from 1.
        first_code: u32,
        /// The word `import`.
        at: Box<Location>,
    },
    /// A path such as `super::hankel::hankel_factor(b)` within code.
    #[error("paths within code are not supported; import the item and use its name alone\n{at}")]
    InlinePath {
        /// The `::`.
        at: Box<Location>,
    },
    /// An attribute `@if`, `@elif` or `@else`.
    #[error(
        "conditional translation (`@{attribute}`) is not supported; use a constant, or another file\n{at}"
    )]
    Conditional {
        /// The attribute, without `@`.
        attribute: String,
        /// The attribute's name.
        at: Box<Location>,
    },
    /// The word `public`.
    #[error("`public` is not supported: every item can be imported; remove the word\n{at}")]
    Public {
        /// The word.
        at: Box<Location>,
    },
    /// A module that exists neither in the library nor among the generated ones.
    #[error("there is no module `{module}`; the nearest are {nearest}\n{at}")]
    UnknownModule {
        /// The path of the module asked for.
        module: String,
        /// The nearest paths of modules, quoted, nearest first.
        nearest: String,
        /// The path in the import.
        at: Box<Location>,
    },
    /// An item that the module does not define.
    #[error("module `{module}` does not define `{item}`; the nearest names are {nearest}\n{at}")]
    UnknownItem {
        /// The item asked for.
        item: String,
        /// The path of the module it was asked from.
        module: String,
        /// The nearest names that the module defines, quoted, nearest first.
        nearest: String,
        /// The item's name in the import.
        at: Box<Location>,
    },
    /// An item that a file imports twice.
    #[error("`{item}` is imported already in line {first}; remove one of the two\n{at}")]
    DuplicateImport {
        /// The item.
        item: String,
        /// The line of the first import, from 1.
        first: u32,
        /// The second import of the item.
        at: Box<Location>,
    },
    /// A name of another module that a file uses without importing it.
    #[error(
        "`{item}` is used, but not imported; add it to the imports (it is defined in {owner})\n{at}"
    )]
    NotImported {
        /// The item.
        item: String,
        /// The file that defines it.
        owner: String,
        /// The first use.
        at: Box<Location>,
    },
    /// Modules that import each other.
    #[error("the imports form a cycle: {cycle}; move what both need to a third module\n{at}")]
    Cycle {
        /// The modules of the cycle in order, joined by arrows; the first is also the last.
        cycle: String,
        /// The module's path in the import that closes the cycle.
        at: Box<Location>,
    },
    /// A name that two of the linked files define. Linked files share one namespace.
    #[error("`{name}` is defined twice; rename the one in `{}`\n{at}\ndefined already\n{first}", at.file)]
    Collision {
        /// The name.
        name: String,
        /// The definition in the file that comes later in the linked text.
        at: Box<Location>,
        /// The definition in the file that comes earlier.
        first: Box<Location>,
    },
    /// A generated module with the name of another.
    #[error("two generated modules are named `{module}`; give one another name")]
    GeneratedName {
        /// The name.
        module: String,
    },
    /// A variable that names a folder of edited modules which does not exist.
    #[error(
        "the environment variable {variable} names {}, which is no folder; name one, or unset it", folder.display()
    )]
    NoFolder {
        /// The environment variable.
        variable: &'static str,
        /// The path that the variable names.
        folder: PathBuf,
    },
    /// A block comment without its end.
    #[error("this comment does not end; close it with `*/`\n{at}")]
    UnterminatedComment {
        /// The start of the comment.
        at: Box<Location>,
    },
}
