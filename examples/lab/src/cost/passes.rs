//! The passes of a graph, each recorded on its own.

use std::collections::BTreeMap;

use moment_shadows_graph::record::{Passes, Recording};
use moment_shadows_graph::{Plan, PlannedBindingResource, PlannedPass, PlannedWork, TextureDesc};

use super::CostError;
use super::baseline::CopyWork;
use super::copy_sets::CopySets;
use super::graph_cost::PassCost;
use super::opened::OpenedGraph;
use super::protocol::{CopyNumbers, Rounds, Subject};
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;

/// A pass that writes fewer texels costs what submitting it does, and little besides.
pub const FEWEST_TEXELS: u64 = 64 * 64;

/// What makes a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grouping {
    /// A pass; those of a node that write fewer than [`FEWEST_TEXELS`] together.
    Passes,
    /// All passes of a node, in copies of what its first pass writes.
    Nodes,
}

/// A graph on a frame whose outputs have been found right, and the copies that its passes are compared with.
pub struct PassSubjects {
    frame: GraphFrame,
    copies: CopySets,
    rows: Vec<Row>,
}

/// Some passes that are timed as one, by their numbers in the plan.
struct Row {
    passes: Vec<usize>,
    copies: CopyNumbers,
    work: CopyWork,
    /// What the copies are of.
    written: Vec<TextureDesc>,
    error: Option<f64>,
}

impl PassSubjects {
    /// Binds the graph to the frame, runs it, and compares what its nodes give with the reference; only nodes of the
    /// types that are `wanted`.
    pub fn new(
        gpu: &Gpu,
        frame: &Frame,
        file: &GraphFile,
        grouping: Grouping,
        wanted: impl Fn(&str) -> bool,
    ) -> Result<Self, CostError> {
        let wanted = |node: &str| {
            let node_type = file.node_entry(node, "type");
            node_type.as_str().is_some_and(&wanted)
        };
        let opened = OpenedGraph::run(gpu, frame, file)?;
        let mut errors = BTreeMap::new();
        let graph_frame = GraphFrame::new(gpu, frame, file)?;
        let plan = &graph_frame.plan;
        let mut copies = CopySets::default();
        let mut rows = Vec::new();
        for group in groups(plan, grouping, wanted) {
            let of_copies = match grouping {
                Grouping::Passes => &group[..],
                Grouping::Nodes => &group[..1],
            };
            let written: Vec<TextureDesc> = of_copies
                .iter()
                .map(|(_, target)| target.desc.clone())
                .collect();
            let (first, target) = &group[0];
            let node = &plan.passes[*first].node;
            let error = match errors.get(node) {
                Some(&error) => error,
                None => {
                    let error = opened.check(gpu, frame, node)?;
                    errors.insert(node.clone(), error);
                    error
                }
            };
            let drawn = target.work == CopyWork::Fullscreen;
            rows.push(Row {
                passes: group.iter().map(|(pass, _)| *pass).collect(),
                copies: copies.numbers(gpu, &written, drawn)?,
                work: target.work,
                written,
                error,
            });
        }
        // Everything that the passes read has its contents before one of them is repeated alone.
        graph_frame.run(gpu)?;
        Ok(Self {
            frame: graph_frame,
            copies,
            rows,
        })
    }

