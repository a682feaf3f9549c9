//! Which resources share memory, and which never do.

use moment_shadows_graph::{
    Access, Direction, Home, NodeDesc, Plan, PlannedMemory, Slot, Stage, Usage, bind,
};

use crate::example::{TEXT, compiled, native};
use crate::host_node::{
    COPY, compute, copy, copy_every_time, copy_of_all, graph, input, made, output, rgba32,
};
use moment_shadows::TextureFormat::Rgba32Float;

const EARLY: Stage = Stage::AfterShadowMaps;
const LATE: Stage = Stage::AfterMainPass;

/// A chain of nodes a, b, c, ..: each reads the one before.
fn chain(nodes: Vec<NodeDesc>, outputs: &[&str]) -> Plan {
    let names = ["a", "b", "c", "d", "e", "f"];
    let slots: Vec<(String, String)> = (0..nodes.len())
        .map(|index| {
            let from = if index == 0 {
                "map".to_owned()
            } else {
                format!("{}.to", names[index - 1])
            };
            (from, format!("{}.from", names[index]))
        })
        .collect();
    let edges: Vec<(&str, &str)> = slots
        .iter()
        .map(|(from, to)| (from.as_str(), to.as_str()))
        .collect();
    let outputs: Vec<(&str, &str)> = outputs
        .iter()
        .map(|&from| (from.split_once('.').unwrap().0, from))
        .collect();
    let graph = graph(
        &[("map", rgba32(3))],
        names.into_iter().zip(nodes).collect(),
        &edges,
        &outputs,
    );
    graph.compile(&native(), &[]).unwrap()
}

/// The labels of the plan's memory: who lives together.
fn homes(plan: &Plan) -> Vec<&str> {
    plan.memory
        .iter()
        .map(|memory| memory.label.as_str())
        .collect()
}

#[test]
fn the_examples_moments_give_their_memory_to_the_blurred_ones() {
    let plan = compiled(TEXT, &native()).unwrap();
    assert_eq!(
        homes(&plan),
        [
            "resolve.map | blur.blurred",
            "blur.half_blurred",
            "shade.shadow_intensity"
        ]
    );
    let home = |name: &str| {
        plan.resources
            .iter()
            .find(|resource| resource.name == name)
            .unwrap()
            .home
    };
    assert_eq!(home("resolve.map"), Home::Memory(0));
    assert_eq!(home("blur.blurred"), Home::Memory(0));
    // What a texture has to allow is what any of its residents needs.
    assert_eq!(
        plan.memory[0].usage,
        [Usage::TextureBinding, Usage::StorageBinding]
    );
}

#[test]
fn transients_of_a_chain_take_turns() {
    let plan = chain(
        vec![
            copy(EARLY, 3),
            copy(EARLY, 3),
            copy(EARLY, 3),
            copy(EARLY, 3),
            copy(EARLY, 3),
        ],
        &["e.to"],
    );
    assert_eq!(homes(&plan), ["a.to | c.to", "b.to | d.to", "e.to"]);
}

#[test]
fn only_equal_textures_share() {
    let plan = chain(
        vec![
            copy(EARLY, 3),
            copy(EARLY, 3),
            copy(EARLY, 2),
            copy(EARLY, 2),
        ],
        &["d.to"],
    );
    assert_eq!(homes(&plan), ["a.to", "b.to", "c.to", "d.to"]);
}

#[test]
fn outputs_never_share() {
    let plan = chain(
        vec![
            copy(EARLY, 3),
            copy(EARLY, 3),
            copy(EARLY, 3),
            copy(EARLY, 3),
        ],
        &["b.to", "d.to"],
    );
    assert_eq!(homes(&plan), ["a.to | c.to", "b.to", "d.to"]);
    let exported = |memory: &PlannedMemory| memory.usage.contains(&Usage::CopySrc);
    let exported: Vec<bool> = plan.memory.iter().map(exported).collect();
    assert_eq!(exported, [false, true, true]);
}

#[test]
fn persistent_resources_never_share() {
    let mut keep = copy(EARLY, 3);
    keep.slots[1].persistent = true;
    let plan = chain(
        vec![keep, copy(EARLY, 3), copy(EARLY, 3), copy(EARLY, 3)],
        &["d.to"],
    );
    assert_eq!(homes(&plan), ["a.to", "b.to", "c.to", "d.to"]);
    let mut late = copy(EARLY, 3);
    late.slots[1].persistent = true;
    let plan = chain(
        vec![copy(EARLY, 3), copy(EARLY, 3), late, copy(EARLY, 3)],
        &["d.to"],
    );
    assert_eq!(homes(&plan), ["a.to", "b.to", "c.to", "d.to"]);
}

