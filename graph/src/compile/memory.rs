//! Lifetimes of resources, and which of them share memory.

use crate::{Access, PlannedMemory, ResourceDesc};

/// What is known of a resource that the plan creates.
#[derive(Clone, Debug)]
pub(super) struct Life {
    /// Index into the plan's resources.
    pub(super) resource: usize,
    /// `node.slot`.
    pub(super) name: String,
    pub(super) desc: ResourceDesc,
    pub(super) access: Access,
    /// The first and the last pass that touch it.
    pub(super) first: usize,
    pub(super) last: usize,
    /// Its contents matter after its last pass: an output, or persistent.
    pub(super) outlives: bool,
    /// It is never to share.
    pub(super) persistent: bool,
    /// Only passes that are recorded per dirty layer write it.
    pub(super) written_by_layer: bool,
    /// A pass that is recorded every time reads it, so layers that are not dirty have to keep their contents.
    pub(super) read_every_time: bool,
    pub(super) exported: bool,
}

/// A texture or buffer under construction.
struct Block {
    memory: PlannedMemory,
    /// Free for resources that begin after this pass; never, where `None`.
    free_after: Option<usize>,
    all_written_by_layer: bool,
}

/// Gives each resource its memory: an index into the returned list, in the order of `lives`.
///
/// A layer that is not dirty keeps what an earlier frame wrote, so a resource that is written by layer and read every
/// time never gives its memory to another. It may take memory whose earlier residents are written by layer, too: those
/// passes touch a layer only when all of its later residents are written again.
pub(super) fn share(lives: &[Life]) -> (Vec<usize>, Vec<PlannedMemory>) {
    let mut order: Vec<usize> = (0..lives.len()).collect();
    order.sort_by_key(|&index| (lives[index].first, lives[index].resource));
    let mut blocks: Vec<Block> = Vec::new();
    let mut homes = vec![0; lives.len()];
    for index in order {
        let life = &lives[index];
        let keeps_layers = life.written_by_layer && (life.read_every_time || life.outlives);
        let found = blocks.iter().position(|block| {
            !life.persistent
                && block.memory.desc == life.desc
                && block.free_after.is_some_and(|pass| pass < life.first)
                && (!keeps_layers || block.all_written_by_layer)
        });
        let free_after = (!life.persistent && !life.outlives && !keeps_layers).then_some(life.last);
        homes[index] = match found {
            Some(home) => {
                let block = &mut blocks[home];
                block.memory.label = format!("{} | {}", block.memory.label, life.name);
                block.memory.access = block.memory.access.union(life.access);
                block.memory.exported |= life.exported;
                block.free_after = free_after;
                block.all_written_by_layer &= life.written_by_layer;
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
                    free_after,
                    all_written_by_layer: life.written_by_layer,
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
