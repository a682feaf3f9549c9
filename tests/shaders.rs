//! The list of every shader, and the folder that it is written to for other compilers.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

#[path = "support/identifiers.rs"]
mod identifiers;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use moment_shadows::{Profile, Source, ValidationOptions, modules, validate};
use moment_shadows_lab::error::LabError;
use moment_shadows_lab::shaders::{self, Kind, Shader};
use serde_json::Value;

use identifiers::taken_identifiers;

fn shader(name: &str, wgsl: &str) -> Shader {
    Shader {
        name: name.to_owned(),
        kind: Kind::Node,
        profile: Profile::WebgpuCore,
        wgsl: wgsl.to_owned(),
        constants: BTreeMap::new(),
    }
}

const SMALL: &str = "@compute @workgroup_size(1) fn nothing() {}";

fn files(folder: &Path) -> BTreeSet<String> {
    let name = |file: std::io::Result<std::fs::DirEntry>| file.unwrap().file_name();
    let names = std::fs::read_dir(folder).unwrap().map(name);
    names.map(|name| name.into_string().unwrap()).collect()
}

#[test]
fn every_module_is_listed_alone_and_called() {
    let all = shaders::all().unwrap();
    let count = |kind| all.iter().filter(|shader| shader.kind == kind).count();
    assert_eq!(count(Kind::Module), modules().len());
    assert_eq!(count(Kind::Calls), modules().len());
    assert_eq!(count(Kind::Node), shaders::nodes().unwrap().len());
    assert_eq!(count(Kind::Example), 1);
    let names: BTreeSet<&str> = all.iter().map(|shader| shader.name.as_str()).collect();
    assert_eq!(names.len(), all.len());
    // Names become names of files.
    let legal = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    assert!(
        names.iter().all(|name| name.chars().all(legal)),
        "{names:?}"
    );
}

#[test]
fn every_function_of_a_module_is_called_where_control_flow_is_not_uniform() {
    let all = shaders::all().unwrap();
    for module in modules() {
        let name = format!("calls_{}", module.name);
        let wgsl = &all.iter().find(|shader| shader.name == name).unwrap().wgsl;
        let (_, calls) = wgsl.split_once("fn call(").unwrap();
        // naga's list of functions, where the shader was made from the text.
        let parsed = naga::front::wgsl::parse_str(wgsl).unwrap();
        let own = |function: &naga::Function| {
            let name = function.name.clone().unwrap();
            module
                .source
                .contains(&format!("fn {name}("))
                .then_some(name)
        };
        let functions: Vec<String> = parsed
            .functions
            .iter()
            .filter_map(|(_, f)| own(f))
            .collect();
        assert!(!functions.is_empty(), "{}", module.name);
        assert_eq!(calls.matches("if place.x > 0.0 {").count(), functions.len());
        for function in functions {
            assert!(calls.contains(&format!("{function}(")), "{function}");
        }
    }
}

