//! Lifetimes of resources, and which of them share memory.

use std::collections::BTreeMap;

use moment_shadows::Finite;

use super::Known;
use crate::plan::Part;
use crate::{Home, Lives, Plan, PlannedMemory, ResourceDesc, Stage, Usage};

/// When a resource that the plan creates is used, and how.
struct Life {
    /// Index into the plan's resources.
    resource: usize,
    /// The first and the last pass that touch it, and the stage of the first.
    first: usize,
    last: usize,
    stage: Stage,
    /// The host may record its last stage several times for one recording of its first, as for several views.
    spans_stages: bool,
    /// It never shares: an output, or persistent.
    alone: bool,
    /// Some pass writes it only where layers are dirty.
    written_when_dirty: bool,
    /// Some pass writes it whenever its stage is recorded.
    written_every_time: bool,
    /// Some pass reads more of it than the layer that it is recorded for.
    read_whole: bool,
}

impl Life {
    /// Whether what an earlier frame wrote is read again: layers that are not dirty keep their contents.
    fn keeps_layers(&self) -> bool {
        self.written_when_dirty && self.read_whole
    }

    /// Whether its memory stays its own from its first pass on.
    fn keeps_memory(&self) -> bool {
        self.alone || self.keeps_layers() || self.spans_stages
    }
}

/// A texture or buffer under construction.
struct Block {
    memory: PlannedMemory,
    /// The stage of the earliest resident.
    stage: Stage,
    /// Free for resources that begin after this pass; never, where `None`.
    free_after: Option<usize>,
    /// Residents are written only where layers are dirty.
    written_when_dirty: bool,
    /// The resource whose layers and regions all residents follow; `None` where they differ.
    root: Option<usize>,
}

impl Block {
    /// Whether a resource can live here after the earlier residents.
    ///
    /// One that keeps layers goes only where all are written by layer in one stage, and are layers of the same map: then
    /// an earlier resident overwrites a layer only when the later one makes it anew, too. A buffer has no layers to tell
    /// apart.
    fn takes(&self, life: &Life, desc: &ResourceDesc, root: usize) -> bool {
        let free = self.free_after.is_some_and(|pass| pass < life.first);
        let layers_survive = self.written_when_dirty
            && self.root == Some(root)
            && self.stage == life.stage
            && desc.texture().is_some();
        !life.alone
            && free
            && self.memory.desc == *desc
            && (!life.keeps_layers() || layers_survive)
            && (!life.spans_stages || self.stage == life.stage)
    }
}

/// Gives every resource that the plan creates its memory. `known` is what is known of the plan's resources.
pub(super) fn share_memory(plan: &mut Plan, known: &[&Known]) {
    let mut lives: Vec<Life> = lives(plan).into_values().collect();
    lives.sort_by_key(|life| (life.first, life.resource));
    let mut blocks: Vec<Block> = Vec::new();
    for life in &mut lives {
        let Known {
            root, persistent, ..
        } = *known[life.resource];
        let exported = plan.outputs.iter().any(|out| out.value == life.resource);
        life.alone = exported || persistent;
        let resource = &mut plan.resources[life.resource];
        resource.lives = if persistent {
            Lives::Always
        } else if life.keeps_layers() || exported && life.written_when_dirty {
            Lives::LayersLeftOut
        } else {
            Lives::Frame
        };
        let free_after = (!life.keeps_memory()).then_some(life.last);
        let written_when_dirty = !life.written_every_time;
        let mut desc = resource.desc.clone();
        if let ResourceDesc::Texture(texture) = &mut desc {
            // What a map has been through is not its memory's.
            texture.deviation = Finite::ZERO;
            texture.width = Finite::ZERO;
            texture.range = None;
        }
        let mut taken = blocks.iter();
        let home = match taken.position(|block| block.takes(life, &desc, root)) {
            Some(home) => {
                let block = &mut blocks[home];
                block.memory.label += &format!(" | {}", resource.name);
                Usage::union(&mut block.memory.usage, &resource.usage);
                block.free_after = free_after;
                block.written_when_dirty &= written_when_dirty;
                block.root = block.root.filter(|&other| other == root);
                home
            }
            None => {
                let mut usage = resource.usage.clone();
                if exported {
                    // A host reads or copies what it takes.
                    let taken = match desc {
                        ResourceDesc::Texture(_) => &[Usage::CopySrc, Usage::TextureBinding][..],
                        ResourceDesc::Buffer { .. } => &[Usage::CopySrc],
                    };
                    Usage::union(&mut usage, taken);
                }
                blocks.push(Block {
                    memory: PlannedMemory {
                        label: resource.name.clone(),
                        desc,
                        usage,
                    },
                    stage: life.stage,
                    free_after,
                    written_when_dirty,
                    root: Some(root),
                });
                blocks.len() - 1
            }
        };
        resource.home = Home::Memory(home);
    }
    plan.memory = blocks.into_iter().map(|block| block.memory).collect();
}

/// The lives of all resources that passes touch and that are no imports.
fn lives(plan: &Plan) -> BTreeMap<usize, Life> {
    let mut lives: BTreeMap<usize, Life> = BTreeMap::new();
    for (index, pass) in plan.passes.iter().enumerate() {
        for touch in pass.touches() {
            if matches!(plan.resources[touch.resource].home, Home::Import(_)) {
                continue;
            }
            let life = lives.entry(touch.resource).or_insert_with(|| Life {
                resource: touch.resource,
                first: index,
                last: index,
                stage: pass.stage,
                spans_stages: false,
                alone: false,
                written_when_dirty: false,
                written_every_time: false,
                read_whole: false,
            });
            life.last = index;
            life.spans_stages |= pass.stage != life.stage;
            let of_layer = matches!(touch.part, Part::Level { .. }) && pass.each_layer;
            life.written_when_dirty |= touch.access.writes() && pass.each_layer;
            life.written_every_time |= touch.access.writes() && !pass.each_layer;
            life.read_whole |= touch.access.read && !of_layer;
        }
    }
    lives
}
