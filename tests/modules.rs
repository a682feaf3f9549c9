//! The rules that every module of the library keeps. Each test lists all failures together.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use moment_shadows::{
    Backend, Module, Profile, Source, ValidationOptions, link, modules, validate,
};

#[path = "support/identifiers.rs"]
mod identifiers;

use identifiers::taken_identifiers;

/// What may be called in non-uniform control flow.
const TEXTURE_FUNCTIONS: [&str; 9] = [
    "textureDimensions",
    "textureGather",
    "textureGatherCompare",
    "textureLoad",
    "textureNumLayers",
    "textureNumSamples",
    "textureSampleCompareLevel",
    "textureSampleGrad",
    "textureSampleLevel",
];

/// Words that have no place in a module: what needs uniform control flow, a pipeline or an extension.
const FORBIDDEN: [&str; 8] = [
    "override",
    "enable",
    "requires",
    "diagnostic",
    "discard",
    "group",
    "binding",
    "workgroup_size",
];

fn source(module: &Module) -> (String, &'static str) {
    (
        format!("moment_shadows/{}/{}.wgsl", module.folder, module.name),
        module.source,
    )
}

/// The text without comments, which are `//` comments in every module.
fn code(text: &str) -> String {
    let lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or_default());
    lines.collect::<Vec<_>>().join("\n")
}

fn words(code: &str) -> impl Iterator<Item = &str> {
    code.split(|c: char| !c.is_alphanumeric() && c != '_')
        .filter(|word| !word.is_empty())
}

/// Kind and name of each definition at top level: those at the start of a line.
fn definitions(text: &str) -> Vec<(String, String)> {
    let kinds = ["fn", "struct", "alias", "const", "var", "override"];
    let defined = |line: &str| {
        let mut words = words(line);
        let kind = words
            .next()
            .filter(|kind| line.starts_with(kind) && kinds.contains(kind))?;
        Some((kind.to_owned(), words.next()?.to_owned()))
    };
    text.lines().filter_map(defined).collect()
}

/// The lines of a module's imports, and the others. The linker checks the imports' form.
fn split_imports(text: &str) -> (Vec<&str>, Vec<&str>) {
    let mut within = false;
    text.lines().partition(|line| {
        let import = within || line.starts_with("import ");
        within = import && !line.contains(';');
        import
    })
}

/// The items that a module imports.
fn imports(code: &str) -> BTreeSet<String> {
    let statements = split_imports(code).0.join("\n");
    let items = statements
        .split(';')
        .filter_map(|import| import.split(['{', '}']).nth(1));
    items.flat_map(words).map(str::to_owned).collect()
}

fn camel_case(name: &str) -> String {
    let capital = |part: &str| part[..1].to_uppercase() + &part[1..];
    name.split('_').map(capital).collect()
}

fn assert_none(failures: &[String]) {
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

#[test]
fn the_registry_holds_every_file() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("wgsl");
    let entries = |folder: &Path| {
        fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().path())
    };
    let (folders, others): (Vec<_>, Vec<_>) = entries(&root).partition(|path| path.is_dir());
    assert_eq!(others, [root.join("wesl.toml")]);
    let files: BTreeSet<_> = folders
        .iter()
        .flat_map(|folder| entries(folder))
        .map(|file| file.strip_prefix(&root).unwrap().display().to_string())
        .collect();
    let registered: BTreeSet<_> = modules()
        .iter()
        .map(|module| format!("{}/{}.wgsl", module.folder, module.name))
        .collect();
    assert_eq!(registered, files);
}

#[test]
fn names_are_unique_and_say_their_module() {
    let mut failures = Vec::new();
    let mut seen = BTreeMap::new();
    for module in modules() {
        let name = module.name;
        for (kind, item) in definitions(module.source) {
            if let Some(other) = seen.insert(item.clone(), name) {
                failures.push(format!("{name}: `{item}` is defined in {other} too"));
            }
            // `FourMomentsBias` belongs to `moments`.
            let prefix = match kind.as_str() {
                "fn" => format!("{name}_"),
                "const" => format!("{}_", name.to_uppercase()),
                _ => camel_case(name.strip_suffix('s').unwrap_or(name)),
            };
            if !item.starts_with(&prefix) {
                failures.push(format!(
                    "{name}: {kind} `{item}` does not start with `{prefix}`"
                ));
            }
        }
    }
    assert_none(&failures);
}

