//! The shaders as files: WGSL, the SPIR-V and the GLSL of each entry point beside it, and an index.

use std::fs;
use std::io;
use std::path::Path;

use naga::{Binding, ScalarKind, ShaderStage, TypeInner};
use serde_json::json;

use super::Shader;
use super::glsl::{extension, versions};
use super::spirv::{Compiled, TARGETS, options};
use crate::error::LabError;

/// Writes all of `shaders` into the new folder `folder`, with `index.json`: for each shader its name, kind, profile, constants
/// and entry points, and the files of its WGSL, SPIR-V and GLSL: of those versions of GLSL that validation calls good. The folder is written beside and renamed: it is there complete or
/// not at all.
pub fn write(shaders: &[Shader], folder: &Path) -> Result<(), LabError> {
    let failed = |error: io::Error| {
        let reason = format!("shaders cannot be written there: {error}; nothing is left there");
        LabError::unsuitable(folder.display(), reason)
    };
    if is_taken(folder).map_err(failed)? {
        let reason = "it exists and is not an empty folder; remove it or name another one";
        return Err(LabError::unsuitable(folder.display(), reason));
    }
    let parent = match folder.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".moment-shadows-").suffix(".part");
    // A temporary folder is private by default; a result is as readable as any other folder.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o777));
    let part = builder.tempdir_in(parent).map_err(failed)?;
    let mut entries = Vec::new();
    for shader in shaders {
        let wgsl = format!("{}.wgsl", shader.name);
        fs::write(part.path().join(&wgsl), &shader.wgsl).map_err(failed)?;
        let compiled = Compiled::new(&shader.name, &shader.wgsl, &shader.constants)?;
        let versions = versions(shader);
        let mut entry_points = Vec::new();
        for entry_point in compiled.entry_points() {
            let mut spirv = Vec::new();
            for (target, version) in TARGETS {
                let file = format!("{}.{}.{target}.spv", shader.name, entry_point.name);
                let words = compiled.spirv(entry_point, &options(version))?;
                fs::write(part.path().join(&file), bytemuck::cast_slice(&words)).map_err(failed)?;
                spirv.push(json!({ "target": target, "file": file }));
            }
            let mut glsl = Vec::new();
            for (target, version) in &versions {
                let extension = extension(entry_point.stage);
                let file = format!("{}.{}.{target}.{extension}", shader.name, entry_point.name);
                let text = compiled.glsl(entry_point, *version)?;
                fs::write(part.path().join(&file), text).map_err(failed)?;
                glsl.push(json!({ "target": target, "file": file }));
            }
            entry_points.push(json!({
                "name": entry_point.name,
                "stage": stage(entry_point.stage),
                // For a fragment stage, a format that each output can be drawn to, by location.
                "targets": targets(compiled.module(), entry_point),
                "spirv": spirv,
                "glsl": glsl,
            }));
        }
        entries.push(json!({
            "name": shader.name,
            "kind": shader.kind,
            "profile": shader.profile,
            "wgsl": wgsl,
            "constants": shader.constants,
            "entry_points": entry_points,
        }));
    }
    let index = json!({ "version": 1, "shaders": entries });
    let text = serde_json::to_string_pretty(&index)?;
    fs::write(part.path().join("index.json"), text).map_err(failed)?;
    fs::rename(part.path(), folder).map_err(failed)?;
    // It has been renamed: there is nothing left to remove.
    let _ = part.keep();
    Ok(())
}

/// Whether something is there that must not be replaced.
fn is_taken(folder: &Path) -> io::Result<bool> {
    match fs::read_dir(folder) {
        Ok(mut files) => Ok(files.next().is_some()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) if error.kind() == io::ErrorKind::NotADirectory => Ok(true),
        Err(error) => Err(error),
    }
}

fn stage(stage: ShaderStage) -> &'static str {
    match stage {
        ShaderStage::Vertex => "vertex",
        ShaderStage::Fragment => "fragment",
        _ => "compute",
    }
}

/// For each location that a fragment stage writes, a format with as many channels of its kind.
fn targets(module: &naga::Module, entry_point: &naga::EntryPoint) -> Vec<Option<&'static str>> {
    let mut targets = Vec::new();
    let Some(result) = &entry_point.function.result else {
        return targets;
    };
    if entry_point.stage != ShaderStage::Fragment {
        return targets;
    }
    let mut push = |binding: &Option<Binding>, ty| {
        if let Some(Binding::Location { location, .. }) = binding {
            let location = *location as usize;
            targets.resize(targets.len().max(location + 1), None);
            targets[location] = format(&module.types[ty].inner);
        }
    };
    push(&result.binding, result.ty);
    if let TypeInner::Struct { members, .. } = &module.types[result.ty].inner {
        for member in members {
            push(&member.binding, member.ty);
        }
    }
    targets
}

fn format(ty: &TypeInner) -> Option<&'static str> {
    let (channels, kind) = match ty {
        TypeInner::Scalar(scalar) => (1, scalar.kind),
        TypeInner::Vector { size, scalar } => (*size as u32, scalar.kind),
        _ => return None,
    };
    match (kind, channels) {
        (ScalarKind::Float, 1) => Some("r8unorm"),
        (ScalarKind::Float, 2) => Some("rg8unorm"),
        (ScalarKind::Float, 4) => Some("rgba8unorm"),
        (ScalarKind::Uint, 1) => Some("r32uint"),
        (ScalarKind::Uint, 4) => Some("rgba32uint"),
        _ => None,
    }
}
