//! Where nodes place their meshes: their own transforms, and those of `EXT_mesh_gpu_instancing`.

use glam::{DMat3, DMat4, DQuat, DVec3, DVec4};
use gltf::scene::Transform;

use super::gltf_source::Source;

/// A node's transform into its parent.
pub(super) fn of_node(node: &gltf::Node<'_>) -> DMat4 {
    match node.transform() {
        Transform::Matrix { matrix } => {
            let [x, y, z, w] = matrix.map(|column| DVec4::from_array(column.map(f64::from)));
            DMat4::from_cols(x, y, z, w)
        }
        Transform::Decomposed {
            translation,
            rotation,
            scale,
        } => transform(translation, rotation, scale),
    }
}

/// Scaled, turned, then moved. What is stored of a unit quaternion is seldom one.
fn transform(translation: [f32; 3], rotation: [f32; 4], scale: [f32; 3]) -> DMat4 {
    let vector = |value: [f32; 3]| DVec3::from_array(value.map(f64::from));
    let turn = DVec4::from_array(rotation.map(f64::from));
    let turn = DQuat::from_vec4(turn.normalize_or(DVec4::W));
    DMat4::from_scale_rotation_translation(vector(scale), turn, vector(translation))
}

/// Whether nothing is left of what is placed there: a scale of zero along all axes.
pub(super) fn vanishes(world: &DMat4) -> bool {
    DMat3::from_mat4(*world) == DMat3::ZERO
}

/// Where a node that lies at `world` shows its mesh.
pub(super) fn of_mesh(
    node: &gltf::Node<'_>,
    world: DMat4,
    document: &gltf::Document,
    source: &mut Source<'_>,
) -> Result<Vec<DMat4>, String> {
    let Some(extension) = node.extension_value("EXT_mesh_gpu_instancing") else {
        return Ok(vec![world]);
    };
    let translations = attribute::<3>(extension, "TRANSLATION", document, source)?;
    let rotations = attribute::<4>(extension, "ROTATION", document, source)?;
    let scales = attribute::<3>(extension, "SCALE", document, source)?;
    let counts = [
        translations.as_ref().map(Vec::len),
        rotations.as_ref().map(Vec::len),
        scales.as_ref().map(Vec::len),
    ];
    let mut given = counts.into_iter().flatten();
    let count = given.next().unwrap_or(1);
    if given.any(|other| other != count) {
        return Err("its instances have different numbers of attributes".to_owned());
    }
    source.take(count, size_of::<DMat4>())?;
    let mut instances = Vec::with_capacity(count);
    for index in 0..count {
        let own = transform(
            translations.as_ref().map_or([0.0; 3], |all| all[index]),
            rotations
                .as_ref()
                .map_or([0.0, 0.0, 0.0, 1.0], |all| all[index]),
            scales.as_ref().map_or([1.0; 3], |all| all[index]),
        );
        let placed = world * own;
        if !placed.is_finite() {
            return Err(format!("its instance {index} has no finite transform"));
        }
        instances.extend((!vanishes(&placed)).then_some(placed));
    }
    Ok(instances)
}

/// One attribute of all instances, if the extension has it.
fn attribute<const N: usize>(
    extension: &serde_json::Value,
    name: &str,
    document: &gltf::Document,
    source: &mut Source<'_>,
) -> Result<Option<Vec<[f32; N]>>, String>
where
    [i8; N]: gltf::accessor::Item,
    [u8; N]: gltf::accessor::Item,
    [i16; N]: gltf::accessor::Item,
    [u16; N]: gltf::accessor::Item,
    [f32; N]: gltf::accessor::Item,
{
    let Some(index) = extension["attributes"].get(name) else {
        return Ok(None);
    };
    let at = index.as_u64().and_then(|at| usize::try_from(at).ok());
    let accessor = at.and_then(|at| document.accessors().nth(at));
    let accessor = accessor.ok_or_else(|| format!("{name}: there is no accessor {index}"))?;
    source.floats(&accessor, name).map(Some)
}
