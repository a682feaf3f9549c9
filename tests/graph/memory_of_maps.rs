//! Memory that is shared in a plan of two maps: their layers are made anew independently of each other.

use moment_shadows_graph::{NodeDesc, Plan, PlannedMemory, Stage, Usage};

use crate::example::native;
use crate::host_node::{copy, copy_every_time, graph, rgba32};

const EARLY: Stage = Stage::AfterShadowMaps;

/// Pairs of nodes, each with the map that it begins from: the second copies the first and is an output.
///
/// Nodes are called a, b; c, d; .. Only the first of a pair can share memory.
fn pairs(pairs: Vec<(&str, NodeDesc, NodeDesc)>) -> Plan {
    let names = [["a", "b"], ["c", "d"], ["e", "f"]];
    let mut nodes = Vec::new();
    let mut edges = Vec::new();
    let mut outputs = Vec::new();
    for ([first, second], (map, made, kept)) in names.into_iter().zip(pairs) {
        nodes.extend([(first, made), (second, kept)]);
        edges.push((map.to_owned(), format!("{first}.from")));
        edges.push((format!("{first}.to"), format!("{second}.from")));
        outputs.push((second, format!("{second}.to")));
    }
    let edges: Vec<(&str, &str)> = edges.iter().map(|(a, b)| (&**a, &**b)).collect();
    let outputs: Vec<(&str, &str)> = outputs.iter().map(|(a, b)| (*a, &**b)).collect();
    let imports = [("left", rgba32(1)), ("right", rgba32(1))];
    let graph = graph(&imports, nodes, &edges, &outputs);
    graph.compile(&native(), &[]).unwrap()
}

/// The labels of the memory that is not an output: who lives together.
fn homes(plan: &Plan) -> Vec<&str> {
    let exported = |memory: &PlannedMemory| memory.usage.contains(&Usage::CopySrc);
    let memory = plan.memory.iter().filter(|memory| !exported(memory));
    memory.map(|memory| memory.label.as_str()).collect()
}

/// What is made by layer, and done with after the next node.
fn passing(map: &str) -> (&str, NodeDesc, NodeDesc) {
    (map, copy(EARLY, 1), copy(EARLY, 1))
}

/// What is made by layer and read in every frame: layers that are not dirty keep their contents.
fn keeping(map: &str) -> (&str, NodeDesc, NodeDesc) {
    (map, copy(EARLY, 1), copy_every_time(EARLY))
}

#[test]
fn what_keeps_its_layers_does_not_live_where_another_map_is_written() {
    // Were c in a's memory, a dirty layer of the left map would overwrite a clean layer of the right one.
    let plan = pairs(vec![passing("left"), keeping("right")]);
    assert_eq!(homes(&plan), ["a.to", "c.to"]);
    // In one map, a overwrites a layer only where c makes it anew.
    let plan = pairs(vec![passing("left"), keeping("left")]);
    assert_eq!(homes(&plan), ["a.to | c.to"]);
}

#[test]
fn nor_where_another_map_was_written_between() {
    // a and e are of the left map, but c, of the right one, lives between them: it would overwrite what e keeps.
    let plan = pairs(vec![passing("left"), passing("right"), keeping("left")]);
    assert_eq!(homes(&plan), ["a.to | c.to", "e.to"]);
    let plan = pairs(vec![passing("left"), passing("left"), keeping("left")]);
    assert_eq!(homes(&plan), ["a.to | c.to | e.to"]);
}

#[test]
fn nor_where_something_between_is_made_every_time() {
    // c is written in every frame, whatever is dirty.
    let every_time = ("left", copy_every_time(EARLY), copy(EARLY, 1));
    let plan = pairs(vec![passing("left"), every_time, keeping("left")]);
    assert_eq!(homes(&plan), ["a.to | c.to", "e.to"]);
}
