//! glTF primitives as meshes in world space.

use std::path::Path;

use glam::{DMat3, DMat4, DVec3};
use gltf::json::accessor::Type;
use gltf::mesh::{Mode, Semantic};

use super::accessor::Reader;
use super::{Mesh, Scene, SceneError};

/// Products of two lengths in a scene, its ground plane among them, fit in single precision.
const LARGEST_COORDINATE: f32 = 1e15;

/// One primitive, placed by `world`; none where it has no triangles.
pub(super) fn load_primitive(
    file: &Path,
    reader: &Reader<'_>,
    primitive: &gltf::Primitive<'_>,
    world: &DMat4,
    item: &str,
    scene: &mut Scene,
) -> Result<Option<Mesh>, SceneError> {
    if primitive.morph_targets().next().is_some() {
        scene.warn(format!("{item}: its morph targets are ignored"));
    }
    if matches!(
        primitive.mode(),
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip
    ) {
        scene.warn(format!("{item}: points and lines are ignored"));
        return Ok(None);
    }
    let failed = |attribute: &str, accessor: usize, reason| SceneError::Accessor {
        file: file.to_owned(),
        item: format!("{item}, {attribute} (accessor {accessor})"),
        reason,
    };
    let Some(accessor) = primitive.get(&Semantic::Positions) else {
        scene.warn(format!("{item}: it has no positions and is ignored"));
        return Ok(None);
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
    let far = |position: &[f32; 3]| position.iter().any(|at| at.abs() > LARGEST_COORDINATE);
    if let Some(vertex) = positions.iter().position(far) {
        return Err(SceneError::Far {
            file: file.to_owned(),
            item: item.to_owned(),
            vertex,
            position: positions[vertex],
            limit: LARGEST_COORDINATE,
        });
    }
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
    Ok((!mesh.indices.is_empty()).then_some(mesh))
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
