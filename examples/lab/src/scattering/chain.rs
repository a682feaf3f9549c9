//! Chains of nodes from the light's depth to light in the air.

use moment_shadows::Storage;
use moment_shadows_graph::{Graph, NodeRegistry};
use serde_json::{Value, json};

use super::flicker::RectifyNearest;
use crate::error::LabError;
use crate::graph_file::GraphFile;

/// A node: its type and properties, the slot that the node before it is connected with, and what it gives.
pub(super) struct Link(
    pub(super) &'static str,
    pub(super) Value,
    pub(super) [&'static str; 2],
);

impl Link {
    /// The light's map in a storage.
    pub(super) fn resolve(storage: Storage) -> Self {
        let properties = json!({ "storage": storage.to_string() });
        Self("resolve", properties, ["depth", "map"])
    }

    /// Its blur.
    pub(super) fn blur(radius: u32, mip_levels: Option<&str>) -> Self {
        let mut properties = json!({ "kernel": { "radius": radius } });
        if let Some(levels) = mip_levels {
            properties["mip_levels"] = levels.into();
        }
        Self("blur", properties, ["map", "blurred"])
    }
}

/// The graph, whose output is what its last node gives.
pub(super) fn graph(name: &str, links: &[Link]) -> Result<GraphFile, LabError> {
    let (mut nodes, mut edges) = (Vec::new(), Vec::new());
    let mut from = "light_depth".to_owned();
    for Link(node, properties, [input, output]) in links {
        nodes.push(json!({ "name": node, "type": node, "properties": properties }));
        edges.push(json!({ "from": from, "to": format!("{node}.{input}") }));
        if *node == "composite_scattering" {
            edges.push(json!({ "from": "camera_depth", "to": format!("{node}.camera_depth") }));
        }
        from = format!("{node}.{output}");
    }
    let output = links.last().map(|Link(_, _, [_, output])| output);
    let text = json!({
        "version": 2,
        "imports": [{ "name": "light_depth" }, { "name": "camera_depth" }],
        "nodes": nodes,
        "edges": edges,
        "outputs": [{ "name": output, "from": from }],
    })
    .to_string();
    let mut registry = NodeRegistry::new();
    registry.register::<RectifyNearest>("rectify_nearest");
    Ok(GraphFile {
        name: name.to_owned(),
        graph: Graph::parse(&text, &registry).map_err(LabError::graph(name))?,
        text,
    })
}
