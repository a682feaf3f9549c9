//! Pictures of soft shadows against geometry, the sampled light and hard shadows.

use moment_shadows::Profile;
use moment_shadows_lab::compare::Stage;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_file::GraphFile;
use moment_shadows_lab::scene;
use moment_shadows_lab::soft::{
    LightSize, SoftCandidate, SoftLightChoice, SoftStage, StageDesc, candidates,
};

/// A light of each kind that makes wide penumbrae in the scene of straight edges.
const LIGHTS: [(SoftLightChoice, [f64; 2]); 3] = [
    (SoftLightChoice::Directional, [8.0, 8.0]),
    (SoftLightChoice::Spot, [2.0, 2.0]),
    (SoftLightChoice::Rectangle, [0.7, 2.0]),
];

fn candidate(name: &str) -> SoftCandidate {
    candidates(&[])
        .unwrap()
        .into_iter()
        .find(|candidate| candidate.name == name)
        .unwrap()
}

/// The graph of soft shadows with other properties of one node type.
fn with_properties(node_type: &str, properties: serde_json::Value) -> SoftCandidate {
    let text = include_str!("../../examples/soft_shadows.json");
    let mut graph: serde_json::Value = serde_json::from_str(text).unwrap();
    for node in graph["nodes"].as_array_mut().unwrap() {
        if node["type"] == node_type {
            node["properties"] = properties.clone();
        }
    }
    let file = GraphFile::parse("soft", graph.to_string(), None).unwrap();
    SoftCandidate {
        name: "soft".to_owned(),
        file: file.in_single_precision().unwrap(),
    }
}

fn stage(light: SoftLightChoice, size: [f64; 2]) -> StageDesc {
    StageDesc {
        light,
        size: Some(LightSize(size)),
        // As wide penumbrae as the table's largest kernel has room for, the narrowest some texels wide.
        map: 1024,
        width: 480,
        height: 270,
        ..StageDesc::default()
    }
}

#[test]
fn penumbrae_are_as_wide_as_geometry_has_them_at_three_distances() {
    let gpu = Gpu::open(Profile::Native).unwrap();
    let scene = scene::load("edge").unwrap();
    for (light, size) in LIGHTS {
        let stage = SoftStage::new(&gpu, &scene, &stage(light, size)).unwrap();
        let exact = stage.exact_widths().unwrap();
        for name in ["moment soft", "variance soft"] {
            let picture = stage.picture(&gpu, &candidate(name)).unwrap();
            for (found, exact) in stage.widths(&picture.shadow).unwrap().iter().zip(exact) {
                let found = found.unwrap_or(0.0);
                println!("{light:?} {name}: {found:.4}, exactly {exact:.4}");
                // Two moments spread an edge with the tails of Chebyshev's bound.
                let tolerance = if name == "moment soft" { 0.15 } else { 0.2 };
                assert!(
                    (found / exact - 1.0).abs() < tolerance,
                    "{light:?} {name}: {found} for {exact}"
                );
            }
            let error = stage.judge(&picture.shadow).unwrap();
            assert_eq!(error.nan_pixels, 0);
        }
    }
}

#[test]
fn a_light_of_no_size_gives_hard_shadows() {
    let gpu = Gpu::open(Profile::Native).unwrap();
    let scene = scene::load("chairs").unwrap();
    // The table from the map that hard shadows read, which is not blurred.
    let soft = with_properties("shade_soft", serde_json::json!({}));
    let hard = r#"{
        "version": 2,
        "imports": [
            { "name": "light_depth", "texture": { "format": "depth32float", "size": [1024, 1024], "samples": 4 } },
            { "name": "camera_depth", "texture": { "format": "depth32float", "size": [1280, 720] } }
        ],
        "nodes": [
            { "name": "resolve", "type": "resolve", "properties": { "storage": "float32" } },
            { "name": "shade", "type": "shade_hard" }
        ],
        "edges": [
            { "from": "light_depth", "to": "resolve.depth" },
            { "from": "resolve.map", "to": "shade.map" },
            { "from": "camera_depth", "to": "shade.camera_depth" }
        ],
        "outputs": [{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }]
    }"#;
    let hard = SoftCandidate {
        name: "hard".to_owned(),
        file: GraphFile::parse("hard", hard.to_owned(), None)
            .unwrap()
            .in_single_precision()
            .unwrap(),
    };
    for light in [SoftLightChoice::Directional, SoftLightChoice::Rectangle] {
        // Texels larger than pixels: filters cover a pixel's footprint at least.
        let desc = StageDesc {
            map: 128,
            ..stage(light, [0.0; 2])
        };
        let stage = SoftStage::new(&gpu, &scene, &desc).unwrap();
        let [soft, hard] = [&soft, &hard].map(|it| stage.picture(&gpu, it).unwrap().shadow);
        let judged = || {
            soft.iter()
                .zip(&hard)
                .zip(&stage.judged)
                .filter(|(_, judged)| **judged)
        };
        let count = judged().count();
        let mean = judged()
            .map(|((a, b), _)| f64::from((a - b).abs()))
            .sum::<f64>()
            / count as f64;
        println!("{light:?}: {mean:.5} on average over {count} pixels");
        // A box of one texel is a bilinear lookup. The table's moment bias is six times that of the map, and some surfaces
        // are seen edge-on by the light.
        assert!(mean < 0.01, "{light:?}: {mean}");
        assert!(hard.contains(&1.0));
    }
}

