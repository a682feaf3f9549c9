//! Rules of slots: what may be connected, and what a node's own resources become.

use std::collections::{BTreeMap, BTreeSet};

use moment_shadows::{Finite, TextureFormat};

use super::limits::{limits, usable};
use crate::{
    Capabilities, CountRule, Direction, ExtentRule, FormatRule, GraphError, GraphErrorKind,
    NodeDesc, ResourceDesc, Slot, SlotResource, TextureDesc, TextureRule,
};

/// A number of a texture that a [`CountRule`] is about.
type Count = fn(&TextureDesc) -> u32;

/// Checks what is connected to a node and gives every slot of it a concrete resource.
pub(super) fn resolve(
    desc: &NodeDesc,
    inputs: &BTreeMap<String, ResourceDesc>,
    capabilities: &Capabilities,
) -> Result<BTreeMap<String, ResourceDesc>, GraphError> {
    let mut names = BTreeSet::new();
    for slot in &desc.slots {
        if !names.insert(slot.name.as_str()) {
            return Err(GraphError::new(
                GraphErrorKind::DuplicateName,
                "the node declares two slots of this name",
            )
            .at_slot(&slot.name));
        }
        if slot.description.trim().is_empty() {
            return Err(GraphError::new(
                GraphErrorKind::Declaration,
                "the slot has no description; say in a sentence what it is for",
            )
            .at_slot(&slot.name));
        }
        if slot.direction == Direction::In && slot.resource.access().writes() {
            return Err(GraphError::new(
                GraphErrorKind::Declaration,
                "the node writes to an input; declare it as changed in place ('in_out')",
            )
            .at_slot(&slot.name));
        }
    }
    let mut resolved = inputs.clone();
    let takes_input = |slot: &&Slot| matches!(slot.direction, Direction::In | Direction::InOut);
    for slot in desc.slots.iter().filter(takes_input) {
        match inputs.get(&slot.name) {
            Some(resource) => check(slot, resource, &resolved, capabilities)?,
            None if slot.optional => {}
            None => {
                return Err(GraphError::new(
                    GraphErrorKind::MissingInput,
                    "nothing is connected to this input; add an edge that leads to it",
                )
                .at_slot(&slot.name));
            }
        }
    }
    for slot in desc.slots.iter().filter(|slot| !takes_input(slot)) {
        let resource = make(slot, &resolved)?;
        check(slot, &resource, &resolved, capabilities)?;
        if resource
            .texture()
            .is_some_and(|texture| texture.samples > 1 && texture.layers > 1)
        {
            return Err(GraphError::new(
                GraphErrorKind::Declaration,
                "the node makes a multisampled texture with several layers, which WebGPU does not have",
            )
            .at_slot(&slot.name));
        }
        resolved.insert(slot.name.clone(), resource);
    }
    Ok(resolved)
}

/// The resource that a rule-bound slot becomes.
fn make(
    slot: &Slot,
    resolved: &BTreeMap<String, ResourceDesc>,
) -> Result<ResourceDesc, GraphError> {
    let undetermined = |what: &str| {
        GraphError::new(
            GraphErrorKind::Declaration,
            format!("the node makes this resource, but leaves its {what} open"),
        )
        .at_slot(&slot.name)
    };
    match &slot.resource {
        SlotResource::Buffer { size, .. } => Ok(ResourceDesc::Buffer { size: *size }),
        SlotResource::Texture(TextureRule {
            format,
            extent,
            layers,
            mips,
            samples,
            deviation,
            ..
        }) => {
            let count = |rule: &CountRule, what: &str, of: Count| match rule {
                CountRule::Exact(count) => Ok(*count),
                CountRule::SameAs(other) => Ok(of(texture_of(slot, other, resolved)?)),
                CountRule::OneOf(_) | CountRule::Any => Err(undetermined(what)),
            };
            Ok(ResourceDesc::Texture(TextureDesc {
                format: match format {
                    FormatRule::Exact(format) => *format,
                    FormatRule::Encoded(encoding) => encoding.format(),
                    FormatRule::SameAs(other) => texture_of(slot, other, resolved)?.format,
                    FormatRule::OneOf(_) => return Err(undetermined("format")),
                },
                planes: match format {
                    FormatRule::Encoded(encoding) => encoding.planes(),
                    FormatRule::SameAs(other) => texture_of(slot, other, resolved)?.planes,
                    FormatRule::Exact(_) | FormatRule::OneOf(_) => 1,
                },
                encoding: match format {
                    FormatRule::Encoded(encoding) => Some(encoding.clone()),
                    FormatRule::SameAs(other) => {
                        texture_of(slot, other, resolved)?.encoding.clone()
                    }
                    FormatRule::Exact(_) | FormatRule::OneOf(_) => None,
                },
                deviation: match format {
                    FormatRule::SameAs(other) => {
                        let before = texture_of(slot, other, resolved)?.deviation;
                        added(before, *deviation)
                    }
                    FormatRule::Encoded(_) | FormatRule::Exact(_) | FormatRule::OneOf(_) => {
                        *deviation
                    }
                },
                size: match extent {
                    ExtentRule::Exact(size) => *size,
                    ExtentRule::SameAs(other) => texture_of(slot, other, resolved)?.size,
                    ExtentRule::Any => return Err(undetermined("extent")),
                },
                regions: match extent {
                    ExtentRule::SameAs(other) => texture_of(slot, other, resolved)?.regions,
                    ExtentRule::Exact(_) | ExtentRule::Any => 1,
                },
                layers: count(layers, "number of layers", |texture| texture.layers)?,
                mips: count(mips, "number of mip levels", |texture| texture.mips)?,
                samples: count(samples, "number of samples", |texture| texture.samples)?,
            }))
        }
    }
}

