//! From passes to a plan: homes of resources, and indices without gaps.

use std::collections::BTreeMap;

use super::Described;
use super::memory::{self, Life};
use super::touch::touched;
use crate::{Home, Lifetime, NamedResource, Plan, PlannedPass};

/// Gives every resource its home and drops those that no pass touches.
pub(super) fn settle(mut plan: Plan, kept: &[&Described], roots: &[usize]) -> Plan {
    let mut lives: BTreeMap<usize, Life> = BTreeMap::new();
    for (index, pass) in plan.passes.iter().enumerate() {
        for touch in touched(pass) {
            let planned = &plan.resources[touch.resource];
            let life = lives.entry(touch.resource).or_insert_with(|| Life {
                resource: touch.resource,
                name: planned.name.clone(),
                root: roots[touch.resource],
                desc: planned.desc.clone(),
                access: planned.access,
                first: index,
                last: index,
                first_stage: pass.stage,
                last_stage: pass.stage,
                alone: false,
                written_when_dirty: false,
                written_every_time: false,
                read_whole: false,
                exported: false,
            });
            life.last = index;
            life.last_stage = pass.stage;
            life.written_when_dirty |= touch.access.writes() && pass.each_layer;
            life.written_every_time |= touch.access.writes() && !pass.each_layer;
            life.read_whole |= touch.access.read && !(touch.one_layer && pass.each_layer);
        }
    }
    for output in &plan.outputs {
        if let Some(life) = lives.get_mut(&output.resource) {
            life.alone = true;
            life.exported = true;
        }
    }
    for described in kept {
        for slot in &described.desc.slots {
            let life = described
                .slots
                .get(&slot.name)
                .and_then(|index| lives.get_mut(index));
            if let (Some(life), Lifetime::Persistent) = (life, slot.lifetime) {
                life.alone = true;
            }
        }
    }
    let used: Vec<usize> = lives.keys().copied().collect();
    let own: Vec<Life> = lives
        .into_values()
        .filter(|life| matches!(plan.resources[life.resource].home, Home::Memory(_)))
        .collect();
    let (homes, memory) = memory::share(&own);
    for (life, home) in own.iter().zip(homes) {
        plan.resources[life.resource].home = Home::Memory(home);
    }
    plan.memory = memory;
    for &resource in &used {
        if let Home::Import(_) = plan.resources[resource].home {
            let import = plan.imports.len();
            plan.imports.push(NamedResource {
                name: plan.resources[resource].name.clone(),
                resource,
            });
            plan.resources[resource].home = Home::Import(import);
        }
    }
    renumber(plan, &used)
}

/// Keeps only the used resources (and those that an output passes through) and rewrites the indices.
fn renumber(mut plan: Plan, used: &[usize]) -> Plan {
    // An import that is handed straight to an output is touched by no pass, but is named.
    let mut keep: Vec<usize> = used.to_vec();
    for output in &plan.outputs {
        if !keep.contains(&output.resource) {
            keep.push(output.resource);
            if matches!(plan.resources[output.resource].home, Home::Import(_)) {
                plan.resources[output.resource].home = Home::Import(plan.imports.len());
                plan.imports.push(NamedResource {
                    name: plan.resources[output.resource].name.clone(),
                    resource: output.resource,
                });
            }
        }
    }
    let new: BTreeMap<usize, usize> = keep
        .iter()
        .enumerate()
        .map(|(new, &old)| (old, new))
        .collect();
    let renumbered = |index: &mut usize| {
        if let Some(&new) = new.get(index) {
            *index = new;
        }
    };
    plan.resources = keep
        .iter()
        .map(|&old| plan.resources[old].clone())
        .collect();
    plan.imports
        .iter_mut()
        .for_each(|import| renumbered(&mut import.resource));
    plan.outputs
        .iter_mut()
        .for_each(|output| renumbered(&mut output.resource));
    for pass in &mut plan.passes {
        renumber_pass(pass, &renumbered);
    }
    plan
}

fn renumber_pass(pass: &mut PlannedPass, renumbered: &impl Fn(&mut usize)) {
    use crate::{PlannedBindingResource as Resource, PlannedWork};
    for binding in &mut pass.bindings {
        match &mut binding.resource {
            Resource::Texture { resource, .. }
            | Resource::StorageTexture { resource, .. }
            | Resource::Buffer { resource, .. } => renumbered(resource),
            Resource::Parameters { .. }
            | Resource::Regions { .. }
            | Resource::Sampler { .. }
            | Resource::ComparisonSampler { .. } => {}
        }
    }
    match &mut pass.work {
        PlannedWork::Compute { .. } => {}
        PlannedWork::Fullscreen { target, .. } => renumbered(target),
        PlannedWork::Host { targets, depth, .. } => {
            targets.iter_mut().for_each(renumbered);
            depth.iter_mut().for_each(renumbered);
        }
    }
}
