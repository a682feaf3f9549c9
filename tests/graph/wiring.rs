//! Names, edges, cycles and stages.

use moment_shadows_graph::GraphErrorKind::{
    Cycle, DuplicateName, MissingImport, MissingInput, StageOrder, TwoWriters, UnknownName,
};
use moment_shadows_graph::{Access, Direction, GraphError, ResourceDesc, Stage, bind};

use crate::example::{TEXT, assert_error, edited, native, parse, refused};
use crate::host_node::{COPY, compute, copy, empty, graph, input, made, output, rgba32};
use moment_shadows::TextureFormat::Rgba32Float;

fn compile_error(graph: &moment_shadows_graph::Graph) -> GraphError {
    graph.compile(&native(), &[]).unwrap_err()
}

#[test]
fn names_are_unique_among_imports_and_nodes_and_among_outputs() {
    let nodes = edited("\"name\": \"blur\"", "\"name\": \"resolve\"");
    assert_error(
        &refused(&nodes),
        DuplicateName,
        "",
        "",
        "9:5",
        "already an import or node named 'resolve'",
    );
    let both = edited("\"name\": \"blur\"", "\"name\": \"camera_depth\"");
    assert_error(
        &refused(&both),
        DuplicateName,
        "",
        "",
        "9:5",
        "named 'camera_depth'",
    );
    let twice = edited("\"name\": \"camera_depth\"", "\"name\": \"light_depth\"");
    assert_error(
        &refused(&twice),
        DuplicateName,
        "",
        "",
        "5:5",
        "named 'light_depth'",
    );
    let output = "{ \"name\": \"shadow_intensity\", \"from\": \"shade.shadow_intensity\" }";
    let outputs = edited(output, &format!("{output},\n{output}"));
    assert_error(
        &refused(&outputs),
        DuplicateName,
        "",
        "",
        "20:1",
        "already an output named 'shadow_intensity'",
    );
}

#[test]
fn names_are_not_empty_and_have_no_dot() {
    let empty = edited("\"name\": \"blur\"", "\"name\": \"\"");
    assert_error(
        &refused(&empty),
        UnknownName,
        "",
        "",
        "9:5",
        "names are not empty",
    );
    let dot = edited("\"name\": \"blur\"", "\"name\": \"blur.x\"");
    assert_error(&refused(&dot), UnknownName, "", "", "9:5", "have no '.'");
}

#[test]
fn an_input_that_nothing_leads_to_is_named() {
    let text = edited(
        "    { \"from\": \"light_depth\", \"to\": \"resolve.depth\" },\n",
        "",
    );
    assert_error(
        &refused(&text),
        MissingInput,
        "resolve",
        "depth",
        "8:5",
        "add an edge",
    );
    let text = edited(
        ",\n    { \"from\": \"camera_depth\", \"to\": \"shade.camera_depth\" }",
        "",
    );
    assert_error(
        &refused(&text),
        MissingInput,
        "shade",
        "camera_depth",
        "10:5",
        "add an edge",
    );
}

#[test]
fn an_input_has_one_writer() {
    let edge = "{ \"from\": \"resolve.map\", \"to\": \"blur.map\" }";
    let text = edited(edge, &format!("{edge},\n      {edge}"));
    assert_error(
        &refused(&text),
        TwoWriters,
        "blur",
        "map",
        "15:7",
        "two edges lead to this input",
    );
}

