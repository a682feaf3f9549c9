//! The chains whose flicker is compared.

use moment_shadows_graph::{Graph, NodeRegistry};
use serde_json::{Value, json};

use super::nearest::RectifyNearest;
use crate::error::LabError;
use crate::graph_file::GraphFile;

/// The example's own graph.
const EXAMPLE: &str = include_str!("../../../../volumetric_scattering.json");

/// A chain of nodes from the light's depth to radiance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Chain {
    /// That of the example: several samples per texel, a blur, bilinear lookups.
    Filtered,
    /// The same with mip levels, over which lookups average what a texel of the rectified map covers.
    MipLevels,
    /// One sample per texel and no blur, but bilinear lookups.
    Bilinear,
    /// One sample per texel, no blur, and lookups of the nearest texel.
    Unfiltered,
}

impl Chain {
    /// All of them.
    pub const ALL: [Chain; 4] = [
        Chain::Filtered,
        Chain::MipLevels,
        Chain::Bilinear,
        Chain::Unfiltered,
    ];

    /// What tables call it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Chain::Filtered => "filtered",
            Chain::MipLevels => "filtered, mip levels",
            Chain::Bilinear => "unfiltered, bilinear",
            Chain::Unfiltered => "unfiltered",
        }
    }

    /// Whether the light's map has one sample per texel.
    #[must_use]
    pub fn is_plain(self) -> bool {
        matches!(self, Chain::Bilinear | Chain::Unfiltered)
    }

    fn change(self, node: &mut Value, extent: [u32; 2]) {
        match node["type"].as_str() {
            Some("rectify_moments") => {
                node["properties"]["extent"] = json!(extent);
                if self == Chain::Unfiltered {
                    node["type"] = json!("rectify_nearest");
                }
            }
            Some("blur") if self == Chain::MipLevels => {
                node["properties"]["mip_levels"] = json!("all");
            }
            Some("resolve") if self.is_plain() => {
                node["properties"]["storage"] = json!("float32");
            }
            _ => {}
        }
    }

    /// The graph, with rectified maps of this extent.
    pub fn graph(self, extent: [u32; 2]) -> Result<GraphFile, LabError> {
        let mut file: Value = serde_json::from_str(EXAMPLE).unwrap_or_default();
        // Textures are those of the frame.
        edit(&mut file, "imports", |imports| {
            for import in imports {
                *import = json!({ "name": import["name"] });
            }
        });
        remove(&mut file, "shade");
        edit(&mut file, "outputs", |outputs| {
            outputs.retain(|output| output["name"] == "scattering");
        });
        edit(&mut file, "nodes", |nodes| {
            for node in nodes {
                self.change(node, extent);
            }
        });
        match self {
            Chain::Filtered => {}
            Chain::MipLevels => {
                redirect(&mut file, "blur.blurred", "mips.map");
                edit(&mut file, "nodes", |nodes| {
                    nodes.push(json!({ "name": "mips", "type": "downsample" }));
                });
                edit(&mut file, "edges", |edges| {
                    edges.push(json!({ "from": "blur.blurred", "to": "mips.map" }));
                });
            }
            Chain::Bilinear | Chain::Unfiltered => {
                remove(&mut file, "blur");
                redirect(&mut file, "blur.blurred", "resolve.map");
            }
        }
        let mut registry = NodeRegistry::new();
        registry.register::<RectifyNearest>("rectify_nearest");
        let (name, text) = (self.name().to_owned(), file.to_string());
        match Graph::parse(&text, &registry) {
            Ok(graph) => Ok(GraphFile { name, text, graph }),
            Err(error) => Err(LabError::Graph { file: name, error }),
        }
    }
}

/// Changes a list of the file.
fn edit(file: &mut Value, name: &str, change: impl FnOnce(&mut Vec<Value>)) {
    if let Some(items) = file[name].as_array_mut() {
        change(items);
    }
}

/// Takes a node out, with the edges that lead to it.
fn remove(file: &mut Value, node: &str) {
    edit(file, "nodes", |nodes| {
        nodes.retain(|other| other["name"] != node)
    });
    let slot = format!("{node}.");
    let leads = |edge: &Value| edge["to"].as_str().is_some_and(|to| to.starts_with(&slot));
    edit(file, "edges", |edges| edges.retain(|edge| !leads(edge)));
}

/// Edges from one slot start at another.
fn redirect(file: &mut Value, from: &str, to: &str) {
    edit(file, "edges", |edges| {
        for edge in edges.iter_mut().filter(|edge| edge["from"] == from) {
            edge["from"] = json!(to);
        }
    });
}
