//! glTF models, loaded as the commands load them, and looked at from a few viewpoints.

use moment_shadows_lab::scene::{self, Scene};
use moment_shadows_lab::view::View;
use serde_json::{Value, json};

use crate::json::{mutate as mutate_json, mutate_text, strings};
use crate::models::{all, glb, parts};
use crate::text::mutate_bytes;
use crate::{Random, Target};

/// glTF and GLB files.
pub const TARGET: Target = Target {
    name: "gltf_model",
    seeds: all,
    mutate,
    try_out,
};

fn mutate(data: &[u8], seeds: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    if random.once_in(12) {
        return mutate_bytes(data, seeds, random);
    }
    if let Some((mut document, mut binary)) = parts(data) {
        match random.below(6) {
            0 => binary = mutate_bytes(&binary, seeds, random),
            1 => overwrite_float(&mut binary, random),
            _ => mutate_document(&mut document, random),
        }
        return glb(&document, &binary);
    }
    match serde_json::from_slice::<Value>(data) {
        Ok(document) if random.once_in(12) => {
            mutate_text(&document.to_string(), random).into_bytes()
        }
        Ok(mut document) => {
            mutate_document(&mut document, random);
            document.to_string().into_bytes()
        }
        Err(_) => mutate_bytes(data, seeds, random),
    }
}

/// Writes a float that arithmetic may trip over.
fn overwrite_float(binary: &mut [u8], random: &mut Random) {
    const VALUES: [f32; 9] = [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        f32::MIN,
        1e-45,
        1e30,
        1e-30,
        -0.0,
    ];
    let at = 4 * random.below(binary.len() / 4);
    if let Some(bytes) = binary.get_mut(at..at + 4) {
        bytes.copy_from_slice(&VALUES[random.below(VALUES.len())].to_le_bytes());
    }
}

fn mutate_document(document: &mut Value, random: &mut Random) {
    match random.below(12) {
        0 => chain_of_nodes(document, random),
        1 => repeat_mesh(document, random),
        2 => huge_accessor(document, random),
        _ => {
            let mut words = Vec::new();
            strings(document, &mut words);
            words.truncate(200);
            words.extend(
                [
                    "",
                    "SCALAR",
                    "VEC2",
                    "VEC4",
                    "MAT4",
                    "OPAQUE",
                    "sparse",
                    "uri",
                    "data:,",
                    "data:;base64,AAAA",
                    "data:image/png;base64,",
                    ".",
                    "/",
                    "/dev/zero",
                    "..%2f",
                    "%zz",
                    "model.gltf",
                    "COLOR_0",
                    "JOINTS_0",
                    "TEXCOORD_1",
                    "skin",
                    "skins",
                    "targets",
                    "extensions",
                    "KHR_draco_mesh_compression",
                    "KHR_texture_transform",
                    "image/jpeg",
                    "camera",
                    "weights",
                ]
                .map(str::to_owned),
            );
            mutate_json(document, &words, random);
        }
    }
}

/// The array of that name, where the document has one.
fn array<'a>(document: &'a mut Value, name: &str) -> Option<&'a mut Vec<Value>> {
    document.get_mut(name)?.as_array_mut()
}

/// Makes these nodes the only scene.
fn show(document: &mut Value, nodes: Vec<usize>) {
    if let Some(fields) = document.as_object_mut() {
        fields.insert("scenes".to_owned(), json!([{ "nodes": nodes }]));
        fields.insert("scene".to_owned(), json!(0));
    }
}

/// A deep hierarchy, which may end in a cycle.
fn chain_of_nodes(document: &mut Value, random: &mut Random) {
    let Some(nodes) = array(document, "nodes") else {
        return;
    };
    let mut child = random.below(nodes.len());
    for number in 0..random.count(20_000) {
        nodes.push(json!({ "children": [child], "translation": [number, 0.5, 0] }));
        child = nodes.len() - 1;
    }
    if random.once_in(3) {
        if let Some(first) = nodes.first_mut().and_then(Value::as_object_mut) {
            first.insert("children".to_owned(), json!([child]));
        }
    } else {
        show(document, vec![child]);
    }
}

/// Many nodes with the same mesh, or many primitives with the same accessors.
fn repeat_mesh(document: &mut Value, random: &mut Random) {
    let count = random.count(20_000);
    if random.once_in(2) {
        let Some(nodes) = array(document, "nodes") else {
            return;
        };
        let first = nodes.len();
        nodes.extend((0..count).map(|_| json!({ "mesh": 0 })));
        show(document, (first..first + count).collect());
    } else if let Some(Value::Array(primitives)) = document.pointer_mut("/meshes/0/primitives") {
        let primitive = primitives.first().cloned().unwrap_or_default();
        primitives.extend((0..count).map(|_| primitive.clone()));
    }
}

/// Millions of zeros, which take no room in the file.
fn huge_accessor(document: &mut Value, random: &mut Random) {
    let count = random.count(1 << 24);
    if let Some(accessors) = array(document, "accessors") {
        let at = random.below(accessors.len());
        let Some(accessor) = accessors.get_mut(at) else {
            return;
        };
        if let Some(fields) = accessor.as_object_mut() {
            fields.insert("count".to_owned(), json!(count));
            fields.remove("bufferView");
            fields.remove("byteOffset");
            fields.insert(
                "sparse".to_owned(),
                json!({
                    "count": 1,
                    "indices": { "bufferView": 1, "componentType": 5121 },
                    "values": { "bufferView": 0 }
                }),
            );
        }
    }
}

/// Loads a model from a file in a folder of its own.
pub fn try_out(data: &[u8]) {
    let folder = tempfile::tempdir().expect("a folder for the model");
    let name = if data.starts_with(b"glTF") {
        "model.glb"
    } else {
        "model.gltf"
    };
    let path = folder.path().join(name);
    std::fs::write(&path, data).expect("the model can be written");
    match scene::load(&path.to_string_lossy()) {
        Ok(scene) => check(&scene),
        Err(error) => assert!(
            error.to_string().contains(name),
            "the error names the file: {error}"
        ),
    }
    let files = std::fs::read_dir(folder.path())
        .expect("the folder is still there")
        .count();
    assert_eq!(files, 1, "loading leaves no file behind");
}

fn check(scene: &Scene) {
    for mesh in &scene.meshes {
        let vertices = mesh.positions.len();
        assert!(
            mesh.positions
                .iter()
                .flatten()
                .all(|coordinate| coordinate.is_finite()),
            "positions are finite"
        );
        assert!(
            mesh.normals
                .iter()
                .flatten()
                .all(|coordinate| coordinate.is_finite()),
            "normals are finite"
        );
        assert_eq!((mesh.normals.len(), mesh.uvs.len()), (vertices, vertices));
        assert_eq!(mesh.indices.len() % 3, 0);
        assert!(
            mesh.indices
                .iter()
                .all(|&index| (index as usize) < vertices)
        );
        assert!(mesh.material < scene.materials.len());
    }
    for material in &scene.materials {
        assert!(
            material
                .texture
                .is_none_or(|texture| texture < scene.images.len())
        );
    }
    for image in &scene.images {
        assert_eq!(
            image.rgba.len(),
            4 * image.width as usize * image.height as usize
        );
    }
    // Viewpoints and lights visit every caster several times.
    if scene.triangles() > 100_000 {
        return;
    }
    for number in 0..2 {
        let view = View::numbered(scene, number);
        let _ = view.camera.clip_from_world_columns();
        let _ = view.sun(scene, [64, 64], 3.0, number == 1);
        let _ = view.spot(scene, 0.05, None, number == 1);
    }
}
