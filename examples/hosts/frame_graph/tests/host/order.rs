use moment_shadows_frame_graph::graphs;
use moment_shadows_frame_graph::world::World;
use moment_shadows_graph::Plan;

use crate::{drawn, gpu, plan, shares};

/// Where each pass of the plan is in an order.
fn places(plan: &Plan, order: &[String]) -> Vec<usize> {
    let names = plan.passes.iter().map(|pass| pass.name());
    names
        .map(|name| order.iter().position(|it| *it == name).unwrap())
        .collect()
}

/// The render graph knows reads and writes alone; `after` is what it has to come to.
#[test]
fn the_order_of_the_host_is_one_that_the_plan_allows() {
    let (gpu, _one) = gpu();
    let mut others = 0;
    for (name, _) in graphs::ALL {
        let plan = plan(name);
        let drawn = drawn(&gpu, &plan, &World::default());
        assert_eq!(drawn.order.len(), plan.passes.len(), "{name}");
        let places = places(&plan, &drawn.order);
        for (index, pass) in plan.passes.iter().enumerate() {
            for &before in &pass.after {
                assert!(places[before] < places[index], "{name}: {:?}", drawn.order);
            }
        }
        others += usize::from(!places.is_sorted());
    }
    assert!(others > 0, "the host orders nothing itself");
}

#[test]
fn pictures_have_light_and_shadow() {
    let (gpu, _one) = gpu();
    for name in ["hard_shadows", "soft_shadows", "two_lights"] {
        for (output, texels) in drawn(&gpu, &plan(name), &World::default()).pictures {
            let [dark, lit] = shares(&texels);
            assert!(dark > 0.02 && lit > 0.3, "{name}, {output}: {dark} {lit}");
        }
    }
}
