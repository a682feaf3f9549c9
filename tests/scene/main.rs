//! Scenes: what good files give, what is warned of, and that broken files give errors that name the culprit.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod blended;
mod broken;
mod build;
mod masks;
mod options;
mod pairs;
mod placements;

use glam::DVec3;
use moment_shadows_lab::error::LabError;
use moment_shadows_lab::scene::{self, Scene, load_gltf, place_on_ground};
use serde_json::{Value, json};
use wgpu::AddressMode::{ClampToEdge, MirrorRepeat};

/// A folder with one glTF file and its buffer.
struct Files {
    folder: tempfile::TempDir,
    document: Value,
    bytes: Vec<u8>,
}

/// A single triangle in the xy plane with 8-bit indices.
const TRIANGLE: &str = r#"{
  "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": [{ "name": "only", "mesh": 0 }],
  "meshes": [{ "name": "sail", "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
  "accessors": [
    { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] },
    { "bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR" }
  ],
  "bufferViews": [{ "buffer": 0, "byteLength": 36, "byteStride": 12 }, { "buffer": 0, "byteOffset": 36, "byteLength": 3 }],
  "buffers": [{ "uri": "sail.bin", "byteLength": 40 }]
}"#;

impl Files {
    /// The triangle with some values set: a JSON pointer and a value a line.
    fn triangle(changes: &str) -> Self {
        let positions = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let mut bytes = positions.map(f32::to_le_bytes).as_flattened().to_vec();
        bytes.extend([0, 1, 2, 0]);
        let mut document = serde_json::from_str(TRIANGLE).unwrap();
        for change in changes.trim().lines() {
            let (pointer, value) = change.trim().split_once(' ').unwrap();
            set(&mut document, pointer, serde_json::from_str(value).unwrap());
        }
        let folder = tempfile::tempdir().unwrap();
        Self {
            folder,
            document,
            bytes,
        }
    }

    fn load(&self) -> Result<Scene, LabError> {
        let path = self.folder.path().join("sail.gltf");
        std::fs::write(self.folder.path().join("sail.bin"), &self.bytes).unwrap();
        std::fs::write(&path, self.document.to_string()).unwrap();
        load_gltf(&path)
    }

    /// The scene as one binary file.
    fn glb(&self) -> Vec<u8> {
        let mut document = self.document.clone();
        document["buffers"][0]["uri"] = Value::Null;
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut file = b"glTF\x02\0\0\0".to_vec();
        file.extend((28 + text.len() as u32 + self.bytes.len() as u32).to_le_bytes());
        for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &self.bytes)] {
            file.extend((chunk.len() as u32).to_le_bytes());
            file.extend(kind);
            file.extend(chunk);
        }
        file
    }

    fn is_refused(&self, culprit: &str) {
        let text = self.load().unwrap_err().to_string();
        assert!(text.contains(culprit), "'{text}' lacks '{culprit}'");
        assert!(text.contains("sail.gltf"), "'{text}' names no file");
    }
}

/// Sets what a JSON pointer names, or appends it to an array.
fn set(document: &mut Value, pointer: &str, value: Value) {
    let (parent, last) = pointer.rsplit_once('/').unwrap();
    match document.pointer_mut(parent).unwrap() {
        Value::Array(items) => {
            let at: usize = last.parse().unwrap();
            items.splice(at..items.len().min(at + 1), [value]);
        }
        parent => parent[last] = value,
    }
}

fn load_bytes(bytes: &[u8]) -> Result<Scene, LabError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sail.glb");
    std::fs::write(&path, bytes).unwrap();
    load_gltf(&path)
}

/// What each loaded scene holds to, whatever the file.
fn check(scene: &Scene) {
    for mesh in &scene.meshes {
        let vertices = mesh.positions.len();
        let numbers = mesh.positions.iter().chain(&mesh.normals).flatten();
        let mut numbers = numbers.chain(mesh.uvs.iter().flatten());
        assert!(numbers.all(|number| number.is_finite()));
        assert_eq!((mesh.normals.len(), mesh.uvs.len()), (vertices, vertices));
        assert_eq!(mesh.indices.len() % 3, 0);
        assert!(mesh.indices.iter().all(|&at| (at as usize) < vertices));
        let texture = scene.materials[mesh.material].texture;
        assert!(texture.is_none_or(|texture| texture < scene.images.len()));
    }
}

