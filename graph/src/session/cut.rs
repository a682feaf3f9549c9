//! A graph cut in two: what is made once for all cameras, and what each camera has of its own.

use std::collections::BTreeSet;

use crate::{Edge, Endpoint, Graph, Import, NodeDesc, Output, Stage};

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
        edges
            .filter(|edge| edge.to.slot.as_deref() == Some("depth") && edge.from.slot.is_none())
            .map(|edge| edge.from.owner.as_str())
            .collect()
    }

    /// Whether light maps are made of an import.
    pub(super) fn of_maps(&self, import: &str) -> bool {
        self.maps.imports.iter().any(|it| it.name == import)
    }
}

/// Parameters of nodes that a camera decides on.
const OF_CAMERAS: [&str; 4] = [
    "ViewParameters",
    "RectifyMomentsParameters",
    "IntegrateScatteringParameters",
    "CompositeScatteringParameters",
];

/// Cuts a graph whose nodes say `descs` about themselves, in the order of the graph.
pub(super) fn cut(graph: Graph, descs: &[NodeDesc]) -> Cut {
    let pictured = of_cameras(&graph, descs);
    let is_pictured = |owner: &str| pictured.contains(owner);
    let is_import = |owner: &str| graph.imports.iter().any(|import| import.name == owner);

    let mut maps = empty();
    let mut picture = empty();
    let mut crossing: Vec<(Endpoint, String)> = Vec::new();
    let outputs = graph.outputs.iter().map(|output| &output.name);
    let imports = graph.imports.iter().map(|import| &import.name);
    let mut names: BTreeSet<String> = outputs.chain(imports).cloned().collect();
    for edge in graph.edges {
        if !is_pictured(&edge.to.owner) {
            maps.edges.push(edge);
            continue;
        }
        let crosses = !is_import(&edge.from.owner) && !is_pictured(&edge.from.owner);
        let from = if crosses {
            let known = crossing.iter().find(|(from, _)| *from == edge.from);
            let known = known.map(|(_, name)| name.clone());
            let owner = known.unwrap_or_else(|| {
                // Names of a graph have no '.'.
                let mut name = edge.from.to_string().replace('.', " ");
                while names.contains(&name) {
                    name.push('\'');
                }
                names.insert(name.clone());
                crossing.push((edge.from.clone(), name.clone()));
                name
            });
            Endpoint { owner, slot: None }
        } else {
            edge.from
        };
        picture.edges.push(Edge { from, ..edge });
    }
    for (from, name) in crossing {
        picture.imports.push(Import {
            name: name.clone(),
            expected: None,
            position: None,
        });
        maps.outputs.push(Output {
            name,
            from,
            position: None,
        });
    }
    for output in graph.outputs {
        let part = if is_pictured(&output.from.owner) {
            &mut picture
        } else {
            &mut maps
        };
        part.outputs.push(output);
    }
    for import in graph.imports {
        let used = |part: &Graph| part.edges.iter().any(|edge| edge.from.owner == import.name);
        let [of_maps, of_picture] = [&maps, &picture].map(used);
        if of_picture {
            picture.imports.push(import.clone());
        }
        if of_maps || !of_picture {
            maps.imports.push(import);
        }
    }
    for node in graph.nodes {
        if is_pictured(&node.name) {
            picture.nodes.push(node);
        } else {
            maps.nodes.push(node);
        }
    }
    Cut { maps, picture }
}

/// The names of nodes that depend on a camera, by their parameters or by what is connected to them.
fn of_cameras(graph: &Graph, descs: &[NodeDesc]) -> BTreeSet<String> {
    let mut found: BTreeSet<String> = graph
        .nodes
        .iter()
        .zip(descs)
        .filter(|(_, desc)| {
            let block = desc.parameters.as_ref().map(|block| block.name.as_str());
            desc.stage == Stage::AfterMainPass || block.is_some_and(|it| OF_CAMERAS.contains(&it))
        })
        .map(|(node, _)| node.name.clone())
        .collect();
    loop {
        let before = found.len();
        for edge in &graph.edges {
            if found.contains(&edge.from.owner) {
                found.insert(edge.to.owner.clone());
            }
        }
        if found.len() == before {
            return found;
        }
    }
}

fn empty() -> Graph {
    Graph {
        imports: Vec::new(),
        nodes: Vec::new(),
        edges: Vec::new(),
        outputs: Vec::new(),
        notes: Vec::new(),
    }
}
