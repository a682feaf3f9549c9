//! Files that place the same meshes in two ways look the same.

use crate::Files;
use crate::build::{CORNERS, FLOAT, is_opaque, options, picture, same};
use glam::DVec3;
use serde_json::{Value, json};

#[test]
fn instances_are_nodes() {
    let parent = json!({ "translation": [0.2, 0.4, -0.3], "rotation": [0.0, 0.2588190, 0.0, 0.9659258], "scale": [1, 1.3, 1] });
    let translations = [[-0.9_f32, 0.1, 0.4], [0.3, 0.7, 0.2], [0.9, 0.2, -0.5]];
    let scales = [[0.25_f32, 0.3, 0.2], [0.1, 0.4, 0.3], [-0.2, 0.15, 0.2]];
    // Of unit quaternions in normalised 16-bit and 8-bit integers.
    let rotations = [
        [0.0_f64, 0.6, 0.0, 0.8],
        [0.48, 0.0, 0.64, 0.6],
        [0.0, 0.0, -1.0, 0.0],
    ];
    for (component, most) in [(5122, 32767.0), (5120, 127.0), (FLOAT, 0.0)] {
        let stored = rotations.map(|rotation| rotation.map(|part| (part * most).round()));
        let build = |extension: bool, nodes: bool| {
            let mut files = Files::block();
            let mesh = files.block_mesh();
            let mut attributes = json!({ "TRANSLATION": files.floats(&translations), "SCALE": files.floats(&scales) });
            let rotation = if component == FLOAT {
                files.floats(&rotations.map(|rotation| rotation.map(|part| part as f32)))
            } else {
                let bytes = stored
                    .as_flattened()
                    .iter()
                    .flat_map(|&part| match component {
                        5122 => (part as i16).to_le_bytes().to_vec(),
                        _ => (part as i8).to_le_bytes().to_vec(),
                    });
                let view = files.view(&bytes.collect::<Vec<u8>>(), None);
                let mut accessor = json!({ "componentType": component, "normalized": true, "count": 3, "type": "VEC4" });
                accessor["bufferView"] = json!(view);
                files.push("accessors", accessor)
            };
            attributes["ROTATION"] = json!(rotation);
            let child =
                json!({ "mesh": mesh, "translation": [0.1, 1.2, 0.2], "scale": [0.1, 0.1, 0.1] });
            let mut children = vec![files.push("nodes", child)];
            let mut node = parent.clone();
            if nodes {
                for (at, translation) in translations.iter().enumerate() {
                    let turn = if most == 0.0 {
                        rotations[at]
                    } else {
                        stored[at]
                    };
                    let length = turn.iter().map(|part| part * part).sum::<f64>().sqrt();
                    let turn = turn.map(|part| part / length);
                    let own = json!({ "mesh": mesh, "translation": translation, "scale": scales[at], "rotation": turn });
                    children.push(files.push("nodes", own));
                }
            } else {
                node["mesh"] = json!(mesh);
            }
            if extension {
                node["extensions"] =
                    json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
            }
            node["children"] = json!(children);
            files.node(node);
            files.document["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
            files
        };
        let what = format!("instances of {component}");
        same(
            &what,
            &build(true, false),
            &build(false, true),
            &build(false, false),
        );
    }
}

#[test]
fn quantised_meshes_are_those_of_floats() {
    let grid = [
        [0_u16, 0, 0],
        [65535, 0, 13107],
        [0, 52428, 0],
        [65535, 65535, 39321],
    ];
    let node = json!({ "translation": [-1.1, 0.25, 0.3], "scale": [2.2, 1.7, 1.3] });
    let build = |quantised: bool, scaled: bool| {
        let mut files = Files::block();
        let position = if quantised {
            let bytes: Vec<u8> = grid
                .iter()
                .flat_map(|&[x, y, z]| [x, y, z, 0].map(u16::to_le_bytes).concat())
                .collect();
            let view = files.view(&bytes, Some(8));
            let mut accessor =
                json!({ "componentType": 5123, "normalized": scaled, "count": 4, "type": "VEC3" });
            accessor["bufferView"] = json!(view);
            accessor["min"] = json!([0, 0, 0]);
            accessor["max"] = json!([65535, 65535, 39321]);
            files.push("accessors", accessor)
        } else {
            files.floats(&grid.map(|corner| corner.map(|at| f32::from(at) / 65535.0)))
        };
        let normal = files.view(&[[0, 0, 127, 0]; 4].concat(), Some(4));
        let normal = json!({ "bufferView": normal, "componentType": 5120, "normalized": true, "count": 4, "type": "VEC3" });
        let normal = files.push("accessors", normal);
        let attributes = json!({ "POSITION": position, "NORMAL": normal });
        let mesh = files.push(
            "meshes",
            json!({ "primitives": [{ "attributes": attributes, "mode": 5 }] }),
        );
        let mut node = node.clone();
        if scaled {
            node["mesh"] = json!(mesh);
        }
        files.node(node);
        files.document["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
        files
    };
    same(
        "quantised",
        &build(true, true),
        &build(false, true),
        &build(false, false),
    );
}

#[test]
fn what_is_hidden_or_has_no_size_is_not_seen() {
    let shown = |node: Value, with_child: bool| {
        let mut files = Files::block();
        let mesh = files.block_mesh();
        let child = files.push(
            "nodes",
            json!({ "mesh": mesh, "scale": [0.5, 0.5, 0.5], "translation": [0, 1, 0] }),
        );
        let mut node = node;
        if with_child {
            node["mesh"] = json!(mesh);
            node["children"] = json!([child]);
        }
        files.node(node);
        files
    };
    let none = Files::block();
    for node in [
        json!({ "extensions": { "KHR_node_visibility": { "visible": false } } }),
        json!({ "scale": [0, 0, 0], "translation": [0, 5, 0] }),
        json!({ "matrix": [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 4, 5, 1] }),
    ] {
        same(
            &node.to_string(),
            &shown(node.clone(), true),
            &none,
            &shown(json!({}), true),
        );
    }
    let seen = json!({ "extensions": { "KHR_node_visibility": { "visible": true } } });
    same(
        "visible",
        &shown(seen, true),
        &shown(json!({}), true),
        &none,
    );
    // Along one axis alone, a mesh is flat.
    let mut flat = Files::block();
    let panel = flat.floats(&[
        [-1.0_f32, 1.4, -1.0],
        [1.0, 1.4, -1.0],
        [-1.0, 1.4, 1.0],
        [1.0, 1.4, 1.0],
    ]);
    let panel = flat.push(
        "meshes",
        json!({ "primitives": [{ "attributes": { "POSITION": panel }, "mode": 5 }] }),
    );
    flat.node(json!({ "mesh": panel }));
    let mut said = Files::block();
    let mesh = said.block_mesh();
    said.node(json!({ "mesh": mesh, "scale": [1, 0, 1], "translation": [0, 1.4, 0] }));
    same("flat", &said, &flat, &none);
}

#[test]
fn far_from_the_origin_all_looks_the_same() {
    let at = |[x, z]: [f64; 2], nested: bool| {
        let mut files = Files::block();
        let material = files.masked(&picture(12, is_opaque), json!({}));
        let panel = files.panel(CORNERS, material);
        let mesh = files.block_mesh();
        let turn = json!([0.0, 0.3826834, 0.0, 0.9238795]);
        let own = json!({ "mesh": mesh, "translation": [0.7, 0.3, 0.6], "scale": [0.2, 0.9, 0.1], "rotation": turn });
        let mut children = vec![
            files.push("nodes", own),
            files.push("nodes", json!({ "mesh": panel })),
            0,
        ];
        if nested {
            // Out and half the way back.
            let inner = json!({ "translation": [-x, 0, -z], "children": children });
            children = vec![files.push("nodes", inner)];
        }
        let scale = if nested { 2.0 } else { 1.0 };
        let outer = json!({ "translation": [scale * x, 0, scale * z], "children": children });
        let outer = files.push("nodes", outer);
        files.document["scenes"][0]["nodes"] = json!([outer]);
        files
    };
    let near = at([0.0; 2], false).seen(&options());
    for nested in [false, true] {
        for place in [[4e6, 0.0], [0.0, -4e6], [4e6, 4e6]] {
            let mut options = options();
            let offset = DVec3::new(place[0], 0.0, place[1]);
            options.camera = options
                .camera
                .map(|camera| camera.map(|point| point + offset));
            let far = at(place, nested).seen(&options);
            assert_eq!(far.apart(&near), [0; 3], "{place:?}, nested {nested}");
        }
    }
}
