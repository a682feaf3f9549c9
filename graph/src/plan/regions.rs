//! Tables of regions: which rectangles of a map's layers there are, per view.

use moment_shadows::MapRegion;
use serde::{Deserialize, Serialize};

use super::ParameterLayout;
use super::parameters::{fits, start};
use crate::GraphError;
use crate::error::unknown;

/// Where the regions of a map lie in a view's block. All nodes that work on a map read the same table.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
    /// What each layer's regions hold until the host writes others: the one that is the whole layer, then zeros, which are no
    /// regions. A region is its origin and its extent, four `u32`.
    pub initial: Vec<u8>,
}

impl PlannedRegions {
    /// Bytes of one layer's regions.
    #[must_use]
    pub fn size(&self) -> u64 {
        u64::from(self.capacity) * size_of::<MapRegion>() as u64
    }

    /// Where a layer's regions begin in the view's block.
    fn start(&self, layer: u32) -> usize {
        start(self.offset, layer, self.stride)
    }

    fn check(&self, regions: &[MapRegion]) -> Result<(), GraphError> {
        let (map, smallest, capacity) = (&self.map, self.smallest, self.capacity);
        let given = regions.len();
        fits(given <= capacity as usize, || {
            format!(
                "a layer of map '{map}' has at most {capacity} regions, {given} were given; describe the import with \
                 'regions': {given}"
            )
        })?;
        for (index, region) in regions.iter().enumerate() {
            let MapRegion { origin, extent } = *region;
            let ends = |axis: usize| origin[axis].checked_add(extent[axis]);
            let inside = |axis: usize| ends(axis).is_some_and(|end| end <= self.extent[axis]);
            let whole = *region == MapRegion::WHOLE;
            fits(whole || (inside(0) && inside(1)), || {
                format!(
                    "region {index} of map '{map}' runs from {}, {} on over {} x {} texels; the map has {} x {}",
                    origin[0], origin[1], extent[0], extent[1], self.extent[0], self.extent[1]
                )
            })?;
            fits(whole || extent[0].min(extent[1]) >= smallest, || {
                format!(
                    "region {index} of map '{map}' has {} x {} texels; {smallest} along each side are the fewest that \
                     the graph's filter can work on",
                    extent[0], extent[1]
                )
            })?;
            let mut earlier = regions[..index].iter();
            let first = earlier.position(|earlier| earlier.overlaps(region));
            fits(first.is_none(), || {
                let first = first.unwrap_or_default();
                format!(
                    "regions {first} and {index} of map '{map}' overlap; each texel belongs to one region"
                )
            })?;
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
    ) -> Result<(), GraphError> {
        let planned = self.regions.iter().find(|planned| planned.map == map);
        let planned = planned.ok_or_else(|| {
            let known = self.regions.iter().map(|planned| planned.map.as_str());
            unknown("map with regions", map, known, "in this plan")
        })?;
        let layers = planned.layers;
        fits(layer < layers, || {
            format!("map '{map}' has {layers} layers; layer {layer} is none of them")
        })?;
        planned.check(regions)?;
        let place = self.place(block, planned.start(layer), planned.size())?;
        let bytes: &[u8] = bytemuck::cast_slice(regions);
        place.fill(0);
        place[..bytes.len()].copy_from_slice(bytes);
        Ok(())
    }
}
