//! Files that say the same of textures and masks in two ways look the same.

use crate::Files;
use crate::build::{CORNERS, FLOAT, is_opaque, options, picture, same};
use serde_json::{Value, json};

/// Samplers' names for the nearest texel, and for a blend.
const FILTERS: [u32; 2] = [9728, 9729];

/// The block with a panel of this texture.
fn panelled(uvs: [[f32; 2]; 4], png: &[u8], sampler: Value) -> Files {
    let mut files = Files::block();
    let material = files.masked(png, sampler);
    let panel = files.panel(uvs, material);
    files.node(json!({ "mesh": panel }));
    files
}

#[test]
fn images_go_on_beyond_their_edges_as_samplers_say() {
    const SIDE: u32 = 10;
    let wide = CORNERS.map(|uv| uv.map(|at| 3.0 * at - 1.0));
    const MODES: [u32; 3] = [33071, 33648, 10497];
    // The texel of an image in the middle of two others.
    let texel = |mode: usize, at: u32| match mode {
        0 => at.clamp(SIDE, 2 * SIDE - 1) - SIDE,
        1 if at / SIDE != 1 => SIDE - 1 - at % SIDE,
        _ => at % SIDE,
    };
    let narrow = picture(SIDE, is_opaque);
    for [s, t] in [[0, 1], [1, 2], [2, 0]] {
        for filter in FILTERS {
            let sampler = |s: u32, t: u32| json!({ "magFilter": filter, "minFilter": filter, "wrapS": s, "wrapT": t });
            let whole = picture(3 * SIDE, |x, y| is_opaque(texel(s, x), texel(t, y)));
            let said = panelled(wide, &narrow, sampler(MODES[s], MODES[t]));
            // The whole one ends in the same texels as the narrow one only where it clamps; else it is repeated.
            let ends = |mode: usize| if mode == 0 { 33071 } else { 10497 };
            let reference = panelled(CORNERS, &whole, sampler(ends(s), ends(t)));
            let unread = panelled(wide, &narrow, sampler(MODES[t], MODES[s]));
            same(
                &format!("wrap {s} {t}, filter {filter}"),
                &said,
                &reference,
                &unread,
            );
        }
    }
}

#[test]
fn the_nearest_texel_has_straight_edges() {
    let png = picture(5, |x, y| is_opaque(2 * x, 2 * y));
    let nearest = panelled(CORNERS, &png, json!({ "magFilter": 9728 }));
    // Each texel as 8x8 of its kind.
    let fine = picture(40, |x, y| is_opaque(x / 8 * 2, y / 8 * 2));
    let reference = panelled(
        CORNERS,
        &fine,
        json!({ "magFilter": 9728, "minFilter": 9729 }),
    );
    let opaque = picture(4, |_, _| true);
    same(
        "nearest",
        &nearest,
        &reference,
        &panelled(CORNERS, &opaque, json!({})),
    );
    // What only one of the two filters says goes for both.
    let small = panelled(CORNERS, &png, json!({ "minFilter": 9986 }));
    same(
        "small nearest",
        &small,
        &reference,
        &panelled(CORNERS, &opaque, json!({})),
    );
    let blended = panelled(CORNERS, &png, json!({ "magFilter": 9729 }));
    let apart = blended.seen(&options()).apart(&nearest.seen(&options()));
    assert!(apart[0] > 100 && apart[1] > 100, "{apart:?}");
}

#[test]
fn texture_transforms_turn_scale_and_move() {
    let png = picture(12, is_opaque);
    let [turn, scale, offset] = [[-0.7_f64, 0.0], [-1.6, 2.3], [0.4, -0.2]];
    let moved = CORNERS.map(|[u, v]| {
        let [u, v] = [f64::from(u) * scale[0], f64::from(v) * scale[1]];
        let (sin, cos) = turn[0].sin_cos();
        [
            (cos * u + sin * v + offset[0]) as f32,
            (cos * v - sin * u + offset[1]) as f32,
        ]
    });
    let transform = json!({ "rotation": turn[0], "scale": scale, "offset": offset, "texCoord": 1 });
    let with = |extensions: Value| {
        let mut files = panelled(CORNERS, &png, json!({}));
        let path = "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions";
        crate::set(&mut files.document, path, extensions);
        // The coordinates that the texture itself names are others.
        let set = &mut files.document["meshes"][1]["primitives"][0]["attributes"];
        let right = set["TEXCOORD_0"].take();
        let wrong = files.floats(&[[0.3_f32, 0.3]; 4]);
        let set = &mut files.document["meshes"][1]["primitives"][0]["attributes"];
        *set = json!({ "POSITION": set["POSITION"], "TEXCOORD_0": wrong, "TEXCOORD_1": right });
        files
    };
    let said = with(json!({ "KHR_texture_transform": transform }));
    let reference = panelled(moved, &png, json!({}));
    same(
        "transform",
        &said,
        &reference,
        &with(json!({ "KHR_texture_transform": { "texCoord": 1 } })),
    );
}

