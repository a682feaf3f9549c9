//! glTF files, given to the lab's loader.

mod container;
mod seeds;

use std::io::Write;
use std::sync::LazyLock;

use moment_shadows_lab::scene::{EXTENSIONS, Scene, load_gltf, place_on_ground};
use serde_json::{Value, json};

use crate::json::{mutate as mutate_json, mutate_text};
use crate::text::mutate_bytes;
use crate::{Random, Target};
use container::Container;

/// glTF files, text and binary.
pub const TARGET: Target = Target {
    name: "gltf",
    seeds: seeds::seeds,
    mutate,
    try_out,
};

fn mutate(data: &[u8], seeds: &[Vec<u8>], times: usize, random: &mut Random) -> Vec<u8> {
    (0..times).fold(data.to_vec(), |data, _| mutate_once(&data, seeds, random))
}

fn mutate_once(data: &[u8], seeds: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let Some(mut container) = Container::read(data) else {
        return mutate_bytes(data, seeds, random);
    };
    match random.below(16) {
        0 => return mutate_bytes(data, seeds, random),
        1 => return container.broken(random),
        2 => {
            let text = mutate_text(&container.document.to_string(), random);
            return container.with_text(text.as_bytes());
        }
        3 => container.binary = mutate_bytes(&container.binary, seeds, random),
        4 => container.is_binary ^= true,
        5..9 => mutate_json(&mut container.document, &WORDS, random),
        9..11 => insert(&mut container.document, random),
        _ => set(&mut container.document, random),
    }
    container.write()
}

/// Fields whose values mean something to a reader, and what they may be.
const FIELDS: [(&str, &[i64]); 21] = [
    ("componentType", &[5120, 5121, 5122, 5123, 5125, 5126, 5124]),
    ("mode", &[0, 1, 4, 5, 6, 7]),
    ("byteStride", &[0, 1, 4, 12, 13, 16, 252, 256]),
    ("byteOffset", &[0, 1, 4, 12, 35, 36, 40, -1, i64::MAX]),
    ("byteLength", &[0, 1, 4, 36, 1000, -1, i64::MAX]),
    (
        "count",
        &[
            0,
            1,
            2,
            3,
            4,
            5,
            300,
            65_536,
            16_777_216,
            89_478_486,
            i64::MAX,
        ],
    ),
    ("bufferView", &[0, 1, 2, 3, 4, 5, 99]),
    ("buffer", &[0, 1, 2]),
    ("mesh", &[0, 1, 2, 3]),
    ("material", &[0, 1, 2]),
    ("indices", &[0, 1, 2, 3, 4, 5]),
    ("POSITION", &[0, 1, 2, 3, 4, 5]),
    ("NORMAL", &[0, 1, 2, 3, 4, 5]),
    ("TEXCOORD_0", &[0, 1, 2, 3, 4, 5]),
    ("COLOR_0", &[0, 1, 2, 3, 4, 5]),
    ("TRANSLATION", &[0, 1, 2, 3, 4, 5]),
    ("source", &[0, 1, 2]),
    ("sampler", &[0, 1]),
    ("index", &[0, 1, 2]),
    ("texCoord", &[0, 1, 2, 99]),
    ("scene", &[0, 1]),
];

/// Gives a field another value of those that it may have, or adds it.
fn set(document: &mut Value, random: &mut Random) {
    let (name, values) = FIELDS[random.below(FIELDS.len())];
    let value = match name {
        "componentType" if random.once_in(3) => json!(values[random.below(values.len())]),
        "componentType" => {
            const TYPES: [&str; 6] = ["SCALAR", "VEC2", "VEC3", "VEC4", "MAT4", "VEC5"];
            let kind = json!(TYPES[random.below(TYPES.len())]);
            with_field(document, "type", random, |field| *field = kind);
            return;
        }
        _ => json!(values[random.below(values.len())]),
    };
    with_field(document, name, random, |field| *field = value);
}

/// Changes one of the fields of a name.
fn with_field(
    document: &mut Value,
    name: &str,
    random: &mut Random,
    change: impl FnOnce(&mut Value),
) {
    fn find<'a>(value: &'a mut Value, name: &str, found: &mut Vec<&'a mut Value>) {
        match value {
            Value::Array(items) => items.iter_mut().for_each(|item| find(item, name, found)),
            Value::Object(fields) => {
                for (key, field) in fields {
                    if key == name && !field.is_array() {
                        found.push(field);
                    } else {
                        find(field, name, found);
                    }
                }
            }
            _ => {}
        }
    }
    let mut found = Vec::new();
    find(document, name, &mut found);
    let at = random.below(found.len());
    if let Some(field) = found.into_iter().nth(at) {
        change(field);
    }
}