/// The standard deviation of two filters one after the other: variances add up.
fn added(first: Finite, second: Finite) -> Finite {
    let sum = first.get().hypot(second.get());
    Finite::new(sum).unwrap_or(second)
}

/// The slot whose width, height and regions a slot takes.
pub(super) fn extent_from(slot: &Slot) -> Option<&str> {
    match &slot.resource {
        SlotResource::Texture(TextureRule {
            extent: ExtentRule::SameAs(other),
            ..
        }) => Some(other),
        SlotResource::Texture(_) | SlotResource::Buffer { .. } => None,
    }
}

fn texture_of<'a>(
    slot: &Slot,
    other: &str,
    resolved: &'a BTreeMap<String, ResourceDesc>,
) -> Result<&'a TextureDesc, GraphError> {
    resolved
        .get(other)
        .and_then(ResourceDesc::texture)
        .ok_or_else(|| {
            GraphError::new(
                GraphErrorKind::Declaration,
                format!("its rule refers to '{other}', which is no connected texture of the node"),
            )
            .at_slot(&slot.name)
        })
}

/// Whether a resource fits a slot and the device.
fn check(
    slot: &Slot,
    resource: &ResourceDesc,
    resolved: &BTreeMap<String, ResourceDesc>,
    capabilities: &Capabilities,
) -> Result<(), GraphError> {
    let fail = |kind, message: String| Err(GraphError::new(kind, message).at_slot(&slot.name));
    match (&slot.resource, resource) {
        (SlotResource::Buffer { size: needed, .. }, ResourceDesc::Buffer { size }) => {
            if size < needed {
                return fail(
                    GraphErrorKind::Size,
                    format!("the buffer has {size} bytes; at least {needed} are needed"),
                );
            }
            if *size == 0 || !size.is_multiple_of(BUFFER_ALIGNMENT) {
                return fail(
                    GraphErrorKind::Size,
                    format!(
                        "the buffer has {size} bytes; a storage buffer has a positive multiple of {BUFFER_ALIGNMENT}"
                    ),
                );
            }
            Ok(())
        }
        (SlotResource::Buffer { .. }, ResourceDesc::Texture(_)) => fail(
            GraphErrorKind::Format,
            "a texture is connected, but this input takes a buffer".to_owned(),
        ),
        (SlotResource::Texture(_), ResourceDesc::Buffer { .. }) => fail(
            GraphErrorKind::Format,
            "a buffer is connected, but this input takes a texture".to_owned(),
        ),
        (
            SlotResource::Texture(TextureRule {
                access,
                format,
                extent,
                layers,
                mips,
                samples,
                deviation: _,
            }),
            ResourceDesc::Texture(texture),
        ) => {
            let formats: Vec<TextureFormat> = match format {
                FormatRule::Exact(format) => vec![*format],
                FormatRule::Encoded(encoding) => vec![encoding.format()],
                FormatRule::OneOf(formats) => formats.clone(),
                FormatRule::SameAs(other) => vec![texture_of(slot, other, resolved)?.format],
            };
            if !formats.contains(&texture.format) {
                let names: Vec<&str> = formats.iter().map(|format| format.name()).collect();
                return fail(
                    GraphErrorKind::Format,
                    format!(
                        "the texture has the format {}; it has to be {}",
                        texture.format,
                        names.join(" or ")
                    ),
                );
            }
            let size = match extent {
                ExtentRule::Any => texture.size,
                ExtentRule::Exact(size) => *size,
                ExtentRule::SameAs(other) => texture_of(slot, other, resolved)?.size,
            };
            if size != texture.size {
                return fail(
                    GraphErrorKind::Size,
                    format!(
                        "the texture has {}x{} texels; it has to have {}x{}",
                        texture.size[0], texture.size[1], size[0], size[1]
                    ),
                );
            }
            use GraphErrorKind::{Format, Size};
            let counts: [(&CountRule, Count, &str, GraphErrorKind); 3] = [
                (layers, |texture| texture.layers, "layers", Size),
                (mips, |texture| texture.mips, "mip levels", Size),
                (
                    samples,
                    |texture| texture.samples,
                    "samples per texel",
                    Format,
                ),
            ];
            for (rule, of, what, kind) in counts {
                let allowed = match rule {
                    CountRule::Any => continue,
                    CountRule::Exact(count) => vec![*count],
                    CountRule::OneOf(counts) => counts.clone(),
                    CountRule::SameAs(other) => vec![of(texture_of(slot, other, resolved)?)],
                };
                if !allowed.contains(&of(texture)) {
                    let allowed: Vec<String> = allowed.iter().map(u32::to_string).collect();
                    return fail(
                        kind,
                        format!(
                            "the texture has {} {what}; it has to have {}",
                            of(texture),
                            allowed.join(" or ")
                        ),
                    );
                }
            }
            limits(texture, capabilities).map_err(|error| error.at_slot(&slot.name))?;
            usable(texture, *access, capabilities).map_err(|error| error.at_slot(&slot.name))
        }
    }
}

/// Sizes of storage buffers are multiples of this in WebGPU.
const BUFFER_ALIGNMENT: u64 = 4;
