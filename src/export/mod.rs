//! A technique in a storage as one file of functions, for engines whose shaders are in another language, and vectors that prove a
//! port.
//!
//! The row of the technique becomes a shader without bindings (`root`); what it passes everywhere is baked in (`bake`), what that
//! decides is decided (`fold`), and what nothing reaches any more goes. That is the WGSL. naga writes the other languages
//! (`translate`), names and comments are put back (`names`). Vectors come from running the functions on the processor (`evaluate`).

mod bake;
mod comments;
mod evaluate;
mod fold;
mod guard;
mod header;
mod inputs;
mod names;
mod root;
mod translate;
mod vectors;

use core::fmt;
use std::collections::BTreeMap;

use crate::link::file::File;
use crate::link::import::Form;
use crate::link::reached;
use crate::{MapEncoding, Storage, ValueError};

pub use vectors::{Bits, FunctionVectors, VectorRow, Vectors};

/// A shading language that functions are exported to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Target {
    /// HLSL, shader model 5 and later.
    Hlsl,
    /// GLSL 4.50.
    Glsl,
    /// Metal shading language 2.1.
    Msl,
    /// WGSL without imports.
    Wgsl,
}

impl Target {
    /// Every target.
    pub const ALL: [Target; 4] = [Target::Hlsl, Target::Glsl, Target::Msl, Target::Wgsl];

    /// The name used on command lines.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Target::Hlsl => "hlsl",
            Target::Glsl => "glsl",
            Target::Msl => "msl",
            Target::Wgsl => "wgsl",
        }
    }

    /// How the names of files end.
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Target::Msl => "metal",
            Target::Hlsl | Target::Glsl | Target::Wgsl => self.name(),
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A technique in a storage as functions in another language.
#[derive(Clone, Debug, PartialEq)]
pub struct Exported {
    /// The file.
    pub text: String,
    /// The names of the functions that are meant for others to call, in the order of the file's head.
    pub functions: Vec<&'static str>,
    encoding: MapEncoding,
    wgsl: String,
}

impl Exported {
    /// Inputs of the functions that every file has and what they give, the same for all languages.
    ///
    /// # Errors
    /// [`ValueError`] if a function uses what is not evaluated.
    pub fn vectors(&self) -> Result<Vectors, ValueError> {
        vectors::vectors(&self.encoding, &self.wgsl).map_err(|error| broken(&error))
    }
}

/// Exports a technique in a storage. No adapter is needed.
///
/// # Errors
/// [`ValueError`] for a map whose layers are placed on the device, and for summed-area tables: both are made by several passes.
pub fn export(encoding: &MapEncoding, target: Target) -> Result<Exported, ValueError> {
    let row = encoding.technique().row();
    if row.places_layers {
        let message = "'lvsm' with the splits 'lloyd' places its layers on the device, in passes that a file of functions does not have; \
             export it with splits that are given";
        return Err(ValueError::new("technique", message));
    }
    if encoding.table().is_some() {
        let message = "a summed-area table is made by several passes, which a file of functions does not have; export the map that it \
             is made of";
        return Err(ValueError::new("storage", message));
    }
    let packing = encoding.storage().packing();
    let functions = root::COMMON.iter().chain(row.functions).chain(packing);
    let functions: Vec<&'static str> = functions.copied().collect();
    let wgsl = wgsl(encoding, &functions)?;
    let file = parsed(&wgsl)?;
    let comments = comments::comments(&wgsl, &file);
    let head = header::header(encoding, target, &functions, &wgsl);
    let body = match target {
        Target::Wgsl => wgsl.clone(),
        Target::Hlsl | Target::Glsl | Target::Msl => {
            translate::translate(&wgsl, target, &comments).map_err(|error| broken(&error))?
        }
    };
    Ok(Exported {
        text: format!("{head}\n{}\n", body.trim()),
        functions,
        encoding: encoding.clone(),
        wgsl,
    })
}

/// What is wrong with the library itself.
fn broken(error: &dyn fmt::Display) -> ValueError {
    ValueError::new(
        "technique",
        format!("this technique cannot be exported: {error}"),
    )
}

fn parsed(wgsl: &str) -> Result<File<'_>, ValueError> {
    let file = File::parse(String::new(), String::new(), wgsl, Form::Outside);
    file.map_err(|error| broken(&error))
}

/// The functions with all that they reach, as WGSL.
fn wgsl(encoding: &MapEncoding, functions: &[&'static str]) -> Result<String, ValueError> {
    let row = encoding.technique().row();
    let linked = root::linked(encoding)?;
    let constants: BTreeMap<&str, &str> = row.constants().collect();
    let parameters = [
        ("both", "BOTH_WARPS"),
        ("exponent", "EXPONENT"),
        ("exponents", "EXPONENTS"),
        ("logarithmic", "LOGARITHMIC"),
        ("lower_bound", "LOWER_BOUND"),
        ("stored_as", "STORAGE"),
        ("terms", "TERMS"),
    ];
    let baked = parameters.into_iter();
    let baked = baked.filter(|(_, it)| *it == "STORAGE" || constants.contains_key(it));
    let baked: Vec<_> = baked.collect();
    let text = bake::bake(&linked, &baked, &constants).map_err(|error| broken(&error))?;
    let text = fold::fold(&text, &|condition: &[&str]| {
        known(condition, encoding.storage(), &constants)
    });
    let file = parsed(&text)?;
    let kept = reached(&file, |name| functions.contains(&name));
    let mut left = String::new();
    let mut end = 0;
    for (index, declaration) in file.declarations.iter().enumerate() {
        if !kept.contains(&index) {
            left.push_str(text.get(end..declaration.range.start).unwrap_or_default());
            end = declaration.range.end;
        }
    }
    left.push_str(text.get(end..).unwrap_or_default());
    Ok(tidied(&left))
}

/// Whether a condition is true, by its words, where constants decide it.
fn known(condition: &[&str], storage: Storage, constants: &BTreeMap<&str, &str>) -> Option<bool> {
    let is = |name: &str| {
        name.strip_prefix("STORAGE_")
            .map(|name| name.to_lowercase() == storage.name())
    };
    match condition {
        ["!", rest @ ..] => known(rest, storage, constants).map(|it| !it),
        ["STORAGE", "=", "=", other] => is(other),
        ["STORAGE", "!", "=", other] => is(other).map(|it| !it),
        ["storage_is_float", "(", ")"] => {
            Some(matches!(storage, Storage::Float16 | Storage::Float32))
        }
        [name] => constants.get(name)?.parse().ok(),
        _ => None,
    }
}

/// How a line begins that names the file of what is below it.
const HEADING: &str = "// moment_shadows/";

/// One blank line where there are several, and no heading of a file of which nothing is left.
fn tidied(text: &str) -> String {
    let mut tidied = String::new();
    let mut heading = None;
    let mut is_blank = true;
    for line in text.lines() {
        if line.starts_with(HEADING) {
            heading = Some(line);
            continue;
        }
        if line.trim().is_empty() {
            is_blank = true;
            continue;
        }
        if let Some(heading) = heading.take() {
            tidied += &format!("\n{heading}\n\n");
        } else if is_blank {
            tidied.push('\n');
        }
        is_blank = false;
        tidied += line;
        tidied.push('\n');
    }
    tidied
}
