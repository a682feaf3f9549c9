//! Regions of a map: the rectangles of an atlas.

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};

/// A rectangle of a map's layer, in texels of mip level 0; the struct `MapRegion` of `map_region.wgsl`.
///
/// No filter, mip level or lookup reads across its edge. A rectangle without texels stands for no region at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Pod, Zeroable, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[repr(C)]
pub struct MapRegion {
    /// The first texel in x and y.
    pub origin: [u32; 2],
    /// Texels in x and y.
    pub extent: [u32; 2],
}

impl MapRegion {
    /// All of a layer, whatever its size.
    pub const WHOLE: MapRegion = MapRegion {
        origin: [0; 2],
        extent: [u32::MAX; 2],
    };

    /// No region.
    pub const NONE: MapRegion = MapRegion {
        origin: [0; 2],
        extent: [0; 2],
    };

    /// A rectangle.
    #[must_use]
    pub const fn new(origin: [u32; 2], extent: [u32; 2]) -> Self {
        Self { origin, extent }
    }

    /// Whether two regions have a texel in common.
    #[must_use]
    pub fn overlaps(&self, other: &MapRegion) -> bool {
        (0..2).all(|axis| {
            let end = |region: &MapRegion| {
                u64::from(region.origin[axis]) + u64::from(region.extent[axis])
            };
            u64::from(self.origin[axis].max(other.origin[axis])) < end(self).min(end(other))
        })
    }
}

impl Default for MapRegion {
    /// All of a layer.
    fn default() -> Self {
        Self::WHOLE
    }
}
