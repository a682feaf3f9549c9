//! Files that are broken, and those that would take too much.

use crate::{Files, check, load_bytes, set};
use moment_shadows_lab::scene::{EXTENSIONS, load_gltf};
use serde_json::json;
use std::path::Path;

/// A JSON pointer into the triangle's document, a value that breaks it there, and what the error must name.
const BROKEN: &str = r#"
    /nodes/0/mesh; 7; nodes[0].mesh
    /nodes/0/scale; [1e38, 1e38, 1e38]; placed POSITION
    /nodes/0/children; [0]; node 0 'only'
    /scenes/0/nodes; []; no triangles
    /meshes/0/primitives/0/attributes/POSITION; 9; index is 9
    /meshes/0/primitives/0/attributes/NORMAL; 2; 3 positions
    /meshes/0/primitives/0/material; 0; material 'holed': image 0
    /meshes/0/primitives/0/mode; 0; no triangles
    /accessors/0/componentType; 5130; accessors[0].componentType
    /accessors/0/count; 4; mesh 0 'sail', primitive 0: POSITION (accessor 0)
    /accessors/0/count; 4000000000; limit of 1073741824 bytes
    /accessors/0/byteOffset; 18446744073709551612; POSITION (accessor 0)
    /accessors/0/type; "VEC2"; 2 components, not 3
    /accessors/0/bufferView; 7; accessors[0].bufferView
    /accessors/1/componentType; 5120; indices (accessor 1)
    /bufferViews/1/byteOffset; 18446744073709551613; indices (accessor 1)
    /bufferViews/0/byteStride; 4; breaks the reader
    /bufferViews/0/byteStride; 4; (gltf-1
    /extensionsRequired; ["KHR_draco_mesh_compression"]; KHR_draco_mesh_compression
    /buffers/0/uri; "absent.bin"; buffer 0: 'absent.bin'
    /buffers/0/uri; null; missing binary portion
    /buffers/0/uri; "data:application/octet-stream,?!"; Invalid byte
    /buffers/0/uri; "%ff.bin"; %ff.bin
    /buffers/0/uri; "https://example.org/a.bin"; https://example.org/a.bin
    /buffers/0/byteLength; 400; expected 400 bytes"#;

#[test]
fn each_broken_file_gives_an_error_that_names_the_culprit() {
    for row in BROKEN.trim().lines() {
        let [pointer, value, culprit] = row.trim().split("; ").collect::<Vec<_>>()[..] else {
            panic!("{row}");
        };
        let mut files = Files::triangle(
            r#"/accessors/2 { "bufferView": 0, "componentType": 5126, "count": 2, "type": "VEC3" }
            /images [{ "bufferView": 0, "mimeType": "image/png" }]
            /textures [{ "source": 0 }]
            /materials [{ "name": "holed", "alphaMode": "MASK" }]
            /materials/0/pbrMetallicRoughness { "baseColorTexture": { "index": 0 } }"#,
        );
        assert!(files.load().is_ok(), "nothing uses the image");
        set(
            &mut files.document,
            pointer,
            serde_json::from_str(value).unwrap(),
        );
        files.is_refused(culprit);
    }
    let float = |value: f32| value.to_le_bytes();
    for (at, bytes, culprit) in [
        (36, [0, 3, 2, 0], "primitive 0: it has the index 3"),
        (12, float(f32::NAN), "vertex 1: POSITION is [NaN, 0.0, 0.0]"),
        (28, float(f32::INFINITY), "vertex 2: POSITION is [0.0, inf"),
        (12, float(1e30), "beyond 1e15"),
    ] {
        let mut files = Files::triangle("");
        files.bytes[at..at + 4].copy_from_slice(&bytes);
        files.is_refused(culprit);
    }
}

#[test]
fn small_files_do_not_multiply_without_limit() {
    // Zeros that take no room in the file, many times.
    let mut files = Files::triangle(
        r#"/accessors/0 { "componentType": 5126, "count": 8000000, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1] }
        /accessors/0/sparse { "count": 1, "indices": { "bufferView": 1, "componentType": 5121 }, "values": { "bufferView": 0 } }
        /accessors/1/count 1"#,
    );
    files.document["nodes"] = vec![json!({ "mesh": 0 }); 30].into();
    files.document["scenes"] = json!([{ "nodes": (0..30).collect::<Vec<_>>() }]);
    files.is_refused("limit of 1073741824 bytes");
    // As many warnings are not repeated for each.
    let line = r#" { "attributes": { "POSITION": 0 }, "mode": 1 }"#;
    let lines = (1..200).map(|at| format!("/meshes/0/primitives/{at}{line}\n"));
    let files = Files::triangle(&lines.collect::<String>());
    let warnings = files.load().unwrap().warnings;
    assert_eq!(warnings.len(), 101);
    assert_eq!(warnings[100], "further warnings are left out");
    // A picture of 20000 x 20000 texels, if it were one.
    Files::triangle(
        r#"/images [{ "uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAATiAAAE4gCAAAAADGGxnlAAAACUlEQVR4nGMAAAABAAFe/335AAAAAElFTkSuQmCC" }]
        /textures [{ "source": 0 }]
        /materials [{ "alphaMode": "MASK", "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]
        /meshes/0/primitives/0/material 0"#,
    )
    .is_refused("limit of 1073741824 bytes");
}

#[test]
fn instances_are_checked_and_do_not_multiply_without_limit() {
    let zeros =
        |count: u64, kind: &str| json!({ "componentType": 5126, "count": count, "type": kind });
    for (scale, rotation, attributes, culprit) in [
        (
            zeros(3, "VEC3"),
            zeros(3, "VEC4"),
            json!({ "SCALE": 2, "TRANSLATION": 0 }),
            "",
        ),
        (
            zeros(3, "VEC3"),
            zeros(4, "VEC4"),
            json!({ "SCALE": 2, "ROTATION": 3 }),
            "node 0 'only': its instances have",
        ),
        (
            zeros(3, "VEC3"),
            zeros(3, "VEC4"),
            json!({ "ROTATION": 2 }),
            "ROTATION (accessor 2): it has 3 components",
        ),
        (
            zeros(3, "VEC3"),
            zeros(3, "VEC4"),
            json!({ "SCALE": 9 }),
            "SCALE: there is no accessor 9",
        ),
        (
            zeros(3, "VEC3"),
            zeros(3, "VEC4"),
            json!({ "SCALE": "two" }),
            "there is no accessor \"two\"",
        ),
        (
            zeros(3, "VEC3"),
            zeros(3, "VEC4"),
            json!({ "SCALE": 1 }),
            "it has 1 components",
        ),
        (
            zeros(4_000_000_000, "VEC3"),
            zeros(3, "VEC4"),
            json!({ "TRANSLATION": 2 }),
            "limit of 1073741824 bytes",
        ),
        (
            zeros(6_000_000, "VEC3"),
            zeros(3, "VEC4"),
            json!({ "TRANSLATION": 2 }),
            "limit of 1073741824 bytes",
        ),
        (
            zeros(3, "VEC3"),
            zeros(10_000_000, "VEC4"),
            json!({ "ROTATION": 3 }),
            "limit of 1073741824 bytes",
        ),
    ] {
        let mut files = Files::triangle("");
        set(&mut files.document, "/accessors/2", scale);
        set(&mut files.document, "/accessors/3", rotation);
        let extension = json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
        set(&mut files.document, "/nodes/0/extensions", extension);
        if culprit.is_empty() {
            // Scaled to nothing, all of them.
            files.is_refused("no triangles");
        } else {
            files.is_refused(culprit);
        }
    }
    // Whatever the extension is, it does not break the reader.
    for extension in [
        json!(7),
        json!({}),
        json!({ "attributes": [] }),
        json!({ "attributes": { "SCALE": null } }),
    ] {
        let mut files = Files::triangle("");
        let extension = json!({ "EXT_mesh_gpu_instancing": extension });
        set(&mut files.document, "/nodes/0/extensions", extension);
        match files.load() {
            Ok(scene) => assert_eq!(scene.meshes.len(), 1),
            Err(error) => assert!(error.to_string().contains("no accessor null"), "{error}"),
        }
    }
    let mut files = Files::triangle(
        "/accessors/2 { \"bufferView\": 0, \"componentType\": 5126, \"count\": 1, \"type\": \"VEC3\" }",
    );
    files.bytes[..12].copy_from_slice(&[f32::MAX, 0.0, 0.0].map(f32::to_le_bytes).concat());
    let extension = json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 2 } } });
    set(&mut files.document, "/nodes/0/extensions", extension);
    files.is_refused("beyond 1e15");
}

