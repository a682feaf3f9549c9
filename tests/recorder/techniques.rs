//! Every technique through resolve, blur and shading on the adapter.

use moment_shadows::{
    Border, CameraView, LeakReduction, LightDepth, LightSize, LightView, MapEncoding, MapRegion,
    Profile, ReceiverBias, Technique, TextureFormat, ViewParameters,
};
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_graph::{Capabilities, TextureDesc};
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_file::GraphFile;
use moment_shadows_lab::techniques;

use crate::depth_map;
use crate::setup::{Bound, IDENTITY, bind, capabilities, compiled};

const MAP: [u32; 2] = [64, 48];

/// A pixel per texel.
const PICTURE: [u32; 2] = MAP;

/// Stored depths of the caster, over the left half of the map, and of the receiver behind it.
const CASTER: f32 = 0.2;
const RECEIVER: f32 = 0.7;

/// A kernel of three texels: how far from the caster's edge its penumbra reaches, with the texel of the lookup.
const REACH: u32 = 3;

fn graph(technique: &str, storage: &str) -> String {
    format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "light_depth" }}, {{ "name": "camera_depth" }}],
  "nodes": [
    {{ "name": "resolve", "type": "resolve",
       "properties": {{ "technique": {technique}, "storage": "{storage}" }} }},
    {{ "name": "blur", "type": "blur", "properties": {{ "kernel": {{ "radius": 1, "sigma": 0.6 }} }} }},
    {{ "name": "shade", "type": "shade_hard", "properties": {{ "format": "r32float" }} }}
  ],
  "edges": [
    {{ "from": "light_depth", "to": "resolve.depth" }},
    {{ "from": "resolve.map", "to": "blur.map" }},
    {{ "from": "blur.blurred", "to": "shade.map" }},
    {{ "from": "camera_depth", "to": "shade.camera_depth" }}
  ],
  "outputs": [{{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }}]
}}"#
    )
}

/// Shading by a test on the plain depth map.
pub(crate) fn reading_depth(technique: &str) -> String {
    format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "light_depth" }}, {{ "name": "camera_depth" }}],
  "nodes": [
    {{ "name": "shade", "type": "shade_hard", "properties": {{ "format": "r32float", "technique": {technique} }} }}
  ],
  "edges": [
    {{ "from": "light_depth", "to": "shade.depth" }},
    {{ "from": "camera_depth", "to": "shade.camera_depth" }}
  ],
  "outputs": [{{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }}]
}}"#
    )
}

/// Shadow intensity of every pixel.
fn shade(gpu: &Gpu, capabilities: &Capabilities, text: &str, layer: u32) -> Vec<f32> {
    let layers = layer + 1;
    let light = depth_map::texture(gpu, wgpu::TextureFormat::Depth32Float, MAP, layers, 1);
    for other in 0..layers {
        let caster = |x| other == layer && x < MAP[0] / 2;
        let depths = depth_map::values(MAP, |x, _| if caster(x) { CASTER } else { 1.0 });
        depth_map::draw(gpu, &light, other, &depths);
    }
    let camera = depth_map::of(gpu, PICTURE, |_, _| RECEIVER);
    let desc = TextureDesc {
        layers,
        ..TextureDesc::new(TextureFormat::Depth32Float, MAP)
    };
    let picture = TextureDesc::new(TextureFormat::Depth32Float, PICTURE);
    let plan = compiled(
        text,
        capabilities,
        &[("light_depth", desc), ("camera_depth", picture)],
    );
    let view = ViewParameters::new(
        &CameraView {
            clip_from_world: IDENTITY,
            far_depth: 1.0,
        },
        &LightView {
            clip_from_world: IDENTITY,
            depth: LightDepth::Orthographic { reversed: false },
            layer,
            region: MapRegion::WHOLE,
            guard: 0,
            border: Border::Sharp,
            channel: 0,
            size: LightSize::Point,
        },
        ReceiverBias::for_kernel(0.6, 0.0),
        LeakReduction::NONE,
    )
    .unwrap();
    let mut bytes = plan.parameters.initial();
    plan.parameters
        .write(&mut bytes, "shade", 0, &view)
        .unwrap();
    let imports = [
        ("light_depth", ImportedResource::from(&light)),
        ("camera_depth", ImportedResource::from(&camera)),
    ];
    let bound: Bound = bind(gpu, plan, &imports, &bytes);
    bound.run(gpu);
    bound.read_floats(gpu, "shadow_intensity", 0)
}

/// Asserts on the three parts of the picture: in shadow at least `shadow`, lit at most `lit`, and in between a penumbra
/// that falls from one to the other.
fn check(name: &str, intensities: &[f32], shadow: f32, lit: f32) {
    let edge = PICTURE[0] / 2;
    for (index, &intensity) in intensities.iter().enumerate() {
        let x = index as u32 % PICTURE[0];
        assert!((0.0..=1.0).contains(&intensity), "{name}, {x}: {intensity}");
        if x + REACH < edge {
            assert!(
                intensity >= shadow,
                "{name}, {x} in shadow: {intensity} < {shadow}"
            );
        } else if x >= edge + REACH {
            assert!(
                intensity <= lit,
                "{name}, {x} in light: {intensity} > {lit}"
            );
        }
        if x > 0 {
            assert!(
                intensity <= intensities[index - 1] + 2e-3,
                "{name}: rises at {x}"
            );
        }
    }
}

