//! Loading glTF 2.0, text or binary, by way of crate `gltf`.

use std::path::Path;

use glam::{DMat4, DVec4};

use super::Scene;
use super::caught::caught;
use super::gltf_mesh::Loader;
use super::gltf_source::{Source, check_file, check_uri};
use crate::error::LabError;

/// Whether a file that needs this extension is shown: it is read, or only changes how surfaces look.
fn is_supported(extension: &str) -> bool {
    extension.starts_with("KHR_materials_")
        || matches!(
            extension,
            "KHR_mesh_quantization"
                | "KHR_node_visibility"
                | "KHR_texture_transform"
                | "KHR_lights_punctual"
        )
}

/// Whether an extension of materials changes what casts a shadow. None of these is read.
fn changes_casters(extension: &str) -> bool {
    matches!(
        extension,
        "KHR_materials_diffuse_transmission"
            | "KHR_materials_pbrSpecularGlossiness"
            | "KHR_materials_transmission"
            | "KHR_materials_variants"
    )
}

/// Loads a glTF or GLB file: triangles of the default scene in world space, base colour and alpha mask. What is left
/// out (extensions, skins, morph targets, points and lines, blending) is said in `warnings`.
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
    if let Some(extension) = required.iter().find(|name| !is_supported(name)) {
        return Err(format!(
            "it requires the extension '{extension}', which is not supported; export it without compression and texture extensions"
        ));
    }
    let document = gltf::Document::from_json(root).map_err(text)?;
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
    for extension in document.extensions_used() {
        if !is_supported(extension) || changes_casters(extension) {
            loader.warn(format!(
                "the extension {extension} is not read; shadows may differ"
            ));
        }
    }
    for (node, world) in placed_nodes(&document)? {
        if let Some(mesh) = node.mesh() {
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
                    .primitive(&primitive, &world, &item)
                    .map_err(|reason| format!("{item}: {reason}"))?;
            }
        }
    }
    if loader.scene.triangles() == 0 {
        return Err("it has no triangles".to_owned());
    }
    Ok(loader.scene)
}

/// A node for messages.
fn describe(node: &gltf::Node<'_>) -> String {
    format!(
        "node {} '{}'",
        node.index(),
        node.name().unwrap_or("unnamed")
    )
}

/// Whether neither the node nor what is under it can be seen.
fn is_hidden(node: &gltf::Node<'_>) -> bool {
    let visibility = node.extension_value("KHR_node_visibility");
    visibility.is_some_and(|extension| extension["visible"] == false)
        || node.transform().decomposed().2 == [0.0; 3]
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
        if is_hidden(&node) {
            continue;
        }
        let columns = node.transform().matrix();
        let [x, y, z, w] = columns.map(|column| DVec4::from_array(column.map(f64::from)));
        let world = parent * DMat4::from_cols(x, y, z, w);
        if !world.is_finite() {
            return Err(format!("{}: its transform is not finite", describe(&node)));
        }
        let children: Vec<_> = node.children().map(|child| (child, world)).collect();
        open.extend(children.into_iter().rev());
        placed.push((node, world));
    }
    Ok(placed)
}
