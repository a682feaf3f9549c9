//! Masks seen from afar.

use crate::Files;
use crate::build::{Seen, options, picture};
use glam::DVec3;
use moment_shadows_lab::command::render::RenderOptions;
use serde_json::{Value, json};

/// Wires of one texel, every eighth column and every fourth row.
fn is_wire(x: u32, y: u32) -> bool {
    x.is_multiple_of(8) || y.is_multiple_of(4)
}

/// The share of the image that is wire.
const WIRES: f64 = 1.0 - 7.0 / 8.0 * 3.0 / 4.0;

/// A panel alone with a fence, an image of 32x32 texels repeated `times` along either axis.
fn fence(times: f32, filter: u32, surface: &Value) -> Files {
    let mut files = Files::block();
    files.document["scenes"][0]["nodes"] = json!([]);
    let material = files.masked(
        &picture(32, is_wire),
        json!({ "magFilter": filter, "minFilter": 9987 }),
    );
    let material = &mut files.document["materials"][material];
    material["alphaMode"] = surface["alphaMode"].clone();
    if surface["alphaMode"] == "MASK" {
        material["alphaCutoff"] = surface["cutoff"].clone();
    }
    material["pbrMetallicRoughness"]["baseColorFactor"] = json!([1, 1, 1, surface["factor"]]);
    let uvs = [[0.0, times], [times, times], [0.0, 0.0], [times, 0.0]];
    let panel = files.panel(uvs, 0);
    files.node(json!({ "mesh": panel }));
    files
}

/// Covered samples of the light's map, pixels, and rays that meet something.
fn covered(seen: &Seen) -> [f64; 3] {
    let count = |count: usize| count as f64;
    [
        count(
            seen.depth
                .values
                .iter()
                .filter(|&&depth| depth < 1.0)
                .count(),
        ),
        count(seen.pixels.covered.iter().filter(|&&it| it).count()),
        count(seen.peeled.iter().filter(|&&surfaces| surfaces > 0).count()),
    ]
}

#[test]
fn a_fine_fence_keeps_its_coverage_from_afar() {
    let options = RenderOptions {
        no_ground: true,
        camera: Some([DVec3::new(0.2, 1.2, 7.0), DVec3::new(-0.1, 1.1, 0.0)]),
        ..options()
    };
    // On about 110 texels of the map and 60 pixels, so that ten texels of the image and more are as wide as one of those.
    for times in [40.0, 57.3] {
        for (filter, factor, cutoff) in [
            (9728, 1.0, 0.5),
            (9729, 1.0, 0.5),
            (9729, 0.6, 0.3),
            (9728, 0.7, 0.6),
        ] {
            let surface =
                |mode: &str| json!({ "alphaMode": mode, "factor": factor, "cutoff": cutoff });
            let solid = fence(times, filter, &surface("OPAQUE")).seen(&options);
            let holed = fence(times, filter, &surface("MASK")).seen(&options);
            // The truth of the map: 64 rays through each of its texels.
            let fine = RenderOptions {
                map: options.map.map(|side| 8 * side),
                ..options.clone()
            };
            let [.., rays] = covered(&fence(times, filter, &surface("MASK")).seen(&fine));
            let [.., all] = covered(&fence(times, filter, &surface("OPAQUE")).seen(&fine));
            let truth = rays / all;
            let shares: Vec<f64> = covered(&holed)
                .iter()
                .zip(covered(&solid))
                .map(|(a, b)| a / b)
                .collect();
            println!(
                "{times} times, filter {filter}, {factor} of {cutoff}: {shares:.3?}, true {truth:.4}"
            );
            // A blend rounds the corners of the meshes off.
            assert!((truth - WIRES).abs() < 0.02, "{truth} of {WIRES}");
            // A few thousand pixels and rays, and four times as many samples.
            for (share, within) in shares.into_iter().zip([0.01, 0.03, 0.02]) {
                assert!((share - truth).abs() < within, "{share} for {truth}");
            }
            // Nowhere is it solid or gone: sixteen by sixteen texels at a time.
            let side = options.map.unwrap() as usize;
            let samples = holed.depth.samples as usize;
            for at in 0..(side / 16).pow(2) {
                let [x, y] = [at % (side / 16) * 16, at / (side / 16) * 16];
                let share = |seen: &Seen| {
                    let rows = (y..y + 16).map(|row| {
                        &seen.depth.values[(row * side + x) * samples..][..16 * samples]
                    });
                    rows.flatten().filter(|&&depth| depth < 1.0).count() as f64
                        / (256 * samples) as f64
                };
                if share(&solid) == 1.0 {
                    let share = share(&holed);
                    assert!(
                        (share - truth).abs() < 0.1,
                        "at {x} {y}: {share} for {truth}"
                    );
                }
            }
        }
    }
}
