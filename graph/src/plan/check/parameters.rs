//! Where uniform data lies.

use super::super::{ParameterLayout, Plan};
use crate::error::ensure;
use crate::{GraphError, GraphErrorKind};

/// A place within a view's block: where it begins, and how many bindings of how many bytes follow each other at which distance.
struct Place {
    offset: u32,
    count: u32,
    stride: u32,
    size: u64,
}

impl Place {
    /// Where it ends; `None` where its bindings overlap or are empty.
    fn end(&self) -> Option<u64> {
        let further = u64::from(self.count.checked_sub(1)?);
        let apart = further == 0 || self.size <= u64::from(self.stride);
        let last = further.checked_mul(u64::from(self.stride))?;
        let end = u64::from(self.offset).checked_add(last)?;
        let end = end.checked_add(self.size)?;
        (apart && self.size > 0).then_some(end)
    }
}

impl Plan {
    /// Whether all uniform data lies within a view's block, each in a place of its own.
    pub(super) fn check_parameters(&self) -> Result<(), GraphError> {
        let ParameterLayout {
            size,
            blocks,
            regions,
        } = &self.parameters;
        let (size, most) = (*size, ParameterLayout::MOST_BYTES);
        ensure(size <= most, GraphErrorKind::Plan, || {
            format!("a view's block has {size} bytes, more than {most}; compile the graph again")
        })?;
        let blocks = blocks.iter().map(|block| {
            let place = Place {
                offset: block.offset,
                count: block.count,
                stride: block.stride,
                size: block.array_size(),
            };
            let holds = block.initial.len() <= block.size as usize;
            (place, holds, format!("parameters of node '{}'", block.node))
        });
        let tables = regions.iter().map(|table| {
            let place = Place {
                offset: table.offset,
                count: table.layers,
                stride: table.stride,
                size: table.size(),
            };
            (place, true, format!("regions of map '{}'", table.map))
        });
        let mut places = Vec::new();
        for (place, holds, what) in blocks.chain(tables) {
            let end = place.end().filter(|&end| holds && end <= u64::from(size));
            let end = end.ok_or_else(|| {
                let message =
                    format!("the {what} do not lie within a view's block; compile the graph again");
                GraphError::new(GraphErrorKind::Plan, message)
            })?;
            places.push((u64::from(place.offset), end, what));
        }
        places.sort();
        let overlap = places.windows(2).find(|pair| pair[1].0 < pair[0].1);
        overlap.map_or(Ok(()), |pair| {
            let message = format!(
                "the {} lie where the {} do; compile the graph again",
                pair[1].2, pair[0].2
            );
            Err(GraphError::new(GraphErrorKind::Plan, message))
        })
    }
}
