//! A graph cut in two: what is made once for all cameras, and what each camera has of its own.

use std::collections::{BTreeMap, BTreeSet};

use crate::{Edge, Graph, Named, NodeDesc, Stage};

/// The two parts of a graph.
#[derive(Debug)]
pub(super) struct Cut {
    /// What follows from lights alone: filtered maps.
    pub(super) maps: Graph,
    /// What follows from a camera, too. It imports what it takes of `maps`, whose outputs have the same names.
    pub(super) picture: Graph,
}

impl Cut {
    /// The imports that are connected as depth maps of lights.
    pub(super) fn light_depths(&self) -> BTreeSet<&str> {
        let edges = self.maps.edges.iter().chain(&self.picture.edges);
        let depths =
            edges.filter(|edge| slot(&edge.to) == "depth" && owner(&edge.from) == edge.from);
        depths.map(|edge| edge.from.as_str()).collect()
    }

    /// Whether light maps are made of an import.
    pub(super) fn of_maps(&self, import: &str) -> bool {
        self.maps.imports.iter().any(|it| it.name == import)
    }
}

/// The node of `node.slot`, or an import.
pub(super) fn owner(end: &str) -> &str {
    end.split('.').next().unwrap_or(end)
}

/// The slot of `node.slot`.
pub(super) fn slot(end: &str) -> &str {
    end.split_once('.').map_or("", |(_, slot)| slot)
}

/// Parameters of nodes that a camera decides on.
const OF_CAMERAS: [&str; 7] = [
    "ViewParameters",
    "ContactShadowParameters",
    "RectifyMomentsParameters",
    "IntegrateScatteringParameters",
    "CompositeScatteringParameters",
    "MarchScatteringParameters",
    "UpsampleScatteringParameters",
];

/// Cuts a graph whose nodes say `descs` about themselves, in the order of the graph.
pub(super) fn cut(graph: Graph, descs: &[NodeDesc]) -> Cut {
    let pictured = of_cameras(&graph, descs);
    let is_pictured = |end: &str| pictured.contains(owner(end));
    let (mut maps, mut picture) = (Graph::default(), Graph::default());
    let outputs = graph.outputs.iter().map(|output| &output.name);
    let imports = graph.imports.iter().map(|import| &import.name);
    let mut names: BTreeSet<String> = outputs.chain(imports).cloned().collect();
    // What goes from one part to the other, and the name that it has on the way.
    let mut crossing: BTreeMap<String, String> = BTreeMap::new();
    for edge in graph.edges {
        if !is_pictured(&edge.to) {
            maps.edges.push(edge);
        } else if slot(&edge.from).is_empty() || is_pictured(&edge.from) {
            picture.edges.push(edge);
        } else {
            let name = crossing.entry(edge.from).or_insert_with_key(|from| {
                // No name of a graph has a '.'.
                let mut name = from.replace('.', " ");
                while !names.insert(name.clone()) {
                    name.push('\'');
                }
                name
            });
            let from = name.clone();
            picture.edges.push(Edge { from, ..edge });
        }
    }
    for (from, name) in crossing {
        picture.imports.push(Named::new(name.as_str(), None));
        maps.outputs.push(Named::new(name, from));
    }
    for output in graph.outputs {
        let of_picture = is_pictured(&output.value);
        let part = if of_picture { &mut picture } else { &mut maps };
        part.outputs.push(output);
    }
    let nodes = graph.nodes.into_iter();
    (picture.nodes, maps.nodes) = nodes.partition(|node| is_pictured(&node.name));
    for import in graph.imports {
        let used = |part: &Graph| part.edges.iter().any(|edge| edge.from == import.name);
        let [of_maps, of_picture] = [&maps, &picture].map(used);
        if of_picture {
            picture.imports.push(import.clone());
        }
        if of_maps || !of_picture {
            maps.imports.push(import);
        }
    }
    Cut { maps, picture }
}

/// The names of nodes that depend on a camera, by their parameters or by what is connected to them.
fn of_cameras(graph: &Graph, descs: &[NodeDesc]) -> BTreeSet<String> {
    let depends = |desc: &NodeDesc| {
        let block = desc.parameters.as_ref().map(|block| block.name.as_str());
        desc.stage == Stage::AfterMainPass || block.is_some_and(|it| OF_CAMERAS.contains(&it))
    };
    let nodes = graph.nodes.iter().zip(descs);
    let mut found: BTreeSet<String> = nodes
        .filter(|(_, desc)| depends(desc))
        .map(|(node, _)| node.name.clone())
        .collect();
    loop {
        let before = found.len();
        for edge in &graph.edges {
            if found.contains(owner(&edge.from)) {
                found.insert(owner(&edge.to).to_owned());
            }
        }
        if found.len() == before {
            return found;
        }
    }
}
