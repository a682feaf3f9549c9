//! Loading glTF 2.0, text or binary, with everything checked before it is used.

use std::path::Path;

use glam::{DMat3, DMat4, DVec4};
use gltf::json::validation::{Error as Violation, Validate};
use gltf::material::AlphaMode;

use super::accessor::Reader;
use super::primitive::load_primitive;
use super::resource;
use super::total::Total;
use super::{Material, Scene, SceneError};

/// Loads a glTF or GLB file: triangles of the default scene in world space, base colour and alpha mask. What is left
/// out (skins, morph targets, points and lines, blending) is said in `warnings`.
pub fn load_gltf(file: &Path) -> Result<Scene, SceneError> {
    let bytes = resource::read_file(file)?;
    let gltf = parse(file, &bytes)?;
    let root = gltf.document.as_json();
    let buffers = resource::buffers(file, root, gltf.blob)?;
    let reader = Reader::new(root, &buffers);
    let name = file.file_stem().unwrap_or(file.as_os_str());
    let mut scene = Scene {
        name: name.to_string_lossy().into_owned(),
        meshes: Vec::new(),
        materials: Vec::new(),
        images: Vec::new(),
        ground: None,
        stand: None,
        warnings: Vec::new(),
    };
    load_materials(file, &gltf.document, &reader, &mut scene)?;
    let mut total = Total::default();
    for (node, world) in placed_nodes(file, &gltf.document)? {
        let Some(mesh) = node.mesh() else { continue };
        if node.skin().is_some() {
            scene.warn(format!("{}: its skin is ignored", describe(&node)));
        }
        let label = mesh.name().unwrap_or("unnamed");
        for primitive in mesh.primitives() {
            let item = format!(
                "mesh {} '{label}', primitive {}",
                mesh.index(),
                primitive.index()
            );
            total.count_primitive(file, &item)?;
            let mesh = load_primitive(file, &reader, &primitive, &world, &item, &mut scene)?;
            if let Some(mesh) = mesh {
                total.count(file, &item, &mesh)?;
                scene.meshes.push(mesh);
            }
        }
    }
    if scene.triangles() == 0 {
        return Err(SceneError::NoTriangles {
            file: file.to_owned(),
        });
    }
    Ok(scene)
}

impl Scene {
    /// Adds a warning once. After many, one says that there are more.
    pub(super) fn warn(&mut self, warning: String) {
        const MOST: usize = 100;
        let warning = match self.warnings.len() {
            0..MOST => warning,
            _ => "further warnings are left out".to_owned(),
        };
        if !self.warnings.contains(&warning) {
            self.warnings.push(warning);
        }
    }
}

/// Extensions that may be required: the first changes only how vertices are stored, the others only how surfaces look.
fn is_supported(extension: &str) -> bool {
    extension == "KHR_mesh_quantization"
        || extension == "KHR_lights_punctual"
        || extension.starts_with("KHR_materials_")
}

/// Parses and validates the document itself.
fn parse(file: &Path, bytes: &[u8]) -> Result<gltf::Gltf, SceneError> {
    let malformed = |reason: String| SceneError::Malformed {
        file: file.to_owned(),
        reason,
    };
    // The length in a GLB header counts the header; the parser subtracts it unchecked.
    if bytes.starts_with(b"glTF") {
        let length = bytes
            .get(8..12)
            .and_then(|length| length.try_into().ok())
            .map_or(0, u32::from_le_bytes);
        if length < 12 {
            return Err(malformed("the binary header is cut short".to_owned()));
        }
    }
    let gltf = gltf::Gltf::from_slice_without_validation(bytes)
        .map_err(|error| malformed(error.to_string()))?;
    let root = gltf.document.as_json();
    if let Some(extension) = root
        .extensions_required
        .iter()
        .find(|extension| !is_supported(extension))
    {
        return Err(SceneError::Extension {
            file: file.to_owned(),
            extension: extension.clone(),
        });
    }
    // The validator reads the accessor of each POSITION before it has checked that there is one.
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    for accessor in primitives.flat_map(|primitive| primitive.attributes.values()) {
        if accessor.value() >= root.accessors.len() {
            return Err(malformed(format!(
                "an attribute names accessor {}, but there are only {}",
                accessor.value(),
                root.accessors.len()
            )));
        }
    }
    let mut violations = Vec::new();
    root.validate(root, gltf::json::Path::new, &mut |path, violation| {
        if violation != Violation::Unsupported {
            violations.push(format!("{}: {violation}", path()));
        }
    });
    match violations.into_iter().next() {
        Some(first) => Err(malformed(first)),
        None => Ok(gltf),
    }
}