#[test]
fn a_triangle_is_flattened_with_its_own_normal() {
    let files = Files::triangle(
        r#"/nodes [{ "children": [1], "translation": [10, 0, 0] }, { "mesh": 0 }]
        /nodes/1/scale [2, 2, 2]
        /nodes/1/rotation [0, 1, 0, 0]"#,
    );
    let scene = files.load().unwrap();
    let mesh = &scene.meshes[0];
    // Scaled by 2, turned by 180 degrees about y, moved by 10 along x; then its middle is moved to zero.
    assert_eq!(scene.origin, DVec3::new(9.0, 0.0, 0.0));
    let expected = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [1.0, 2.0, 0.0]];
    assert_eq!(mesh.positions, expected);
    // The file has no normals, so the triangle gets its own: +z before the turn, -z after it.
    for normal in &mesh.normals {
        assert!((normal[2] + 1.0).abs() < 1e-6, "{normal:?}");
    }
    assert_eq!(scene.materials[mesh.material].name, "default");
}

#[test]
fn binary_and_text_give_the_same() {
    let files = Files::triangle("");
    let text = files.load().unwrap();
    let binary = load_bytes(&files.glb()).unwrap();
    assert_eq!(text.meshes, binary.meshes);
}

#[test]
fn strips_and_fans_become_lists_that_turn_one_way() {
    for (mode, expected) in [(5, [[0, 1, 2], [2, 1, 3]]), (6, [[0, 1, 2], [0, 2, 3]])] {
        let mut files = Files::triangle(
            r#"/bufferViews/0/byteLength 48
            /accessors/0/count 4
            /buffers/0/byteLength 48
            /meshes/0/primitives/0 { "attributes": { "POSITION": 0, "NORMAL": 0 } }"#,
        );
        files.document["meshes"][0]["primitives"][0]["mode"] = json!(mode);
        files.bytes.resize(48, 0);
        let scene = files.load().unwrap();
        assert_eq!(scene.meshes[0].indices, expected.concat(), "mode {mode}");
    }
}

#[test]
fn integers_become_coordinates() {
    // Normalised bytes from -128 to 127 stand for -1 to 1; others for themselves.
    for (normalized, expected) in [(true, [-1.0, 1.0, 0.0]), (false, [-128.0, 127.0, 0.0])] {
        let expected = DVec3::from(expected);
        let mut files = Files::triangle(
            r#"/extensionsRequired ["KHR_mesh_quantization"]
            /bufferViews/0/byteStride 4
            /accessors/0/componentType 5120"#,
        );
        files.document["accessors"][0]["normalized"] = json!(normalized);
        files.bytes[4..7].copy_from_slice(&[128, 127, 0]);
        let scene = files.load().unwrap();
        let position = scene.meshes[0].positions[1].map(f64::from);
        assert_eq!(scene.origin + DVec3::from(position), expected);
    }
}

#[test]
fn a_placed_scene_stands_on_the_ground_in_the_middle() {
    for name in scene::PROCEDURAL {
        let scene = scene::load(name).unwrap();
        let bounds = scene.bounds();
        // Positions are f32 and the scenes about 10 m large.
        assert!(bounds.min.y.abs() < 1e-5, "{name}: {bounds:?}");
        assert!(bounds.centre().x.abs() < 1e-5 && bounds.centre().z.abs() < 1e-5);
        let grounds: Vec<_> = scene.meshes.iter().filter(|mesh| mesh.ground).collect();
        assert_eq!(grounds.len(), 1);
        assert!(f64::from(grounds[0].positions[2][0]) > 10.0 * bounds.radius());
        assert!(scene.triangles() > 10_000);
        check(&scene);
    }
}

