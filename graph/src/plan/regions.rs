//! Tables of regions: which rectangles of a map's layers there are, per view.

use moment_shadows::MapRegion;
use serde::{Deserialize, Serialize};

use super::ParameterLayout;

/// Where the regions of a map lie in a view's block. All nodes that work on a map read the same table.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedRegions {
    /// The import or resource whose regions they are.
    pub map: String,
    /// Bytes from the start of the view's block.
    pub offset: u32,
    /// Bytes from one layer's regions to the next.
    pub stride: u32,
    /// How many layers there are.
    pub layers: u32,
    /// How many regions each layer can have.
    pub capacity: u32,
    /// Width and height of the map.
    pub extent: [u32; 2],
    /// The fewest texels that a region has along each side: a filter's kernel has to fit.
    pub smallest: u32,
}

/// Regions that a map cannot have.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RegionError {
    /// No recorded pass works on regions of that map.
    #[error("map '{map}' has no regions in this plan; maps that do: {known}")]
    UnknownMap {
        /// The map that was named.
        map: String,
        /// The maps with regions.
        known: String,
    },
    /// There are fewer layers.
    #[error("map '{map}' has {layers} layers; layer {layer} is none of them")]
    Layer {
        /// The map.
        map: String,
        /// How many layers there are.
        layers: u32,
        /// The layer that was named.
        layer: u32,
    },
    /// More regions than the plan was compiled for.
    #[error(
        "a layer of map '{map}' has at most {capacity} regions, {given} were given; describe the import with 'regions': {given}"
    )]
    Count {
        /// The map.
        map: String,
        /// How many there can be.
        capacity: u32,
        /// How many were given.
        given: usize,
    },
    /// A region that is not within the map.
    #[error(
        "region {index} of map '{map}' runs from {}, {} on over {} x {} texels; the map has {} x {}",
        region.origin[0], region.origin[1], region.extent[0], region.extent[1], extent[0], extent[1]
    )]
    Outside {
        /// The map.
        map: String,
        /// The region's number.
        index: usize,
        /// The region.
        region: MapRegion,
        /// The map's size.
        extent: [u32; 2],
    },
    /// A region that is smaller than a filter's kernel, or than its mip levels need.
    #[error(
        "region {index} of map '{map}' has {} x {} texels; {smallest} along each side are the fewest that the graph's \
         filter can work on",
        extent[0], extent[1]
    )]
    Small {
        /// The map.
        map: String,
        /// The region's number.
        index: usize,
        /// The region's size.
        extent: [u32; 2],
        /// The least size along each side.
        smallest: u32,
    },
    /// Two regions with a texel in common.
    #[error(
        "regions {first} and {second} of map '{map}' overlap; each texel belongs to one region"
    )]
    Overlap {
        /// The map.
        map: String,
        /// The number of one.
        first: usize,
        /// The number of the other.
        second: usize,
    },
    /// The view's block is too small.
    #[error("a view's block has {expected} bytes, {given} were given")]
    Block {
        /// [`ParameterLayout::size`].
        expected: u32,
        /// What was given.
        given: usize,
    },
}

impl PlannedRegions {
    /// Bytes of one layer's regions.
    #[must_use]
    pub fn size(&self) -> u64 {
        u64::from(self.capacity) * size_of::<MapRegion>() as u64
    }

    fn place<'a>(&self, block: &'a mut [u8], layer: u32) -> Option<&'a mut [u8]> {
        let start = self.offset as usize + layer as usize * self.stride as usize;
        block.get_mut(start..start + self.size() as usize)
    }

    /// The whole layer as its one region.
    pub(super) fn reset(&self, block: &mut [u8], layer: u32) {
        if let Some(place) = self.place(block, layer) {
            place.fill(0);
            let whole = bytemuck::bytes_of(&MapRegion::WHOLE);
            place[..whole.len()].copy_from_slice(whole);
        }
    }

    fn check(&self, regions: &[MapRegion]) -> Result<(), RegionError> {
        for (index, region) in regions.iter().enumerate() {
            if *region == MapRegion::WHOLE {
                continue;
            }
            let inside = |axis: usize| {
                region.origin[axis]
                    .checked_add(region.extent[axis])
                    .is_some_and(|end| end <= self.extent[axis])
            };
            if !(inside(0) && inside(1)) {
                return Err(RegionError::Outside {
                    map: self.map.clone(),
                    index,
                    region: *region,
                    extent: self.extent,
                });
            }
            if region.extent.iter().any(|&side| side < self.smallest) {
                return Err(RegionError::Small {
                    map: self.map.clone(),
                    index,
                    extent: region.extent,
                    smallest: self.smallest,
                });
            }
        }
        for (second, region) in regions.iter().enumerate() {
            if let Some(first) = regions[..second]
                .iter()
                .position(|earlier| earlier.overlaps(region))
            {
                return Err(RegionError::Overlap {
                    map: self.map.clone(),
                    first,
                    second,
                });
            }
        }
        Ok(())
    }
}

impl ParameterLayout {
    /// Writes the regions of a map's layer into a view's block. Texels outside of them are left as they are: a region that
    /// is not listed keeps its contents, so a host lists those that have changed. Shading is told its regions apart.
    ///
    /// The map is named as the import is (or `node.slot`, where a node makes a map of its own). Until this is called, the
    /// whole layer is its one region.
    pub fn write_regions(
        &self,
        block: &mut [u8],
        map: &str,
        layer: u32,
        regions: &[MapRegion],
    ) -> Result<(), RegionError> {
        let planned = self
            .regions
            .iter()
            .find(|planned| planned.map == map)
            .ok_or_else(|| RegionError::UnknownMap {
                map: map.to_owned(),
                known: match self.regions.as_slice() {
                    [] => "none".to_owned(),
                    tables => tables
                        .iter()
                        .map(|table| table.map.as_str())
                        .collect::<Vec<_>>()
                        .join(", "),
                },
            })?;
        if layer >= planned.layers {
            return Err(RegionError::Layer {
                map: map.to_owned(),
                layers: planned.layers,
                layer,
            });
        }
        if regions.len() > planned.capacity as usize {
            return Err(RegionError::Count {
                map: map.to_owned(),
                capacity: planned.capacity,
                given: regions.len(),
            });
        }
        planned.check(regions)?;
        let given = block.len();
        let place = planned.place(block, layer).ok_or(RegionError::Block {
            expected: self.size,
            given,
        })?;
        let bytes: &[u8] = bytemuck::cast_slice(regions);
        place.fill(0);
        place[..bytes.len()].copy_from_slice(bytes);
        Ok(())
    }
}
