//! From a graph to a plan, with nothing created on the device:
//!
//! 1. `wiring` looks up names and orders nodes;
//! 2. nodes describe themselves, upstream first; `slots` checks what is connected and says what is made, within `limits`;
//! 3. `order` checks what nodes take of each other, and nodes whose outputs nobody takes are left out;
//! 4. `parameters` lays out uniform data;
//! 5. `passes` replaces slots by resources, `workgroups` and `bytes` count, `usage` checks what a pass does at once;
//! 6. `reflect` compares passes with their shaders;
//! 7. `lifetimes` lets resources share memory, and passes are told which they follow;
//! 8. `needs` says what a device has to have.

mod bytes;
mod fields;
mod lifetimes;
mod limits;
mod needs;
mod off;
mod order;
mod parameters;
mod passes;
mod reflect;
mod slots;
mod usage;
mod wiring;
mod workgroups;

use std::collections::{BTreeMap, BTreeSet};

use crate::error::unknown;
use crate::{
    Access, Capabilities, Connected, Direction, Graph, GraphError, GraphErrorKind, Home, Lives,
    Named, NodeDesc, Plan, PlannedDevice, PlannedExtent, PlannedResource, ResourceDesc, Slot,
    SlotResource,
};
pub(crate) use reflect::numbers as binding_numbers;
use wiring::Wiring;

/// An import, or what a node makes, whether or not a pass touches it. Imports come first.
struct Known {
    name: String,
    desc: ResourceDesc,
    /// Some slot that it is connected to keeps its contents from frame to frame.
    persistent: bool,
    /// The one whose layers and regions it follows: itself, or that of the slot whose extent it takes.
    root: usize,
    /// Texels of the root for each texel.
    per: [u32; 2],
}

/// A node's description.
struct Described {
    node: usize,
    desc: NodeDesc,
    /// Index into what is known for every connected or made slot.
    slots: BTreeMap<String, usize>,
}

impl Described {
    /// How the node's passes may touch a slot.
    fn access(&self, slot: &str) -> Access {
        let mut slots = self.desc.slots.iter();
        let slot = slots.find(|candidate| candidate.name == slot);
        slot.map_or(Access::default(), |slot| slot.resource.access())
    }
}

impl Graph {
    /// Compiles the graph for a device and for the imports that a host gives, by name.
    ///
    /// Checks names, cycles, formats, sizes, usages, and every binding against its shader; leaves out nodes whose outputs
    /// nobody takes; orders passes by stage; and lets resources share memory whose lives do not overlap. An import that
    /// the host does not describe is taken as the graph file expects it. Creates nothing on the device.
    pub fn compile(
        &self,
        capabilities: &Capabilities,
        imports: &[(&str, ResourceDesc)],
    ) -> Result<Plan, GraphError> {
        let wiring = Wiring::of(self)?;
        let mut known = import_resources(self, imports)?;
        let mut kept = describe_all(self, &wiring, capabilities, &mut known)?;
        let outputs = outputs(self, &kept)?;
        let needed = wiring.needed(self)?;
        order::stages_in_order(self, &wiring, &kept)?;
        order::changed_in_place_by_one(self, &wiring, &kept)?;
        kept.retain(|described| needed.contains(&described.node));
        // Stable: within a stage the order of dependencies remains.
        kept.sort_by_key(|described| described.desc.stage);

        let layout = parameters::lay_out(self, &kept, &known, capabilities)?;
        let used = used(&kept, &outputs);
        let indices: BTreeMap<usize, usize> =
            (0..).zip(&used).map(|(new, &old)| (old, new)).collect();
        let mut plan = Plan {
            version: Plan::VERSION,
            device: PlannedDevice::default(),
            bind_group: capabilities.bind_group,
            shaders: Vec::new(),
            passes: Vec::new(),
            resources: Vec::new(),
            memory: Vec::new(),
            imports: Vec::new(),
            outputs: outputs
                .into_iter()
                .map(|output| Named::new(output.name, indices[&output.value]))
                .collect(),
            parameters: layout,
            off: Vec::new(),
        };
        for &index in &used {
            let known = &known[index];
            let mut home = Home::Memory(0);
            if index < self.imports.len() {
                home = Home::Import(plan.imports.len());
                let import = Named::new(known.name.clone(), plan.resources.len());
                plan.imports.push(import);
            }
            plan.resources.push(PlannedResource {
                name: known.name.clone(),
                desc: known.desc.clone(),
                usage: Vec::new(),
                extent: None,
                lives: Lives::Frame,
                home,
            });
        }
        for (resource, &index) in plan.resources.iter_mut().zip(&used) {
            let Known { root, per, .. } = known[index];
            let mut imports = plan.imports.iter();
            let import = imports.position(|import| import.name == known[root].name);
            resource.extent = import.map(|import| PlannedExtent { import, per });
        }
        imports_of_one_size(&mut plan, &kept, &indices);
        let mut shaders = reflect::Shaders::default();
        for described in &kept {
            let node = &self.nodes[described.node];
            let placed = |error| node.placed(error);
            for pass in &described.desc.passes {
                let planner = passes::Planner {
                    node: &node.name,
                    described,
                    pass,
                    known: &known,
                    indices: &indices,
                    layout: &plan.parameters,
                    capabilities,
                };
                let resources = &mut plan.resources;
                let mut planned = planner.plan(resources).map_err(placed)?;
                usage::check_pass(&planned, resources, capabilities).map_err(placed)?;
                shaders
                    .bind(pass, &mut planned, resources, capabilities)
                    .map_err(placed)?;
                planned.dynamic_offsets = plan.parameters.offsets(&planned.bindings);
                plan.passes.push(planned);
            }
            usage::check_outputs(described).map_err(placed)?;
            let stand_ins = off::of(&node.name, described, &known, &indices);
            plan.off.extend(stand_ins.map_err(placed)?);
        }
        let used: Vec<&Known> = used.iter().map(|&index| &known[index]).collect();
        lifetimes::share_memory(&mut plan, &used);
        plan.update_hazards();
        shaders.add_fields(&mut plan.parameters);
        plan.device = needs::of(&plan, capabilities);
        plan.shaders = shaders.into_texts();
        Ok(plan)
    }

