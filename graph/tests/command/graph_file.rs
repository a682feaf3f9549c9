//! Graph files as sub-commands and other programs read them.

use moment_shadows_graph::command::GraphFile;
use serde_json::Value;

use crate::GRAPH;

#[test]
fn the_text_of_an_old_file_is_kept_with_the_names_of_now() {
    let old = GRAPH
        .replace("\"version\": 2", "\"version\": 1")
        .replace("\"type\": \"resolve\"", "\"type\": \"resolve_moments\"");
    let file = GraphFile::parse("old.json", old).unwrap();
    assert_eq!(file.graph.notes.len(), 1);
    let kept: Value = serde_json::from_str(&file.text).unwrap();
    let now: Value = serde_json::from_str(GRAPH).unwrap();
    assert_eq!(kept, now);
}