    /// The compiled graph.
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.frame.plan
    }

    /// The node that a row is of, and the texels that it writes first.
    pub fn nodes(&self) -> impl Iterator<Item = (&str, u64)> {
        self.rows.iter().map(|row| {
            let texels = row.written.first().map_or(0, texels);
            (self.pass(row, 0).map_or("", |pass| &pass.node), texels)
        })
    }

    /// The copies, then the rows.
    #[must_use]
    pub fn subjects(&self) -> Vec<Subject<'_>> {
        let mut subjects = self.copies.subjects();
        subjects.extend(self.rows.iter().map(|row| self.subject(row)));
        subjects
    }

    /// The number of each row and of its copies, where the number of the first subject is `first`.
    #[must_use]
    pub fn numbers(&self, first: usize) -> Vec<(usize, CopyNumbers)> {
        let from_first = |copies: CopyNumbers| CopyNumbers {
            compute: first + copies.compute,
            api: first + copies.api,
            draw: copies.draw.map(|draw| first + draw),
        };
        self.rows
            .iter()
            .enumerate()
            .map(|(index, row)| (first + self.copies.len() + index, from_first(row.copies)))
            .collect()
    }

    /// What each row costs, if these subjects alone were timed.
    #[must_use]
    pub fn costs(&self, rounds: &Rounds) -> Vec<PassCost> {
        self.rows
            .iter()
            .zip(self.numbers(0))
            .map(|(row, (subject, copies))| self.cost(row, rounds.time(subject, copies)))
            .collect()
    }

    fn cost(&self, row: &Row, time: super::report::Time) -> PassCost {
        let passes = row.passes.iter().map(|&pass| &self.plan().passes[pass]);
        let bytes_read = passes.clone().map(|pass| pass.bytes_read).sum();
        let bytes_written = passes.map(|pass| pass.bytes_written).sum();
        let copied_bytes: u64 = row.written.iter().map(|desc| 2 * desc.bytes()).sum();
        let minimum_bytes: u64 = bytes_read + bytes_written;
        let textures: Vec<String> = row.written.iter().map(ToString::to_string).collect();
        PassCost {
            pass: self.name(row),
            texture: between(&textures, " .. "),
            work: row.work,
            small: row.written.iter().all(|desc| texels(desc) < FEWEST_TEXELS),
            efficiency: minimum_bytes as f64 / copied_bytes as f64 / time.x_compute_copy.median,
            time,
            bytes_read,
            bytes_written,
            minimum_bytes,
            error: row.error,
        }
    }

    fn subject(&self, row: &Row) -> Subject<'_> {
        let passes: Vec<_> = row
            .passes
            .iter()
            .map(|&pass| (self.plan().passes[pass].stage, pass))
            .collect();
        Subject {
            name: self.name(row),
            record: Box::new(move |encoder| {
                for &(stage, pass) in &passes {
                    let recording = Recording {
                        passes: Passes::Only(&[pass]),
                        ..Recording::default()
                    };
                    self.frame.bindings.record(stage, encoder, recording)?;
                }
                Ok(())
            }),
        }
    }

    fn pass(&self, row: &Row, index: usize) -> Option<&PlannedPass> {
        row.passes
            .get(index)
            .and_then(|&pass| self.plan().passes.get(pass))
    }

    /// `node/pass`, or `node/first pass to last pass`.
    fn name(&self, row: &Row) -> String {
        let labels: Vec<String> = (0..row.passes.len())
            .filter_map(|index| self.pass(row, index))
            .map(|pass| pass.label.clone())
            .collect();
        let node = self.pass(row, 0).map_or("", |pass| &pass.node);
        format!("{node}/{}", between(&labels, " to "))
    }
}

/// What a pass writes.
struct Target {
    desc: TextureDesc,
    work: CopyWork,
}

/// The passes that make a row each; none of them is empty.
fn groups(
    plan: &Plan,
    grouping: Grouping,
    wanted: impl Fn(&str) -> bool,
) -> Vec<Vec<(usize, Target)>> {
    let mut groups: Vec<Vec<(usize, Target)>> = Vec::new();
    for (index, pass) in plan.passes.iter().enumerate() {
        // The host's own passes are not ours to measure.
        let Some(target) = written(plan, pass) else {
            continue;
        };
        if !wanted(&pass.node) {
            continue;
        }
        let small = |target: &Target| texels(&target.desc) < FEWEST_TEXELS;
        let joined = groups.iter_mut().find(|group| {
            let (first, theirs) = &group[0];
            plan.passes[*first].node == pass.node
                && (grouping == Grouping::Nodes || (small(theirs) && small(&target)))
        });
        match joined {
            Some(group) => group.push((index, target)),
            None => groups.push(vec![(index, target)]),
        }
    }
    groups
}

/// The texture that a pass writes: a mip level, as a texture of its own with the layers that the pass is recorded for.
fn written(plan: &Plan, pass: &PlannedPass) -> Option<Target> {
    let (resource, level, work) = match &pass.work {
        PlannedWork::Compute { .. } => {
            let (resource, level) =
                pass.bindings
                    .iter()
                    .find_map(|binding| match binding.resource {
                        PlannedBindingResource::StorageTexture {
                            resource, level, ..
                        } => Some((resource, level)),
                        _ => None,
                    })?;
            (resource, level, CopyWork::Compute)
        }
        PlannedWork::Fullscreen { target, level, .. } => (*target, *level, CopyWork::Fullscreen),
        PlannedWork::Host { .. } => return None,
    };
    let desc = plan.resources.get(resource)?.desc.texture()?;
    Some(Target {
        desc: TextureDesc {
            layers: pass.layers.max(1),
            ..TextureDesc::new(desc.format, desc.size_at(level))
        },
        work,
    })
}

fn texels(desc: &TextureDesc) -> u64 {
    u64::from(desc.size[0]) * u64::from(desc.size[1]) * u64::from(desc.layers)
}

/// The first and the last of some texts, or the only one.
fn between(texts: &[String], joint: &str) -> String {
    match texts {
        [] => String::new(),
        [only] => only.clone(),
        [first, .., last] => format!("{first}{joint}{last}"),
    }
}
