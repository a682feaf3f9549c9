//! Layers of variance beside variance alone, on procedural scenes: what they are for.

use moment_shadows::{Profile, Storage};
use moment_shadows_lab::candidate::TechniqueChoice;
use moment_shadows_lab::command::drawn::Drawn;
use moment_shadows_lab::command::render::RenderOptions;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_frame::GraphFrame;
use moment_shadows_lab::judgement::Truth;
use moment_shadows_lab::scene;

use crate::stage::StageDesc;

/// Mean errors of variance alone, of layers of equal depth and of placed ones.
const TECHNIQUES: [&str; 3] = ["vsm", "lvsm", "lvsm_lloyd"];

fn check(name: &str) {
    let scene = scene::load(name).unwrap();
    let options = RenderOptions::default();
    let drawn = Drawn {
        picture: [320, 180],
        map: [512; 2],
        ..Drawn::default()
    };
    // Two channels of half precision can be stored to.
    let gpu = Gpu::open(Profile::NativeAdapter).unwrap();
    let frame = options.frame(&gpu, &scene, &drawn, 4).unwrap();
    let graph_in = |storage| {
        let desc = StageDesc {
            picture: drawn.picture,
            map: drawn.map[0],
            ..StageDesc::new(storage)
        };
        desc.graph()
    };
    let truth = Truth::of(&gpu, &frame, &graph_in(Storage::Float32)).unwrap();
    for storage in Storage::OF_FOUR_MOMENTS {
        let own = graph_in(storage);
        let [alone, layers, placed] = TECHNIQUES.map(|technique| {
            let technique: TechniqueChoice = technique.parse().unwrap();
            let file = technique.graph(&own, Some(storage)).unwrap();
            let graph = GraphFrame::new(&gpu, &frame, &file).unwrap();
            graph.run(&gpu).unwrap();
            let shadow = graph.read_shadow(&gpu, &file).unwrap();
            truth.judge(&shadow).unwrap().error.facing.mean_absolute
        });
        println!("{name} {storage}: {alone:.5} alone, {layers:.5} in layers, {placed:.5} placed");
        assert!(layers <= alone, "{name} {storage}: {layers} of {alone}");
        assert!(placed <= layers, "{name} {storage}: {placed} of {layers}");
    }
}

#[test]
fn layers_err_at_most_as_variance_alone_and_placed_ones_at_most_as_those_in_a_hall() {
    check("hall");
}

#[test]
fn layers_err_at_most_as_variance_alone_and_placed_ones_at_most_as_those_at_a_fence() {
    check("fence-and-foliage");
}

#[test]
fn layers_err_at_most_as_variance_alone_and_placed_ones_at_most_as_those_under_chairs() {
    check("chairs");
}
