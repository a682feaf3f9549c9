//! Errors of the file itself: each at its line and column.

use moment_shadows_graph::GraphErrorKind::{
    MissingInput, Size, Syntax, UnknownName, UnknownNodeType, Version,
};

use crate::example::{TEXT, assert_error, edited, end_of, parse, refused};

#[test]
fn the_example_is_read() {
    let graph = parse(TEXT).unwrap();
    let names: Vec<&str> = graph.nodes.iter().map(|node| node.name.as_str()).collect();
    assert_eq!(names, ["resolve", "blur", "shade"]);
    let places: Vec<String> = graph
        .nodes
        .iter()
        .map(|node| node.position.unwrap().to_string())
        .collect();
    assert_eq!(places, ["8:5", "9:5", "10:5"]);
    assert_eq!(graph.edges[3].position.unwrap().to_string(), "16:5");
    assert_eq!(graph.outputs[0].position.unwrap().to_string(), "19:5");
}

#[test]
fn what_is_no_json_is_told_with_its_place() {
    assert_error(&refused(""), Syntax, "", "", "1:1", "EOF while parsing");
    assert_error(&refused("shadows"), Syntax, "", "", "1:1", "expected value");
    let comma = edited("\"size\": [1280, 720] } }", "\"size\": [1280, 720] } },");
    assert_error(&refused(&comma), Syntax, "", "", "6:3", "expected value");
}

#[test]
fn a_version_is_needed_and_has_to_be_known() {
    let missing = edited("\"version\": 2,", "");
    assert_error(
        &refused(&missing),
        Syntax,
        "",
        "",
        "21:1",
        "missing field `version`",
    );
    let newer = edited("\"version\": 2,", "\"version\": 3,");
    assert_error(
        &refused(&newer),
        Version,
        "",
        "",
        "",
        "has version 3, this library reads versions 1 to 2",
    );
    // A newer file may have other keys: its version is what is said.
    let changed = edited("\"version\": 2,", "\"version\": 7, \"cameras\": [],");
    assert_error(&refused(&changed), Version, "", "", "", "version 7");
}

/// A replacement in the example is refused, at the end of `at` within it.
#[track_caller]
fn assert_syntax(from: &str, to: &str, node: &str, at: &str, says: &str) {
    let text = edited(from, to);
    assert_error(&refused(&text), Syntax, node, "", &end_of(&text, at), says);
}

#[test]
fn unknown_keys_are_refused_where_they_stand() {
    // The place of the first, counted by hand.
    let file = edited("\"version\": 2,", "\"version\": 2, \"nods\": [],");
    assert_error(
        &refused(&file),
        Syntax,
        "",
        "",
        "2:22",
        "unknown field `nods`",
    );
    assert_syntax(
        "\"name\": \"light_depth\",",
        "\"name\": \"light_depth\", \"sise\": 3,",
        "",
        "\"sise\"",
        "unknown field `sise`",
    );
    assert_syntax(
        "\"samples\": 4",
        "\"sample\": 4",
        "",
        "\"sample\"",
        "unknown field `sample`",
    );
    assert_syntax(
        "\"type\": \"shade_hard\"",
        "\"type\": \"shade_hard\", \"property\": {}",
        "shade",
        "\"property\"",
        "unknown field `property`",
    );
    assert_syntax(
        "\"storage\"",
        "\"storag\"",
        "resolve",
        "\"storag\"",
        "unknown field `storag`, expected one of",
    );
    assert_syntax(
        "\"sigma\"",
        "\"sgima\"",
        "blur",
        "\"sgima\"",
        "unknown field `sgima`",
    );
    assert_syntax(
        "\"from\": \"light_depth\",",
        "\"form\": \"light_depth\",",
        "",
        "\"form\"",
        "unknown field `form`",
    );
    assert_syntax(
        "\"from\": \"shade.shadow_intensity\"",
        "\"taken\": \"x\"",
        "",
        "\"taken\"",
        "unknown field `taken`",
    );
}

#[test]
fn values_of_the_wrong_kind_are_refused_where_they_stand() {
    assert_syntax(
        "\"unorm16\"",
        "\"unorm12\"",
        "resolve",
        "\"unorm12\"",
        "unknown variant `unorm12`, expected one of",
    );
    assert_syntax(
        "\"depth32float\", \"size\": [1280",
        "\"depth64float\", \"size\": [1280",
        "",
        "\"depth64float\"",
        "unknown variant `depth64float`",
    );
    assert_syntax(
        "[1280, 720]",
        "[1280, -720]",
        "",
        "-720",
        "invalid value: integer `-720`",
    );
    assert_syntax(
        "\"radius\": 4",
        "\"radius\": true",
        "blur",
        "true",
        "invalid type: boolean `true`",
    );
}

