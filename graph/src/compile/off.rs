//! What stands in for outputs of nodes that a host leaves out.

use std::collections::BTreeMap;

use moment_shadows::{Finite, MapEncoding};

use super::{Described, Known, declaration};
use crate::error::ensure;
use crate::{GraphError, GraphErrorKind, Instead, Off, PlannedOff, ResourceDesc};

/// The stand-ins for a node's outputs that the plan has.
pub(super) fn of(
    node: &str,
    described: &Described,
    known: &[Known],
    indices: &BTreeMap<usize, usize>,
) -> Result<Vec<PlannedOff>, GraphError> {
    let mut planned = Vec::new();
    for (slot, off) in &described.desc.off {
        let at_slot = |error: GraphError| error.at_slot(slot);
        let find = |slot: &str| {
            let found = described.slots.get(slot).copied();
            found.ok_or_else(|| {
                declaration(format!(
                    "what stands in for an output names '{slot}', which is no slot"
                ))
            })
        };
        let made = find(slot)?;
        let Some(&output) = indices.get(&made) else {
            continue;
        };
        let instead = match off {
            Off::Bypass(input) => {
                let input = find(input)?;
                let same = alike(&known[made].desc) == rounded_again(alike(&known[input].desc));
                ensure(same, GraphErrorKind::Declaration, || {
                    format!(
                        "{} stands in for {}, which is something else",
                        known[input].desc, known[made].desc
                    )
                })
                .map_err(at_slot)?;
                let read = indices.get(&input).copied();
                Instead::Bypass(read.ok_or_else(|| {
                    at_slot(declaration("what stands in for it is read by no pass"))
                })?)
            }
            Off::Fill(texels) => {
                let planes = known[made].desc.texture().map_or(0, |it| it.planes);
                let (given, needed) = (texels.len(), planes as usize);
                ensure(given == needed, GraphErrorKind::Declaration, || {
                    format!("{given} texels stand in for {needed} planes")
                })
                .map_err(at_slot)?;
                Instead::Fill(texels.clone())
            }
        };
        planned.push(PlannedOff {
            node: node.to_owned(),
            output,
            instead,
        });
    }
    Ok(planned)
}

/// The same for who does not know that texels are rounded inwards: a larger bias does for them, too.
fn rounded_again(mut desc: ResourceDesc) -> ResourceDesc {
    if let ResourceDesc::Texture(texture) = &mut desc {
        texture.encoding = texture.encoding.take().map(MapEncoding::rounded_again);
    }
    desc
}

/// A resource, whatever filter it has been through.
fn alike(desc: &ResourceDesc) -> ResourceDesc {
    let mut desc = desc.clone();
    if let ResourceDesc::Texture(texture) = &mut desc {
        texture.deviation = Finite::ZERO;
        texture.width = Finite::ZERO;
    }
    desc
}
