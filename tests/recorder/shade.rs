//! `shade_hard`: where there is shadow, and where there is light whatever the map holds.

use moment_shadows::{Profile, TextureFormat, ViewParameters};
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_graph::{Capabilities, TextureDesc};
use moment_shadows_lab::gpu::Gpu;

use crate::depth_map;
use crate::setup::{
    EXAMPLE, IDENTITY, aligned_view, bind, block, capabilities, compiled, gpu, view,
};

const MAP: [u32; 2] = [64, 64];
const PICTURE: [u32; 2] = [48, 32];

/// The picture of the example, as r32float, for a map and a camera's depth.
fn shaded(
    gpu: &Gpu,
    capabilities: &Capabilities,
    storage: &str,
    light: &wgpu::Texture,
    camera: &wgpu::Texture,
    view: &ViewParameters,
) -> Vec<f32> {
    let text = EXAMPLE
        .replace("\"unorm16\"", &format!("\"{storage}\""))
        .replace(
            "\"type\": \"shade_hard\"",
            "\"type\": \"shade_hard\", \"properties\": { \"format\": \"r32float\" }",
        );
    let depth = |size| TextureDesc::new(TextureFormat::Depth32Float, size);
    let imports = [
        ("light_depth", depth(MAP)),
        ("camera_depth", depth(PICTURE)),
    ];
    let plan = compiled(&text, capabilities, &imports);
    let bytes = block(&plan, view);
    let bound = bind(
        gpu,
        plan,
        &[
            ("light_depth", ImportedResource::from(light)),
            ("camera_depth", ImportedResource::from(camera)),
        ],
        &bytes,
    );
    bound.run(gpu);
    bound.read_floats(gpu, "shadow_intensity", 0)
}

/// An occluder over the left half, near the light.
fn half_covered(gpu: &Gpu) -> wgpu::Texture {
    depth_map::of(gpu, MAP, |x, _| if x < MAP[0] / 2 { 0.2 } else { 1.0 })
}

#[test]
fn an_occluder_shades_what_lies_behind_it_and_nothing_else() {
    let gpu = gpu();
    let camera = depth_map::of(&gpu, PICTURE, |_, _| 0.8);
    for storage in ["unorm16", "float16", "float32"] {
        let picture = shaded(
            &gpu,
            &capabilities(&gpu),
            storage,
            &half_covered(&gpu),
            &camera,
            &aligned_view(0),
        );
        for (index, &intensity) in picture.iter().enumerate() {
            let x = index as u32 % PICTURE[0];
            // The kernel reaches 4 texels, which are 3 pixels, beyond the edge. Half-covered, the bound is not a step.
            if x < 20 {
                assert!(intensity > 0.99, "{storage}, pixel {index}: {intensity}");
            } else if x >= 28 {
                assert!(intensity < 0.01, "{storage}, pixel {index}: {intensity}");
            }
            assert!(
                (0.0..=1.0).contains(&intensity),
                "{storage}, pixel {index}: {intensity}"
            );
        }
    }
}

#[test]
fn sky_is_lit() {
    let gpu = gpu();
    let light = depth_map::of(&gpu, MAP, |_, _| 0.0);
    // The upper half is sky.
    let camera = depth_map::of(
        &gpu,
        PICTURE,
        |_, y| if y < PICTURE[1] / 2 { 1.0 } else { 0.8 },
    );
    let picture = shaded(
        &gpu,
        &capabilities(&gpu),
        "float32",
        &light,
        &camera,
        &aligned_view(0),
    );
    let (sky, ground) = picture.split_at(picture.len() / 2);
    assert!(sky.iter().all(|&intensity| intensity == 0.0));
    assert!(ground.iter().all(|&intensity| intensity > 0.99));
}

#[test]
fn what_lies_outside_the_map_is_lit() {
    let gpu = gpu();
    let light = depth_map::of(&gpu, MAP, |_, _| 0.1);
    let camera = depth_map::of(&gpu, PICTURE, |_, _| 0.8);
    // The map covers the middle half of the picture along x.
    let mut narrow = IDENTITY;
    narrow[0][0] = 2.0;
    let picture = shaded(
        &gpu,
        &capabilities(&gpu),
        "float32",
        &light,
        &camera,
        &view(IDENTITY, narrow, 0),
    );
    for (index, &intensity) in picture.iter().enumerate() {
        let x = index as u32 % PICTURE[0];
        let inside = (PICTURE[0] / 4..PICTURE[0] * 3 / 4).contains(&x);
        assert_eq!(intensity > 0.99, inside, "pixel {index}: {intensity}");
        assert!(inside || intensity == 0.0, "pixel {index}: {intensity}");
    }
}

#[test]
fn what_lies_behind_the_light_is_lit() {
    let gpu = gpu();
    let light = depth_map::of(&gpu, MAP, |_, _| 0.0);
    // Left half before the light's plane at 0.5, right half behind it.
    let camera = depth_map::of(
        &gpu,
        PICTURE,
        |x, _| if x < PICTURE[0] / 2 { 0.9 } else { 0.3 },
    );
    // Clip space w is z - 0.5; x and y are drawn together so that both halves would lie on the map.
    let mut spot = IDENTITY;
    spot[0][0] = 0.1;
    spot[1][1] = 0.1;
    spot[2][3] = 1.0;
    spot[3][3] = -0.5;
    let picture = shaded(
        &gpu,
        &capabilities(&gpu),
        "float32",
        &light,
        &camera,
        &view(IDENTITY, spot, 0),
    );
    for (index, &intensity) in picture.iter().enumerate() {
        if index as u32 % PICTURE[0] < PICTURE[0] / 2 {
            assert!(intensity > 0.9, "pixel {index}: {intensity}");
        } else {
            assert_eq!(intensity, 0.0, "pixel {index}");
        }
    }
}

#[test]
fn filtering_in_the_shader_gives_the_samplers_picture() {
    let Ok(gpu) = Gpu::open_with(Profile::Native, wgpu::Features::FLOAT32_FILTERABLE) else {
        panic!("no adapter");
    };
    let filterable = capabilities(&gpu);
    if !filterable.float32_filterable {
        return;
    }
    let loaded = Capabilities {
        float32_filterable: false,
        ..filterable.clone()
    };
    let light = depth_map::of(
        &gpu,
        MAP,
        |x, y| if (x / 5 + y / 7) % 2 == 0 { 0.15 } else { 0.6 },
    );
    let camera = depth_map::of(&gpu, PICTURE, |x, y| 0.5 + 0.3 * (x + y) as f32 / 80.0);
    let [sampled, loaded] = [filterable, loaded].map(|capabilities| {
        shaded(
            &gpu,
            &capabilities,
            "float32",
            &light,
            &camera,
            &aligned_view(0),
        )
    });
    let penumbra = sampled
        .iter()
        .filter(|&&intensity| (0.1..0.9).contains(&intensity))
        .count();
    assert!(
        penumbra > 100,
        "the picture has penumbrae to differ in: {penumbra}"
    );
    for (index, (sampled, loaded)) in sampled.iter().zip(&loaded).enumerate() {
        // Samplers weight with 8 bits.
        assert!(
            (sampled - loaded).abs() <= 1.0 / 255.0,
            "pixel {index}: {sampled} and {loaded}"
        );
    }
}