#[test]
fn a_cycle_names_its_nodes_in_the_order_of_the_edges() {
    let third = "{ \"name\": \"again\", \"type\": \"blur\", \"properties\": { \"kernel\": { \"radius\": 1 } } }";
    let text = edited(
        "{ \"name\": \"shade\", \"type\": \"shade_hard\" }",
        &format!(
            "{{ \"name\": \"shade\", \"type\": \"shade_hard\" }},\n    {third},\n    {}",
            third.replace("again", "more")
        ),
    );
    let text = text.replace(
        "{ \"from\": \"resolve.map\", \"to\": \"blur.map\" }",
        "{ \"from\": \"more.blurred\", \"to\": \"blur.map\" }, { \"from\": \"blur.blurred\", \"to\": \"again.map\" },
         { \"from\": \"again.blurred\", \"to\": \"more.map\" }",
    );
    let error = refused(&text);
    assert_eq!(error.kind, Cycle);
    assert!(
        error.message.contains("again -> more -> blur wait"),
        "{error}"
    );
    assert_eq!(
        (error.node.as_deref(), error.position.unwrap().to_string()),
        (Some("again"), "11:5".to_owned())
    );
}

#[test]
fn a_node_that_waits_for_itself_is_a_cycle() {
    let text = edited("\"from\": \"resolve.map\"", "\"from\": \"blur.blurred\"");
    assert_error(
        &refused(&text),
        Cycle,
        "blur",
        "",
        "9:5",
        "the nodes blur wait",
    );
}

#[test]
fn a_node_does_not_read_what_a_later_stage_makes() {
    let graph = graph(
        &[("map", rgba32(1))],
        vec![
            ("late", copy(Stage::AfterMainPass, 1)),
            ("early", copy(Stage::AfterShadowMaps, 1)),
        ],
        &[("map", "late.from"), ("late.to", "early.from")],
        &[("out", "early.to")],
    );
    assert_error(
        &compile_error(&graph),
        StageOrder,
        "early",
        "",
        "",
        "before 'late', whose output it reads",
    );
}

#[test]
fn passes_are_ordered_by_stage_and_then_by_dependency() {
    let graph = graph(
        &[("map", rgba32(1))],
        vec![
            ("d", copy(Stage::AfterMainPass, 1)),
            ("b", copy(Stage::AfterShadowMaps, 1)),
            ("c", copy(Stage::AfterMainPass, 1)),
            ("a", copy(Stage::AfterShadowMaps, 1)),
        ],
        &[
            ("map", "a.from"),
            ("a.to", "b.from"),
            ("map", "c.from"),
            ("c.to", "d.from"),
        ],
        &[("x", "b.to"), ("y", "d.to")],
    );
    let plan = graph.compile(&native(), &[]).unwrap();
    let order: Vec<&str> = plan.passes.iter().map(|pass| pass.node.as_str()).collect();
    assert_eq!(order, ["a", "b", "c", "d"]);
}

#[test]
fn imports_are_described_by_the_host_or_the_file_and_by_nobody_else() {
    let text = edited(
        "{ \"name\": \"camera_depth\", \"texture\": { \"format\": \"depth32float\", \"size\": [1280, 720] } }",
        "{ \"name\": \"camera_depth\" }",
    );
    assert_error(
        &refused(&text),
        MissingImport,
        "",
        "",
        "5:5",
        "import 'camera_depth' is described neither by the host",
    );
    let graph = parse(TEXT).unwrap();
    let imports = [("light_deph", rgba32(1))];
    let error = graph.compile(&native(), &imports).unwrap_err();
    assert_error(
        &error,
        UnknownName,
        "",
        "",
        "",
        "no import 'light_deph'; the nearest are `light_depth`",
    );
}

#[test]
fn the_hosts_description_of_an_import_takes_the_place_of_the_files() {
    let graph = parse(TEXT).unwrap();
    let desc = moment_shadows_graph::TextureDesc::new(
        moment_shadows::TextureFormat::Depth16Unorm,
        [256, 128],
    );
    let imports = [("light_depth", ResourceDesc::Texture(desc))];
    let plan = graph.compile(&native(), &imports).unwrap();
    assert_eq!(plan.memory[0].desc.to_string(), "rgba16unorm 256x128");
}

#[test]
fn what_is_changed_in_place_is_taken_by_nobody_else() {
    let change = || moment_shadows_graph::NodeDesc {
        slots: vec![
            made(
                "map",
                Direction::InOut,
                Access::STORAGE_WRITE,
                Rgba32Float,
                1,
            ),
            input("from"),
        ],
        passes: vec![compute(
            COPY,
            "map",
            true,
            [
                ("source", bind::layer("from")),
                ("copied", bind::store("map")),
            ],
        )],
        ..empty(Stage::AfterShadowMaps)
    };
    let nodes = || {
        vec![
            ("make", copy(Stage::AfterShadowMaps, 1)),
            ("change", change()),
            ("read", copy(Stage::AfterShadowMaps, 1)),
        ]
    };
    let with = |read_from: &str, taken: &str| {
        graph(
            &[("source", rgba32(1)), ("other", rgba32(1))],
            nodes(),
            &[
                ("source", "make.from"),
                ("make.to", "change.map"),
                ("other", "change.from"),
                (read_from, "read.from"),
            ],
            &[("out", "read.to"), ("map", taken)],
        )
    };
    let says = "'make.to' is changed in place here and taken elsewhere, too; take 'change.map' there instead";
    assert_error(
        &compile_error(&with("make.to", "change.map")),
        TwoWriters,
        "change",
        "map",
        "",
        says,
    );
    assert_error(
        &compile_error(&with("change.map", "make.to")),
        TwoWriters,
        "change",
        "map",
        "",
        says,
    );
    let plan = with("change.map", "change.map")
        .compile(&native(), &[])
        .unwrap();
    let order: Vec<&str> = plan.passes.iter().map(|pass| pass.node.as_str()).collect();
    assert_eq!(order, ["make", "change", "read"]);
    assert_eq!(
        plan.memory.len(),
        2,
        "the change is made in the memory of what is changed"
    );
}

#[test]
fn optional_inputs_may_stay_open() {
    let node = moment_shadows_graph::NodeDesc {
        slots: vec![
            input("from"),
            moment_shadows_graph::Slot {
                optional: true,
                ..input("mask")
            },
            output("to", 1),
        ],
        ..copy(Stage::AfterShadowMaps, 1)
    };
    let graph = graph(
        &[("map", rgba32(1))],
        vec![("copy", node)],
        &[("map", "copy.from")],
        &[("out", "copy.to")],
    );
    assert_eq!(graph.compile(&native(), &[]).unwrap().passes.len(), 1);
}