#[test]
fn missing_properties_name_the_node_without_a_place_in_nothing() {
    let properties = ", \"properties\": { \"kernel\": { \"radius\": 4, \"sigma\": 2.4 } }";
    let error = refused(&edited(properties, ""));
    assert_error(&error, Syntax, "blur", "", "9:5", "missing field `kernel`");
    assert!(!error.message.contains("at line"), "{error}");
}

#[test]
fn places_are_counted_in_files_of_one_line_and_of_many_bytes() {
    let line: String = edited("\"unorm16\"", "\"unorm12\"")
        .split_whitespace()
        .collect();
    let column = line.find("unorm12").unwrap() + "unorm12\"".len();
    assert_error(
        &refused(&line),
        Syntax,
        "resolve",
        "",
        &format!("1:{column}"),
        "unorm12",
    );
    // Characters of several bytes before the error; columns are bytes.
    let wide = edited(
        "\"name\": \"light_depth\",",
        "\"name\": \"lïght\", \"sise\": 3,",
    );
    assert_error(
        &refused(&wide),
        Syntax,
        "",
        "",
        &end_of(&wide, "\"sise\""),
        "unknown field `sise`",
    );
}

#[test]
fn unknown_node_types_name_the_nearest() {
    let text = edited("\"type\": \"blur\"", "\"type\": \"blurr\"");
    let error = refused(&text);
    assert_error(
        &error,
        UnknownNodeType,
        "blur",
        "",
        "9:5",
        "no node type 'blurr'",
    );
    assert!(error.message.contains("nearest are `blur`"), "{error}");
}

#[test]
fn an_import_is_a_texture_or_a_buffer() {
    let text = edited(
        "\"name\": \"light_depth\",",
        "\"name\": \"light_depth\", \"buffer_size\": 64,",
    );
    assert_error(
        &refused(&text),
        Syntax,
        "",
        "",
        "4:5",
        "as a texture and as a buffer",
    );
}

#[test]
fn endpoints_name_what_there_is() {
    let import = edited("\"from\": \"light_depth\"", "\"from\": \"light_deph\"");
    assert_error(
        &refused(&import),
        UnknownName,
        "",
        "",
        "13:5",
        "no import 'light_deph'; the nearest are `light_depth`",
    );
    let node = edited("\"from\": \"resolve.map\"", "\"from\": \"resolv.map\"");
    assert_error(
        &refused(&node),
        UnknownName,
        "",
        "",
        "14:5",
        "no node 'resolv'; the nearest are `resolve`",
    );
    let output = edited("\"from\": \"resolve.map\"", "\"from\": \"resolve.mab\"");
    assert_error(
        &refused(&output),
        UnknownName,
        "resolve",
        "mab",
        "14:5",
        "no output 'mab'; the nearest are `map`",
    );
    // The node cannot describe itself without its input, so what is connected is said.
    let input = edited("\"to\": \"shade.map\"", "\"to\": \"shade.mab\"");
    let says = "add an edge that leads to it (what is connected is 'camera_depth', 'mab')";
    assert_error(&refused(&input), MissingInput, "shade", "map", "10:5", says);
    let further = edited(
        "\"to\": \"blur.map\" },",
        "\"to\": \"blur.map\" }, { \"from\": \"light_depth\", \"to\": \"blur.depth\" },",
    );
    let edge = refused(&further);
    assert_error(
        &edge,
        UnknownName,
        "blur",
        "depth",
        "14:50",
        "no input 'depth'; the nearest are `map` (",
    );
    let no_slot = edited("\"to\": \"blur.map\"", "\"to\": \"blur\"");
    assert_error(
        &refused(&no_slot),
        UnknownName,
        "blur",
        "",
        "14:5",
        "write 'node.slot'",
    );
    let backwards = edited("\"to\": \"blur.map\"", "\"to\": \"blur.blurred\"");
    assert_error(
        &refused(&backwards),
        MissingInput,
        "blur",
        "map",
        "9:5",
        "what is connected is 'blurred'",
    );
    let taken = edited(
        "\"from\": \"shade.shadow_intensity\"",
        "\"from\": \"shade.map\"",
    );
    assert_error(
        &refused(&taken),
        UnknownName,
        "shade",
        "map",
        "19:5",
        "no output 'map'",
    );
}

#[test]
fn files_beyond_the_largest_size_are_refused() {
    let text = format!("{}{TEXT}", " ".repeat(1 << 20));
    assert_error(
        &refused(&text),
        Size,
        "",
        "",
        "",
        "at most 1048576 are read",
    );
}

#[test]
fn a_large_file_is_read_in_no_time() {
    let edges = vec!["{\"from\":\"a\",\"to\":\"b.c\"}"; 40_000].join(",\n");
    let text =
        format!("{{\"version\":2,\"imports\":[],\"nodes\":[],\"edges\":[{edges}],\"outputs\":[]}}");
    let graph = parse(&text).unwrap();
    assert_eq!(graph.edges.last().unwrap().position.unwrap().line, 40_000);
}
