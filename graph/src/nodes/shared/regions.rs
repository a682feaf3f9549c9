//! Passes over the regions of a map: by compute shaders, or, where none can write the map's format, drawn.

use moment_shadows::{MapEncoding, Technique};

use super::wgsl;
use crate::{Pass, bind};

/// Texels that a row or column may have: more than any texture.
pub(in crate::nodes) const ENDLESS: u32 = 65536;

/// The shader that writes a map texel by texel, as the module `written_texel` says.
pub(in crate::nodes) fn shader(encoding: &MapEncoding) -> (&'static str, &'static str) {
    if encoding.storage().is_drawn() {
        wgsl!("write_drawn.wgsl")
    } else {
        wgsl!("write_computed.wgsl")
    }
}

/// A pass that writes all regions, of at least `smallest` texels along each side, of a mip level of a map by the entry point
/// `write_map` of a shader. Where it is no draw, it writes through the storage texture `written_map`.
pub(in crate::nodes) fn write(
    label: impl Into<String>,
    wgsl: &str,
    encoding: &MapEncoding,
    (slot, level): (&str, u32),
    texels_per_workgroup: [u32; 2],
    smallest: u32,
) -> Pass {
    let pass = if encoding.storage().is_drawn() {
        Pass::fullscreen(label, slot)
    } else {
        Pass::compute(label, slot, texels_per_workgroup)
            .bind("written_map", bind::store_level(slot, level))
    };
    pass.over_regions(level)
        .bind("regions", bind::regions(slot, smallest))
        .shader(wgsl, "write_map")
}

/// These passes for each plane of a map, labelled with its number where there are several.
pub(in crate::nodes) fn of_each_plane(
    planes: u32,
    passes: Vec<Pass>,
) -> impl Iterator<Item = Pass> {
    (0..planes).flat_map(move |plane| {
        passes.clone().into_iter().map(move |mut pass| {
            if planes > 1 {
                pass.label = format!("plane {plane}: {}", pass.label);
            }
            pass.plane(plane)
        })
    })
}

/// The refusal of drawn maps by nodes of single scattering, whose maps are prefix sums and no pixel's own business, and of packed texels,
/// which are no sums.
pub(in crate::nodes) fn refuse_prefix_sums(encoding: &MapEncoding) -> Result<(), String> {
    let storage = encoding.storage();
    if storage.is_packed() {
        return Err(format!(
            "prefix sums of a row are averages of channels, and those of '{storage}' are none; use 'float16', 'unorm16' or 'float32'"
        ));
    }
    if !storage.is_drawn() {
        return Ok(());
    }
    let row = Technique::Hamburger6.row();
    let others = row.storages.iter().chain(row.rectified);
    let others = others.filter(|other| !other.is_drawn());
    let others: Vec<String> = others.map(|other| format!("'{other}'")).collect();
    Err(format!(
        "prefix sums of a row are written by compute shaders, which cannot write {}, the format of '{storage}'; use one of {}",
        encoding.format(),
        others.join(", ")
    ))
}