#[test]
fn modules_hold_functions_structs_aliases_and_constants_only() {
    let mut failures = Vec::new();
    for module in modules() {
        let name = module.name;
        let (file, text) = source(module);
        let linked = match link(Source { name: &file, text }, &[]) {
            Ok(linked) => linked,
            Err(error) => {
                failures.push(format!("{name}: {error}"));
                continue;
            }
        };
        let parsed = match naga::front::wgsl::parse_str(linked.wgsl()) {
            Ok(parsed) => parsed,
            Err(error) => {
                failures.push(format!("{name}: {}", error.emit_to_string(linked.wgsl())));
                continue;
            }
        };
        if !parsed.global_variables.is_empty() {
            failures.push(format!("{name}: has variables at top level"));
        }
        if !parsed.entry_points.is_empty() {
            failures.push(format!("{name}: has entry points"));
        }
        if !parsed.overrides.is_empty() {
            failures.push(format!("{name}: has overrides"));
        }
        for word in words(&code(text)).filter(|word| FORBIDDEN.contains(word)) {
            failures.push(format!("{name}: uses `{word}`"));
        }
        // The other tests read definitions off the lines; this makes sure that they miss none.
        let found: BTreeSet<_> = definitions(linked.wgsl())
            .into_iter()
            .map(|(_, item)| item)
            .collect();
        let functions = parsed
            .functions
            .iter()
            .filter_map(|(_, function)| function.name.clone());
        let constants = parsed
            .constants
            .iter()
            .filter_map(|(_, constant)| constant.name.clone());
        let types = parsed.types.iter().filter_map(|(_, ty)| ty.name.clone());
        for item in functions
            .chain(constants)
            .chain(types)
            .filter(|item| !item.starts_with("__"))
        {
            if !found.contains(&item) {
                failures.push(format!(
                    "{name}: `{item}` is not defined at the start of a line"
                ));
            }
        }
    }
    assert_none(&failures);
}

/// The hexadecimal numbers in a text that are not integers.
fn hexadecimal_floats(code: &str) -> Vec<&str> {
    code.split(|c: char| !c.is_alphanumeric() && c != '_' && c != '.')
        .filter(|word| word.starts_with("0x") || word.starts_with("0X"))
        .filter(|word| word.contains(['.', 'p', 'P']))
        .collect()
}

#[test]
fn numbers_mean_the_same_to_every_linker() {
    // The crate `wesl` 0.4.0 reads 0x1p-24 as 16^-24 (`tests/wesl`). What else WESL tools differ in, our linker refuses.
    let planted = "0x1p-24 0X1.8P+2f 0x.8 0x1.p1 0xffu 0x7f800000 1.5 1e-7 a0x1p2";
    let expected = ["0x1p", "0X1.8P", "0x.8", "0x1.p1"];
    assert_eq!(hexadecimal_floats(planted), expected);
    let mut failures = Vec::new();
    for module in modules() {
        for number in hexadecimal_floats(&code(module.source)) {
            failures.push(format!("{}: hexadecimal float `{number}`", module.name));
        }
    }
    assert_none(&failures);
}

/// The files below a folder that are written by hand and end in `.wgsl`.
fn wgsl_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            if !["snapshots", "target"].iter().any(|it| path.ends_with(it)) {
                files.extend(wgsl_files(&path));
            }
        } else if path.extension().is_some_and(|it| it == "wgsl") {
            files.push(path);
        }
    }
    files
}

#[test]
fn no_name_is_a_keyword_to_libraries_that_reflect_shaders() {
    // `tests/shaders.rs` looks at what is generated.
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut failures = Vec::new();
    for folder in ["wgsl", "graph/src", "examples", "tests"] {
        let files = wgsl_files(&root.join(folder));
        assert!(!files.is_empty(), "{folder}");
        for file in files {
            let text = fs::read_to_string(&file).unwrap();
            for line in taken_identifiers(&text) {
                let file = file.strip_prefix(root).unwrap().display();
                failures.push(format!(
                    "{file}: another name is needed in `{}`",
                    line.trim()
                ));
            }
        }
    }
    assert_none(&failures);
}