#[test]
fn no_name_in_a_linked_shader_is_a_keyword_to_libraries_that_reflect_shaders() {
    let mut failures = Vec::new();
    for shader in shaders::all().unwrap() {
        for line in taken_identifiers(&shader.wgsl) {
            failures.push(format!(
                "{}: another name is needed in `{}`",
                shader.name,
                line.trim()
            ));
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

#[test]
fn calls_are_made_with_whatever_a_function_takes() {
    let module = "
fn plain() {
}

fn several(
    map: texture_2d_array<f32>,
    other: texture_2d_array<f32>,
    map_sampler: sampler,
    weights: array<vec4f, 2>,
    sum: ptr<function, vec2<f32>>,
) -> f32 {
    return weights[0].x + (*sum).x;
}
";
    let text = shaders::calls(module, module);
    let source = Source {
        name: "calls.wgsl",
        text: &text,
    };
    let report = validate(source, &ValidationOptions::default());
    assert!(report.is_valid(), "{report}");
    assert!(text.contains("        plain();\n"), "{text}");
    let call = "_ = several(called_resource_0, called_resource_0, called_resource_1, argument_3, &argument_4);";
    assert!(text.contains(call), "{text}");
}

#[test]
fn the_folder_holds_what_its_index_names() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path().join("shaders");
    let all = shaders::all().unwrap();
    shaders::write(&all, &folder).unwrap();
    assert_eq!(files(temporary.path()), ["shaders".to_owned()].into());
    let index = std::fs::read(folder.join("index.json")).unwrap();
    let index: Value = serde_json::from_slice(&index).unwrap();
    let mut named = BTreeSet::from(["index.json".to_owned()]);
    let entries = index["shaders"].as_array().unwrap();
    assert_eq!(entries.len(), all.len());
    for (entry, shader) in entries.iter().zip(&all) {
        assert_eq!(entry["name"], shader.name.as_str());
        assert_eq!(entry["profile"], shader.profile.name());
        let wgsl = entry["wgsl"].as_str().unwrap();
        let text = std::fs::read_to_string(folder.join(wgsl)).unwrap();
        assert_eq!(text, shader.wgsl);
        named.insert(wgsl.to_owned());
        let entry_points = entry["entry_points"].as_array().unwrap();
        assert_eq!(
            entry_points.is_empty(),
            shader.kind == Kind::Module,
            "{wgsl}"
        );
        for entry_point in entry_points {
            let fragment = entry_point["stage"] == "fragment";
            let targets = entry_point["targets"].as_array().unwrap();
            // Every fragment stage of ours writes one target.
            assert_eq!(targets.len(), usize::from(fragment), "{wgsl}");
            assert!(targets.iter().all(Value::is_string), "{wgsl}");
            // Vulkan 1.1 takes SPIR-V 1.3, Vulkan 1.3 takes 1.6.
            for (spirv, version) in entry_point["spirv"].as_array().unwrap().iter().zip([3, 6]) {
                let file = spirv["file"].as_str().unwrap();
                let bytes = std::fs::read(folder.join(file)).unwrap();
                assert_eq!(bytes[..8], [3, 2, 0x23, 7, 0, version, 1, 0], "{file}");
                named.insert(file.to_owned());
            }
            for glsl in entry_point["glsl"].as_array().unwrap() {
                let (file, target) = (glsl["file"].as_str().unwrap(), &glsl["target"]);
                let text = std::fs::read_to_string(folder.join(file)).unwrap();
                let version = if target == "300es" { "300 es" } else { "450" };
                assert!(text.starts_with(&format!("#version {version}")), "{file}");
                named.insert(file.to_owned());
            }
        }
    }
    assert_eq!(files(&folder), named);
}

#[test]
fn an_existing_folder_is_left_alone_unless_it_is_empty() {
    let folder = tempfile::tempdir().unwrap();
    let shaders = [shader("small", SMALL)];
    let full = folder.path().join("full");
    std::fs::create_dir(&full).unwrap();
    std::fs::write(full.join("mine"), "text").unwrap();
    for taken in [&full, &full.join("mine")] {
        let error = shaders::write(&shaders, taken).unwrap_err();
        assert!(
            matches!(&error, LabError::Unsuitable { file, .. } if *file == taken.display().to_string()),
            "{error}"
        );
        assert!(
            error.to_string().contains("is not an empty folder"),
            "{error}"
        );
    }
    assert_eq!(files(&full), ["mine".to_owned()].into());
    let empty = folder.path().join("empty");
    std::fs::create_dir(&empty).unwrap();
    shaders::write(&shaders, &empty).unwrap();
    assert!(files(&empty).contains("small.nothing.vulkan1.1.spv"));
}

#[test]
fn nothing_is_left_of_a_folder_that_cannot_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("shaders");
    let shaders = [
        shader("small", SMALL),
        shader("wrong", "fn wrong() -> f32 { return true; }"),
    ];
    let error = shaders::write(&shaders, &out).unwrap_err();
    assert!(
        matches!(&error, LabError::Unsuitable { file, .. } if file == "wrong"),
        "{error}"
    );
    let error = shaders::write(&shaders[..1], &out.join("below")).unwrap_err();
    assert!(error.to_string().contains("cannot be written"), "{error}");
    assert!(files(folder.path()).is_empty());
}
