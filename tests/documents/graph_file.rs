//! The page and the schema of graph files are what the code says.

use std::collections::BTreeSet;

use moment_shadows_graph::{Graph, NodeRegistry, graph_file_schema};
use serde_json::Value;

use crate::kept;

#[test]
fn the_schema_is_what_the_code_says() {
    let text = serde_json::to_string_pretty(&graph_file_schema()).unwrap();
    kept("graph/graph_file.schema.json", &format!("{text}\n"));
}
