//! Soft shadows in a range that fits itself.

use moment_shadows_lab::command::drawn::Drawn;
use moment_shadows_lab::command::render::RenderOptions;
use moment_shadows_lab::scene;

use crate::{gpu, imports, places, recorded, session};

const SOFT: &str = include_str!("../../examples/soft_shadows.json");

#[test]
fn penumbrae_are_as_wide_as_in_the_hosts_range() {
    let gpu = gpu();
    let options = RenderOptions {
        range_times: 4.0,
        ..Default::default()
    };
    let drawn = Drawn {
        picture: [160, 90],
        map: [256; 2],
        ..Drawn::default()
    };
    let scene = scene::load("edge").unwrap();
    let frame = options.frame(&gpu, &scene, &drawn, 4).unwrap();
    let (camera, light) = places(&frame);
    let plain = SOFT.replace(
        r#""type": "shade_soft""#,
        r#""type": "shade_soft", "properties": { "format": "r32float" }"#,
    );
    let fitted = plain
        .replace(
            r#""nodes": ["#,
            r#""nodes": [ { "name": "fit", "type": "fit_range" },"#,
        )
        .replace(
            r#""edges": ["#,
            r#""edges": [
            { "from": "light_depth", "to": "fit.depth" },
            { "from": "fit.ranges", "to": "resolve.ranges" },
            { "from": "fit.ranges", "to": "shade.ranges" },"#,
        );
    let [plain, fitted] = [plain, fitted].map(|text| {
        let mut session = session(&gpu, &text, &imports(&frame));
        session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
        let bytes = recorded(&gpu, &session, 0, "shadow_intensity");
        bytemuck::pod_collect_to_vec::<u8, f32>(&bytes)
    });
    let both = plain.iter().zip(&fitted);
    let apart = both.clone().map(|(a, b)| (a - b).abs()).sum::<f32>() / plain.len() as f32;
    let partly = both.filter(|(a, _)| (0.1..0.9).contains(*a)).count();
    println!("{apart:.4} apart on average; {partly} pixels in penumbrae");
    // One blocker in front of one receiver: nothing leaks. A light that knows the host's range alone is as many times too large
    // as that is too long.
    assert!(apart <= 2e-3 && partly > 100, "{apart} {partly}");
}
