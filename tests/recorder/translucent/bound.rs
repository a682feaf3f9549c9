//! The bound is never above 1 - transmittance but for the bias, however many casters are blended.

use moment_shadows::{MapEncoding, Opacity, Profile, Storage, Technique, TextureFormat};
use moment_shadows_graph::Stage;
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::{ImportedResource, Recording};
use moment_shadows_lab::gpu::Gpu;

use super::draw::{Caster, Casters};
use crate::depth_map;
use crate::setup::{aligned_view, bind, block, capabilities, compiled};

const SIDE: u32 = 64;

fn gpu() -> Gpu {
    let optional = wgpu::Features::FLOAT32_BLENDABLE | wgpu::Features::DUAL_SOURCE_BLENDING;
    Gpu::open_with(Profile::NativeAdapter, optional).unwrap()
}

fn graph(encoding: &MapEncoding) -> String {
    format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "light_depth" }}, {{ "name": "camera_depth" }}],
  "nodes": [
    {{ "name": "resolve", "type": "resolve",
       "properties": {{ "technique": "{}", "storage": "{}", "blends": {} }} }},
    {{ "name": "casters", "type": "translucent_casters" }},
    {{ "name": "shade", "type": "shade_hard", "properties": {{ "format": "r32float" }} }}
  ],
  "edges": [
    {{ "from": "light_depth", "to": "resolve.depth" }},
    {{ "from": "resolve.map", "to": "casters.map" }},
    {{ "from": "casters.map", "to": "shade.map" }},
    {{ "from": "camera_depth", "to": "shade.camera_depth" }}
  ],
  "outputs": [{{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }}]
}}"#,
        encoding.technique(),
        encoding.storage(),
        encoding.blends(),
    )
}

/// Opaque casters of the lower half, and none in the upper one.
fn opaque(y: u32) -> f32 {
    if y < SIDE / 2 { 1.0 } else { 0.875 }
}

/// Receivers from front to back, between any two casters.
fn receiver(x: u32) -> f32 {
    (x as f32 + 0.7) / SIDE as f32
}

/// How far the bound is above the truth at most, and below it on average.
#[derive(Clone, Copy, Debug)]
struct Errors {
    above: f64,
    below: f64,
}

/// The errors of maps with these casters, far to near.
fn errors(gpu: &Gpu, encoding: &MapEncoding, opacity: Opacity, casters: &[Caster]) -> Errors {
    let capabilities = capabilities(gpu);
    let depth = TextureDesc::new(TextureFormat::Depth32Float, [SIDE; 2]);
    let imports = [("light_depth", depth.clone()), ("camera_depth", depth)];
    let plan = compiled(&graph(encoding), &capabilities, &imports);
    let bytes = block(&plan, &aligned_view(0));
    let light = depth_map::of(gpu, [SIDE; 2], |_, y| opaque(y));
    let camera = depth_map::of(gpu, [SIDE; 2], |x, _| receiver(x));
    let bound = bind(
        gpu,
        plan,
        &[
            ("light_depth", ImportedResource::from(&light)),
            ("camera_depth", ImportedResource::from(&camera)),
        ],
        &bytes,
    );
    let drawn = Casters::new(gpu, encoding, opacity, casters);
    let mut handler = |pass: moment_shadows_graph::record::HostPass<'_>,
                       encoder: &mut wgpu::CommandEncoder| {
        assert_eq!(
            (pass.name, pass.layer, pass.blend, pass.targets.len()),
            (
                "casters/translucent casters",
                0,
                true,
                encoding.planes() as usize
            )
        );
        drawn.draw(&pass, encoder);
    };
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    for stage in Stage::ALL {
        let recording = Recording {
            host_passes: Some(&mut handler),
            ..Recording::default()
        };
        bound
            .bindings
            .record(stage, &mut encoder, recording)
            .unwrap();
    }
    gpu.queue.submit([encoder.finish()]);
    gpu.check().unwrap();
    let mut errors = Errors {
        above: f64::NEG_INFINITY,
        below: 0.0,
    };
    let shaded = bound.read_floats(gpu, "shadow_intensity", 0);
    for (index, &intensity) in (0..).zip(&shaded) {
        let (x, y) = (index % SIDE, index / SIDE);
        let before = |depth: f32| depth < receiver(x);
        let lit = casters.iter().filter(|caster| before(caster.depth));
        let lit: f64 = lit.map(|caster| 1.0 - caster.opacity_at(x, y)).product();
        let truth = 1.0 - if before(opaque(y)) { 0.0 } else { lit };
        let error = f64::from(intensity) - truth;
        errors.above = errors.above.max(error);
        errors.below += (-error).max(0.0) / f64::from(SIDE * SIDE);
    }
    errors
}

/// So many casters, far to near: apart, or in a cloud of a hundredth of the range.
fn casters(count: u32, cloud: bool, textured: bool) -> Vec<Caster> {
    let extent = if cloud { 0.01 } else { 0.6 };
    let caster = |index: u32| Caster {
        depth: 0.2 + extent * ((count - index) as f32 - 0.5) / count as f32,
        // What is lit behind all of them is the same for any number.
        opacity: 1.0 - 0.3_f32.powf(1.0 / count as f32),
        textured,
    };
    (0..count).map(caster).collect()
}

/// Every map that casters are blended into, with its bias for so many.
fn maps(blends: u32) -> Vec<(MapEncoding, f64)> {
    let four = Storage::OF_FOUR_MOMENTS.into_iter().flat_map(|storage| {
        [
            (
                Technique::Hamburger4,
                storage,
                storage.moment_bias().with_blends(blends).alpha,
            ),
            (
                Technique::Hausdorff4,
                storage,
                storage.hausdorff_moment_bias().with_blends(blends).alpha,
            ),
        ]
    });
    let six = [
        Storage::Unorm16,
        Storage::Float16,
        Storage::Float32,
        Storage::Unorm10,
    ];
    let six = six.map(|storage| {
        let bias = storage.six_moments_bias().unwrap().with_blends(blends);
        (Technique::Hamburger6, storage, bias.alpha)
    });
    let all = four.chain(six);
    let all = all.map(|(technique, storage, alpha)| {
        let encoding = MapEncoding::new(technique, storage).unwrap();
        (encoding.with_blends(blends).unwrap(), f64::from(alpha))
    });
    all.collect()
}

/// What the arithmetic of the bound in f32 adds.
const ARITHMETIC: f64 = 2e-4;

#[test]
fn bounds_are_below_the_truth_but_for_the_bias() {
    let gpu = gpu();
    println!("| map | opacity | casters | bias | above, at most | below, on average |");
    println!("|---|---|---|---|---|---|");
    for count in [1, 2, 4, 8, 16] {
        for (encoding, alpha) in maps(count) {
            for (cloud, textured) in [(false, false), (false, true), (true, false), (true, true)] {
                let casters = casters(count, cloud, textured);
                let opacity = match encoding.technique() {
                    Technique::Hamburger6 => Opacity::Alpha,
                    _ if textured => Opacity::SecondSource,
                    _ => Opacity::Constant,
                };
                let Errors { above, below } = errors(&gpu, &encoding, opacity, &casters);
                let what = if textured { "textured" } else { "uniform" };
                let where_ = if cloud { "cloud" } else { "apart" };
                println!(
                    "| {encoding} | {what}, {where_} | {count} | {alpha:.1e} | {above:.1e} | {below:.4} |"
                );
                assert!(
                    above <= alpha + ARITHMETIC,
                    "{encoding}, {what}, {where_}, {count}: {above}"
                );
            }
        }
    }
}
