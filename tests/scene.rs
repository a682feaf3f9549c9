//! Scenes: what good files give, and that each kind of broken file gives an error that names the culprit.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::{Path, PathBuf};

use moment_shadows_lab::scene::{self, Scene, SceneError, load_gltf, place_on_ground};
use serde_json::{Value, json};

/// A folder with one glTF file and its buffer, a single triangle in the xy plane with 8-bit indices.
struct Files {
    folder: tempfile::TempDir,
    document: Value,
    bytes: Vec<u8>,
}

impl Files {
    fn triangle() -> Self {
        let positions = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let mut bytes: Vec<u8> = positions
            .iter()
            .flatten()
            .flat_map(|coordinate| coordinate.to_le_bytes())
            .collect();
        bytes.extend([0, 1, 2, 0]);
        let document = json!({
            "asset": { "version": "2.0" },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "name": "only", "mesh": 0 }],
            "meshes": [{ "name": "sail", "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
            "accessors": [
                { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] },
                { "bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR" }
            ],
            "bufferViews": [
                { "buffer": 0, "byteLength": 36 },
                { "buffer": 0, "byteOffset": 36, "byteLength": 3 }
            ],
            "buffers": [{ "uri": "sail.bin", "byteLength": 40 }]
        });
        Self {
            folder: tempfile::tempdir().unwrap(),
            document,
            bytes,
        }
    }

    fn path(&self) -> PathBuf {
        self.folder.path().join("sail.gltf")
    }

    fn load(&self) -> Result<Scene, SceneError> {
        std::fs::write(self.folder.path().join("sail.bin"), &self.bytes).unwrap();
        std::fs::write(self.path(), self.document.to_string()).unwrap();
        load_gltf(&self.path())
    }

    /// The same as one binary file.
    fn glb(&self) -> Vec<u8> {
        let mut document = self.document.clone();
        document["buffers"][0]
            .as_object_mut()
            .unwrap()
            .remove("uri");
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
}

fn load_bytes(bytes: &[u8]) -> Result<Scene, SceneError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sail.glb");
    std::fs::write(&path, bytes).unwrap();
    load_gltf(&path)
}

#[test]
fn a_triangle_is_flattened_with_its_own_normal() {
    let mut files = Files::triangle();
    files.document["nodes"] = json!([
        { "children": [1], "translation": [10, 0, 0] },
        { "mesh": 0, "scale": [2, 2, 2], "rotation": [0, 1, 0, 0] }
    ]);
    let scene = files.load().unwrap();
    let mesh = &scene.meshes[0];
    // Scaled by 2, turned by 180 degrees about y, moved by 10 along x.
    assert_eq!(
        mesh.positions,
        [[10.0, 0.0, 0.0], [8.0, 0.0, 0.0], [10.0, 2.0, 0.0]]
    );
    // The file has no normals, so the triangle gets its own: +z before the turn, -z after it.
    for normal in &mesh.normals {
        assert!((normal[2] + 1.0).abs() < 1e-6, "{normal:?}");
    }
    assert_eq!(scene.materials[mesh.material].name, "default");
}

#[test]
fn binary_and_text_give_the_same() {
    let files = Files::triangle();
    let text = files.load().unwrap();
    let binary = load_bytes(&files.glb()).unwrap();
    assert_eq!(text.meshes, binary.meshes);
}

