//! Passes over the regions of a map: by compute shaders, or, where none can write the map's format, drawn.

use moment_shadows::{MapEncoding, Technique};

use super::{FULLSCREEN, Specialization, VirtualModule};
use crate::{GraphError, GraphErrorKind, Pass, TextureDesc, bind};

/// The virtual module of shaders that compute the regions of a map.
pub(in crate::nodes) const TILE: VirtualModule = ("region_tile", include_str!("region_tile.wgsl"));

/// The virtual modules of shaders that draw them.
const DRAWN: [VirtualModule; 2] = [
    ("region_pixel", include_str!("region_pixel.wgsl")),
    FULLSCREEN,
];

/// The virtual modules of shaders that write a map.
pub(in crate::nodes) fn modules(encoding: &MapEncoding) -> &'static [VirtualModule] {
    if encoding.storage().is_drawn() {
        &DRAWN
    } else {
        &[TILE]
    }
}

/// Tells the shader how many regions the table holds.
pub(in crate::nodes) fn specialize(
    specialization: Specialization,
    map: &TextureDesc,
) -> Specialization {
    specialization.constant("REGIONS", &format!("{}u", map.regions))
}

/// A dispatch over all regions of a slot's map.
pub(in crate::nodes) fn compute(
    label: impl Into<String>,
    slot: &str,
    level: u32,
    texels_per_workgroup: [u32; 2],
) -> Pass {
    Pass::compute(label, slot, texels_per_workgroup)
        .over_regions(level)
        .bind("regions", bind::regions(slot, 1))
}

/// A pass that writes a mip level of a map, all its regions, of at least `smallest` texels along each side. Where it is
/// no draw, it writes through the storage texture `variable`.
pub(in crate::nodes) fn write(
    label: impl Into<String>,
    encoding: &MapEncoding,
    (slot, level): (&str, u32),
    variable: &str,
    texels_per_workgroup: [u32; 2],
    smallest: u32,
) -> Pass {
    let pass = if encoding.storage().is_drawn() {
        Pass::fullscreen(label, slot)
    } else {
        Pass::compute(label, slot, texels_per_workgroup)
            .bind(variable, bind::store_level(slot, level))
    };
    pass.over_regions(level)
        .bind("regions", bind::regions(slot, smallest))
}

/// The refusal of drawn maps by nodes of single scattering, whose maps are prefix sums and no pixel's own business.
pub(in crate::nodes) fn refuse_prefix_sums(
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
