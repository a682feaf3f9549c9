//! A graph file with what the lab reads from it besides the graph: its kernel, its technique and its storage.

mod technique;

use std::path::Path;

use moment_shadows::{Kernel, Storage};
use moment_shadows_graph::nodes::Blur;
use moment_shadows_graph::{Graph, GraphError, GraphErrorKind, NodeRegistry};
use serde_json::Value;

use crate::error::LabError;

/// A graph file.
#[derive(Debug)]
pub struct GraphFile {
    /// Its name, for errors.
    pub name: String,
    /// Its text.
    pub text: String,
    /// The graph.
    pub graph: Graph,
}

impl GraphFile {
    /// Reads a file. With a storage, every `resolve` node uses that instead of its own.
    pub fn read(path: &Path, storage: Option<Storage>) -> Result<Self, LabError> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|error| LabError::Read {
            path: name.clone(),
            reason: error.to_string(),
        })?;
        let file = Self::parse(&name, text, storage)?;
        for note in &file.graph.notes {
            eprintln!("note: {name} is of version 1: {note} now");
        }
        Ok(file)
    }

    /// The graph of a text that errors name by `name`.
    pub fn parse(name: &str, text: String, storage: Option<Storage>) -> Result<Self, LabError> {
        let parsed = |text: &str| {
            Graph::parse(text, &NodeRegistry::new()).map_err(|error| LabError::Graph {
                file: name.to_owned(),
                error,
            })
        };
        // The text as given is parsed first, so that errors have its positions.
        let mut graph = parsed(&text)?;
        let mut text = text;
        if !graph.notes.is_empty() {
            let mut file: Value = serde_json::from_str(&text).unwrap_or_default();
            moment_shadows_graph::upgrade(&mut file);
            text = file.to_string();
        }
        if let Some(storage) = storage {
            text = with_property(&text, "resolve", "storage", storage.name().into());
            graph.nodes = parsed(&text)?.nodes;
        }
        Ok(Self {
            name: name.to_owned(),
            text,
            graph,
        })
    }

    /// This graph with its shadow intensity written in single precision, so that it can be measured.
    pub fn in_single_precision(&self) -> Result<Self, LabError> {
        let mut text = self.text.clone();
        for node_type in ["shade_hard", "shade_soft"] {
            text = with_property(&text, node_type, "format", "r32float".into());
        }
        Self::parse(&self.name, text, None)
    }

    /// Whether a node of this type is in the graph.
    #[must_use]
    pub fn has_node(&self, node_type: &str) -> bool {
        nodes(&self.text)
            .iter()
            .any(|node| node["type"] == node_type)
    }

    /// This graph without mip levels: what read a downsampled map reads the map itself.
    pub fn without_mip_levels(&self) -> Result<Self, LabError> {
        let mut file: Value = serde_json::from_str(&self.text).unwrap_or_default();
        let mut sources = std::collections::BTreeMap::new();
        for node in nodes(&self.text) {
            let name = node["name"].as_str().unwrap_or_default();
            if node["type"] == "downsample" {
                sources.insert(format!("{name}.map"), String::new());
            }
        }
        if let Some(edges) = file["edges"].as_array_mut() {
            edges.retain(|edge| {
                let ends = [&edge["from"], &edge["to"]].map(|end| end.as_str().unwrap_or_default());
                let source = sources.get_mut(ends[1]);
                let goes = source.is_some();
                if let Some(source) = source {
                    *source = ends[0].to_owned();
                }
                !goes
            });
        }
        for list in ["edges", "outputs"] {
            if let Some(items) = file[list].as_array_mut() {
                for item in items {
                    let from = item["from"].as_str().unwrap_or_default().to_owned();
                    if let Some(source) = sources.get(&from) {
                        item["from"] = source.clone().into();
                    }
                }
            }
        }
        if let Some(nodes) = file["nodes"].as_array_mut() {
            nodes.retain(|node| node["type"] != "downsample");
            for node in nodes {
                if let Some(properties) = node["properties"].as_object_mut() {
                    properties.remove("mip_levels");
                }
            }
        }
        Self::parse(&self.name, file.to_string(), None)
    }

    /// This graph with a Gaussian of this radius and 0.6 times that as its standard deviation in place of its kernel.
    pub fn with_radius(&self, radius: u32) -> Result<Self, LabError> {
        if self.kernel()?.is_none() {
            return Err(LabError::unsuitable(
                &self.name,
                "it has no blur node whose radius could be another; add one",
            ));
        }
        let kernel = serde_json::json!({ "radius": radius });
        let text = with_property(&self.text, "blur", "kernel", kernel);
        let file = Self::parse(&self.name, text, None)?;
        file.kernel()?;
        Ok(file)
    }

    /// This graph with the filtered map that its `shade_hard` node looks up as a further output, and that output's name.
    pub fn with_filtered_map(&self) -> Result<(Self, String), LabError> {
        let unsuitable = |reason: &str| self.unsuitable(reason.to_owned());
        let shade = nodes(&self.text)
            .into_iter()
            .find(|node| node["type"] == "shade_hard")
            .ok_or_else(|| unsuitable("it has no shade_hard node whose map could be judged"))?;
        let slot = format!("{}.map", shade["name"].as_str().unwrap_or_default());
        let mut file: Value = serde_json::from_str(&self.text).unwrap_or_default();
        let edges = file["edges"].as_array().cloned().unwrap_or_default();
        let source = edges
            .into_iter()
            .find(|edge| edge["to"] == slot.as_str())
            .map(|edge| edge["from"].clone())
            .ok_or_else(|| unsuitable("no edge leads to the moments of its shade_hard node"))?;
        let Some(outputs) = file["outputs"].as_array_mut() else {
            return Err(unsuitable("it has no outputs"));
        };
        if let Some(output) = outputs.iter().find(|output| output["from"] == source) {
            let name = output["name"].as_str().unwrap_or_default().to_owned();
            return Ok((Self::parse(&self.name, self.text.clone(), None)?, name));
        }
        let name = "lab_filtered_map".to_owned();
        outputs.push(serde_json::json!({ "name": name, "from": source }));
        Ok((Self::parse(&self.name, file.to_string(), None)?, name))
    }

    /// An entry of a node as the file has it, such as its type; null where it is missing.
    #[must_use]
    pub fn node_entry(&self, node: &str, entry: &str) -> Value {
        nodes(&self.text)
            .into_iter()
            .find(|candidate| candidate["name"] == node)
            .map_or(Value::Null, |found| found[entry].clone())
    }

    /// The kernel of the graph's blur; `None` for a graph without a blur.
    pub fn kernel(&self) -> Result<Option<Kernel>, LabError> {
        let blurs: Vec<Blur> = nodes(&self.text)
            .iter()
            .filter(|node| node["type"] == "blur")
            .filter_map(|node| serde_json::from_value(node["properties"].clone()).ok())
            .collect();
        match blurs.as_slice() {
            [] => Ok(None),
            [blur] => blur
                .kernel
                .clone()
                .map(Some)
                .map_err(|error| LabError::Graph {
                    file: self.name.clone(),
                    error: GraphError::new(GraphErrorKind::Property, error.to_string()),
                }),
            _ => Err(LabError::unsuitable(
                &self.name,
                format!(
                    "it has {} blur nodes; the receiver bias and the truth are derived from one kernel",
                    blurs.len()
                ),
            )),
        }
    }
}

fn nodes(text: &str) -> Vec<Value> {
    let file: Value = serde_json::from_str(text).unwrap_or_default();
    file["nodes"].as_array().cloned().unwrap_or_default()
}

/// The text with a property of every node of a type replaced. The text has been parsed before.
fn with_property(text: &str, node_type: &str, property: &str, value: Value) -> String {
    let mut file: Value = serde_json::from_str(text).unwrap_or_default();
    if let Some(nodes) = file["nodes"].as_array_mut() {
        for node in nodes.iter_mut().filter(|node| node["type"] == node_type) {
            node["properties"][property] = value.clone();
        }
    }
    file.to_string()
}
