//! Marched scattering by the short path: of the first light, in the session's medium and fog.

use half::f16;
use moment_shadows::{HeightFog, MarchedAir, SingleScattering};
use moment_shadows_graph::LightView;
use moment_shadows_lab::frame::Frame;
use moment_shadows_lab::gpu::Gpu;

use crate::{AIR, frame, gpu, imports, places, recorded, session};

fn picture(
    gpu: &Gpu,
    text: &str,
    frame: &Frame,
    lights: &[LightView],
    air: MarchedAir,
) -> Vec<f32> {
    let mut session = session(gpu, text, &imports(frame));
    let haze = [0.02, 0.025, 0.03];
    let medium = SingleScattering::new(haze, haze, 0.3, [9.0; 3]).unwrap();
    session.medium = (medium, 40.0);
    session.marched = air;
    session
        .view(&gpu.queue, 0, &places(frame).0, lights)
        .unwrap();
    let bytes = recorded(gpu, &session, 0, "scattering");
    let halves = bytes.chunks_exact(2);
    halves
        .map(|pair| f16::from_le_bytes([pair[0], pair[1]]).to_f32())
        .collect()
}

/// How far apart radiances are, as a part of all of one; and the largest difference of transmittances.
fn apart(found: &[f32], expected: &[f32]) -> (f32, f32) {
    assert_eq!(found.len(), expected.len());
    let (mut sum, mut scale, mut most) = (0.0, 0.0, 0.0_f32);
    for (found, expected) in found.chunks_exact(4).zip(expected.chunks_exact(4)) {
        for colour in 0..3 {
            sum += (found[colour] - expected[colour]).abs();
            scale += expected[colour];
        }
        most = most.max((found[3] - expected[3]).abs());
    }
    (sum / scale, most)
}

#[test]
fn in_homogeneous_air_it_is_what_prefiltered_scattering_is() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [160, 90]);
    let light = places(&frame).1;
    let upsample = r#",
    { "name": "upsample", "type": "upsample_scattering" }"#;
    let edges = r#",
    { "from": "march.scattering", "to": "upsample.scattering" },
    { "from": "camera_depth", "to": "upsample.camera_depth" }"#;
    assert!(FOG_ALONE.contains(upsample) && FOG_ALONE.contains(edges));
    let full = FOG_ALONE
        .replace(upsample, "")
        .replace(edges, "")
        .replace(r#""resolution": "half""#, r#""steps": 128"#)
        .replace("upsample.upsampled", "march.scattering");
    let marched = picture(&gpu, &full, &frame, &[light], MarchedAir::default());
    let prefiltered = picture(&gpu, AIR, &frame, &[light], MarchedAir::default());
    let (radiance, transmittance) = apart(&marched, &prefiltered);
    println!("{radiance} of the radiance, {transmittance} of the transmittance");
    // Bounds of six moments over dozens of beams.
    assert!(
        radiance < 0.2 && transmittance < 1e-3,
        "{radiance} {transmittance}"
    );
}

#[test]
fn half_of_the_resolution_is_made_whole_by_depth() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [160, 90]);
    let light = places(&frame).1;
    let of = |text: &str| picture(&gpu, text, &frame, &[light], MarchedAir::default());
    let half = of(FOG_ALONE);
    let whole = of(&FOG_ALONE.replace(r#""resolution": "half""#, r#""resolution": "full""#));
    let transmittances = |picture: &[f32]| -> Vec<f32> {
        let texels = picture.chunks_exact(4);
        texels.map(|texel| texel[3]).collect()
    };
    let (half, whole) = (transmittances(&half), transmittances(&whole));
    // Beside the edge of something near, where mixing by place alone takes half of what is behind.
    let off = half.iter().zip(&whole).map(|(a, b)| (a - b).abs());
    let far = off.filter(|off| *off > 0.02).count();
    println!("{far} of {} are off by more than 0.02", whole.len());
    // What is thinner than a texel of half the resolution no texel may have seen.
    assert!(far * 30 < whole.len(), "{far}");
}

#[test]
fn the_first_light_counts_and_fog_and_frame_do() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [97, 55]);
    let light = places(&frame).1;
    let other = LightView {
        channel: 1,
        layer: 1,
        ..light
    };
    let of = |lights: &[LightView], air| picture(&gpu, FOG_ALONE, &frame, lights, air);
    let alone = of(&[light], MarchedAir::default());
    assert_eq!(alone, of(&[light, other], MarchedAir::default()));
    let fog = HeightFog {
        falloff: 0.3,
        ..HeightFog::NONE
    };
    let (radiance, transmittance) = apart(
        &of(
            &[light],
            MarchedAir {
                fog,
                ..MarchedAir::default()
            },
        ),
        &alone,
    );
    assert!(
        radiance > 0.05 && transmittance > 0.02,
        "{radiance} {transmittance}"
    );
    let next = of(
        &[light],
        MarchedAir {
            frame: 1,
            ..MarchedAir::default()
        },
    );
    let (radiance, transmittance) = apart(&next, &alone);
    assert!(
        radiance > 1e-3 && transmittance == 0.0,
        "{radiance} {transmittance}"
    );
}

/// Marching at half of the resolution, and nothing that shades.
const FOG_ALONE: &str = r#"{
  "version": 2,
  "imports": [
    { "name": "light_depth", "texture": { "format": "depth32float", "size": [256, 256] } },
    { "name": "camera_depth" }
  ],
  "nodes": [
    { "name": "resolve", "type": "resolve", "properties": { "storage": "float16" } },
    { "name": "march", "type": "march_scattering", "properties": { "resolution": "half" } },
    { "name": "upsample", "type": "upsample_scattering" }
  ],
  "edges": [
    { "from": "light_depth", "to": "resolve.depth" },
    { "from": "resolve.map", "to": "march.map" },
    { "from": "camera_depth", "to": "march.camera_depth" },
    { "from": "march.scattering", "to": "upsample.scattering" },
    { "from": "camera_depth", "to": "upsample.camera_depth" }
  ],
  "outputs": [{ "name": "scattering", "from": "upsample.upsampled" }]
}"#;

#[test]
fn what_does_not_suit_the_node_is_named() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [48, 32]);
    let (camera, light) = places(&frame);
    let mut session = session(&gpu, FOG_ALONE, &imports(&frame));
    let mut refused = |lights: &[LightView]| {
        let error = session.view(&gpu.queue, 0, &camera, lights).unwrap_err();
        error.to_string()
    };
    let none = refused(&[]);
    assert!(
        none.contains("'march'") && none.contains("there is no light"),
        "{none}"
    );
    let many = refused(&[light, LightView { layer: 1, ..light }]);
    assert!(
        many.contains("has 2 views, but the node's 'views' is 1"),
        "{many}"
    );
    let mut broken = light;
    broken.clip_from_world = [[0.0; 4]; 4];
    let broken = refused(&[broken]);
    assert!(broken.contains("view 0 of a light"), "{broken}");
}
