use moment_shadows_frame_graph::device::Pipelines;
use moment_shadows_frame_graph::frame::{Frame, Options};
use moment_shadows_frame_graph::graphs;
use moment_shadows_frame_graph::world::World;
use moment_shadows_graph::{Home, Plan};

use crate::{SIZES, drawn, gpu, plan, text};

/// Bytes where each resource of the plan has memory of its own.
fn apart(plan: &Plan) -> u64 {
    let own = plan
        .resources
        .iter()
        .filter(|it| matches!(it.home, Home::Memory(_)));
    own.map(|it| it.desc.bytes()).sum()
}

/// Maps that are kept for the next frame share none; the pictures are the same.
#[test]
fn the_host_lets_resources_share_memory() {
    let (gpu, _one) = gpu();
    let mut sharing = 0;
    for (name, _) in graphs::ALL {
        let plan = plan(name);
        let pipelines = Pipelines::of_plan(&gpu.device, &plan).unwrap();
        let drawn = [true, false].map(|keeps| {
            let options = Options {
                leaves_out_layers: keeps,
                ..Options::default()
            };
            let mut frame = Frame::new(&gpu, &plan, &pipelines, SIZES, &options).unwrap();
            let drawn = frame.draw_world(&gpu, &World::default()).unwrap();
            (drawn.pictures, frame.bytes())
        });
        let [(kept, most), (pictures, least)] = drawn;
        let apart = apart(&plan);
        assert!(pictures == kept, "{name}");
        assert!(
            least <= most && most <= apart,
            "{name}: {least} {most} {apart}"
        );
        sharing += usize::from(least < apart);
    }
    // All but soft shadows, of which no two textures are alike, and six moments, of which some differ in their layers alone.
    assert_eq!(sharing, graphs::ALL.len() - 2);
}

/// The maps of one light have a second layer, and are like those of the other else; whichever is drawn first.
#[test]
fn textures_of_other_layers_share_none() {
    let (gpu, _one) = gpu();
    let even = drawn(&gpu, &plan("two_lights"), &World::default());
    for import in 0..2 {
        let mut file: serde_json::Value = serde_json::from_str(text("two_lights")).unwrap();
        file["imports"][import]["texture"]["layers"] = 2.into();
        let odd = graphs::compile(&file.to_string(), SIZES).unwrap();
        let layers = odd.resources.iter().map(|it| it.desc.layers());
        assert_eq!(layers.max(), Some(2));
        let pipelines = Pipelines::of_plan(&gpu.device, &odd).unwrap();
        let options = Options {
            leaves_out_layers: false,
            ..Options::default()
        };
        let mut frame = Frame::new(&gpu, &odd, &pipelines, SIZES, &options).unwrap();
        let odd = frame.draw_world(&gpu, &World::default()).unwrap();
        assert!(odd.pictures == even.pictures);
    }
}