#[test]
fn functions_may_be_called_from_non_uniform_control_flow() {
    let mut failures = Vec::new();
    for module in modules() {
        for word in words(&code(module.source)) {
            let texture_function = word
                .strip_prefix("texture")
                .is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_uppercase()));
            let derivative = ["dpdx", "dpdy", "fwidth"]
                .iter()
                .any(|start| word.starts_with(start));
            let barrier = word.ends_with("Barrier")
                || word.starts_with("atomic")
                || word == "workgroupUniformLoad";
            if (texture_function && !TEXTURE_FUNCTIONS.contains(&word)) || derivative || barrier {
                failures.push(format!("{}: calls `{word}`", module.name));
            }
        }
    }
    assert_none(&failures);
}

#[test]
fn what_is_used_is_imported_and_what_is_imported_is_used() {
    // The linker refuses what is not imported only where a file is linked with the one that defines it.
    let mut failures = Vec::new();
    let mut owner = BTreeMap::new();
    for module in modules() {
        for (_, item) in definitions(module.source) {
            owner.insert(item, module.name);
        }
    }
    for module in modules() {
        let name = module.name;
        let code = code(module.source);
        let imported = imports(&code);
        let body = split_imports(&code).1.join("\n");
        let used: BTreeSet<_> = words(&body).map(str::to_owned).collect();
        for item in &used {
            if owner.get(item).is_some_and(|of| *of != name) && !imported.contains(item) {
                failures.push(format!("{name}: uses `{item}` without importing it"));
            }
        }
        for item in imported.difference(&used) {
            failures.push(format!("{name}: imports `{item}` without using it"));
        }
    }
    assert_none(&failures);
}

#[test]
fn files_and_functions_open_with_a_comment() {
    let mut failures = Vec::new();
    for module in modules() {
        let name = module.name;
        let (_, rest) = split_imports(module.source);
        let first = rest.iter().find(|line| !line.is_empty());
        let first = first.copied().unwrap_or_default();
        if !first.starts_with("// ") {
            failures.push(format!("{name}: does not open with what it computes"));
        }
        if module.source.contains("/*") {
            failures.push(format!(
                "{name}: has a block comment; these tests read `//` only"
            ));
        }
        let lines: Vec<_> = module.source.lines().collect();
        for pair in lines.windows(2) {
            if let [before, line] = pair
                && line.starts_with("fn ")
                && !before.starts_with("//")
            {
                failures.push(format!("{name}: no comment above `{line}`"));
            }
        }
    }
    assert_none(&failures);
}

/// Modules that load depth. GLSL samples depth textures through comparison samplers only, so they are not available on OpenGL.
const LOADS_DEPTH: [&str; 3] = [
    "opaque_depth",
    "percentage_closer",
    "percentage_closer_soft",
];

/// Modules that choose among integers by component, which GLSL ES 3.00 does for floats only. Summed-area tables are made by compute
/// shaders, which it does not have either.
const SELECTS_INTEGERS: [&str; 2] = ["summed_area_table", "moment_soft_shadows"];

#[test]
fn every_module_validates_alone_on_every_backend() {
    let mut failures = Vec::new();
    for module in modules() {
        let (file, text) = source(module);
        for profile in Profile::ALL {
            let options = ValidationOptions {
                profile,
                ..ValidationOptions::default()
            };
            let report = validate(Source { name: &file, text }, &options);
            if !report.is_valid() {
                failures.push(format!("{}: {profile}: {report}", module.name));
                continue;
            }
            assert_eq!(report.outcomes.len(), Backend::ALL.len());
            for (backend, outcome) in report.outcomes {
                let lacking = match backend {
                    Backend::GlslEs300 if module.name == "opaque_depth" => Some("TEXTURE_SAMPLES"),
                    Backend::Glsl450 | Backend::GlslEs300 if LOADS_DEPTH.contains(&module.name) => {
                        Some("textureLoad")
                    }
                    Backend::GlslEs300 if SELECTS_INTEGERS.contains(&module.name) => {
                        Some("`select` by component of integers")
                    }
                    _ => None,
                };
                match (outcome, lacking) {
                    (Ok(()), None) => {}
                    (Err(reason), Some(lacking)) if reason.contains(lacking) => {}
                    (other, _) => {
                        failures.push(format!("{}: {profile}: {backend}: {other:?}", module.name));
                    }
                }
            }
        }
    }
    assert_none(&failures);
}