    /// What every node says about itself for these imports, in the order of the graph: slots with their descriptions,
    /// passes and parameters. Nodes are described whether or not their outputs are taken.
    pub fn describe(
        &self,
        capabilities: &Capabilities,
        imports: &[(&str, ResourceDesc)],
    ) -> Result<Vec<NodeDesc>, GraphError> {
        let mut known = import_resources(self, imports)?;
        let wiring = Wiring::of(self)?;
        let mut described = describe_all(self, &wiring, capabilities, &mut known)?;
        described.sort_by_key(|described| described.node);
        Ok(described
            .into_iter()
            .map(|described| described.desc)
            .collect())
    }
}

/// What is known that the plan has: everything that passes touch, and then what is only handed through to an output.
fn used(kept: &[Described], outputs: &[Named<usize>]) -> Vec<usize> {
    let touched = |described: &Described| {
        let passes = described.desc.passes.iter();
        let slots = passes.flat_map(|pass| pass.touched());
        let known = slots.filter_map(|(slot, _)| described.slots.get(slot).copied());
        known.collect::<Vec<_>>()
    };
    let touched: BTreeSet<usize> = kept.iter().flat_map(touched).collect();
    let mut used: Vec<usize> = touched.into_iter().collect();
    for output in outputs {
        if !used.contains(&output.value) {
            used.push(output.value);
        }
    }
    used
}

/// Lets the extent of an import be that of another one, where a slot says so. The sizes are equal already.
fn imports_of_one_size(plan: &mut Plan, kept: &[Described], indices: &BTreeMap<usize, usize>) {
    for described in kept {
        for slot in described
            .desc
            .slots
            .iter()
            .filter(|it| it.direction.takes())
        {
            let find = |slot: &str| indices.get(described.slots.get(slot)?).copied();
            let from = slots::extent_from(slot).and_then(|(from, per)| Some((find(from)?, per)));
            if let (Some(to), Some((from, [1, 1]))) = (find(&slot.name), from)
                && matches!(plan.resources[to].home, Home::Import(_))
            {
                plan.resources[to].extent = plan.resources[from].extent;
            }
        }
    }
}

/// The imports, in the order of the graph.
fn import_resources(
    graph: &Graph,
    imports: &[(&str, ResourceDesc)],
) -> Result<Vec<Known>, GraphError> {
    let mut names = graph.imports.iter().map(|import| import.name.as_str());
    if let Some((name, _)) = imports
        .iter()
        .find(|(name, _)| names.clone().all(|known| known != *name))
    {
        let remark = "the host describes an import that the graph does not have";
        return Err(unknown("import", name, names.by_ref(), remark));
    }
    let resources = graph.imports.iter().enumerate().map(|(root, import)| {
        let name = &import.name;
        let given = imports.iter().find(|(given, _)| given == name);
        let desc = given.map(|(_, desc)| desc).or(import.value.as_ref());
        let desc = desc.ok_or_else(|| {
            GraphError::new(
                GraphErrorKind::MissingImport,
                format!(
                    "import '{name}' is described neither by the host nor in the graph; describe its texture"
                ),
            )
            .at_position(import.position)
        })?;
        Ok(Known {
            name: name.clone(),
            desc: desc.clone(),
            persistent: false,
            root,
            per: [1; 2],
        })
    });
    resources.collect()
}

