//! A graph file with what the lab reads from it besides the graph: its kernel, its technique and its storage.

mod technique;

use std::path::Path;

use moment_shadows::{Kernel, Storage};
use moment_shadows_graph::nodes::{Blur, BlurKernel};
use moment_shadows_graph::{Graph, GraphError, GraphErrorKind, TextureDesc, command};
use serde_json::{Value, json};

use crate::error::LabError;

pub(crate) use technique::LARGEST_RESOLVED_RADIUS;

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
    /// Reads a file. With a storage, every node that resolves uses that instead of its own.
    pub fn read(path: &Path, storage: Option<Storage>) -> Result<Self, LabError> {
        Self::with_storage(command::GraphFile::read(path)?, storage)
    }

    /// The graph of a text that errors name by `name`.
    pub fn parse(name: &str, text: String, storage: Option<Storage>) -> Result<Self, LabError> {
        Self::with_storage(command::GraphFile::parse(name, text)?, storage)
    }

    fn with_storage(file: command::GraphFile, storage: Option<Storage>) -> Result<Self, LabError> {
        let command::GraphFile { name, text, graph } = file;
        let file = Self { name, text, graph };
        if let Some(node) = file.node_of("translucent_casters") {
            return Err(file.unsuitable(format!(
                "node '{}' leaves a pass to a host that draws translucent casters, and no command draws any for a graph file; take the node out, \
                 and what is opaque is judged, or judge translucent casters by 'moment-shadows-lab transmittance'",
                node["name"].as_str().unwrap_or_default()
            )));
        }
        match storage {
            None => Ok(file),
            Some(storage) => {
                let file = file.written_once(storage)?.unwrap_or(file);
                let Self { text, graph, .. } = file.edited(|file| {
                    for node in items(file, "nodes").filter(|node| technique::resolves(node)) {
                        technique::told_how_to_resolve(node)["storage"] = storage.name().into();
                        technique::round_as_can_be(node);
                    }
                })?;
                // Edges and outputs keep their places in the file.
                let nodes = graph.nodes;
                let graph = Graph {
                    nodes,
                    ..file.graph
                };
                Ok(Self {
                    text,
                    graph,
                    ..file
                })
            }
        }
    }

    /// This graph with something in its file changed.
    fn edited(&self, edit: impl FnOnce(&mut Value)) -> Result<Self, LabError> {
        let mut file: Value = serde_json::from_str(&self.text).unwrap_or_default();
        edit(&mut file);
        Self::parse(&self.name, file.to_string(), None)
    }

    /// This graph with its shadow intensity written in single precision, so that it can be measured.
    pub fn in_single_precision(&self) -> Result<Self, LabError> {
        self.edited(|file| {
            for node_type in ["shade_hard", "shade_soft"] {
                set_property(file, node_type, "format", "r32float".into());
            }
        })
    }

    /// This graph with shadows at contacts after its `shade_hard` node, of so many steps, and the output of what maps say without them.
    pub fn with_contact_shadows(&self, steps: u32) -> Result<(Self, String), LabError> {
        let shade = self.node_of("shade_hard").ok_or_else(|| {
            self.unsuitable("it has no shade_hard node after which contacts could be marched")
        })?;
        let slot = |slot| format!("{}.{slot}", shade["name"].as_str().unwrap_or_default());
        let intensity = slot("shadow_intensity");
        let camera = self.find("edges", "to", &slot("camera_depth"));
        let camera = camera.map_or(Value::Null, |edge| edge["from"].clone());
        let file = self.edited(|file| {
            for output in items(file, "outputs").filter(|output| output["from"] == *intensity) {
                output["from"] = "contact.shadow_intensity".into();
            }
            let properties = json!({ "steps": steps });
            let node =
                json!({ "name": "contact", "type": "contact_shadows", "properties": properties });
            push(file, "nodes", node);
            for (from, to) in [
                (camera, "camera_depth"),
                (intensity.as_str().into(), "intensity"),
            ] {
                let edge = json!({ "from": from, "to": format!("contact.{to}") });
                push(file, "edges", edge);
            }
        })?;
        file.with_output(&intensity, "lab_intensity_of_maps")
    }

    /// What the file says of an import that is a texture.
    #[must_use]
    pub fn import(&self, name: &str) -> Option<&TextureDesc> {
        let mut imports = self.graph.imports.iter();
        let import = imports.find(|import| import.name == name)?;
        import.value.as_ref()?.texture()
    }

    /// This graph with an import of another width and height.
    pub fn with_import_size(&self, name: &str, size: [u32; 2]) -> Result<Self, LabError> {
        if self.import(name).is_none() {
            return Err(self.unsuitable(format!(
                "it says nothing of a texture '{name}' that could be of another size"
            )));
        }
        self.edited(|file| {
            for import in items(file, "imports").filter(|import| import["name"] == name) {
                import["texture"]["size"] = json!(size);
            }
        })
    }

    /// Whether a node of this type is in the graph.
    #[must_use]
    pub fn has_node(&self, node_type: &str) -> bool {
        self.node_of(node_type).is_some()
    }

    /// This graph without mip levels: what read a downsampled map reads the map itself.
    pub fn without_mip_levels(&self) -> Result<Self, LabError> {
        let nodes = nodes(&self.text);
        let downsampled: Vec<String> = nodes
            .iter()
            .filter(|node| node["type"] == "downsample")
            .map(|node| format!("{}.map", node["name"].as_str().unwrap_or_default()))
            .collect();
        self.edited(|file| {
            let mut sources = Vec::new();
            if let Some(edges) = file["edges"].as_array_mut() {
                let ends = |edge: &Value| downsampled.iter().any(|map| edge["to"] == map.as_str());
                sources = edges.extract_if(.., |edge| ends(edge)).collect();
            }
            for list in ["edges", "outputs"] {
                for item in items(file, list) {
                    if let Some(source) = sources.iter().find(|edge| edge["to"] == item["from"]) {
                        item["from"] = source["from"].clone();
                    }
                }
            }
            if let Some(nodes) = file["nodes"].as_array_mut() {
                nodes.retain(|node| node["type"] != "downsample");
            }
            for node in items(file, "nodes") {
                remove_property(node, "mip_levels");
            }
        })
    }

    /// This graph with a Gaussian of this radius and 0.6 times that as its standard deviation in place of its kernel.
    pub fn with_radius(&self, radius: u32) -> Result<Self, LabError> {
        self.with_kernel(&json!({ "radius": radius }))
    }

    /// This graph with another kernel, as files describe it.
    pub fn with_kernel(&self, kernel: &Value) -> Result<Self, LabError> {
        if self.kernel()?.is_none() {
            return Err(
                self.unsuitable("it has no blur node whose radius could be another; add one")
            );
        }
        let kernel = kernel.clone();
        let file = self.edited(|file| set_property(file, "blur", "kernel", kernel))?;
        file.kernel()?;
        Ok(file)
    }

    /// This graph with the filtered map that its `shade_hard` node looks up as a further output, and that output's name.
    pub fn with_filtered_map(&self) -> Result<(Self, String), LabError> {
        let unsuitable = |reason: &str| self.unsuitable(reason);
        let shade = self
            .node_of("shade_hard")
            .ok_or_else(|| unsuitable("it has no shade_hard node whose map could be judged"))?;
        let slot = format!("{}.map", shade["name"].as_str().unwrap_or_default());
        let source = self
            .find("edges", "to", &slot)
            .map(|edge| edge["from"].as_str().unwrap_or_default().to_owned())
            .ok_or_else(|| unsuitable("no edge leads to the moments of its shade_hard node"))?;
        self.with_output(&source, "lab_filtered_map")
    }

    /// This graph with what a slot gives as a further output of this name, and the output's name, if there is one already its.
    pub(crate) fn with_output(&self, slot: &str, name: &str) -> Result<(Self, String), LabError> {
        if let Some(output) = self.find("outputs", "from", slot) {
            let name = output["name"].as_str().unwrap_or_default().to_owned();
            return Ok((self.edited(|_| ())?, name));
        }
        let output = json!({ "name": name, "from": slot });
        let file = self.edited(|file| push(file, "outputs", output))?;
        Ok((file, name.to_owned()))
    }

    /// An entry of a node as the file has it, such as its type; null where it is missing.
    #[must_use]
    pub fn node_entry(&self, node: &str, entry: &str) -> Value {
        self.find("nodes", "name", node)
            .map_or(Value::Null, |found| found[entry].clone())
    }

    /// The first item of one of the file's lists whose entry `key` is `value`.
    fn find(&self, list: &str, key: &str, value: &str) -> Option<Value> {
        let mut file: Value = serde_json::from_str(&self.text).unwrap_or_default();
        let found = items(&mut file, list).find(|item| item[key] == value);
        found.map(|item| item.take())
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
            [blur] => match &blur.kernel {
                Ok(BlurKernel::Texels(kernel)) => Ok(Some(kernel.clone())),
                Ok(BlurKernel::Scene { .. }) => Err(self.unsuitable(
                    "its kernel has a 'width' in scene units, which a session makes kernels from; give it a 'sigma' in texels",
                )),
                Err(error) => Err(GraphError::new(GraphErrorKind::Property, error.to_string()))
                    .map_err(LabError::graph(&self.name)),
            },
            _ => Err(self.unsuitable(format!(
                "it has {} blur nodes; the receiver bias and the truth are derived from one kernel",
                blurs.len()
            ))),
        }
    }
}

fn nodes(text: &str) -> Vec<Value> {
    let file: Value = serde_json::from_str(text).unwrap_or_default();
    file["nodes"].as_array().cloned().unwrap_or_default()
}

/// The items of one of the file's lists.
fn items<'a>(file: &'a mut Value, list: &str) -> impl Iterator<Item = &'a mut Value> + use<'a> {
    file[list].as_array_mut().into_iter().flatten()
}

fn push(file: &mut Value, list: &str, item: Value) {
    if let Some(items) = file[list].as_array_mut() {
        items.push(item);
    }
}

/// Replaces a property of every node of a type.
fn set_property(file: &mut Value, node_type: &str, property: &str, value: Value) {
    for node in items(file, "nodes").filter(|node| node["type"] == node_type) {
        node["properties"][property] = value.clone();
    }
}

fn remove_property(node: &mut Value, property: &str) {
    if let Some(properties) = node["properties"].as_object_mut() {
        properties.remove(property);
    }
}
