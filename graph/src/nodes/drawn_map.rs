//! Maps whose format no compute shader can write: their passes draw each layer, plane and mip level instead.

use moment_shadows::{MapEncoding, Technique};

use super::techniques::VirtualModule;
use crate::{Access, Binding, BindingResource, GraphError, GraphErrorKind, MipLevel, Work};

/// The virtual module of shaders that draw the regions of a map.
pub(super) const MODULE: VirtualModule = ("region_pixel", include_str!("region_pixel.wgsl"));

/// How passes write a map.
pub(super) fn write_access(encoding: &MapEncoding) -> Access {
    if encoding.storage().is_drawn() {
        Access::RENDER_TARGET
    } else {
        Access::STORAGE_WRITE
    }
}

/// The work of a pass that writes a mip level of a map, all its regions.
pub(super) fn work(
    encoding: &MapEncoding,
    slot: &str,
    level: u32,
    texels_per_workgroup: [u32; 2],
) -> Work {
    if encoding.storage().is_drawn() {
        Work::FullscreenRegions {
            target: slot.to_owned(),
            level,
        }
    } else {
        Work::ComputeRegions {
            covers: slot.to_owned(),
            level,
            texels_per_workgroup,
        }
    }
}

/// The storage texture that such a pass writes, where it does not draw.
pub(super) fn binding(
    encoding: &MapEncoding,
    binding: u32,
    slot: &str,
    level: u32,
) -> Option<Binding> {
    let slot = slot.to_owned();
    (!encoding.storage().is_drawn()).then_some(Binding {
        binding,
        resource: match level {
            0 => BindingResource::StorageLayer(slot),
            _ => BindingResource::StorageLevel(MipLevel { slot, level }),
        },
    })
}

/// The refusal of drawn maps by nodes of single scattering, whose maps are prefix sums and no pixel's own business.
pub(super) fn refuse_prefix_sums(
    encoding: &MapEncoding,
    kind: GraphErrorKind,
) -> Result<(), GraphError> {
    let storage = encoding.storage();
    if !storage.is_drawn() {
        return Ok(());
    }
    let alternative = Technique::Hamburger6
        .storages()
        .iter()
        .filter(|other| !other.is_drawn())
        .map(|other| format!("'{other}'"))
        .collect::<Vec<_>>()
        .join(", ");
    Err(GraphError::new(
        kind,
        format!(
            "prefix sums of a row are written by compute shaders, which cannot write {}, the format of '{storage}'; \
             use one of {alternative}",
            encoding.format()
        ),
    ))
}
