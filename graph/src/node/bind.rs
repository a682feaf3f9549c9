//! What variables of a shader hold, by slot: for [`Pass::bind`](super::Pass::bind).

use super::BindingResource;

/// The node's uniform data.
pub fn parameters() -> BindingResource {
    BindingResource::Parameters
}

/// The regions of a slot's map, which have at least so many texels along each side.
pub fn regions(slot: &str, smallest: u32) -> BindingResource {
    BindingResource::Regions {
        slot: slot.to_owned(),
        smallest,
    }
}

/// One layer, mip level 0, loaded or sampled.
pub fn layer(slot: &str) -> BindingResource {
    level(slot, 0)
}

/// A mip level of one layer, loaded or sampled.
pub fn level(slot: &str, level: u32) -> BindingResource {
    BindingResource::Level {
        slot: slot.to_owned(),
        level,
    }
}

/// All layers, loaded or sampled.
pub fn layers(slot: &str) -> BindingResource {
    BindingResource::Layers(slot.to_owned())
}

/// One layer, mip level 0, written.
pub fn store(slot: &str) -> BindingResource {
    store_level(slot, 0)
}

/// A mip level of one layer, written.
pub fn store_level(slot: &str, level: u32) -> BindingResource {
    BindingResource::StorageLevel {
        slot: slot.to_owned(),
        level,
        plane: None,
    }
}

/// One plane of one layer, mip level 0, written, whatever the pass's plane is.
pub fn store_plane(slot: &str, plane: u32) -> BindingResource {
    BindingResource::StorageLevel {
        slot: slot.to_owned(),
        level: 0,
        plane: Some(plane),
    }
}

/// A storage buffer.
pub fn buffer(slot: &str) -> BindingResource {
    BindingResource::Buffer(slot.to_owned())
}

/// A sampler that clamps to the edge, linear or nearest.
pub fn sampler(filtering: bool) -> BindingResource {
    BindingResource::Sampler {
        filtering,
        anisotropy: 1,
    }
}
