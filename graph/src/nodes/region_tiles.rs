//! What nodes share that work on the regions of a map: the table's binding and the shader that reads it.

use super::specialization::Specialization;
use crate::{Binding, BindingResource, RegionTable, TextureDesc};

/// The virtual module of shaders that work on regions.
pub(super) const MODULE: (&str, &str) = ("region_tile", include_str!("region_tile.wgsl"));

/// The binding of the table in `region_tile.wgsl`.
pub(super) fn binding(slot: &str, smallest: u32) -> Binding {
    Binding {
        binding: 4,
        resource: BindingResource::Regions(RegionTable {
            slot: slot.to_owned(),
            smallest,
        }),
    }
}

/// Tells the shader how many regions the table holds.
pub(super) fn specialize(specialization: Specialization, map: &TextureDesc) -> Specialization {
    specialization.constant("REGIONS", &format!("{}u", map.regions))
}
