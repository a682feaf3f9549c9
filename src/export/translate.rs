//! The functions in other languages, by naga, with the names and comments that they have in WGSL.

use std::collections::BTreeMap;

use naga::back::{glsl, hlsl, msl};
use naga::proc::BoundsCheckPolicies;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Module, ShaderStage};

use super::names::Names;
use super::{Target, guard};

/// GLSL is written for an entry point.
fn entry_point(target: Target) -> &'static str {
    match target {
        Target::Glsl => "\n@compute @workgroup_size(1)\nfn main() {\n}\n",
        Target::Hlsl | Target::Msl | Target::Wgsl => "",
    }
}

/// WGSL as the compiler has it.
pub(super) fn parse(wgsl: &str) -> Result<Module, String> {
    naga::front::wgsl::parse_str(wgsl).map_err(|error| error.emit_to_string(wgsl))
}

/// `wgsl` in another language, with `comments` above what they stand above in WGSL, by name.
pub(super) fn translate(
    wgsl: &str,
    target: Target,
    comments: &BTreeMap<String, String>,
) -> Result<String, String> {
    let mut module = parse(&format!("{wgsl}{}", entry_point(target)))?;
    guard::check(&module)?;
    let mut names = Names::default();
    names.replace(&mut module);
    let reserved = reserved(&names, target)?;
    let text = write(&module, target)?;
    let text = names.restored(&text, &reserved, comments);
    Ok(match target {
        Target::Glsl => without_entry_point(&text),
        Target::Hlsl => with_initialisers(&text),
        Target::Msl | Target::Wgsl => text,
    })
}

/// Those of the names that are words of the language: the writer changes them.
fn reserved(names: &Names, target: Target) -> Result<Vec<String>, String> {
    let all = names.distinct();
    let functions = all.iter().map(|name| format!("fn {name}() {{\n}}\n"));
    let module = parse(&(functions.collect::<String>() + entry_point(target)))?;
    let text = write(&module, target)?;
    let written = text.lines().filter_map(|line| line.strip_prefix("void "));
    let written = written.filter_map(|line| line.split('(').next());
    let reserved = all.iter().zip(written).filter(|(name, written)| {
        // One behind a digit is only there for numbers that may follow.
        let behind_digit = name.ends_with(|c: char| c.is_ascii_digit());
        let as_it_is = if behind_digit {
            written.strip_suffix('_')
        } else {
            Some(*written)
        };
        as_it_is != Some(**name)
    });
    Ok(reserved.map(|(name, _)| (*name).to_owned()).collect())
}

fn write(module: &Module, target: Target) -> Result<String, String> {
    let validated = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(module);
    let info = validated.map_err(|error| format!("{error:?}"))?;
    match target {
        Target::Hlsl => write_hlsl(module, &info),
        Target::Glsl => write_glsl(module, &info),
        Target::Msl => write_msl(module, &info),
        Target::Wgsl => Err("WGSL is not translated".to_owned()),
    }
}

fn write_hlsl(module: &Module, info: &ModuleInfo) -> Result<String, String> {
    let options = hlsl::Options {
        shader_model: hlsl::ShaderModel::V5_0,
        ..Default::default()
    };
    let pipeline = hlsl::PipelineOptions::default();
    let mut text = String::new();
    let written = hlsl::Writer::new(&mut text, &options, &pipeline).write(module, info, None);
    written.map_err(|error| error.to_string())?;
    Ok(text)
}

fn write_glsl(module: &Module, info: &ModuleInfo) -> Result<String, String> {
    let options = glsl::Options {
        version: glsl::Version::Desktop(450),
        ..Default::default()
    };
    let pipeline = glsl::PipelineOptions {
        shader_stage: ShaderStage::Compute,
        entry_point: "main".to_owned(),
        multiview: None,
    };
    let mut text = String::new();
    let policies = BoundsCheckPolicies::default();
    glsl::Writer::new(&mut text, module, info, &options, &pipeline, policies)
        .and_then(|mut writer| writer.write())
        .map_err(|error| error.to_string())?;
    Ok(text)
}

fn write_msl(module: &Module, info: &ModuleInfo) -> Result<String, String> {
    let options = msl::Options {
        lang_version: (2, 1),
        ..Default::default()
    };
    let pipeline = msl::PipelineOptions::default();
    let written = msl::write_string(module, info, &options, &pipeline);
    let (text, _) = written.map_err(|error| error.to_string())?;
    Ok(text)
}

/// What a file of functions has no use for: the version and the layout before them, and the entry point behind.
fn without_entry_point(text: &str) -> String {
    let functions = text.split("\nvoid main() {").next().unwrap_or_default();
    let lines = functions.lines();
    let lines = lines.filter(|line| !line.starts_with("#version") && !line.starts_with("layout("));
    lines.map(|line| format!("{line}\n")).collect()
}

/// Constants of several numbers, which some compilers want in braces instead of as what a function makes of them.
fn with_initialisers(text: &str) -> String {
    let line = |line: &str| {
        let made = line
            .split_once(" = Construct")
            .filter(|_| line.starts_with("static const"));
        let in_braces = made.and_then(|(constant, value)| {
            let (_, values) = value.split_once('(')?;
            Some(format!(
                "{constant} = {{ {} }};\n",
                values.strip_suffix(");")?
            ))
        });
        in_braces.unwrap_or_else(|| format!("{line}\n"))
    };
    text.lines().map(line).collect()
}