/// Lets every node describe itself, upstream first, and makes the resources of its slots.
fn describe_all(
    graph: &Graph,
    wiring: &Wiring,
    capabilities: &Capabilities,
    known: &mut Vec<Known>,
) -> Result<Vec<Described>, GraphError> {
    let mut described: Vec<Described> = Vec::new();
    for &node in &wiring.order {
        let graph_node = &graph.nodes[node];
        let placed = |error| graph_node.placed(error);
        let mut slots = BTreeMap::new();
        for (slot, (_, edge)) in &wiring.inputs[node] {
            let edge = &graph.edges[*edge];
            let resource = find(graph, &described, &edge.from)
                .map_err(|error| error.at_position(edge.position))?;
            slots.insert(slot.clone(), resource);
        }
        let inputs: BTreeMap<String, ResourceDesc> = slots
            .iter()
            .map(|(slot, &resource)| (slot.clone(), known[resource].desc.clone()))
            .collect();
        for (slot, resource) in &inputs {
            let of_device = resource
                .texture()
                .map(|it| limits::counts(it, capabilities));
            of_device
                .unwrap_or(Ok(()))
                .map_err(|error| placed(error.at_slot(slot)))?;
        }
        let desc = graph_node
            .value
            .describe(&Connected::new(&inputs, capabilities))
            .map_err(|error| placed(with_connected(error, &inputs)))?;
        let inputs_of = desc.slots.iter().filter(|slot| slot.direction.takes());
        let mut names = inputs_of.map(|slot| slot.name.as_str());
        for (slot, (_, edge)) in &wiring.inputs[node] {
            if !names.clone().any(|name| name == slot) {
                let remark = "an edge leads to an input of the node";
                let error = unknown("input", slot, names.by_ref(), remark).at_slot(slot);
                return Err(placed(error.at_position(graph.edges[*edge].position)));
            }
        }
        let resolved = slots::resolve(&desc, &inputs, capabilities).map_err(placed)?;
        // In the order of the slots: one may take its extent from another that was made before it.
        for slot in &desc.slots {
            let made = resolved.get(&slot.name);
            let Some(made) = made.filter(|_| !slots.contains_key(&slot.name)) else {
                continue;
            };
            let index = known.len();
            let from = slots::extent_from(slot)
                .and_then(|(from, per)| Some((&known[*slots.get(from)?], per)));
            let (root, per) = from.map_or((index, [1; 2]), |(from, per)| {
                let per = [0, 1].map(|axis| from.per[axis].saturating_mul(per[axis]));
                (from.root, per)
            });
            let name = format!("{}.{}", graph_node.name, slot.name);
            let mut desc = made.clone();
            if let (SlotResource::Texture(rule), ResourceDesc::Texture(made)) =
                (&slot.resource, &mut desc)
                && rule.fitted_to.as_ref() == Some(&slot.name)
            {
                made.range = Some(name.clone());
            }
            known.push(Known {
                name,
                desc,
                persistent: false,
                root,
                per,
            });
            slots.insert(slot.name.clone(), index);
        }
        let persistent = desc.slots.iter().filter(|slot| slot.persistent);
        for index in persistent.filter_map(|slot| slots.get(&slot.name)) {
            known[*index].persistent = true;
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

/// The resource that an edge or an output starts from. Imports are the first that are known.
fn find(graph: &Graph, described: &[Described], from: &str) -> Result<usize, GraphError> {
    let Some((name, slot)) = from.split_once('.') else {
        return wiring::import_index(graph, from);
    };
    let node = wiring::node_index(graph, name)?;
    let owner = described.iter().find(|described| described.node == node);
    let slots = owner.map_or(&[][..], |owner| &owner.desc.slots);
    let gives = |slot: &&Slot| matches!(slot.direction, Direction::Out | Direction::InOut);
    let mut given = slots.iter().filter(gives).map(|slot| slot.name.as_str());
    let known = given.clone().any(|name| name == slot);
    let resource = owner.and_then(|owner| owner.slots.get(slot).copied());
    resource.filter(|_| known).ok_or_else(|| {
        let remark = "an edge starts from an output of a node";
        let error = unknown("output", slot, given.by_ref(), remark);
        error.at_node(name).at_slot(slot)
    })
}

fn outputs(graph: &Graph, described: &[Described]) -> Result<Vec<Named<usize>>, GraphError> {
    let outputs = graph.outputs.iter().map(|output| {
        let resource = find(graph, described, &output.value)
            .map_err(|error| error.at_position(output.position))?;
        Ok(Named::new(output.name.clone(), resource))
    });
    outputs.collect()
}

/// A node that contradicts itself.
fn declaration(message: impl Into<String>) -> GraphError {
    GraphError::new(GraphErrorKind::Declaration, message)
}
