use moment_shadows_frame_graph::device::Pipelines;
use moment_shadows_frame_graph::error::HostError;
use moment_shadows_frame_graph::frame::{Frame, Options};
use moment_shadows_frame_graph::graphs;
use moment_shadows_frame_graph::variants::without;
use moment_shadows_frame_graph::world::World;

use crate::{SIZES, drawn, gpu, plan, text};

/// Its readers take what it reads: the same as a graph that never had it.
#[test]
fn a_blur_is_passed_by() {
    let (gpu, _one) = gpu();
    let mut file: serde_json::Value = serde_json::from_str(text("hard_shadows")).unwrap();
    file["nodes"]
        .as_array_mut()
        .unwrap()
        .retain(|node| node["name"] != "blur");
    file["edges"]
        .as_array_mut()
        .unwrap()
        .retain(|edge| edge["to"] != "blur.map");
    for edge in file["edges"].as_array_mut().unwrap() {
        if edge["from"] == "blur.blurred" {
            edge["from"] = "resolve.map".into();
        }
    }
    let never = graphs::compile(&file.to_string(), SIZES).unwrap();
    let (never, whole) = (drawn(&gpu, &never, &World::default()), plan("hard_shadows"));
    let off = drawn(
        &gpu,
        &without(&whole, &["blur"]).unwrap(),
        &World::default(),
    );
    assert!(off.pictures == never.pictures);
    assert_eq!(off.order, ["resolve/resolve", "shade/shade"]);
    assert!(off.pictures != drawn(&gpu, &whole, &World::default()).pictures);
}

/// A map that is not made casts no shadow, filtered or not.
#[test]
fn without_a_map_all_is_lit() {
    let (gpu, _one) = gpu();
    for nodes in [&["resolve"][..], &["blur", "resolve"]] {
        let off = without(&plan("hard_shadows"), nodes).unwrap();
        let picture = drawn(&gpu, &off, &World::default()).pictures.remove(0).1;
        assert!(picture.iter().all(|&texel| texel <= 1), "{nodes:?}");
    }
}

/// One light is off, with all of its nodes; the other is as before.
#[test]
fn a_light_is_switched_off_and_on_again() {
    let (gpu, _one) = gpu();
    let whole = plan("two_lights");
    let off = without(&whole, &["resolve_lamp", "blur_lamp", "shade_lamp"]).unwrap();
    // The pipelines are those of the whole plan.
    let pipelines = Pipelines::of_plan(&gpu.device, &whole).unwrap();
    let [on, off, again] = [&whole, &off, &whole].map(|plan| {
        let mut frame = Frame::new(&gpu, plan, &pipelines, SIZES, &Options::default()).unwrap();
        frame.draw_world(&gpu, &World::default()).unwrap()
    });
    assert!(off.pictures[0] == on.pictures[0]);
    assert!(off.pictures[1].1.iter().all(|&texel| texel == 0));
    assert!(on.pictures[1].1.iter().any(|&texel| texel > 200));
    assert!(again.pictures == on.pictures);
}

#[test]
fn air_that_is_left_out_is_clear() {
    let (gpu, _one) = gpu();
    let whole = plan("volumetric_scattering");
    let off = without(&whole, &["rectify", "integrate", "composite"]).unwrap();
    let [on, off] = [&whole, &off].map(|plan| drawn(&gpu, plan, &World::default()).pictures);
    assert!(off[0] == on[0]);
    // In half precision: no light of its own, and all that comes from behind.
    let clear = [0, 0, 0, 0, 0, 0, 0x00, 0x3c];
    assert!(off[1].1.chunks_exact(8).all(|texel| texel == clear));
    assert!(on[1].1.chunks_exact(8).any(|texel| texel != clear));
}

/// Nothing stands in for a summed-area table.
#[test]
fn a_node_without_a_stand_in_is_left_out_with_its_readers() {
    let (gpu, _one) = gpu();
    let whole = plan("soft_shadows");
    let pipelines = Pipelines::of_plan(&gpu.device, &whole).unwrap();
    let alone = without(&whole, &["sum"]).unwrap();
    match Frame::new(&gpu, &alone, &pipelines, SIZES, &Options::default()) {
        Err(HostError::Unwritten(resource)) => assert_eq!(resource, "sum.table"),
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("the table is not there"),
    }
    let both = without(&whole, &["sum", "shade"]).unwrap();
    let drawn = drawn(&gpu, &both, &World::default());
    // Nobody reads the map any more.
    assert!(drawn.order.is_empty(), "{:?}", drawn.order);
    assert!(drawn.pictures[0].1.iter().all(|&texel| texel == 0));
}
