//! The session's pictures against those of the objects that it keeps, which the lab fills in by itself.

use moment_shadows::{Kernel, ReceiverBias, SingleScattering};
use moment_shadows_lab::graph_file::GraphFile;
use moment_shadows_lab::graph_frame::GraphFrame;
use moment_shadows_lab::scattering::Air;

use crate::{
    AIR, FITTED, HARD, MAP_ALONE, MINIFIED, frame, gpu, imports, places, recorded, session,
};

const SIZE: [u32; 2] = [160, 90];

/// What is in the air of the third graph.
fn medium() -> (SingleScattering, f64) {
    let medium = SingleScattering::new([0.02; 3], [0.018; 3], 0.4, [9.0, 8.4, 7.5]).unwrap();
    (medium, 40.0)
}

#[test]
fn pictures_are_those_of_the_five_objects() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, SIZE);
    let (camera, light) = places(&frame);
    let cases = [
        (HARD, "shadow_intensity"),
        (MINIFIED, "shadow_intensity"),
        (FITTED, "shadow_intensity"),
        (AIR, "shadow_intensity"),
        (AIR, "scattering"),
    ];
    for (text, output) in cases {
        let (medium, far) = medium();
        let air = Air { medium, far };
        let file = GraphFile::parse("graph", text.to_owned(), None).unwrap();
        let whole = GraphFrame::in_air(&gpu, &frame, &file, Some(&air)).unwrap();
        whole.run(&gpu).unwrap();
        let texture = whole.bindings.output(output).unwrap();
        let expected = gpu.read_texture(texture, 0, output).unwrap();

        let mut session = session(&gpu, text, &imports(&frame));
        session.medium = (medium, far);
        session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
        assert_eq!(recorded(&gpu, &session, 0, output), expected, "{output}");
        let first = expected[0];
        assert!(
            expected.iter().any(|&byte| byte != first),
            "{output} is empty"
        );
    }
}

#[test]
fn a_graph_that_ends_with_the_map_gives_it_to_all_cameras() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, SIZE);
    let (camera, light) = places(&frame);
    let mut session = session(&gpu, MAP_ALONE, &imports(&frame)[..1]);
    session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
    let map = recorded(&gpu, &session, 0, "shadow_map");
    assert!(map.iter().any(|&byte| byte != map[0]));
    let bias = session.receiver_bias("shadow_map", &light).unwrap();
    let kernel = Kernel::gaussian(4, 2.4).unwrap();
    let depth_per_texel = light.depth_per_texel([256; 2]) as f32;
    let expected = ReceiverBias::for_kernel(kernel.standard_deviation(), depth_per_texel);
    assert!((bias.slope_scale / expected.slope_scale - 1.0).abs() < 1e-6);
    assert_eq!(bias.maximum, expected.maximum);
    session.receiver_bias("camera_depth", &light).unwrap_err();
}

#[test]
fn the_receiver_bias_follows_from_the_kernel_of_the_graph() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, SIZE);
    let (camera, light) = places(&frame);
    let lit = |text: &str| {
        let mut session = session(&gpu, text, &imports(&frame));
        session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
        recorded(&gpu, &session, 0, "shadow_intensity")
    };
    // Two blurs one after the other are one with the sum of the variances.
    let once = HARD.replace(
        r#""radius": 4, "sigma": 2.4"#,
        r#""radius": 12, "sigma": 3.0"#,
    );
    let twice = HARD
        .replace(r#""radius": 4, "sigma": 2.4"#, r#""radius": 10, "sigma": 2.4"#)
        .replace(
            r#"{ "name": "shade""#,
            r#"{ "name": "again", "type": "blur", "properties": { "kernel": { "radius": 8, "sigma": 1.8 } } },
               { "name": "shade""#,
        )
        .replace(
            r#"{ "from": "blur.blurred", "to": "shade.map" }"#,
            r#"{ "from": "blur.blurred", "to": "again.map" }, { "from": "again.blurred", "to": "shade.map" }"#,
        );
    let (once, twice) = (lit(&once), lit(&twice));
    let differences = once
        .iter()
        .zip(&twice)
        .map(|(a, b)| f64::from(a.abs_diff(*b)) / 255.0);
    let mean = differences.sum::<f64>() / once.len() as f64;
    assert!(mean < 2e-3, "{mean}");
}
