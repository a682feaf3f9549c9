//! What shading does with a view's leak reduction.

use moment_shadows::{LeakReduction, TextureFormat};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::ImportedResource;

use crate::depth_map;
use crate::setup::{EXAMPLE, aligned_view, bind, block, capabilities, compiled, gpu};

const SIDE: u32 = 48;

#[test]
fn all_three_settings_act_on_the_bound_of_every_pixel() {
    let gpu = gpu();
    let text = EXAMPLE.replace(
        "\"type\": \"shade_hard\"",
        "\"type\": \"shade_hard\", \"properties\": { \"format\": \"r32float\" }",
    );
    let depth = TextureDesc::new(TextureFormat::Depth32Float, [SIDE; 2]);
    let imports = [("light_depth", depth.clone()), ("camera_depth", depth)];
    let plan = compiled(&text, &capabilities(&gpu), &imports);
    // An occluder at the left: a penumbra of all intensities to the right of it.
    let map = depth_map::of(&gpu, [SIDE; 2], |x, _| if x < SIDE / 2 { 0.2 } else { 0.7 });
    let camera = depth_map::of(&gpu, [SIDE; 2], |_, _| 0.7);
    let picture = |leak_reduction| {
        let mut view = aligned_view(0);
        view.leak_reduction = leak_reduction;
        let imports = [
            ("light_depth", ImportedResource::from(&map)),
            ("camera_depth", ImportedResource::from(&camera)),
        ];
        let bytes = block(&plan, &view);
        let bound = bind(&gpu, plan.clone(), &imports, &bytes);
        bound.run(&gpu);
        bound.read_floats(&gpu, "shadow_intensity", 0)
    };
    let plain = picture(LeakReduction::NONE);
    let penumbra = |intensity: &&f32| (0.05..0.95).contains(*intensity);
    assert!(plain.iter().filter(penumbra).count() > 4 * SIDE as usize);
    for [full_shadow, bleed_reduction, visibility_exponent] in [
        [0.8, 0.0, 1.0],
        [1.0, 0.3, 1.0],
        [1.0, 0.0, 2.5],
        [0.9, 0.2, 0.5_f32],
    ] {
        let reduced = picture(LeakReduction {
            full_shadow,
            bleed_reduction,
            visibility_exponent,
            padding: 0.0,
        });
        let [full, bleed, exponent] =
            [full_shadow, bleed_reduction, visibility_exponent].map(f64::from);
        for (&plain, &reduced) in plain.iter().zip(&reduced) {
            let visibility = 1.0 - (f64::from(plain) / full).min(1.0);
            let remaining = ((visibility - bleed) / (1.0 - bleed)).max(0.0);
            let expected = 1.0 - remaining.powf(exponent);
            // A power goes through logarithms of 2^-21; that of 0.5 is steep where little remains.
            let tolerance = if remaining < 1e-3 { 1e-3 } else { 1e-5 };
            assert!(
                (f64::from(reduced) - expected).abs() < tolerance,
                "{full_shadow}, {bleed_reduction}, {visibility_exponent}: {plain} became {reduced}, not {expected}"
            );
        }
    }
}
