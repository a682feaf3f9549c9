//! Small files that use all of what is read.

use data_encoding::BASE64;
use serde_json::{Value, json};

use super::container::Container;

/// A picture of one texel.
const PNG: &str = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGP4z8DwHwAFAAH/iZk9HQAAAABJRU5ErkJggg==";

pub(super) fn seeds() -> Vec<Vec<u8>> {
    let binary = triangle_bytes();
    let parts = [(triangle(), binary.clone()), all(), quantized()];
    let mut seeds = Vec::new();
    for (document, binary) in parts {
        let mut container = Container {
            document,
            binary,
            is_binary: true,
        };
        seeds.push(container.write());
        let uri = format!(
            "data:application/octet-stream;base64,{}",
            BASE64.encode(&container.binary)
        );
        container.document["buffers"][0]["uri"] = json!(uri);
        container.is_binary = false;
        seeds.push(container.write());
    }
    seeds
}

/// The corners of a triangle, and its indices.
fn triangle_bytes() -> Vec<u8> {
    let corners = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let mut bytes = corners.map(f32::to_le_bytes).as_flattened().to_vec();
    bytes.extend([0, 1, 2, 0]);
    bytes
}

fn triangle() -> Value {
    json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"}
        ],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 3}],
        "buffers": [{"byteLength": 40}]
    })
}

/// A tree of nodes with a textured mask, instances, a sparse accessor, colours, a strip and lines.
fn all() -> (Value, Vec<u8>) {
    let mut bytes = triangle_bytes();
    let start = bytes.len();
    let strip = [
        -1.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 2.0, 0.0, 1.0, 2.0, 0.5,
    ];
    let coordinates = [0.0_f32, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0];
    let colours = [1.0_f32; 16];
    for number in strip.iter().chain(&coordinates).chain(&colours) {
        bytes.extend(number.to_le_bytes());
    }
    let picture = BASE64.decode(PNG.as_bytes()).unwrap_or_default();
    let picture_start = bytes.len();
    bytes.extend(&picture);
    let document = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 3]}],
        "extensionsUsed": ["KHR_texture_transform", "EXT_mesh_gpu_instancing", "KHR_node_visibility", "MSFT_lod"],
        "nodes": [
            {"name": "root", "children": [1, 2], "translation": [0, 1, 0], "rotation": [0, 0.6, 0, 0.8], "scale": [1, 2, 1]},
            {"mesh": 1, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1]},
            {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}},
            {"mesh": 2, "skin": 0, "extensions": {"KHR_node_visibility": {"visible": true}}}
        ],
        "meshes": [
            {"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1}]},
            {"primitives": [{"attributes": {"POSITION": 2, "TEXCOORD_0": 3, "COLOR_0": 4}, "mode": 5, "material": 0}]},
            {"primitives": [{"attributes": {"POSITION": 5}, "targets": [{"POSITION": 5}]}, {"attributes": {"POSITION": 0}, "mode": 1}]}
        ],
        "skins": [{"joints": [0]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"},
            {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, 0, 0], "max": [1, 2, 0.5]},
            {"bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 4, "componentType": 5126, "count": 4, "type": "VEC4"},
            {"componentType": 5126, "count": 6, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0],
             "sparse": {"count": 3, "indices": {"bufferView": 1, "componentType": 5121}, "values": {"bufferView": 0}}}
        ],
        "materials": [{
            "name": "leaf", "alphaMode": "MASK", "doubleSided": true,
            "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform":
                {"offset": [0.5, 0.25], "rotation": 1.5, "scale": [2, 3]}}}, "baseColorFactor": [1, 1, 1, 0.5]}
        }],
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [{"wrapS": 33071, "wrapT": 33648, "magFilter": 9729, "minFilter": 9987}],
        "images": [{"bufferView": 5, "mimeType": "image/png"}],
        "bufferViews": [
            {"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 3},
            {"buffer": 0, "byteOffset": start, "byteLength": 48, "byteStride": 12},
            {"buffer": 0, "byteOffset": start + 48, "byteLength": 32},
            {"buffer": 0, "byteOffset": start + 80, "byteLength": 64},
            {"buffer": 0, "byteOffset": picture_start, "byteLength": picture.len()}
        ],
        "buffers": [{"byteLength": bytes.len()}]
    });
    (document, bytes)
}

/// A mesh of small integers.
fn quantized() -> (Value, Vec<u8>) {
    let mut bytes: Vec<u8> = Vec::new();
    for corner in [[0_u16, 0, 0, 0], [65535, 0, 0, 0], [0, 65535, 0, 0]] {
        bytes.extend(corner.map(u16::to_le_bytes).as_flattened());
    }
    bytes.extend([0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0]);
    bytes.extend([0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0, 0]);
    let document = json!({
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [2, 2, 2]}],
        "extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5123, "normalized": true, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [65535, 65535, 0]},
            {"bufferView": 1, "componentType": 5120, "normalized": true, "count": 3, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC2"}
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": 24, "byteStride": 8}, {"buffer": 0, "byteOffset": 24, "byteLength": 12, "byteStride": 4},
            {"buffer": 0, "byteOffset": 36, "byteLength": 12, "byteStride": 4}
        ],
        "buffers": [{"byteLength": bytes.len()}]
    });
    (document, bytes)
}
