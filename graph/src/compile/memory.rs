//! Lifetimes of resources, and which of them share memory.

use crate::{Access, PlannedMemory, ResourceDesc, Stage};

/// What is known of a resource that the plan creates.
#[derive(Clone, Debug)]
pub(super) struct Life {
    /// Index into the plan's resources.
    pub(super) resource: usize,
    /// `node.slot`.
    pub(super) name: String,
    /// The resource whose layers and regions it follows.
    pub(super) root: usize,
    pub(super) desc: ResourceDesc,
    pub(super) access: Access,
    /// The first and the last pass that touch it, and their stages.
    pub(super) first: usize,
    pub(super) last: usize,
    pub(super) first_stage: Stage,
    pub(super) last_stage: Stage,
    /// It never shares: an output, or persistent.
    pub(super) alone: bool,
    /// Some pass writes it only where layers are dirty.
    pub(super) written_when_dirty: bool,
    /// Some pass writes it whenever its stage is recorded.
    pub(super) written_every_time: bool,
    /// Some pass reads more of it than the layer that it is recorded for.
    pub(super) read_whole: bool,
    pub(super) exported: bool,
}

impl Life {
    /// Whether what an earlier frame wrote is read again: layers that are not dirty keep their contents.
    fn keeps_layers(&self) -> bool {
        self.written_when_dirty && self.read_whole
    }

    /// Whether the host may record its last stage several times for one recording of its first, as for several views.
    fn spans_stages(&self) -> bool {
        self.first_stage != self.last_stage
    }

    /// Whether its memory stays its own from its first pass on.
    fn keeps_memory(&self) -> bool {
        self.alone || self.keeps_layers() || self.spans_stages()
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
    fn takes(&self, life: &Life) -> bool {
        let free = self.free_after.is_some_and(|pass| pass < life.first);
        let layers_survive = self.written_when_dirty
            && self.root == Some(life.root)
            && self.stage == life.first_stage
            && life.desc.texture().is_some();
        !life.alone
            && free
            && self.memory.desc == life.desc
            && (!life.keeps_layers() || layers_survive)
            && (!life.spans_stages() || self.stage == life.first_stage)
    }
}

/// Gives each resource its memory: an index into the returned list, in the order of `lives`.
pub(super) fn share(lives: &[Life]) -> (Vec<usize>, Vec<PlannedMemory>) {
    let mut order: Vec<usize> = (0..lives.len()).collect();
    order.sort_by_key(|&index| (lives[index].first, lives[index].resource));
    let mut blocks: Vec<Block> = Vec::new();
    let mut homes = vec![0; lives.len()];
    for index in order {
        let life = &lives[index];
        let free_after = (!life.keeps_memory()).then_some(life.last);
        let written_when_dirty = !life.written_every_time;
        homes[index] = match blocks.iter().position(|block| block.takes(life)) {
            Some(home) => {
                let block = &mut blocks[home];
                block.memory.label = format!("{} | {}", block.memory.label, life.name);
                block.memory.access = block.memory.access.union(life.access);
                block.free_after = free_after;
                block.written_when_dirty &= written_when_dirty;
                block.root = block.root.filter(|&root| root == life.root);
                home
            }
            None => {
                blocks.push(Block {
                    memory: PlannedMemory {
                        label: life.name.clone(),
                        desc: life.desc.clone(),
                        access: life.access,
                        exported: life.exported,
                    },
                    stage: life.first_stage,
                    free_after,
                    written_when_dirty,
                    root: Some(life.root),
                });
                blocks.len() - 1
            }
        };
    }
    (
        homes,
        blocks.into_iter().map(|block| block.memory).collect(),
    )
}
