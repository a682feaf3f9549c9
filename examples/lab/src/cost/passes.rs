//! The passes of a graph, each recorded on its own.

use moment_shadows_graph::record::{Passes, Recording};
use moment_shadows_graph::{
    Plan, PlannedBindingResource, PlannedPass, PlannedWork, ResourceDesc, TextureDesc,
};

use super::CostError;
use super::baseline::{Copies, CopyWork};
use super::clock::Clock;
use super::opened::OpenedGraph;
use super::protocol::{Rounds, Subject};
use super::report::PassCost;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;

/// A graph on a frame whose outputs have been found right, and the copies that its passes are compared with.
pub struct PassSubjects {
    frame: GraphFrame,
    copies: Vec<(CopyKey, Copies)>,
    measured: Vec<Measured>,
}

/// What distinguishes copies from each other.
#[derive(Clone, Debug, PartialEq)]
struct CopyKey {
    desc: TextureDesc,
    work: CopyWork,
}

/// A pass, by its number in the plan.
struct Measured {
    pass: usize,
    copies: usize,
    error: Option<f64>,
}

impl PassSubjects {
    /// Binds the graph to the frame, runs it, and compares what its nodes give with the reference.
    pub fn new(gpu: &Gpu, frame: &Frame, file: &GraphFile) -> Result<Self, CostError> {
        let opened = OpenedGraph::run(gpu, frame, file)?;
        let graph_frame = GraphFrame::new(gpu, frame, file)?;
        let mut copies: Vec<(CopyKey, Copies)> = Vec::new();
        let mut measured = Vec::new();
        for (index, pass) in graph_frame.plan.passes.iter().enumerate() {
            // The host's own passes are not ours to measure.
            let Some(key) = written(&graph_frame.plan, pass) else {
                continue;
            };
            let known = copies.iter().position(|(known, _)| *known == key);
            let number = match known {
                Some(number) => number,
                None => {
                    copies.push((key.clone(), Copies::new(gpu, &key.desc, key.work)?));
                    copies.len() - 1
                }
            };
            measured.push(Measured {
                pass: index,
                copies: number,
                error: opened.check(gpu, frame, &pass.node)?,
            });
        }
        // Everything that the passes read has its contents before one of them is repeated alone.
        graph_frame.run(gpu)?;
        Ok(Self {
            frame: graph_frame,
            copies,
            measured,
        })
    }

    /// The compiled graph.
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.frame.plan
    }

    /// Times every pass.
    pub fn run(
        &self,
        clock: &Clock<'_>,
        rounds: u32,
        progress: impl FnMut(),
    ) -> Result<Vec<PassCost>, CostError> {
        let mut subjects = Vec::new();
        for (key, copies) in &self.copies {
            subjects.push(Subject {
                name: format!("{:?} copy of {}", key.work, key.desc),
                record: copies.by_shader(),
            });
            subjects.push(Subject {
                name: format!("interface copy of {}", key.desc),
                record: copies.by_interface(),
            });
        }
        subjects.extend(self.measured.iter().map(|measured| self.subject(measured)));
        let times = Rounds::run(clock, &subjects, rounds, progress)?;
        Ok(self
            .measured
            .iter()
            .enumerate()
            .map(|(index, measured)| {
                let pass = &self.plan().passes[measured.pass];
                let (key, _) = &self.copies[measured.copies];
                let copy = 2 * measured.copies;
                let time = times.time(2 * self.copies.len() + index, [copy, copy + 1]);
                let minimum_bytes = pass.bytes_read + pass.bytes_written;
                let copied_bytes = 2 * key.desc.bytes();
                PassCost {
                    pass: name(pass),
                    texture: key.desc.to_string(),
                    copy: key.work,
                    efficiency: minimum_bytes as f64
                        / copied_bytes as f64
                        / time.x_shader_copy.median,
                    time,
                    bytes_read: pass.bytes_read,
                    bytes_written: pass.bytes_written,
                    minimum_bytes,
                    error: measured.error,
                }
            })
            .collect())
    }

    fn subject(&self, measured: &Measured) -> Subject<'_> {
        let pass = &self.plan().passes[measured.pass];
        let (stage, index) = (pass.stage, measured.pass);
        Subject {
            name: name(pass),
            record: Box::new(move |encoder| {
                let recording = Recording {
                    passes: Passes::Only(&[index]),
                    ..Recording::default()
                };
                Ok(self.frame.bindings.record(stage, encoder, recording)?)
            }),
        }
    }
}

fn name(pass: &PlannedPass) -> String {
    format!("{}/{}", pass.node, pass.label)
}

/// The texture that a pass writes, and how a copy of it is made.
fn written(plan: &Plan, pass: &PlannedPass) -> Option<CopyKey> {
    let (resource, work) = match &pass.work {
        PlannedWork::Compute { .. } => {
            let stored = pass
                .bindings
                .iter()
                .find_map(|binding| match binding.resource {
                    PlannedBindingResource::StorageTexture { resource, .. } => Some(resource),
                    _ => None,
                })?;
            (stored, CopyWork::Compute)
        }
        PlannedWork::Fullscreen { target } => (*target, CopyWork::Fullscreen),
        PlannedWork::Host { .. } => return None,
    };
    match &plan.resources[resource].desc {
        ResourceDesc::Texture(desc) => Some(CopyKey {
            desc: desc.clone(),
            work,
        }),
        ResourceDesc::Buffer { .. } => None,
    }
}