#[test]
fn what_is_made_by_layer_and_read_every_time_gives_its_memory_to_nobody() {
    // b is read whole by c in every frame, also in those in which none of its layers is made anew.
    let c = copy_every_time(EARLY);
    let nodes = vec![
        copy(EARLY, 1),
        copy(EARLY, 1),
        c,
        copy(EARLY, 1),
        copy(EARLY, 1),
    ];
    let plan = chain(nodes, &["e.to"]);
    let b = homes(&plan)
        .into_iter()
        .find(|label| label.contains("b.to"))
        .unwrap();
    assert!(
        b.ends_with("b.to"),
        "nobody lives where b lives after it: {b}"
    );
}

#[test]
fn a_pass_by_layer_that_binds_all_layers_reads_them_all() {
    // Recorded for one dirty layer, c reads the other layers of b, too: they have to be there.
    let nodes = vec![
        copy(EARLY, 3),
        copy(EARLY, 3),
        copy_of_all(EARLY, 3, true),
        copy(EARLY, 3),
        copy(EARLY, 3),
    ];
    let plan = chain(nodes, &["e.to"]);
    let b = homes(&plan)
        .into_iter()
        .find(|label| label.contains("b.to"))
        .unwrap();
    assert!(
        b.ends_with("b.to"),
        "nobody lives where b lives after it: {b}"
    );
}

#[test]
fn what_keeps_its_layers_lives_only_where_all_are_made_by_layer() {
    // a is made every time. Were c, whose clean layers keep their contents, in its memory, a would overwrite them.
    let nodes = vec![
        copy_every_time(EARLY),
        copy(EARLY, 1),
        copy(EARLY, 1),
        copy_every_time(EARLY),
        copy(EARLY, 1),
    ];
    let plan = chain(nodes, &["e.to"]);
    let c = homes(&plan)
        .into_iter()
        .find(|label| label.contains("c.to"))
        .unwrap();
    assert_eq!(c, "c.to");
    // Where a is made by layer, too, it overwrites a layer only if c makes it anew.
    let nodes = vec![
        copy(EARLY, 1),
        copy(EARLY, 1),
        copy(EARLY, 1),
        copy_every_time(EARLY),
        copy(EARLY, 1),
    ];
    let plan = chain(nodes, &["e.to"]);
    assert_eq!(homes(&plan)[0], "a.to | c.to");
}

#[test]
fn what_a_later_stage_reads_stays_for_a_second_view() {
    // The host may record the later stage once per view: b is read by each, so d does not overwrite it.
    let plan = chain(
        vec![
            copy(EARLY, 3),
            copy(EARLY, 3),
            copy(LATE, 3),
            copy(LATE, 3),
            copy(LATE, 3),
        ],
        &["e.to"],
    );
    let b = homes(&plan)
        .into_iter()
        .find(|label| label.contains("b.to"))
        .unwrap();
    assert!(b.ends_with("b.to"), "{b}");
    // a is done when the later stage begins.
    assert_eq!(homes(&plan)[0], "a.to | c.to");
}

#[test]
fn what_keeps_its_layers_does_not_live_where_another_stage_writes() {
    // The host may record the earlier stage with other dirty layers than the later one.
    let nodes = vec![
        copy(EARLY, 1),
        copy(EARLY, 1),
        copy(LATE, 1),
        copy_every_time(LATE),
        copy(LATE, 1),
    ];
    let plan = chain(nodes, &["e.to"]);
    let c = homes(&plan)
        .into_iter()
        .find(|label| label.contains("c.to"))
        .unwrap();
    assert_eq!(c, "c.to");
}

#[test]
fn a_node_that_changes_in_place_makes_no_memory() {
    let change = NodeDesc {
        slots: vec![
            made(
                "from",
                Direction::InOut,
                Access::STORAGE_WRITE,
                Rgba32Float,
                3,
            ),
            Slot {
                direction: Direction::In,
                ..input("other")
            },
            output("to", 3),
        ],
        passes: vec![
            compute(
                COPY,
                "from",
                true,
                [
                    ("source", bind::layer("other")),
                    ("copied", bind::store("from")),
                ],
            ),
            compute(
                COPY,
                "to",
                true,
                [
                    ("source", bind::layer("other")),
                    ("copied", bind::store("to")),
                ],
            ),
        ],
        ..copy(EARLY, 3)
    };
    let graph = graph(
        &[("map", rgba32(3)), ("second", rgba32(3))],
        vec![("a", copy(EARLY, 3)), ("b", change)],
        &[("map", "a.from"), ("a.to", "b.from"), ("second", "b.other")],
        &[("changed", "b.from"), ("made", "b.to")],
    );
    let plan = graph.compile(&native(), &[]).unwrap();
    assert_eq!(homes(&plan), ["a.to", "b.to"]);
    assert_eq!(
        plan.output_texture("changed"),
        plan.memory[0].desc.texture()
    );
}