/// Adds a part that few files have.
fn insert(document: &mut Value, random: &mut Random) {
    const PARTS: &[(&str, &str, &str)] = &[
        (
            "accessors",
            "sparse",
            r#"{"count": 1, "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 0}}"#,
        ),
        (
            "accessors",
            "sparse",
            r#"{"count": 4000000, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}}"#,
        ),
        ("accessors", "normalized", "true"),
        ("nodes", "children", "[0]"),
        ("nodes", "children", "[1, 2]"),
        ("nodes", "skin", "0"),
        ("nodes", "scale", "[0, 1e38, -1]"),
        ("nodes", "rotation", "[0, 0, 0, 0]"),
        (
            "nodes",
            "matrix",
            "[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1e30, 0, 0, 0]",
        ),
        (
            "nodes",
            "extensions",
            r#"{"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0, "SCALE": 0}}}"#,
        ),
        (
            "nodes",
            "extensions",
            r#"{"EXT_mesh_gpu_instancing": {"attributes": {"ROTATION": 0}}}"#,
        ),
        (
            "nodes",
            "extensions",
            r#"{"KHR_node_visibility": {"visible": false}}"#,
        ),
        ("materials", "alphaMode", "\"MASK\""),
        ("materials", "alphaMode", "\"BLEND\""),
        ("materials", "alphaCutoff", "-1e38"),
        (
            "materials",
            "extensions",
            r#"{"KHR_materials_ior": {"ior": 1.5}}"#,
        ),
        ("images", "uri", "\"data:image/png;base64,iVBORw0KGgo=\""),
        (
            "images",
            "uri",
            "\"data:image/jpeg;base64,/9j/4AAQSkZJRg==\"",
        ),
        (
            "buffers",
            "uri",
            "\"data:application/octet-stream;base64,AAAA\"",
        ),
        ("buffers", "uri", "\"..\""),
        ("samplers", "wrapS", "33648"),
        ("bufferViews", "target", "34963"),
    ];
    let (list, name, value) = PARTS[random.below(PARTS.len())];
    let value = serde_json::from_str(value).unwrap_or_default();
    let Some(items) = document.get_mut(list).and_then(Value::as_array_mut) else {
        return;
    };
    let at = random.below(items.len());
    if let Some(Value::Object(fields)) = items.get_mut(at) {
        fields.insert(name.to_owned(), value);
    }
}

/// The keys of files, and names of extensions.
static WORDS: LazyLock<Vec<String>> = LazyLock::new(|| {
    const WORDS: &str = "asset version scenes scene nodes mesh meshes primitives attributes indices accessors bufferViews buffers uri \
        byteLength byteOffset byteStride componentType count type min max sparse values normalized SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4 \
        POSITION NORMAL TANGENT TEXCOORD_0 TEXCOORD_1 COLOR_0 JOINTS_0 WEIGHTS_0 mode material materials images textures samplers \
        mimeType image/png image/jpeg pbrMetallicRoughness baseColorTexture baseColorFactor alphaMode MASK BLEND OPAQUE alphaCutoff \
        doubleSided extensions extensionsUsed extensionsRequired extras translation rotation scale matrix children skin skins weights \
        targets animations cameras KHR_texture_transform offset texCoord absent.bin %2e%2e . / data: data:,x";
    let names = EXTENSIONS.iter().flat_map(|row| row.names);
    let all = WORDS.split_whitespace().chain(names.copied());
    all.map(str::to_owned).collect()
});

/// Loads a file as the lab does.
pub fn try_out(data: &[u8]) -> bool {
    let mut file = tempfile::NamedTempFile::new().expect("there is room for a file");
    file.write_all(data).expect("there is room for a file");
    match load_gltf(file.path()) {
        Ok(scene) => {
            check(&place_on_ground(scene));
            true
        }
        Err(error) => {
            let text = error.to_string();
            assert!(!text.is_empty());
            assert!(!text.contains("(lab/src/"), "{text}");
            false
        }
    }
}

/// What each loaded scene holds to, whatever the file.
fn check(scene: &Scene) {
    for mesh in &scene.meshes {
        let vertices = mesh.positions.len();
        let numbers = mesh.positions.iter().chain(&mesh.normals).flatten();
        let mut numbers = numbers.chain(mesh.uvs.iter().flatten());
        assert!(
            numbers.all(|number| number.is_finite()),
            "all places are finite"
        );
        assert_eq!((mesh.normals.len(), mesh.uvs.len()), (vertices, vertices));
        assert_eq!(mesh.indices.len() % 3, 0, "triangles have three corners");
        assert!(mesh.indices.iter().all(|&at| (at as usize) < vertices));
        let texture = scene.materials[mesh.material].texture;
        assert!(texture.is_none_or(|texture| texture < scene.images.len()));
    }
    for image in &scene.images {
        let texels = image.width as usize * image.height as usize;
        assert_eq!(image.rgba.len(), 4 * texels);
    }
    let _ = (scene.bounds(), scene.extremes().len(), scene.triangles());
}
