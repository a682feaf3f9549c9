use std::collections::HashMap;

use glam::DVec3;
use moment_shadows_frame_graph::adapter::Inputs;
use moment_shadows_frame_graph::variants::without;
use moment_shadows_frame_graph::world::World;

use crate::{SIZES, drawn, frame, gpu, plan};

fn moved() -> World {
    World {
        lamp: DVec3::new(2.5, 4.0, 3.5),
        ..World::default()
    }
}

fn changed(maps: &[(&str, &[u32])]) -> Inputs {
    let maps = maps
        .iter()
        .map(|(map, layers)| ((*map).to_owned(), layers.to_vec()));
    Inputs {
        changed: HashMap::from_iter(maps),
        ..Inputs::default()
    }
}

/// The lamp moves, and the sun does not: its map is not made again, whatever its depth map holds now.
#[test]
fn the_map_of_a_light_that_did_not_move_is_kept() {
    let (gpu, _one) = gpu();
    let plan = plan("two_lights");
    let mut frame = frame(&gpu, &plan, SIZES);
    let first = frame.draw_world(&gpu, &World::default()).unwrap();
    frame.write_parameters(&gpu, &moved()).unwrap();
    frame.write_depths(&gpu, &moved());
    frame.spoil_depth(&gpu, "sun_depth", 0);
    let second = frame.draw(&gpu, changed(&[("sun_depth", &[])])).unwrap();
    let expected = drawn(&gpu, &plan, &moved());
    assert!(second.pictures == expected.pictures);
    assert!(second.pictures[0] == first.pictures[0]);
    assert!(second.pictures[1] != first.pictures[1]);
    let is_of_sun_map = |name: &&String| name.contains("_sun/") && !name.starts_with("shade");
    assert_eq!(second.order.iter().filter(is_of_sun_map).count(), 0);
    // The spoilt map would be seen.
    let third = frame.draw(&gpu, Inputs::default()).unwrap();
    assert!(third.pictures[0] != first.pictures[0]);
}

#[test]
fn the_layer_of_a_light_that_did_not_move_is_kept() {
    let (gpu, _one) = gpu();
    let plan = plan("two_layers");
    let mut frame = frame(&gpu, &plan, SIZES);
    let first = frame.draw_world(&gpu, &World::default()).unwrap();
    frame.write_parameters(&gpu, &moved()).unwrap();
    frame.write_depths(&gpu, &moved());
    frame.spoil_depth(&gpu, "light_depth", 0);
    let second = frame.draw(&gpu, changed(&[("light_depth", &[1])])).unwrap();
    assert!(second.pictures == drawn(&gpu, &plan, &moved()).pictures);
    assert!(second.pictures != first.pictures);
}

/// What stands in for a map is kept as the map would be.
#[test]
fn the_map_of_a_light_whose_blur_is_off_is_kept() {
    let (gpu, _one) = gpu();
    let plan = without(&plan("two_lights"), &["blur_sun", "blur_lamp"]).unwrap();
    let mut frame = frame(&gpu, &plan, SIZES);
    let first = frame.draw_world(&gpu, &World::default()).unwrap();
    frame.write_parameters(&gpu, &moved()).unwrap();
    frame.write_depths(&gpu, &moved());
    frame.spoil_depth(&gpu, "sun_depth", 0);
    let second = frame.draw(&gpu, changed(&[("sun_depth", &[])])).unwrap();
    assert!(second.pictures[0] == first.pictures[0]);
    assert!(second.pictures == drawn(&gpu, &plan, &moved()).pictures);
}

/// A node that the host switches off by name leaves its output as it is.
#[test]
fn passes_that_are_switched_off_by_name_are_not_recorded() {
    use nightshade_renderer::rendergraph::render_graph_set_pass_enabled;
    let (gpu, _one) = gpu();
    let plan = plan("hard_shadows");
    let mut frame = frame(&gpu, &plan, SIZES);
    let first = frame.draw_world(&gpu, &World::default()).unwrap();
    for pass in plan.passes.iter().filter(|pass| pass.each_layer) {
        render_graph_set_pass_enabled(&mut frame.graph, &pass.name(), false).unwrap();
    }
    frame.spoil_depth(&gpu, "light_depth", 0);
    let second = frame.draw(&gpu, Inputs::default()).unwrap();
    assert_eq!(second.order, ["shade/shade"]);
    assert!(second.pictures == first.pictures);
}