/// What a technique gives behind a single caster, one half of the depth range in front of the receiver, at least.
fn full_shadow(encoding: &MapEncoding) -> f32 {
    match encoding.technique() {
        // 1 - e^-c less the rounding of the storage, which the largest exponents hold to 1 %.
        Technique::Esm { exponent, .. } => 1.0 - (-exponent.unwrap().get()).exp() - 0.02,
        // The largest overshoot of the damped series is subtracted.
        Technique::Convolution { .. } => 0.93,
        // Behind one surface the bound leaks by about the moment bias over the squared distance, or the smallest variance.
        _ => 0.99,
    }
}

/// What a technique gives beside the caster, at most: a moment bias moves a share of every map towards surfaces in front.
fn lit(encoding: &MapEncoding) -> f32 {
    match encoding.technique() {
        Technique::Hamburger6 => encoding
            .storage()
            .six_moments_bias()
            .map_or(0.0, |bias| bias.alpha.max(1e-3)),
        _ => 1e-3,
    }
}

#[test]
fn every_filterable_technique_shades_a_caster_and_spares_what_is_beside_it() {
    let gpu = Gpu::open(Profile::NativeAdapter).unwrap();
    let capabilities = capabilities(&gpu);
    let mut checked = 0;
    for encoding in techniques::filterable() {
        if encoding.check(capabilities.profile).is_err() {
            continue;
        }
        let json = serde_json::to_string(encoding.technique()).unwrap();
        let text = graph(&json, encoding.storage().name());
        let file = GraphFile::parse("graph", text, Some(encoding.storage()));
        let text = file.unwrap().text;
        // Planes of a second layer lie behind those of the first.
        for layer in [0, 1] {
            let intensities = shade(&gpu, &capabilities, &text, layer);
            let name = format!(
                "{}, {}, layer {layer}",
                techniques::label(encoding.technique()),
                encoding.storage()
            );
            check(&name, &intensities, full_shadow(&encoding), lit(&encoding));
        }
        checked += 1;
    }
    assert_eq!(
        checked,
        techniques::filterable().len(),
        "this adapter writes every format"
    );
}

#[test]
fn every_test_on_the_plain_depth_map_does_the_same() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let capabilities = capabilities(&gpu);
    for technique in techniques::reading_depth() {
        let json = serde_json::to_string(&technique).unwrap();
        for layer in [0, 1] {
            let intensities = shade(&gpu, &capabilities, &reading_depth(&json), layer);
            let name = format!("{}, layer {layer}", techniques::label(&technique));
            if let Technique::Pcf(moment_shadows::PcfTaps::Poisson { .. }) = technique {
                // Each pixel has its own taps, within four texels.
                for (index, &intensity) in intensities.iter().enumerate() {
                    let x = index as u32 % PICTURE[0];
                    if x + 5 < PICTURE[0] / 2 {
                        assert_eq!(intensity, 1.0, "{name}, {x}");
                    } else if x >= PICTURE[0] / 2 + 5 {
                        assert_eq!(intensity, 0.0, "{name}, {x}");
                    }
                }
                continue;
            }
            let wide: Vec<f32> = intensities;
            let at = |x: u32| wide[(PICTURE[0] * (PICTURE[1] / 2) + x) as usize];
            assert_eq!(at(PICTURE[0] / 2 - 6), 1.0, "{name}");
            assert_eq!(at(PICTURE[0] / 2 + 6), 0.0, "{name}");
            for x in 1..PICTURE[0] {
                assert!(at(x) <= at(x - 1) + 1e-6, "{name}: rises at {x}");
            }
        }
    }
}

#[test]
fn filtering_in_the_shader_gives_the_samplers_picture_for_every_technique() {
    let gpu = Gpu::open_with(Profile::Native, wgpu::Features::FLOAT32_FILTERABLE).unwrap();
    let filterable = capabilities(&gpu);
    if !filterable.float32_filterable {
        return;
    }
    let loaded = Capabilities {
        float32_filterable: false,
        ..filterable.clone()
    };
    let mut compared = 0;
    for encoding in techniques::filterable() {
        if encoding.storage() != moment_shadows::Storage::Float32 {
            continue;
        }
        let json = serde_json::to_string(encoding.technique()).unwrap();
        let text = graph(&json, "float32");
        let [sampled, loaded] =
            [&filterable, &loaded].map(|capabilities| shade(&gpu, capabilities, &text, 0));
        for (index, (sampled, loaded)) in sampled.iter().zip(&loaded).enumerate() {
            // Pixels lie on texels here, so that samplers' weights of 8 bits differ by one part in 256 at most.
            assert!(
                (sampled - loaded).abs() <= 1.0 / 128.0,
                "{encoding}, {index}: {sampled} and {loaded}"
            );
        }
        compared += 1;
    }
    assert!(compared >= 7, "{compared}");
}
