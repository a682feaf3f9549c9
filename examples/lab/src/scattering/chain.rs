//! Chains of nodes from the light's depth to light in the air.

use moment_shadows::{Storage, Technique};
use moment_shadows_graph::{Graph, NodeRegistry};
use serde_json::{Value, json};

use super::flicker::RectifyNearest;
use super::ten_bits::CompositeTenBits;
use crate::error::LabError;
use crate::graph_file::GraphFile;

/// A chain: what resamples a map of moments, and what that is made of.
pub(super) struct Chain {
    /// Storage of the light's map.
    pub(super) map: Storage,
    /// Radius in texels of its blur, if it is blurred.
    pub(super) radius: Option<u32>,
    /// The type of the node that resamples it.
    pub(super) rectify: &'static str,
    /// The technique and the storage of the rectified map.
    pub(super) rectified: (Technique, Storage),
    /// Columns and rows of the rectified map.
    pub(super) extent: [u32; 2],
    /// Whether what resamples it knows the view rays of the picture.
    pub(super) seen: bool,
    /// The type of the node that lights the air.
    pub(super) composite: &'static str,
}

impl Chain {
    /// The graph, whose output is `scattering`.
    pub(super) fn graph(&self) -> Result<GraphFile, LabError> {
        let (technique, storage) = &self.rectified;
        let rectify = json!({ "technique": technique, "storage": storage, "extent": self.extent });
        let resolve = json!({ "storage": self.map });
        // Each with the slot that the node before it is connected with, and what it gives.
        let mut links = vec![("resolve", resolve, ["depth", "map"])];
        if let Some(radius) = self.radius {
            let blur = json!({ "kernel": { "radius": radius } });
            links.push(("blur", blur, ["map", "blurred"]));
        }
        links.extend([
            (self.rectify, rectify, ["map", "rectified"]),
            (
                "integrate_scattering",
                json!({}),
                ["rectified", "integrated"],
            ),
            (self.composite, json!({}), ["integrated", "scattering"]),
        ]);
        graph(&links, self.seen)
    }
}

fn graph(links: &[(&str, Value, [&str; 2])], seen: bool) -> Result<GraphFile, LabError> {
    let mut nodes = Vec::new();
    let last = links.last().map_or("", |(node, ..)| *node);
    let mut edges = vec![json!({ "from": "camera_depth", "to": format!("{last}.camera_depth") })];
    let of_view_rays = [
        json!({ "from": "camera_depth", "to": "rectify_moments.camera_depth" }),
        json!({ "from": "rectify_moments.view_rays", "to": "integrate_scattering.view_rays" }),
    ];
    if seen {
        edges.extend(of_view_rays);
    }
    let mut from = "light_depth".to_owned();
    for (node, properties, [input, output]) in links {
        nodes.push(json!({ "name": node, "type": node, "properties": properties }));
        edges.push(json!({ "from": from, "to": format!("{node}.{input}") }));
        from = format!("{node}.{output}");
    }
    let text = json!({
        "version": 2,
        "imports": [{ "name": "light_depth" }, { "name": "camera_depth" }],
        "nodes": nodes,
        "edges": edges,
        "outputs": [{ "name": "scattering", "from": from }],
    })
    .to_string();
    let mut registry = NodeRegistry::new();
    registry.register::<RectifyNearest>("rectify_nearest");
    registry.register::<CompositeTenBits>("composite_ten_bits");
    Ok(GraphFile {
        name: "scattering".to_owned(),
        graph: Graph::parse(&text, &registry).map_err(LabError::graph("scattering"))?,
        text,
    })
}
