//! The copies that passes are compared with, each made once.

use moment_shadows::TextureFormat;
use moment_shadows_graph::TextureDesc;

use super::CostError;
use super::baseline::{Copies, CopyWork};
use super::protocol::{CopyNumbers, Record, Subject};
use crate::gpu::Gpu;

/// Sets of copies: a set is what several passes together write.
#[derive(Default)]
pub(super) struct CopySets {
    sets: Vec<CopySet>,
}

struct CopySet {
    descs: Vec<TextureDesc>,
    work: CopyWork,
    copies: Vec<Copies>,
    /// The number of the first of its subjects: the copy by a shader, and for a dispatch that by the interface.
    first: usize,
}

impl CopySets {
    /// The copies of some textures, of one layer or more and one mip level each.
    pub(super) fn numbers(
        &mut self,
        gpu: &Gpu,
        descs: &[TextureDesc],
        drawn: bool,
    ) -> Result<CopyNumbers, CostError> {
        let storable: Vec<TextureDesc> = descs.iter().map(same_bytes).collect();
        let compute = self.number(gpu, &storable, CopyWork::Compute)?;
        let draw = if drawn {
            Some(self.number(gpu, descs, CopyWork::Fullscreen)?)
        } else {
            None
        };
        Ok(CopyNumbers {
            compute,
            api: compute + 1,
            draw,
        })
    }

    fn number(
        &mut self,
        gpu: &Gpu,
        descs: &[TextureDesc],
        work: CopyWork,
    ) -> Result<usize, CostError> {
        let mut known = self.sets.iter();
        if let Some(set) = known.find(|set| set.work == work && set.descs == descs) {
            return Ok(set.first);
        }
        let first = self.len();
        self.sets.push(CopySet {
            descs: descs.to_vec(),
            work,
            copies: descs
                .iter()
                .map(|desc| Copies::new(gpu, desc, work))
                .collect::<Result<_, _>>()?,
            first,
        });
        Ok(first)
    }

    /// How many subjects there are.
    pub(super) fn len(&self) -> usize {
        self.sets.iter().map(CopySet::len).sum()
    }

    /// All copies, in the order of their numbers.
    pub(super) fn subjects(&self) -> Vec<Subject<'_>> {
        self.sets.iter().flat_map(CopySet::subjects).collect()
    }
}

impl CopySet {
    fn len(&self) -> usize {
        match self.work {
            CopyWork::Compute => 2,
            CopyWork::Fullscreen => 1,
        }
    }

    fn subjects(&self) -> Vec<Subject<'_>> {
        let shader = Subject {
            name: format!("{:?} copy", self.work),
            record: self.together(Copies::by_shader),
        };
        let api = Subject {
            name: "copy by the interface".to_owned(),
            record: self.together(Copies::by_interface),
        };
        [shader, api].into_iter().take(self.len()).collect()
    }

    fn together<'a>(&'a self, record: fn(&'a Copies) -> Record<'a>) -> Record<'a> {
        let records: Vec<Record<'a>> = self.copies.iter().map(record).collect();
        Box::new(move |encoder| records.iter().try_for_each(|record| record(encoder)))
    }
}

/// A texture of as many bytes that a shader can store to everywhere: the same one, unless its texels are too small.
fn same_bytes(desc: &TextureDesc) -> TextureDesc {
    match desc.format {
        TextureFormat::R8Unorm | TextureFormat::R16Float => {
            let row = desc.size[0] * desc.format.bytes_per_texel();
            TextureDesc {
                layers: desc.layers,
                ..TextureDesc::new(TextureFormat::R32Float, [row.div_ceil(4), desc.size[1]])
            }
        }
        _ => desc.clone(),
    }
}