#[test]
fn what_is_left_out_is_said() {
    let files = Files::triangle(
        r#"/extensionsUsed ["KHR_materials_ior", "MSFT_lod"]
        /images [{ "uri": "absent.png" }]
        /textures [{ "source": 0 }]
        /materials [{ "name": "glass", "alphaMode": "BLEND" }, { "alphaMode": "MASK" }]
        /materials/0/pbrMetallicRoughness { "baseColorTexture": { "index": 0 } }
        /materials/1/pbrMetallicRoughness { "baseColorTexture": { "index": 0 } }
        /meshes/0/primitives/0/material 0
        /meshes/0/primitives/1 { "attributes": { "POSITION": 0 }, "mode": 0 }"#,
    );
    let warnings = files.load().unwrap().warnings.join("\n");
    let culprits = "MSFT_lod absent.png coordinates 1:";
    assert_eq!(warnings.lines().count(), 4, "{warnings}");
    for (warning, culprit) in warnings.lines().zip(culprits.split(' ')) {
        assert!(warning.contains(culprit), "{warnings}");
    }
}

#[test]
fn masks_are_wrapped_turned_and_scaled_as_the_file_says() {
    // The coordinates are (0, 0), (1, 0) and (0, 1), in the positions' bytes.
    let files = Files::triangle(
        r#"/images [{ "uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGP4z8DwHwAFAAH/iZk9HQAAAABJRU5ErkJggg==" }]
        /samplers [{ "wrapS": 33071, "wrapT": 33648 }]
        /textures [{ "source": 0, "sampler": 0 }]
        /materials [{ "alphaMode": "MASK", "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]
        /materials/0/pbrMetallicRoughness/baseColorTexture/extensions { "KHR_texture_transform": { "scale": [2, 3] } }
        /materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset [0.5, 0.25]
        /materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/rotation 1.570796326794897
        /accessors/2 { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2" }
        /meshes/0/primitives/0/attributes/TEXCOORD_0 2
        /meshes/0/primitives/0/material 0"#,
    );
    let scene = files.load().unwrap();
    assert_eq!(scene.warnings, [""; 0]);
    let material = &scene.materials[scene.meshes[0].material];
    assert_eq!((material.mask, material.texture), (Some(0.5), Some(0)));
    assert_eq!(material.wrap, [ClampToEdge, MirrorRepeat]);
    // Scaled, then a quarter turn counterclockwise where v points down, then moved.
    let expected = [[0.5, 0.25], [0.5, -1.75], [3.5, 0.25]];
    for (uv, expected) in scene.meshes[0].uvs.iter().zip(expected) {
        let distance = (uv[0] - expected[0]).hypot(uv[1] - expected[1]);
        assert!(distance < 1e-6, "{uv:?} for {expected:?}");
    }
}

#[test]
fn hidden_nodes_are_left_out_and_flat_ones_stay() {
    let files = Files::triangle(
        r#"/nodes/1 { "scale": [0, 0, 0], "children": [2] }
        /nodes/2 { "mesh": 0 }
        /nodes/3 { "extensions": { "KHR_node_visibility": { "visible": false } }, "children": [4] }
        /nodes/4 { "mesh": 0 }
        /nodes/5 { "mesh": 0, "scale": [1, 1, 0], "translation": [0, 0, 7] }
        /scenes/0/nodes [0, 1, 3, 5]
        /meshes/0/primitives/0/attributes/NORMAL 0"#,
    );
    let scene = files.load().unwrap();
    assert_eq!(scene.meshes.len(), 2);
    assert_eq!(scene.origin, DVec3::new(0.5, 0.0, 3.5));
    assert_eq!(scene.meshes[1].positions[2], [-0.5, 1.0, 3.5]);
    // Normals have no direction in a flat node; the triangle has.
    assert_eq!(scene.meshes[1].normals[2], [0.0, 0.0, 1.0]);
}

#[test]
fn an_unknown_name_lists_the_scenes() {
    let text = scene::load("fence-and-folage").unwrap_err().to_string();
    for name in ["no file 'fence-and-folage'", "fence-and-foliage", "hall"] {
        assert!(text.contains(name), "{text}");
    }
}

#[test]
fn a_scene_far_from_the_origin_is_brought_to_it() {
    let files = Files::triangle("/nodes/0/translation [1000, -50, 3]");
    let scene = place_on_ground(files.load().unwrap());
    let bounds = scene.bounds();
    assert!(bounds.min.y.abs() < 1e-9, "{bounds:?}");
    assert!(bounds.centre().x.abs() < 1e-3, "{bounds:?}");
    assert_eq!(scene.ground, Some(0.0));
}