#[test]
fn strips_and_fans_become_lists_that_turn_one_way() {
    for (mode, expected) in [(5, [[0, 1, 2], [2, 1, 3]]), (6, [[0, 1, 2], [0, 2, 3]])] {
        let mut files = Files::triangle();
        files.bytes = [
            [0.0_f32, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, 1.0, 0.0],
        ]
        .iter()
        .flatten()
        .flat_map(|coordinate| coordinate.to_le_bytes())
        .collect();
        files.document["buffers"][0]["byteLength"] = json!(48);
        files.document["bufferViews"] = json!([{ "buffer": 0, "byteLength": 48 }]);
        files.document["accessors"] = json!([{ "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] }]);
        // Not indexed either.
        files.document["meshes"][0]["primitives"][0] =
            json!({ "attributes": { "POSITION": 0, "NORMAL": 0 }, "mode": mode });
        let scene = files.load().unwrap();
        assert_eq!(scene.meshes[0].indices, expected.concat(), "mode {mode}");
    }
}

#[test]
fn what_is_left_out_is_said() {
    let mut files = Files::triangle();
    files.document["materials"] = json!([{ "name": "glass", "alphaMode": "BLEND" }]);
    files.document["meshes"][0]["primitives"][0]["material"] = json!(0);
    let points = json!({ "attributes": { "POSITION": 0 }, "mode": 0 });
    files.document["meshes"][0]["primitives"]
        .as_array_mut()
        .unwrap()
        .push(points);
    let warnings = files.load().unwrap().warnings;
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    assert!(warnings[0].contains("glass"), "{warnings:?}");
    assert!(warnings[1].contains("primitive 1"), "{warnings:?}");
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
        for mesh in &scene.meshes {
            assert!(mesh.material < scene.materials.len());
            assert!(
                mesh.indices
                    .iter()
                    .all(|&index| (index as usize) < mesh.positions.len())
            );
            assert_eq!(mesh.positions.len(), mesh.normals.len());
            assert_eq!(mesh.positions.len(), mesh.uvs.len());
        }
    }
}

/// One way to break the triangle, the error it must give and what the text must name.
type Row = (
    &'static str,
    fn(&mut Value, &mut Vec<u8>),
    fn(&SceneError) -> bool,
    &'static str,
);

const ROWS: &[Row] = &[
    (
        "a mesh that does not exist",
        |document, _| document["nodes"][0]["mesh"] = json!(7),
        |error| matches!(error, SceneError::Malformed { .. }),
        "nodes[0].mesh",
    ),
    (
        "an accessor that does not exist",
        |document, _| {
            document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(9);
        },
        |error| matches!(error, SceneError::Malformed { .. }),
        "accessor 9",
    ),
    (
        "an unknown component type",
        |document, _| document["accessors"][0]["componentType"] = json!(5130),
        |error| matches!(error, SceneError::Malformed { .. }),
        "accessors[0].componentType",
    ),
    (
        "a required extension",
        |document, _| document["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]),
        |error| matches!(error, SceneError::Extension { .. }),
        "KHR_draco_mesh_compression",
    ),
    (
        "a buffer that is not there",
        |document, _| document["buffers"][0]["uri"] = json!("absent.bin"),
        |error| matches!(error, SceneError::Buffer { buffer: 0, .. }),
        "absent.bin",
    ),
    (
        "a buffer without a source",
        |document, _| {
            document["buffers"][0]
                .as_object_mut()
                .unwrap()
                .remove("uri");
        },
        |error| matches!(error, SceneError::Buffer { buffer: 0, .. }),
        "no URI",
    ),
    (
        "a short buffer",
        |_, bytes| bytes.truncate(17),
        |error| matches!(error, SceneError::Buffer { buffer: 0, .. }),
        "40 bytes, but has 17",
    ),
    (
        "broken base64",
        |document, _| {
            document["buffers"][0]["uri"] = json!("data:application/octet-stream;base64,?!");
        },
        |error| matches!(error, SceneError::Buffer { buffer: 0, .. }),
        "data URI",
    ),
    (
        "a path that is not UTF-8",
        |document, _| document["buffers"][0]["uri"] = json!("%ff.bin"),
        |error| matches!(error, SceneError::Buffer { buffer: 0, .. }),
        "%ff.bin",
    ),
    (
        "a remote buffer",
        |document, _| document["buffers"][0]["uri"] = json!("https://example.org/a.bin"),
        |error| matches!(error, SceneError::Buffer { buffer: 0, .. }),
        "https://example.org/a.bin",
    ),
    (
        "more elements than bytes",
        |document, _| document["accessors"][0]["count"] = json!(4),
        |error| matches!(error, SceneError::Accessor { .. }),
        "'sail', primitive 0, POSITION (accessor 0)",
    ),
    (
        "an absurd number of elements",
        |document, _| document["accessors"][0]["count"] = json!(1_000_000_000_000_000_u64),
        |error| matches!(error, SceneError::Accessor { .. }),
        "1000000000000000 elements",
    ),
    (
        "an offset near the end of the address space",
        |document, _| document["accessors"][0]["byteOffset"] = json!(u64::MAX - 3),
        |error| matches!(error, SceneError::Accessor { .. }),
        "buffer view 0",
    ),
    (
        "a view beyond its buffer",
        |document, _| document["bufferViews"][1]["byteOffset"] = json!(u64::MAX - 1),
        |error| matches!(error, SceneError::Accessor { .. }),
        "buffer view 1",
    ),
    (
        "a stride shorter than an element",
        |document, _| document["bufferViews"][0]["byteStride"] = json!(4),
        |error| matches!(error, SceneError::Accessor { .. }),
        "stride of 4",
    ),
    (
        "positions of two components",
        |document, _| document["accessors"][0]["type"] = json!("VEC2"),
        |error| matches!(error, SceneError::Accessor { .. }),
        "Vec2",
    ),
    (
        "signed indices",
        |document, _| document["accessors"][1]["componentType"] = json!(5120),
        |error| matches!(error, SceneError::Accessor { .. }),
        "indices (accessor 1)",
    ),
    (
        "a sparse entry beyond the end",
        |document, bytes| {
            bytes[36] = 9;
            document["accessors"][0]["sparse"] = json!({
                "count": 1,
                "indices": { "bufferView": 1, "componentType": 5121 },
                "values": { "bufferView": 0 }
            });
        },
        |error| matches!(error, SceneError::Accessor { .. }),
        "sparse entry 0",
    ),
    (
        "normals for some vertices only",
        |document, _| {
            document["accessors"].as_array_mut().unwrap().push(json!(
                { "bufferView": 0, "componentType": 5126, "count": 2, "type": "VEC3" }
            ));
            document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(2);
        },
        |error| matches!(error, SceneError::Accessor { .. }),
        "2 entries for 3 positions",
    ),
    (
        "an index without a vertex",
        |_, bytes| bytes[37] = 3,
        |error| {
            matches!(
                error,
                SceneError::Index {
                    index: 3,
                    vertices: 3,
                    ..
                }
            )
        },
        "mesh 0 'sail', primitive 0",
    ),
    (
        "a NaN vertex",
        |_, bytes| bytes[12..16].copy_from_slice(&f32::NAN.to_le_bytes()),
        |error| matches!(error, SceneError::Vertex { vertex: 1, .. }),
        "vertex 1: POSITION is [NaN, 0.0, 0.0]",
    ),
    (
        "an infinite vertex",
        |_, bytes| bytes[28..32].copy_from_slice(&f32::INFINITY.to_le_bytes()),
        |error| matches!(error, SceneError::Vertex { vertex: 2, .. }),
        "vertex 2: POSITION is [0.0, inf, 0.0]",
    ),
    (
        "a vertex placed beyond f32",
        |document, bytes| {
            bytes[12..16].copy_from_slice(&1e30_f32.to_le_bytes());
            document["nodes"][0]["scale"] = json!([1e30, 1e30, 1e30]);
        },
        |error| matches!(error, SceneError::Vertex { vertex: 1, .. }),
        "placed POSITION",
    ),
    (
        "a scale of zero",
        |document, _| document["nodes"][0]["scale"] = json!([1, 0, 1]),
        |error| matches!(error, SceneError::Node { .. }),
        "node 0 'only'",
    ),
    (
        "a node that is its own child",
        |document, _| document["nodes"][0]["children"] = json!([0]),
        |error| matches!(error, SceneError::Node { .. }),
        "node 0 'only'",
    ),
    (
        "an image that is none",
        |document, _| {
            document["images"] = json!([{ "bufferView": 0 }]);
            document["textures"] = json!([{ "source": 0 }]);
            document["materials"] =
                json!([{ "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
        },
        |error| matches!(error, SceneError::Image { image: 0, .. }),
        "image 0",
    ),
    (
        "points only",
        |document, _| document["meshes"][0]["primitives"][0]["mode"] = json!(0),
        |error| matches!(error, SceneError::NoTriangles { .. }),
        "no triangles",
    ),
    (
        "an empty scene",
        |document, _| document["scenes"][0]["nodes"] = json!([]),
        |error| matches!(error, SceneError::NoTriangles { .. }),
        "no triangles",
    ),
    (
        "instances without end",
        |document, bytes| {
            // A million triangles in a small file, nine times.
            bytes.resize(36 + 3_000_000, 0);
            document["buffers"][0]["byteLength"] = json!(bytes.len());
            document["bufferViews"][1]["byteLength"] = json!(3_000_000);
            document["accessors"][1]["count"] = json!(3_000_000);
            document["nodes"] = json!(vec![json!({ "mesh": 0 }); 9]);
            document["scenes"][0]["nodes"] = json!((0..9).collect::<Vec<_>>());
        },
        |error| matches!(error, SceneError::TooLarge { .. }),
        "9000000 vertices",
    ),
];

#[test]
fn each_broken_file_gives_its_error_and_names_the_culprit() {
    for (name, break_it, is_expected, culprit) in ROWS {
        let mut files = Files::triangle();
        break_it(&mut files.document, &mut files.bytes);
        match files.load() {
            Ok(_) => panic!("{name}: it was loaded"),
            Err(error) => {
                let text = error.to_string();
                assert!(is_expected(&error), "{name}: {error:?}");
                assert!(text.contains(culprit), "{name}: '{text}' lacks '{culprit}'");
                assert!(text.contains("sail.gltf"), "{name}: '{text}' names no file");
            }
        }
    }
}

#[test]
fn broken_containers_are_malformed() {
    let glb = Files::triangle().glb();
    let cut = |length: usize| glb[..length].to_vec();
    let with = |at: usize, value: u32| {
        let mut bytes = glb.clone();
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        bytes
    };
    let rows = [
        ("empty", Vec::new()),
        ("text", b"{ \"asset\": ".to_vec()),
        ("a header cut short", cut(7)),
        ("a chunk cut short", cut(glb.len() - 8)),
        ("a length below that of the header", with(8, 4)),
        ("version 1", with(4, 1)),
        ("a chunk longer than the file", with(12, u32::MAX)),
    ];
    for (name, bytes) in rows {
        match load_bytes(&bytes) {
            Err(error @ SceneError::Malformed { .. }) => {
                assert!(error.to_string().contains("sail.glb"), "{name}: {error}");
            }
            other => panic!("{name}: {other:?}"),
        }
    }
}

#[test]
fn no_changed_byte_makes_the_loader_panic() {
    // A linear congruential generator is random enough to pick bytes.
    let glb = Files::triangle().glb();
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
        refused += usize::from(load_bytes(&bytes).is_err());
    }
    assert!(refused > 300, "only {refused} of 1500 were refused");
}

#[test]
fn an_unknown_name_lists_the_scenes() {
    match scene::load("fence-and-folage") {
        Err(error @ SceneError::Unknown { .. }) => {
            let text = error.to_string();
            assert!(text.contains("'fence-and-folage'"), "{text}");
            assert!(
                text.contains("fence-and-foliage") && text.contains("hall"),
                "{text}"
            );
        }
        other => panic!("{other:?}"),
    }
    match load_gltf(Path::new("absent.glb")) {
        Err(error @ SceneError::Read { .. }) => assert!(error.to_string().contains("absent.glb")),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_scene_far_from_the_origin_is_brought_to_it() {
    let mut files = Files::triangle();
    files.document["nodes"][0]["translation"] = json!([1000, -50, 3]);
    let scene = place_on_ground(files.load().unwrap());
    let bounds = scene.bounds();
    assert!(
        bounds.min.y.abs() < 1e-9 && bounds.centre().x.abs() < 1e-3,
        "{bounds:?}"
    );
    assert_eq!(scene.ground, Some(0.0));
}

#[test]
fn vertices_too_far_away_are_refused() {
    let mut files = Files::triangle();
    files.bytes[12..16].copy_from_slice(&1.0e38_f32.to_le_bytes());
    match files.load() {
        Err(error @ SceneError::Far { .. }) => {
            let text = error.to_string();
            assert!(text.contains("vertex 1") && text.contains("1e15"), "{text}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
#[cfg(unix)]
fn what_never_ends_is_not_read() {
    let mut files = Files::triangle();
    for uri in ["/dev/zero", "%2Fdev/zero"] {
        files.document["buffers"][0]["uri"] = json!(uri);
        match files.load() {
            Err(error @ SceneError::Buffer { buffer: 0, .. }) => {
                assert!(error.to_string().contains("no regular file"), "{error}");
            }
            other => panic!("{other:?}"),
        }
    }
    match load_gltf(Path::new("/dev/zero")) {
        Err(error @ SceneError::Read { .. }) => {
            assert!(error.to_string().contains("no regular file"), "{error}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn small_files_do_not_multiply_without_limit() {
    // Millions of zeros that take no room in the file, in many primitives without triangles.
    let mut files = Files::triangle();
    let accessor = &mut files.document["accessors"][0];
    accessor["count"] = json!(1 << 23);
    accessor.as_object_mut().unwrap().remove("bufferView");
    accessor["sparse"] = json!({
        "count": 1,
        "indices": { "bufferView": 1, "componentType": 5121 },
        "values": { "bufferView": 0 }
    });
    files.document["accessors"][1]["count"] = json!(1);
    let primitive = files.document["meshes"][0]["primitives"][0].clone();
    files.document["meshes"][0]["primitives"] = vec![primitive; 20].into();
    match files.load() {
        Err(error @ SceneError::Accessor { .. }) => {
            assert!(
                error.to_string().contains("counted once per use"),
                "{error}"
            );
        }
        other => panic!("{other:?}"),
    }
    // Many nodes with the same many primitives, of lines that are left out.
    let mut files = Files::triangle();
    let mut primitive = files.document["meshes"][0]["primitives"][0].clone();
    primitive["mode"] = json!(1);
    files.document["meshes"][0]["primitives"] = vec![primitive; 2000].into();
    files.document["nodes"] = vec![json!({ "mesh": 0 }); 2000].into();
    files.document["scenes"] = json!([{ "nodes": (0..2000).collect::<Vec<_>>() }]);
    match files.load() {
        Err(SceneError::TooLarge {
            unit, count, limit, ..
        }) => {
            assert_eq!((unit, count, limit), ("primitives", (1 << 20) + 1, 1 << 20));
        }
        other => panic!("{other:?}"),
    }
    // As many warnings are not repeated for each.
    files.document["nodes"] = vec![json!({ "mesh": 0 }); 20].into();
    files.document["scenes"] = json!([{ "nodes": (0..20).collect::<Vec<_>>() }]);
    files.document["meshes"][0]["primitives"][0]["mode"] = json!(4);
    let scene = files.load().unwrap();
    assert_eq!(scene.warnings.len(), 101);
    assert_eq!(scene.warnings[100], "further warnings are left out");
}