#[test]
fn what_a_file_requires_is_read_or_refused_by_name() {
    for row in &EXTENSIONS {
        for name in row.names {
            let mut files = Files::triangle("");
            files.document["extensionsUsed"] = json!([name]);
            let warnings = files.load().unwrap().warnings.join("\n");
            assert_eq!(
                warnings.contains(name),
                row.what.contains("warning"),
                "{name}: {warnings}"
            );
            files.document["extensionsRequired"] = json!([name]);
            if row.what.contains("refused") {
                files.is_refused(&format!("requires the extension '{name}'"));
            } else {
                assert_eq!(files.load().unwrap().warnings.join("\n"), warnings);
            }
        }
    }
    let mut files = Files::triangle("");
    files.document["extensionsUsed"] = json!(["ACME_matter"]);
    assert!(files.load().unwrap().warnings[0].contains("ACME_matter"));
    files.document["extensionsRequired"] = json!(["ACME_matter"]);
    files.is_refused("ACME_matter");
}

#[test]
fn broken_containers_are_refused() {
    let glb = Files::triangle("").glb();
    let with = |at: usize, value: u32| {
        let mut bytes = glb.clone();
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        bytes
    };
    let rows = [
        ("empty", Vec::new()),
        ("text", b"{ \"asset\": ".to_vec()),
        ("a header cut short", glb[..7].to_vec()),
        ("a chunk cut short", glb[..glb.len() - 8].to_vec()),
        ("a length below that of the header", with(8, 4)),
        ("version 1", with(4, 1)),
        ("a chunk longer than the file", with(12, u32::MAX)),
    ];
    for (name, bytes) in rows {
        let error = load_bytes(&bytes).unwrap_err().to_string();
        assert!(error.contains("sail.glb"), "{name}: {error}");
    }
}

#[test]
fn no_changed_byte_makes_the_loader_panic_or_gives_a_broken_scene() {
    // A linear congruential generator is random enough to pick bytes.
    let glb = Files::triangle("").glb();
    let mut state = 1_u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        state >> 8
    };
    let mut refused = 0;
    for _ in 0..1500 {
        let mut bytes = glb.clone();
        for _ in 0..1 + next() % 3 {
            let at = next() as usize % bytes.len();
            bytes[at] = next() as u8;
        }
        match load_bytes(&bytes) {
            Ok(scene) => check(&scene),
            Err(_) => refused += 1,
        }
    }
    assert!(refused > 300, "only {refused} of 1500 were refused");
}

#[test]
#[cfg(unix)]
fn what_never_ends_is_not_read() {
    for uri in ["/dev/zero", "%2Fdev/zero"] {
        Files::triangle(&format!("/buffers/0/uri \"{uri}\"")).is_refused("no regular file");
    }
    let error = load_gltf(Path::new("/dev/zero")).unwrap_err().to_string();
    assert!(error.contains("no regular file"), "{error}");
}
