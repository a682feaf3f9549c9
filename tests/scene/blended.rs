//! Translucent materials of a file: the light that they let through is known, in the truth and in maps.

use moment_shadows_lab::picture::save_rgba;
use moment_shadows_lab::scene::{Scene, place_on_ground};
use moment_shadows_lab::translucent::{SceneTransmittance, TranslucentStage};
use serde_json::json;

use super::Files;

/// What the arithmetic of the bound in f32 adds.
const ARITHMETIC: f64 = 2e-4;

/// Triangles of glass that lie a metre or more above the ground, where a smaller opaque one is.
fn over_a_floor(heights: &[f32], changes: &str) -> Scene {
    let mut files = Files::triangle(changes);
    let pane = files.document["meshes"][0].clone();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let flat = json!([-half, 0.0, 0.0, half]);
    let mut nodes = vec![json!({ "mesh": 1, "rotation": flat, "scale": [0.5, 0.5, 0.5] })];
    nodes.extend(
        heights
            .iter()
            .map(|height| json!({ "mesh": 0, "rotation": flat, "translation": [0, height, 0] })),
    );
    files.document["scenes"][0]["nodes"] = (0..nodes.len()).collect();
    files.document["nodes"] = nodes.into();
    files.document["meshes"] = json!([pane, pane]);
    files.document["meshes"][0]["primitives"][0]["material"] = json!(0);
    // Texture coordinates are the positions: (0, 0), (1, 0) and (0, 1).
    let coordinates = json!({ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2" });
    let accessors = files.document["accessors"].as_array_mut().unwrap();
    accessors.push(coordinates);
    files.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(2);
    // Two texels, of a quarter and of three quarters.
    let texels = [255, 255, 255, 64, 255, 255, 255, 192];
    save_rgba(&files.folder.path().join("alpha.png"), 2, 1, &texels).unwrap();
    let scene = files.load().unwrap();
    assert_eq!(scene.warnings, [""; 0]);
    place_on_ground(scene)
}

const HALF: &str = r#"/materials [{ "alphaMode": "BLEND", "doubleSided": true, "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, 0.5] } }]"#;

/// The mean of what passes is that of the truth: behind everything a bound is off by the bias at most where it is too dark, and short by what
/// the bias leaks, which is less than twice its root. Two moments have a smallest variance in place of a bias.
fn agree(found: &SceneTransmittance) {
    println!("{found}");
    assert_eq!(found.rows.len(), 13);
    for row in &found.rows {
        let bias = if row.bias.is_nan() { 6e-4 } else { row.bias };
        let dark = bias + ARITHMETIC;
        let off = row.transmittance - found.truth;
        assert!(
            off > -dark && off < 2.0 * bias.sqrt() && row.above <= dark,
            "{row:?}"
        );
    }
}

#[test]
fn a_pane_of_a_file_halves_the_light_and_two_in_one_place_quarter_it() {
    let stage = TranslucentStage::new(128).unwrap();
    let one = SceneTransmittance::of(&stage, &over_a_floor(&[1.0], HALF), 0).unwrap();
    assert!(one.rays > 200 && one.casters == 1, "{one}");
    assert!((one.truth - 0.5).abs() < 1e-9, "{one}");
    agree(&one);
    let two = SceneTransmittance::of(&stage, &over_a_floor(&[1.0, 1.0], HALF), 0).unwrap();
    assert_eq!((two.rays, two.casters), (one.rays, 2));
    assert!((two.truth - 0.25).abs() < 1e-9, "{two}");
    agree(&two);
    // Light that passes one of them alone, and light that passes both.
    let apart = SceneTransmittance::of(&stage, &over_a_floor(&[1.0, 1.1], HALF), 0).unwrap();
    assert!(apart.truth > 0.26 && apart.truth < 0.49, "{apart}");
    agree(&apart);
}

#[test]
fn alpha_of_a_texture_times_that_of_the_material_is_what_a_pane_keeps() {
    let textured = format!(
        r#"{HALF}
        /materials/0/pbrMetallicRoughness/baseColorTexture {{ "index": 0 }}
        /images [{{ "uri": "alpha.png" }}]
        /samplers [{{ "magFilter": 9728, "minFilter": 9728 }}]
        /textures [{{ "source": 0, "sampler": 0 }}]"#
    );
    let stage = TranslucentStage::new(256).unwrap();
    let found = SceneTransmittance::of(&stage, &over_a_floor(&[1.0], &textured), 0).unwrap();
    // u is below one half in three quarters of the triangle; a ray in each texel of the map.
    let passes = |alpha: f64| 1.0 - 0.5 * alpha / 255.0;
    let expected = 0.75 * passes(64.0) + 0.25 * passes(192.0);
    assert!((found.truth - expected).abs() < 0.01, "{found} {expected}");
    agree(&found);
    // What is behind the shadow of nothing translucent is refused.
    let opaque = over_a_floor(&[1.0], r#"/materials [{ "doubleSided": true }]"#);
    let refused = SceneTransmittance::of(&stage, &opaque, 0).unwrap_err();
    assert!(refused.to_string().contains("BLEND"), "{refused}");
}
