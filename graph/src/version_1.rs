//! Graph files of version 1: names that have changed since.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::Graph;
use crate::graph::VERSION;

/// Node types of version 1 that have another name now.
const TYPES: [(&str, &str); 3] = [
    ("resolve_moments", "resolve"),
    ("blur_moments", "blur"),
    ("downsample_moments", "downsample"),
];

/// Types whose slot `moments` is called `map` now.
const MAP_SLOTS: [&str; 7] = [
    "resolve",
    "blur",
    "downsample",
    "summed_area_table",
    "debug_moments",
    "shade_hard",
    "rectify_moments",
];

/// Names that have changed, and a note for each one that a file uses.
#[derive(Default)]
pub(crate) struct Renamed {
    /// The nodes that have a slot `map`.
    with_map: BTreeMap<String, &'static str>,
    /// What to change in the file.
    pub(crate) notes: Vec<String>,
}

impl Renamed {
    /// The type's name now.
    pub(crate) fn type_name<'a>(&mut self, node: &str, type_name: &'a str) -> &'a str {
        let renamed = TYPES.iter().find(|(old, _)| *old == type_name);
        let now = renamed.map_or(type_name, |(_, now)| now);
        if now != type_name {
            self.note(format!("the node type '{type_name}' is called '{now}'"));
        }
        if let Some(with_map) = MAP_SLOTS.iter().find(|name| **name == now) {
            self.with_map.insert(node.to_owned(), with_map);
        }
        now
    }

    fn note(&mut self, note: String) {
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// Gives an end of a connection (`node.slot`) its name of now, once all nodes are known.
    pub(crate) fn endpoint(&mut self, end: &mut String) {
        let Some((node, "moments")) = end.split_once('.') else {
            return;
        };
        if let Some(type_name) = self.with_map.get(node) {
            self.note(format!(
                "the slot 'moments' of nodes '{type_name}' is called 'map'"
            ));
            *end = format!("{node}.map");
        }
    }
}

impl Graph {
    /// Rewrites a graph file of version 1 to the current one, for tools that change files before they parse them; returns
    /// what has changed. Anything but a graph file of version 1 stays as it is, for [`parse`](Self::parse) to judge.
    pub fn upgrade(file: &mut Value) -> Vec<String> {
        let mut renamed = Renamed::default();
        if file["version"] != 1 {
            return renamed.notes;
        }
        file["version"] = VERSION.into();
        for node in array(file, "nodes") {
            if let (Some(name), Some(old)) = (node["name"].as_str(), node["type"].as_str()) {
                node["type"] = renamed.type_name(name, old).into();
            }
        }
        for list in ["edges", "outputs"] {
            for connection in array(file, list) {
                for end in ["from", "to"] {
                    if let Some(Value::String(end)) = connection.get_mut(end) {
                        renamed.endpoint(end);
                    }
                }
            }
        }
        renamed.notes
    }
}

/// The objects of a list of the file.
fn array<'a>(file: &'a mut Value, name: &str) -> impl Iterator<Item = &'a mut Value> {
    let list = file.get_mut(name).and_then(Value::as_array_mut);
    list.into_iter().flatten().filter(|value| value.is_object())
}