#[test]
fn lit_surfaces_have_no_acne_and_everything_is_a_number() {
    let gpu = Gpu::open(Profile::Native).unwrap();
    let scene = scene::load("chairs").unwrap();
    for (light, size) in [
        (SoftLightChoice::Directional, [0.5; 2]),
        (SoftLightChoice::Directional, [8.0; 2]),
        (SoftLightChoice::Spot, [0.5; 2]),
    ] {
        let stage = SoftStage::new(&gpu, &scene, &stage(light, size)).unwrap();
        let shadow = stage
            .picture(&gpu, &candidate("moment soft"))
            .unwrap()
            .shadow;
        assert!(shadow.iter().all(|value| (0.0..=1.0).contains(value)));
        let lit: Vec<f32> = far_from_shadows(&stage)
            .into_iter()
            .map(|pixel| shadow[pixel])
            .collect();
        let darkest = lit.iter().copied().fold(0.0, f32::max);
        let dark = lit.iter().filter(|&&value| value > 0.02).count();
        println!(
            "{light:?} {size:?}: {dark} of {} lit pixels are darkened, one by {darkest}",
            lit.len()
        );
        // What a pixel is next to may lie far away on the map: a few are behind a silhouette.
        assert!(
            lit.len() > 10_000 && dark * 1000 <= lit.len(),
            "{light:?} {size:?}"
        );
        // A spot light's cone ends within the picture; beyond it nothing is in shadow.
        let outside = shadow
            .iter()
            .zip(&stage.pixels.position)
            .zip(&stage.pixels.covered)
            .filter(|((_, position), covered)| {
                let uv = stage
                    .desc()
                    .light
                    .uv(glam::DVec3::from(position.map(f64::from)));
                // Positions are off by what rasterisers round.
                let beyond = |uv: glam::DVec2| uv.min_element() < -1e-3 || uv.max_element() > 1.001;
                **covered && uv.is_none_or(beyond)
            })
            .map(|((&value, _), _)| value);
        assert!(outside.into_iter().all(|value| value == 0.0));
    }
}

/// Judged pixels around which nothing is in the light's shadow: in a square of 17 pixels, which is more than a filter adds to
/// a penumbra.
fn far_from_shadows(stage: &SoftStage) -> Vec<usize> {
    const REACH: usize = 8;
    let [width, height] = stage.desc().picture.map(|side| side as usize);
    let is_lit = |x: usize, y: usize| {
        let pixel = y * width + x;
        stage.judged[pixel] && stage.truth[pixel] == 0.0
    };
    let mut far = Vec::new();
    for y in REACH..height - REACH {
        for x in REACH..width - REACH {
            let mut around =
                (y - REACH..=y + REACH).flat_map(|y| (x - REACH..=x + REACH).map(move |x| (x, y)));
            if around.all(|(x, y)| is_lit(x, y)) {
                far.push(y * width + x);
            }
        }
    }
    far
}

/// The search is allowed to count whole texels by default; the filter decides about bands.
#[test]
fn interpolation_makes_slow_penumbrae_smooth() {
    let gpu = Gpu::open(Profile::Native).unwrap();
    let scene = scene::load("edge").unwrap();
    let stage =
        SoftStage::new(&gpu, &scene, &stage(SoftLightChoice::Directional, [8.0; 2])).unwrap();
    let errors = ["both", "filter", "neither"].map(|interpolation| {
        let soft = with_properties(
            "shade_soft",
            serde_json::json!({ "interpolation": interpolation }),
        );
        let picture = stage.picture(&gpu, &soft).unwrap();
        stage.judge(&picture.shadow).unwrap().penumbra.mean_absolute
    });
    println!("both, filter, neither: {errors:?}");
    assert!(errors[1] < 1.05 * errors[0]);
    assert!(errors[2] > errors[1]);
}
