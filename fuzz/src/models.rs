//! Small glTF models, and the parts of binary ones.

use serde_json::{Value, json};

/// A red texel and a transparent one, as PNG.
const PNG: [u8; 77] = [
    0x89, 0x50, 0x4e, 0x47, 0xd, 0xa, 0x1a, 0xa, 0, 0, 0, 0xd, 0x49, 0x48, 0x44, 0x52, 0, 0, 0, 2,
    0, 0, 0, 1, 8, 6, 0, 0, 0, 0xf4, 0x22, 0x7f, 0x8a, 0, 0, 0, 0x14, 0x49, 0x44, 0x41, 0x54, 0x78,
    1, 1, 9, 0, 0xf6, 0xff, 0, 0xff, 0, 0, 0xff, 0, 0, 0, 0, 0xc, 0xfc, 1, 0xff, 0x40, 0xc8, 0x72,
    0xba, 0, 0, 0, 0, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82,
];

/// A binary glTF file.
#[must_use]
pub fn glb(document: &Value, binary: &[u8]) -> Vec<u8> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend((28 + text.len() as u32 + binary.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &text[..]), (b"BIN\0", binary)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}

/// The document and the bytes of a binary file.
#[must_use]
pub fn parts(file: &[u8]) -> Option<(Value, Vec<u8>)> {
    let length = |at: usize| {
        let bytes: [u8; 4] = file.get(at..at + 4)?.try_into().ok()?;
        usize::try_from(u32::from_le_bytes(bytes)).ok()
    };
    let end = 20_usize.checked_add(length(12)?)?;
    let document = serde_json::from_slice(file.get(20..end)?).ok()?;
    Some((document, file.get(end + 8..)?.to_vec()))
}

/// Models that use what the loader knows, as binary and as text files.
#[must_use]
pub fn all() -> Vec<Vec<u8>> {
    let triangle = triangle();
    let square = textured_square();
    vec![
        glb(&triangle.0, &triangle.1),
        glb(&square.0, &square.1),
        text_with_data_uri().to_string().into_bytes(),
    ]
}

fn floats(values: &[f32]) -> Vec<u8> {
    values
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect()
}

/// A triangle with 8-bit indices under a node.
fn triangle() -> (Value, Vec<u8>) {
    let mut bytes = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    bytes.extend([0, 1, 2, 0]);
    let document = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [
            { "name": "parent", "children": [1], "translation": [1, 2, 3], "rotation": [0, 1, 0, 0] },
            { "name": "child", "mesh": 0, "scale": [2, 1, 1] }
        ],
        "meshes": [{ "name": "sail", "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] },
            { "bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR" }
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 36 },
            { "buffer": 0, "byteOffset": 36, "byteLength": 3 }
        ],
        "buffers": [{ "byteLength": 40 }]
    });
    (document, bytes)
}

/// A square as a strip, with interleaved attributes, a masked material, and an image in a buffer view; a fan with sparse
/// and quantised positions beside it.
fn textured_square() -> (Value, Vec<u8>) {
    let mut bytes = Vec::new();
    for [x, y] in [[0.0_f32, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] {
        bytes.extend(floats(&[x, y, 0.0, 0.0, 0.0, 1.0, x, 1.0 - y]));
    }
    // 128: sparse indices; 132: their positions; 144: quantised positions.
    bytes.extend([1, 0, 0, 0]);
    bytes.extend(floats(&[0.5, 0.5, 0.5]));
    bytes.extend([0_u8, 0, 0, 0, 127, 0, 0, 0, 0, 127, 0, 0, 127, 127, 0, 0]);
    let image = bytes.len();
    bytes.extend(PNG);
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let document = json!({
        "asset": { "version": "2.0" },
        "extensionsUsed": ["KHR_mesh_quantization"],
        "extensionsRequired": ["KHR_mesh_quantization"],
        "scenes": [{ "nodes": [0, 1] }],
        "nodes": [
            { "mesh": 0 },
            { "mesh": 1, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 0, 0, 1] }
        ],
        "meshes": [
            { "primitives": [{ "mode": 5, "material": 0, "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 } }] },
            { "primitives": [
                { "mode": 6, "attributes": { "POSITION": 3 } },
                { "mode": 5, "material": 1, "attributes": { "POSITION": 4 } }
            ] }
        ],
        "materials": [
            { "alphaMode": "MASK", "alphaCutoff": 0.25, "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } },
            { "alphaMode": "BLEND", "doubleSided": true, "pbrMetallicRoughness": { "baseColorFactor": [1, 0.5, 0, 1] } }
        ],
        "textures": [{ "source": 0 }],
        "images": [{ "bufferView": 3, "mimeType": "image/png" }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] },
            { "bufferView": 0, "byteOffset": 12, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 0, "byteOffset": 24, "componentType": 5126, "count": 4, "type": "VEC2" },
            { "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1],
              "sparse": { "count": 1, "indices": { "bufferView": 1, "componentType": 5121 }, "values": { "bufferView": 1, "byteOffset": 4 } } },
            { "bufferView": 2, "componentType": 5120, "normalized": true, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [127, 127, 0] }
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 128, "byteStride": 32 },
            { "buffer": 0, "byteOffset": 128, "byteLength": 16 },
            { "buffer": 0, "byteOffset": 144, "byteLength": 16, "byteStride": 4 },
            { "buffer": 0, "byteOffset": image, "byteLength": PNG.len() }
        ],
        "buffers": [{ "byteLength": bytes.len() }]
    });
    (document, bytes)
}

/// The triangle as text, its bytes in a data URI.
fn text_with_data_uri() -> Value {
    let (mut document, _) = triangle();
    document["buffers"][0]["uri"] = json!(
        "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAECAA=="
    );
    document
}
