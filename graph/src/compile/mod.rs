//! From a graph to a plan: names, formats, sizes and shaders are checked before anything is created.

mod bytes;
mod limits;
mod memory;
mod parameters;
mod passes;
mod reflect;
mod settle;
mod slots;
mod touch;
mod usage;
mod wiring;
mod work;
mod workgroups;

use std::collections::BTreeMap;

use crate::graph::VERSION;
use crate::{
    Access, Capabilities, Connected, Direction, Graph, GraphError, GraphErrorKind, Home,
    NamedResource, NodeDesc, Plan, PlannedResource, ResourceDesc, Slot,
};
pub(crate) use reflect::numbers as binding_numbers;
use wiring::{Source, Wiring};

/// The imports that a host gives, by name.
pub type Imports = BTreeMap<String, ResourceDesc>;

/// A node that is part of the plan.
struct Described {
    node: usize,
    desc: NodeDesc,
    /// Index into the resources for every connected or made slot.
    slots: BTreeMap<String, usize>,
}

/// Compiles a graph for a device and for what the host gives.
///
/// Checks names, cycles, formats, sizes, usages, and every binding against its shader; leaves out nodes whose outputs
/// nobody takes; orders passes by stage; and lets resources share memory whose lives do not overlap. An import that the
/// host does not describe is taken as the graph file expects it. Creates nothing on the device.
pub fn compile(
    graph: &Graph,
    capabilities: &Capabilities,
    imports: &Imports,
) -> Result<Plan, GraphError> {
    let wiring = Wiring::of(graph)?;
    let mut resources = import_resources(graph, imports)?;
    let mut roots: Vec<usize> = (0..resources.len()).collect();
    let described = describe_all(graph, &wiring, capabilities, &mut resources, &mut roots)?;
    let outputs = outputs(graph, &described)?;
    let needed = wiring.needed(graph)?;
    let mut kept: Vec<&Described> = described
        .iter()
        .filter(|described| needed.contains(&described.node))
        .collect();
    stages_in_order(graph, &wiring, &described)?;
    changed_in_place_by_one(graph, &wiring, &described)?;
    // Stable: within a stage the order of dependencies remains.
    kept.sort_by_key(|described| described.desc.stage);

    let places = parameters::lay_out(graph, &kept, &resources, &roots, capabilities)?;
    let mut shaders = reflect::Shaders::default();
    let mut passes = Vec::new();
    for described in &kept {
        let name = &graph.nodes[described.node].name;
        let placed = |error: GraphError| {
            error
                .at_node(name)
                .at_position(graph.nodes[described.node].position)
        };
        let first = passes.len();
        let planner = passes::Planner {
            node: name,
            described,
            places: &places,
            roots: &roots,
            capabilities,
        };
        for pass in &described.desc.passes {
            let mut planned = planner.plan(pass, &mut resources).map_err(placed)?;
            usage::check_pass(&planned, &resources, capabilities).map_err(placed)?;
            shaders
                .bind(
                    pass,
                    &mut planned,
                    &resources,
                    capabilities.profile,
                    capabilities.bind_group,
                )
                .map_err(placed)?;
            passes.push(planned);
        }
        usage::check_outputs(described, &passes[first..]).map_err(placed)?;
    }
    let plan = Plan {
        version: VERSION,
        bind_group: capabilities.bind_group,
        passes,
        resources,
        memory: Vec::new(),
        imports: Vec::new(),
        outputs,
        parameters: places.layout,
    };
    Ok(settle::settle(plan, &kept, &roots))
}

/// What every node of a graph says about itself for these imports, in the order of the graph: slots with their
/// descriptions, passes and parameters. Nodes are described whether or not their outputs are taken.
pub fn describe(
    graph: &Graph,
    capabilities: &Capabilities,
    imports: &Imports,
) -> Result<Vec<NodeDesc>, GraphError> {
    let mut resources = import_resources(graph, imports)?;
    let mut roots = (0..resources.len()).collect();
    let wiring = Wiring::of(graph)?;
    let mut described = describe_all(graph, &wiring, capabilities, &mut resources, &mut roots)?;
    described.sort_by_key(|described| described.node);
    Ok(described
        .into_iter()
        .map(|described| described.desc)
        .collect())
}

