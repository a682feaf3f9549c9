//! The passes of a graph, each recorded on its own.

use std::collections::BTreeMap;
use std::rc::Rc;

use moment_shadows_graph::record::Recording;
use moment_shadows_graph::{Plan, PlannedBindingResource, PlannedPass, PlannedWork, TextureDesc};

use super::copies::CopyWork;
use super::harness::Case;
use super::opened::OpenedGraph;
use super::table::{FEWEST_TEXELS, Facts, Gate, between, texels};
use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;

/// Binds the graph to the frame, runs it, and compares what its nodes give with the reference: a case per pass, those of a
/// node that write fewer than [`FEWEST_TEXELS`] together, and the bytes that the plan creates and moves.
pub fn cases(
    gpu: &Gpu,
    frame: &Frame,
    file: &GraphFile,
) -> Result<(Vec<Case>, [u64; 2]), LabError> {
    let opened = OpenedGraph::run(gpu, frame, file)?;
    let graph = Rc::new(GraphFrame::new(gpu, frame, file)?);
    // Everything that the passes read has its contents before one of them is repeated alone.
    graph.run(gpu)?;
    let plan = &graph.plan;
    let mut differences = BTreeMap::new();
    let mut cases = Vec::new();
    for group in groups(plan) {
        let numbers: Vec<usize> = group.iter().map(|(number, ..)| *number).collect();
        let passes: Vec<&PlannedPass> =
            numbers.iter().map(|&number| &plan.passes[number]).collect();
        let node = passes[0].node.clone();
        let difference = match differences.get(&node) {
            Some(&difference) => difference,
            None => opened.difference(gpu, frame, &node)?,
        };
        differences.insert(node.clone(), difference);
        let labels: Vec<String> = passes.iter().map(|pass| pass.label.clone()).collect();
        let name = format!("{node}/{}", between(&labels, " to "));
        let recorded = Rc::clone(&graph);
        cases.push(Case {
            facts: Facts(vec![("pass", name.clone().into())]),
            name,
            written: group.iter().map(|(_, desc, _)| desc.clone()).collect(),
            work: group[0].2,
            bytes: [
                passes.iter().map(|pass| pass.bytes_read).sum(),
                passes.iter().map(|pass| pass.bytes_written).sum(),
            ],
            difference,
            gate: Gate::default(),
            record: Box::new(move |encoder| {
                for &number in &numbers {
                    let recording = Recording {
                        passes: Some(&[number]),
                        ..Recording::default()
                    };
                    let stage = recorded.plan.passes[number].stage;
                    recorded.bindings.record(stage, encoder, recording)?;
                }
                Ok(())
            }),
        });
    }
    Ok((cases, [plan.bytes_resident(), plan.bytes_moved()]))
}

/// A pass by its number, with what it writes: a mip level, as a texture of its own with the layers that the pass is recorded
/// for.
type Written = (usize, TextureDesc, CopyWork);

/// The passes that make a row each; none of them is empty.
fn groups(plan: &Plan) -> Vec<Vec<Written>> {
    let mut groups: Vec<Vec<Written>> = Vec::new();
    // The host's own passes are not ours to measure.
    for pass in (0..plan.passes.len()).filter_map(|number| written(plan, number)) {
        let node = |pass: &Written| &plan.passes[pass.0].node;
        let small = |pass: &Written| texels(&pass.1) < FEWEST_TEXELS;
        let joined = groups
            .iter_mut()
            .find(|group| node(&group[0]) == node(&pass) && small(&group[0]) && small(&pass));
        match joined {
            Some(group) => group.push(pass),
            None => groups.push(vec![pass]),
        }
    }
    groups
}

fn written(plan: &Plan, number: usize) -> Option<Written> {
    let pass = &plan.passes[number];
    let (resource, level, work) = match &pass.work {
        PlannedWork::Compute { .. } => {
            let mut stored = pass
                .bindings
                .iter()
                .filter_map(|binding| match binding.resource {
                    PlannedBindingResource::StorageTexture { resource, part } => {
                        Some((resource, part.level))
                    }
                    _ => None,
                });
            let (resource, level) = stored.next()?;
            (resource, level, CopyWork::Compute)
        }
        PlannedWork::Fullscreen { target, part, .. } => (*target, part.level, CopyWork::Fullscreen),
        PlannedWork::Host { .. } => return None,
    };
    let texture = plan.resources.get(resource)?.desc.texture()?;
    let desc = TextureDesc {
        layers: pass.layers.max(1),
        ..TextureDesc::new(texture.format, texture.size_at(level))
    };
    Some((number, desc, work))
}
