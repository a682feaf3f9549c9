//! Loading glTF 2.0, text or binary, by way of crate `gltf`.

use std::path::Path;

use glam::DMat4;

use super::caught::caught;
use super::gltf_mesh::Loader;
use super::gltf_source::{Source, check_file, check_uri};
use super::{Scene, extensions, gltf_instances};
use crate::error::LabError;

/// Loads a glTF or GLB file: triangles of the default scene in world space, base colour, alpha mask and blending. The middle of its
/// lowest points is moved to zero before anything is rounded to single precision. What is left out (extensions, skins, morph
/// targets, points and lines) is said in `warnings`.
pub fn load_gltf(file: &Path) -> Result<Scene, LabError> {
    caught(|| load(file)).map_err(|reason| {
        LabError::refused(format!("'{}' cannot be shown: {reason}", file.display()))
    })
}

fn load(file: &Path) -> Result<Scene, String> {
    check_file(file)?;
    let bytes = std::fs::read(file).map_err(|error| error.to_string())?;
    let text = |error: gltf::Error| error.to_string();
    let gltf = gltf::Gltf::from_slice_without_validation(&bytes).map_err(text)?;
    let mut root = gltf.document.into_json();
    // The library would refuse those that it does not know itself.
    let required = std::mem::take(&mut root.extensions_required);
    if let Some(extension) = required.iter().find(|name| !extensions::is_shown(name)) {
        return Err(format!(
            "it requires the extension '{extension}', which is not supported; export it without compression and texture extensions"
        ));
    }
    let document = checked(root)?;
    let folder = file.parent().unwrap_or(Path::new(""));
    for buffer in document.buffers() {
        if let gltf::buffer::Source::Uri(uri) = buffer.source() {
            check_uri(folder, uri)
                .map_err(|reason| format!("buffer {}: {reason}", buffer.index()))?;
        }
    }
    let buffers = gltf::import_buffers(&document, Some(folder), gltf.blob).map_err(text)?;
    let name = file.file_stem().unwrap_or(file.as_os_str());
    let source = Source::new(folder, &buffers);
    let mut loader = Loader::new(source, &document, &name.to_string_lossy());
    for extension in document
        .extensions_used()
        .chain(required.iter().map(String::as_str))
    {
        if extensions::is_warned_of(extension) {
            loader.warn(format!(
                "the extension {extension} is not read; shadows may differ"
            ));
        }
    }
    for (node, world) in placed_nodes(&document)? {
        if let Some(mesh) = node.mesh() {
            let instances = gltf_instances::of_mesh(&node, world, &document, &mut loader.source)
                .map_err(|reason| format!("{}: {reason}", describe(&node)))?;
            if node.skin().is_some() {
                loader.warn(format!("{}: its skin is ignored", describe(&node)));
            }
            for primitive in mesh.primitives() {
                let item = format!(
                    "mesh {} '{}', primitive {}",
                    mesh.index(),
                    mesh.name().unwrap_or("unnamed"),
                    primitive.index()
                );
                loader
                    .primitive(&primitive, &instances, &item)
                    .map_err(|reason| format!("{item}: {reason}"))?;
            }
        }
    }
    if loader.scene.triangles() == 0 {
        return Err("it has no triangles".to_owned());
    }
    Ok(loader.finish())
}

/// The document, if it is valid. The library would refuse accessors without data, which stand for zeros.
fn checked(root: gltf::json::Root) -> Result<gltf::Document, String> {
    let error = match gltf::Document::from_json(root.clone()) {
        Ok(document) => return Ok(document),
        Err(gltf::Error::Validation(mut errors)) => {
            errors.retain(|(path, error)| {
                let place = path.as_str();
                let is_accessor =
                    place.starts_with("accessors[") && place.ends_with("].bufferView");
                !(is_accessor && *error == gltf::json::validation::Error::Missing)
            });
            if errors.is_empty() {
                return Ok(gltf::Document::from_json_without_validation(root));
            }
            gltf::Error::Validation(errors)
        }
        Err(error) => error,
    };
    Err(error.to_string())
}

/// A node for messages.
fn describe(node: &gltf::Node<'_>) -> String {
    format!(
        "node {} '{}'",
        node.index(),
        node.name().unwrap_or("unnamed")
    )
}

/// Whether the file says that neither the node nor what is under it is seen.
fn is_hidden(node: &gltf::Node<'_>) -> bool {
    let visibility = node.extension_value("KHR_node_visibility");
    visibility.is_some_and(|extension| extension["visible"] == false)
}

/// All visible nodes of the default scene with their transforms to world space. Without a scene: all roots.
fn placed_nodes(document: &gltf::Document) -> Result<Vec<(gltf::Node<'_>, DMat4)>, String> {
    let roots: Vec<_> = match document
        .default_scene()
        .or_else(|| document.scenes().next())
    {
        Some(scene) => scene.nodes().collect(),
        None => {
            let mut is_child = vec![false; document.nodes().len()];
            for node in document.nodes() {
                node.children()
                    .for_each(|child| is_child[child.index()] = true);
            }
            let nodes = document.nodes();
            nodes.filter(|node| !is_child[node.index()]).collect()
        }
    };
    let mut visited = vec![false; document.nodes().len()];
    let identity = |node| (node, DMat4::IDENTITY);
    let mut open: Vec<_> = roots.into_iter().rev().map(identity).collect();
    let mut placed = Vec::new();
    while let Some((node, parent)) = open.pop() {
        if std::mem::replace(&mut visited[node.index()], true) {
            let node = describe(&node);
            return Err(format!("{node}: it is the child of two nodes or its own"));
        }
        let world = parent * gltf_instances::of_node(&node);
        if is_hidden(&node) || gltf_instances::vanishes(&world) {
            continue;
        }
        if !world.is_finite() {
            return Err(format!("{}: its transform is not finite", describe(&node)));
        }
        let children: Vec<_> = node.children().map(|child| (child, world)).collect();
        open.extend(children.into_iter().rev());
        placed.push((node, world));
    }
    Ok(placed)
}