/// Resources of the imports, in the order of the graph.
fn import_resources(graph: &Graph, imports: &Imports) -> Result<Vec<PlannedResource>, GraphError> {
    if let Some(name) = imports
        .keys()
        .find(|name| graph.imports.iter().all(|import| import.name != **name))
    {
        return Err(wiring::unknown(
            "import",
            name,
            graph.imports.iter().map(|import| import.name.as_str()),
            "the host describes an import that the graph does not have",
        ));
    }
    graph
        .imports
        .iter()
        .enumerate()
        .map(|(index, import)| {
            let desc = imports.get(&import.name).or(import.expected.as_ref()).ok_or_else(|| {
                GraphError::new(
                    GraphErrorKind::MissingImport,
                    format!(
                        "import '{}' is described neither by the host nor in the graph; describe its texture",
                        import.name
                    ),
                )
                .at_position(import.position)
            })?;
            Ok(PlannedResource {
                name: import.name.clone(),
                desc: desc.clone(),
                access: Access::default(),
                home: Home::Import(index),
            })
        })
        .collect()
}

/// Lets every node describe itself, upstream first, and makes the resources of its slots. `roots` gets, for each, the
/// resource whose layers and regions it follows: itself, or that of the slot whose extent it takes.
fn describe_all(
    graph: &Graph,
    wiring: &Wiring,
    capabilities: &Capabilities,
    resources: &mut Vec<PlannedResource>,
    roots: &mut Vec<usize>,
) -> Result<Vec<Described>, GraphError> {
    let mut described: Vec<Described> = Vec::new();
    for &node in &wiring.order {
        let graph_node = &graph.nodes[node];
        let placed = |error: GraphError| {
            error
                .at_node(&graph_node.name)
                .at_position(graph_node.position)
        };
        let mut slots = BTreeMap::new();
        for (slot, (source, edge)) in &wiring.inputs[node] {
            let resource = find(graph, &described, source)
                .map_err(|error| error.at_position(graph.edges[*edge].position))?;
            slots.insert(slot.clone(), resource);
        }
        let inputs: BTreeMap<String, ResourceDesc> = slots
            .iter()
            .map(|(slot, &resource)| (slot.clone(), resources[resource].desc.clone()))
            .collect();
        let desc = graph_node
            .node
            .describe(&Connected::new(&inputs, capabilities))
            .map_err(|error| placed(with_connected(error, &inputs)))?;
        let takes = |slot: &&Slot| matches!(slot.direction, Direction::In | Direction::InOut);
        let mut names = desc
            .slots
            .iter()
            .filter(takes)
            .map(|slot| slot.name.as_str());
        for (slot, (_, edge)) in &wiring.inputs[node] {
            if !names.clone().any(|name| name == slot) {
                let remark = "an edge leads to an input of the node";
                return Err(wiring::unknown("input", slot, names.by_ref(), remark)
                    .at_node(&graph_node.name)
                    .at_slot(slot)
                    .at_position(graph.edges[*edge].position));
            }
        }
        let resolved = slots::resolve(&desc, &inputs, capabilities).map_err(placed)?;
        // In the order of the slots: one may take its extent from another that was made before it.
        for slot in &desc.slots {
            let Some(made) = resolved.get(&slot.name) else {
                continue;
            };
            if slots.contains_key(&slot.name) {
                continue;
            }
            let index = resources.len();
            resources.push(PlannedResource {
                name: format!("{}.{}", graph_node.name, slot.name),
                desc: made.clone(),
                access: Access::default(),
                // Settled once lifetimes are known.
                home: Home::Memory(0),
            });
            let root = slots::extent_from(slot).and_then(|from| slots.get(from));
            roots.push(root.map_or(index, |&from| roots[from]));
            slots.insert(slot.name.clone(), index);
        }
        described.push(Described { node, desc, slots });
    }
    Ok(described)
}

