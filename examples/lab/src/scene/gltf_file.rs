//! Loading glTF 2.0, text or binary, with everything checked before it is used.

use std::path::Path;

use glam::{DMat3, DMat4, DVec3, DVec4};
use gltf::json::accessor::Type;
use gltf::json::validation::{Error as Violation, Validate};
use gltf::material::AlphaMode;
use gltf::mesh::{Mode, Semantic};

use super::accessor::{MOST_ELEMENTS, Reader};
use super::resource;
use super::{Material, Mesh, Scene, SceneError};

/// Loads a glTF or GLB file: triangles of the default scene in world space, base colour and alpha mask. What is left
/// out (skins, morph targets, points and lines, blending) is said in `warnings`.
pub fn load_gltf(file: &Path) -> Result<Scene, SceneError> {
    let bytes = resource::read_file(file)?;
    let gltf = parse(file, &bytes)?;
    let root = gltf.document.as_json();
    let buffers = resource::buffers(file, root, gltf.blob)?;
    let reader = Reader {
        root,
        buffers: &buffers,
    };
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
            load_primitive(file, &reader, &primitive, &world, &item, &mut scene)?;
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
    /// Adds a warning once.
    fn warn(&mut self, warning: String) {
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
                        scene.images.push(resource::image(file, reader, source)?);
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

/// Adds one primitive, placed by `world`.
fn load_primitive(
    file: &Path,
    reader: &Reader<'_>,
    primitive: &gltf::Primitive<'_>,
    world: &DMat4,
    item: &str,
    scene: &mut Scene,
) -> Result<(), SceneError> {
    if primitive.morph_targets().next().is_some() {
        scene.warn(format!("{item}: its morph targets are ignored"));
    }
    if matches!(
        primitive.mode(),
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip
    ) {
        scene.warn(format!("{item}: points and lines are ignored"));
        return Ok(());
    }
    let failed = |attribute: &str, accessor: usize, reason| SceneError::Accessor {
        file: file.to_owned(),
        item: format!("{item}, {attribute} (accessor {accessor})"),
        reason,
    };
    let Some(accessor) = primitive.get(&Semantic::Positions) else {
        scene.warn(format!("{item}: it has no positions and is ignored"));
        return Ok(());
    };
    let local: Vec<[f32; 3]> = reader
        .vectors(accessor.index(), Type::Vec3)
        .map_err(|reason| failed("POSITION", accessor.index(), reason))?;
    check_finite(file, item, "POSITION", &local)?;
    let indices = match primitive.indices() {
        Some(accessor) => reader
            .indices(accessor.index())
            .map_err(|reason| failed("indices", accessor.index(), reason))?,
        None => (0..local.len() as u32).collect(),
    };
    if let Some(&index) = indices.iter().find(|&&index| index as usize >= local.len()) {
        return Err(SceneError::Index {
            file: file.to_owned(),
            item: item.to_owned(),
            index,
            vertices: local.len(),
        });
    }
    let normals = match primitive.get(&Semantic::Normals) {
        None => None,
        Some(accessor) => {
            let normals: Vec<[f32; 3]> = reader
                .vectors(accessor.index(), Type::Vec3)
                .map_err(|reason| failed("NORMAL", accessor.index(), reason))?;
            check_finite(file, item, "NORMAL", &normals)?;
            Some(normals)
        }
    };
    let material = primitive
        .material()
        .index()
        .unwrap_or(scene.materials.len() - 1);
    let set = primitive
        .material()
        .pbr_metallic_roughness()
        .base_color_texture()
        .map_or(0, |info| info.tex_coord());
    let uvs = match primitive.get(&Semantic::TexCoords(set)) {
        None => {
            if scene.materials[material].texture.is_some() {
                scene.warn(format!(
                    "{item}: it has a texture but no coordinates for it"
                ));
            }
            vec![[0.0; 2]; local.len()]
        }
        Some(accessor) => {
            let uvs: Vec<[f32; 2]> = reader
                .vectors(accessor.index(), Type::Vec2)
                .map_err(|reason| failed("TEXCOORD", accessor.index(), reason))?;
            check_finite(file, item, "TEXCOORD", &uvs)?;
            uvs
        }
    };
    for (attribute, length) in [
        ("NORMAL", normals.as_ref().map_or(local.len(), Vec::len)),
        ("TEXCOORD", uvs.len()),
    ] {
        if length != local.len() {
            return Err(SceneError::Accessor {
                file: file.to_owned(),
                item: format!("{item}, {attribute}"),
                reason: format!("it has {length} entries for {} positions", local.len()),
            });
        }
    }
    let positions: Vec<[f32; 3]> = local
        .iter()
        .map(|&position| {
            world
                .transform_point3(to_f64(position))
                .as_vec3()
                .to_array()
        })
        .collect();
    check_finite(file, item, "placed POSITION", &positions)?;
    let to_world = DMat3::from_mat4(*world).inverse().transpose();
    let normals = normals.map(|normals| {
        normals
            .iter()
            .map(|&normal| {
                (to_world * to_f64(normal))
                    .normalize_or_zero()
                    .as_vec3()
                    .to_array()
            })
            .collect()
    });
    let indices = triangles(primitive.mode(), &indices);
    let mesh = match normals {
        Some(normals) => Mesh {
            positions,
            normals,
            uvs,
            indices,
            material,
            ground: false,
        },
        None => flat(&positions, &uvs, &indices, material),
    };
    // Flattening multiplies instances, so the whole is limited, not only its parts.
    let vertices: usize = scene.meshes.iter().map(|mesh| mesh.positions.len()).sum();
    let all = [
        ("vertices", vertices + mesh.positions.len()),
        ("triangles", scene.triangles() + mesh.indices.len() / 3),
    ];
    for (unit, count) in all {
        if count as u64 > MOST_ELEMENTS {
            return Err(SceneError::TooLarge {
                file: file.to_owned(),
                item: format!("the scene up to {item}"),
                count: count as u64,
                unit,
                limit: MOST_ELEMENTS,
            });
        }
    }
    if !mesh.indices.is_empty() {
        scene.meshes.push(mesh);
    }
    Ok(())
}

fn to_f64([x, y, z]: [f32; 3]) -> DVec3 {
    DVec3::new(f64::from(x), f64::from(y), f64::from(z))
}

/// Refuses the first value with a component that is NaN or infinite.
fn check_finite<const N: usize>(
    file: &Path,
    item: &str,
    attribute: &'static str,
    values: &[[f32; N]],
) -> Result<(), SceneError> {
    match values
        .iter()
        .position(|value| value.iter().any(|component| !component.is_finite()))
    {
        None => Ok(()),
        Some(vertex) => Err(SceneError::Vertex {
            file: file.to_owned(),
            item: item.to_owned(),
            vertex,
            attribute,
            value: values[vertex].to_vec(),
        }),
    }
}

/// The indices of a triangle list, strip or fan as those of a list. An incomplete last triangle is dropped.
fn triangles(mode: Mode, indices: &[u32]) -> Vec<u32> {
    match mode {
        Mode::TriangleStrip => indices
            .windows(3)
            .enumerate()
            .flat_map(|(number, corner)| {
                // Every second triangle of a strip turns the other way.
                if number % 2 == 0 {
                    [corner[0], corner[1], corner[2]]
                } else {
                    [corner[1], corner[0], corner[2]]
                }
            })
            .collect(),
        Mode::TriangleFan => indices
            .windows(2)
            .skip(1)
            .flat_map(|edge| [indices[0], edge[0], edge[1]])
            .collect(),
        _ => indices[..indices.len() - indices.len() % 3].to_vec(),
    }
}

/// A mesh whose triangles share no vertices, with the triangles' own normals: what glTF asks for where it gives none.
fn flat(positions: &[[f32; 3]], uvs: &[[f32; 2]], indices: &[u32], material: usize) -> Mesh {
    let mut mesh = Mesh {
        material,
        ..Mesh::default()
    };
    for corners in indices.chunks_exact(3) {
        let [a, b, c] = [corners[0], corners[1], corners[2]].map(|corner| corner as usize);
        let [p, q, r] = [positions[a], positions[b], positions[c]].map(to_f64);
        let normal = (q - p)
            .cross(r - p)
            .normalize_or_zero()
            .as_vec3()
            .to_array();
        for corner in [a, b, c] {
            mesh.indices.push(mesh.positions.len() as u32);
            mesh.positions.push(positions[corner]);
            mesh.normals.push(normal);
            mesh.uvs.push(uvs[corner]);
        }
    }
    mesh
}