#[test]
fn the_alpha_of_vertices_makes_holes() {
    // Alpha falls from 1 on the left to 0 on the right; times 0.8 it is 0.5 at 3/8 of the way.
    let panel = |colours: Value, factor: f64, mode: &str, right: f32| {
        let mut files = Files::block();
        let material = json!({ "alphaMode": mode, "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, factor] } });
        let material = files.push("materials", material);
        let panel = files.panel(CORNERS, material);
        let at = |left: [f32; 3], other: [f32; 3]| {
            [0, 1, 2].map(|axis| left[axis] + right * (other[axis] - left[axis]))
        };
        let low = at([-1.3, 0.3, 0.5], [1.0, 0.35, -0.4]);
        let high = at([-1.3, 1.9, 0.1], [1.0, 1.95, -0.8]);
        let position = files.floats(&[[-1.3, 0.3, 0.5], low, [-1.3, 1.9, 0.1], high]);
        files.document["meshes"][panel]["primitives"][0]["attributes"]["POSITION"] =
            json!(position);
        if !colours.is_null() {
            let bytes = [[9, 9, 9, 255], [9, 9, 9, 0], [9, 9, 9, 255], [9, 9, 9, 0]];
            let view = files.view(bytes.as_flattened(), Some(4));
            let mut accessor =
                json!({ "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4" });
            accessor["bufferView"] = json!(view);
            let accessor = files.push("accessors", accessor);
            files.document["meshes"][panel]["primitives"][0]["attributes"]["COLOR_0"] =
                json!(accessor);
        }
        // The light is fitted to the same points in all.
        let rest = files.floats(&[[1.0_f32, 0.35, -0.4], [1.0, 1.95, -0.8], [1.0, 1.95, -0.8]]);
        let rest = files.push(
            "meshes",
            json!({ "primitives": [{ "attributes": { "POSITION": rest } }] }),
        );
        files.node(json!({ "mesh": panel }));
        files.node(json!({ "mesh": rest }));
        files
    };
    let said = panel(json!(true), 0.8, "MASK", 1.0);
    let reference = panel(Value::Null, 1.0, "OPAQUE", 3.0 / 8.0);
    same(
        "vertex alpha",
        &said,
        &reference,
        &panel(Value::Null, 0.8, "MASK", 1.0),
    );
    // Opaque materials have no alpha.
    let opaque = panel(json!(true), 0.8, "OPAQUE", 1.0);
    let solid = panel(Value::Null, 1.0, "OPAQUE", 1.0);
    same("opaque", &opaque, &solid, &reference);
}

#[test]
fn textures_without_an_image_are_left_out() {
    let png = picture(12, is_opaque);
    let fallback = |texture: Value| {
        let mut files = Files::block();
        let view = files.view(&png, None);
        files.push(
            "images",
            json!({ "bufferView": view, "mimeType": "image/png" }),
        );
        files.push(
            "images",
            json!({ "uri": "absent.webp", "mimeType": "image/webp" }),
        );
        files.push("textures", texture);
        let material = files.material(json!({ "index": 0 }));
        let panel = files.panel(CORNERS, material);
        files.node(json!({ "mesh": panel }));
        files.document["extensionsUsed"] = json!(["EXT_texture_webp"]);
        files
    };
    let webp = json!({ "EXT_texture_webp": { "source": 1 } });
    let masked = fallback(json!({ "source": 0 }));
    let mut plain = fallback(json!({ "source": 0 }));
    plain.document["materials"][0]["alphaMode"] = json!("OPAQUE");
    same(
        "fallback",
        &fallback(json!({ "source": 0, "extensions": webp })),
        &masked,
        &plain,
    );
    same(
        "no fallback",
        &fallback(json!({ "extensions": webp })),
        &plain,
        &masked,
    );
    same("no source", &fallback(json!({})), &plain, &masked);
    // Coordinates without data are zero, where the image has a hole.
    let mut zero = fallback(json!({ "source": 0 }));
    let accessor = json!({ "componentType": FLOAT, "count": 4, "type": "VEC2" });
    let accessor = zero.push("accessors", accessor);
    zero.document["meshes"][1]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(accessor);
    let hole = panelled([[0.0; 2]; 4], &png, json!({}));
    same("no data", &zero, &hole, &masked);
}