/// A missing input may be a misspelt one: what is connected is said along with it.
fn with_connected(mut error: GraphError, inputs: &BTreeMap<String, ResourceDesc>) -> GraphError {
    if error.kind == GraphErrorKind::MissingInput && !inputs.is_empty() {
        let names: Vec<String> = inputs.keys().map(|name| format!("'{name}'")).collect();
        error.message += &format!(" (what is connected is {})", names.join(", "));
    }
    error
}

/// The resource behind a source.
fn find(graph: &Graph, described: &[Described], source: &Source) -> Result<usize, GraphError> {
    match source {
        Source::Import(import) => Ok(*import),
        Source::Node(node, slot) => {
            let name = &graph.nodes[*node].name;
            let owner = described.iter().find(|described| described.node == *node);
            let slots = owner.map_or(&[][..], |owner| &owner.desc.slots);
            let gives = |direction| matches!(direction, Direction::Out | Direction::InOut);
            let known = slots
                .iter()
                .any(|candidate| candidate.name == *slot && gives(candidate.direction));
            owner
                .filter(|_| known)
                .and_then(|owner| owner.slots.get(slot).copied())
                .ok_or_else(|| {
                    wiring::unknown(
                        "output",
                        slot,
                        slots
                            .iter()
                            .filter(|candidate| gives(candidate.direction))
                            .map(|candidate| candidate.name.as_str()),
                        "an edge starts from an output of a node",
                    )
                    .at_node(name)
                    .at_slot(slot)
                })
        }
    }
}

fn outputs(graph: &Graph, described: &[Described]) -> Result<Vec<NamedResource>, GraphError> {
    graph
        .outputs
        .iter()
        .map(|output| {
            let resource = wiring::source(graph, &output.from)
                .and_then(|source| find(graph, described, &source))
                .map_err(|error| error.at_position(output.position))?;
            Ok(NamedResource {
                name: output.name.clone(),
                resource,
            })
        })
        .collect()
}

/// A node cannot be recorded before one that it depends on.
fn stages_in_order(
    graph: &Graph,
    wiring: &Wiring,
    described: &[Described],
) -> Result<(), GraphError> {
    let stage = |node: usize| {
        described
            .iter()
            .find(|described| described.node == node)
            .map(|described| described.desc.stage)
    };
    for (node, inputs) in wiring.inputs.iter().enumerate() {
        for (source, edge) in inputs.values() {
            let Source::Node(upstream, _) = source else {
                continue;
            };
            if stage(*upstream) > stage(node) {
                return Err(GraphError::new(
                    GraphErrorKind::StageOrder,
                    format!(
                        "it is recorded before '{}', whose output it reads; connect it to a node of an earlier stage",
                        graph.nodes[*upstream].name
                    ),
                )
                .at_node(&graph.nodes[node].name)
                .at_position(graph.edges[*edge].position));
            }
        }
    }
    Ok(())
}

/// What a node changes in place nobody else takes: whether they saw it before or after would depend on the order.
fn changed_in_place_by_one(
    graph: &Graph,
    wiring: &Wiring,
    described: &[Described],
) -> Result<(), GraphError> {
    for described in described {
        let name = &graph.nodes[described.node].name;
        let in_place = |slot: &&Slot| slot.direction == Direction::InOut;
        for slot in described.desc.slots.iter().filter(in_place) {
            let Some((_, edge)) = wiring.inputs[described.node].get(&slot.name) else {
                continue;
            };
            let from = &graph.edges[*edge].from;
            let other_edge = graph
                .edges
                .iter()
                .enumerate()
                .find(|(other, candidate)| other != edge && candidate.from == *from)
                .map(|(_, other)| other.position);
            let output = graph
                .outputs
                .iter()
                .find(|output| output.from == *from)
                .map(|output| output.position);
            if let Some(position) = other_edge.or(output) {
                return Err(GraphError::new(
                    GraphErrorKind::TwoWriters,
                    format!(
                        "'{from}' is changed in place here and taken elsewhere, too; take '{name}.{}' there instead",
                        slot.name
                    ),
                )
                .at_node(name)
                .at_slot(&slot.name)
                .at_position(position));
            }
        }
    }
    Ok(())
}

/// A node that contradicts itself.
fn declaration(message: String) -> GraphError {
    GraphError::new(GraphErrorKind::Declaration, message)
}