/// A node for messages.
fn describe(node: &gltf::Node<'_>) -> String {
    format!(
        "node {} '{}'",
        node.index(),
        node.name().unwrap_or("unnamed")
    )
}

/// All nodes of the default scene with their transforms to world space. Without a scene: all roots.
fn placed_nodes<'a>(
    file: &Path,
    document: &'a gltf::Document,
) -> Result<Vec<(gltf::Node<'a>, DMat4)>, SceneError> {
    let failed = |node: &gltf::Node<'_>, reason: &str| SceneError::Node {
        file: file.to_owned(),
        node: describe(node),
        reason: reason.to_owned(),
    };
    let roots: Vec<_> = match document
        .default_scene()
        .or_else(|| document.scenes().next())
    {
        Some(scene) => scene.nodes().collect(),
        None => {
            let children: std::collections::HashSet<usize> = document
                .nodes()
                .flat_map(|node| {
                    node.children()
                        .map(|child| child.index())
                        .collect::<Vec<_>>()
                })
                .collect();
            document
                .nodes()
                .filter(|node| !children.contains(&node.index()))
                .collect()
        }
    };
    let mut visited = vec![false; document.nodes().len()];
    let mut open: Vec<_> = roots
        .into_iter()
        .rev()
        .map(|node| (node, DMat4::IDENTITY))
        .collect();
    let mut placed = Vec::new();
    while let Some((node, parent)) = open.pop() {
        if std::mem::replace(&mut visited[node.index()], true) {
            return Err(failed(
                &node,
                "it is its own descendant or the child of two nodes",
            ));
        }
        let columns = node
            .transform()
            .matrix()
            .map(|column| DVec4::from_array(column.map(f64::from)));
        let local = DMat4::from_cols(columns[0], columns[1], columns[2], columns[3]);
        let world = parent * local;
        if !world.is_finite() {
            return Err(failed(&node, "its transform is not finite"));
        }
        let linear = DMat3::from_mat4(local);
        let lengths = linear.x_axis.length() * linear.y_axis.length() * linear.z_axis.length();
        if linear.determinant().abs() <= 1e-9 * lengths {
            return Err(failed(
                &node,
                "its scale is zero along some axis, which flattens everything in it",
            ));
        }
        let children: Vec<_> = node.children().map(|child| (child, world)).collect();
        open.extend(children.into_iter().rev());
        placed.push((node, world));
    }
    Ok(placed)
}

/// All materials, the default one last, and the images they use.
fn load_materials(
    file: &Path,
    document: &gltf::Document,
    reader: &Reader<'_>,
    scene: &mut Scene,
) -> Result<(), SceneError> {
    let mut loaded = std::collections::HashMap::new();
    let mut image_bytes = 0;
    for material in document.materials() {
        let name = material.name().unwrap_or("unnamed").to_owned();
        let surface = material.pbr_metallic_roughness();
        let texture = match surface.base_color_texture() {
            None => None,
            Some(info) => {
                // By way of the JSON: the wrapper of an image panics if its MIME type is missing.
                let source = reader.root.textures[info.texture().index()].source.value();
                Some(match loaded.get(&source) {
                    Some(&index) => index,
                    None => {
                        let index = scene.images.len();
                        let image = resource::image(file, reader, source)?;
                        image_bytes += image.rgba.len() as u64;
                        if image_bytes > resource::MOST_BYTES {
                            return Err(SceneError::TooLarge {
                                file: file.to_owned(),
                                item: format!("the images up to image {source}"),
                                count: image_bytes,
                                unit: "bytes",
                                limit: resource::MOST_BYTES,
                            });
                        }
                        scene.images.push(image);
                        loaded.insert(source, index);
                        index
                    }
                })
            }
        };
        let mask = match material.alpha_mode() {
            AlphaMode::Opaque => None,
            AlphaMode::Mask => Some(material.alpha_cutoff().unwrap_or(0.5)),
            AlphaMode::Blend => {
                scene.warn(format!(
                    "material '{name}': blending is ignored, it is opaque"
                ));
                None
            }
        };
        scene.materials.push(Material {
            name,
            base_colour: surface.base_color_factor(),
            texture,
            mask,
            double_sided: material.double_sided(),
        });
    }
    scene
        .materials
        .push(Material::plain("default", [0.8, 0.8, 0.8]));
    Ok(())
}
