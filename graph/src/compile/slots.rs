//! Rules of slots: what may be connected, and what a node's own resources become.

use std::collections::{BTreeMap, BTreeSet};

use moment_shadows::{Finite, MapEncoding, TextureFormat};

use super::declaration;
use super::limits::{limits, usable};
use crate::GraphErrorKind::{Declaration, DuplicateName, Format, Size};
use crate::error::ensure;
use crate::node::{missing_input, wrong_kind};
use crate::{
    Capabilities, Direction, GraphError, NodeDesc, ResourceDesc, Rule, Slot, SlotResource,
    TextureDesc, TextureRule,
};

/// Checks what is connected to a node and gives every slot of it a concrete resource.
pub(super) fn resolve(
    desc: &NodeDesc,
    inputs: &BTreeMap<String, ResourceDesc>,
    capabilities: &Capabilities,
) -> Result<BTreeMap<String, ResourceDesc>, GraphError> {
    let mut names = BTreeSet::new();
    for slot in &desc.slots {
        let described = !slot.description.trim().is_empty();
        let writes_input = slot.direction == Direction::In && slot.resource.access().writes();
        let is_new = names.insert(slot.name.as_str());
        let wrong = if !is_new {
            "the node declares two slots of this name"
        } else if !described {
            "the slot has no description; say in a sentence what it is for"
        } else if writes_input {
            "the node writes to an input; declare it as changed in place ('in_out')"
        } else {
            continue;
        };
        let kind = if is_new { Declaration } else { DuplicateName };
        return Err(GraphError::new(kind, wrong).at_slot(&slot.name));
    }
    let mut resolved = inputs.clone();
    let (inputs_of, made): (Vec<&Slot>, Vec<&Slot>) =
        desc.slots.iter().partition(|slot| slot.direction.takes());
    for slot in inputs_of {
        match inputs.get(&slot.name) {
            Some(resource) => check(slot, resource, &resolved, capabilities)?,
            None if slot.optional => {}
            None => return Err(missing_input(&slot.name)),
        }
    }
    for slot in made {
        let resource = make(slot, &resolved).map_err(|error| error.at_slot(&slot.name))?;
        check(slot, &resource, &resolved, capabilities)?;
        let texture = resource.texture();
        if texture.is_some_and(|texture| texture.samples > 1 && texture.layers > 1) {
            let message = "the node makes a multisampled texture with several layers, which WebGPU does not have";
            return Err(declaration(message).at_slot(&slot.name));
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
    fn exact<T: Copy>(
        resolved: &BTreeMap<String, ResourceDesc>,
        rule: &Rule<T>,
        what: &str,
        of: fn(&TextureDesc) -> T,
    ) -> Result<T, GraphError> {
        match rule {
            Rule::Exact(value) => Ok(*value),
            Rule::SameAs(other) => Ok(of(texture_of(other, resolved)?)),
            Rule::OneOf(_) | Rule::Any => Err(declaration(format!(
                "the node makes this resource, but leaves its {what} open"
            ))),
        }
    }
    let rule = match &slot.resource {
        SlotResource::Buffer { size, .. } => return Ok(ResourceDesc::Buffer { size: *size }),
        SlotResource::Texture(rule) => rule,
    };
    let count = |rule, what, of| exact(resolved, rule, what, of);
    let format = exact(resolved, &rule.format, "format", |other| other.format)?;
    let size = exact(resolved, &extent(rule, resolved)?, "extent", |other| {
        other.size
    })?;
    let mut texture = TextureDesc {
        layers: count(&rule.layers, "number of layers", |other| other.layers)?,
        mips: count(&rule.mips, "number of mip levels", |other| other.mips)?,
        samples: count(&rule.samples, "number of samples", |other| other.samples)?,
        deviation: rule.deviation,
        width: rule.width,
        ..TextureDesc::new(format, size)
    };
    if let Some(encoding) = &rule.encoding {
        texture.planes = encoding.planes();
        texture.encoding = Some(encoding.as_ref().clone());
    }
    // Ranges themselves get their name from the compiler.
    let ranges = rule.fitted_to.iter().filter(|other| **other != slot.name);
    let mut ranges = ranges.filter_map(|other| resolved.get(other)?.texture());
    texture.range = ranges.find_map(|ranges| ranges.range.clone());
    if let Rule::SameAs(other) = &rule.format {
        let other = texture_of(other, resolved)?;
        texture.range = other.range.clone();
        texture.planes = other.planes;
        // Texels that are made of another map's are rounded to all sides.
        texture.encoding = other.encoding.clone().map(MapEncoding::rounded_again);
        texture.deviation = added(other.deviation, rule.deviation);
        texture.width = added(other.width, rule.width);
    }
    if let (Rule::SameAs(other), [1, 1]) = (&rule.extent, rule.per) {
        texture.regions = texture_of(other, resolved)?.regions;
    }
    Ok(ResourceDesc::Texture(texture))
}

/// The rule of a texture's width and height, with those of another slot divided.
fn extent(
    rule: &TextureRule,
    resolved: &BTreeMap<String, ResourceDesc>,
) -> Result<Rule<[u32; 2]>, GraphError> {
    Ok(match &rule.extent {
        Rule::SameAs(other) => Rule::Exact(rule.extent_of(texture_of(other, resolved)?.size)),
        Rule::Exact(_) | Rule::OneOf(_) | Rule::Any => rule.extent.clone(),
    })
}

/// The standard deviation of two filters one after the other: variances add up.
fn added(first: Finite, second: Finite) -> Finite {
    let sum = first.get().hypot(second.get());
    Finite::new(sum).unwrap_or(second)
}

/// The slot whose width and height a slot's follow from, and the texels of that for each texel.
pub(super) fn extent_from(slot: &Slot) -> Option<(&str, [u32; 2])> {
    match &slot.resource {
        SlotResource::Texture(TextureRule {
            extent: Rule::SameAs(other),
            per,
            ..
        }) => Some((other, *per)),
        SlotResource::Texture(_) | SlotResource::Buffer { .. } => None,
    }
}

fn texture_of<'a>(
    other: &str,
    resolved: &'a BTreeMap<String, ResourceDesc>,
) -> Result<&'a TextureDesc, GraphError> {
    let texture = resolved.get(other).and_then(ResourceDesc::texture);
    texture.ok_or_else(|| {
        declaration(format!(
            "its rule refers to '{other}', which is no connected texture of the node"
        ))
    })
}

/// Whether a resource fits a slot and the device.
fn check(
    slot: &Slot,
    resource: &ResourceDesc,
    resolved: &BTreeMap<String, ResourceDesc>,
    capabilities: &Capabilities,
) -> Result<(), GraphError> {
    let checked = match (&slot.resource, resource) {
        (SlotResource::Buffer { size: needed, .. }, ResourceDesc::Buffer { size }) => {
            let aligned = *size > 0 && size.is_multiple_of(BUFFER_ALIGNMENT);
            ensure(size >= needed, Size, || {
                format!("the buffer has {size} bytes; at least {needed} are needed")
            })
            .and(ensure(aligned, Size, || {
                format!(
                    "the buffer has {size} bytes; a storage buffer has a positive multiple of {BUFFER_ALIGNMENT}"
                )
            }))
        }
        (SlotResource::Buffer { .. }, ResourceDesc::Texture(_)) => {
            Err(wrong_kind("texture", "buffer"))
        }
        (SlotResource::Texture(_), ResourceDesc::Buffer { .. }) => {
            Err(wrong_kind("buffer", "texture"))
        }
        (SlotResource::Texture(rule), ResourceDesc::Texture(texture)) => {
            check_texture(rule, texture, resolved)
                .and_then(|()| limits(texture, capabilities))
                .and_then(|()| usable(texture, rule.access, capabilities))
        }
    };
    checked.map_err(|error| error.at_slot(&slot.name))
}

/// Whether a texture keeps to the rules of its slot.
fn check_texture(
    rule: &TextureRule,
    texture: &TextureDesc,
    resolved: &BTreeMap<String, ResourceDesc>,
) -> Result<(), GraphError> {
    let count = |rule, of| allowed(rule, u32::to_string, of, texture, resolved);
    let format = |format: &TextureFormat| format.name().to_owned();
    let size = |size: &[u32; 2]| format!("{}x{}", size[0], size[1]);
    let format = allowed(&rule.format, format, |it| it.format, texture, resolved)?;
    let extent = extent(rule, resolved)?;
    let extent = allowed(&extent, size, |it| it.size, texture, resolved)?;
    let layers = count(&rule.layers, |it| it.layers)?;
    let mips = count(&rule.mips, |it| it.mips)?;
    let samples = count(&rule.samples, |it| it.samples)?;
    for ((found, allowed), kind, has, has_to) in [
        (format, Format, "the format {}", "be"),
        (extent, Size, "{} texels", "have"),
        (layers, Size, "{} layers", "have"),
        (mips, Size, "{} mip levels", "have"),
        (samples, Format, "{} samples per texel", "have"),
    ] {
        let holds = allowed.is_empty() || allowed.contains(&found);
        ensure(holds, kind, || {
            let has = has.replace("{}", &found);
            let allowed = allowed.join(" or ");
            format!("the texture has {has}; it has to {has_to} {allowed}")
        })?;
    }
    Ok(())
}

/// A property of a texture and what a rule allows of it, as texts; nothing where it allows anything.
fn allowed<T>(
    rule: &Rule<T>,
    text: impl Fn(&T) -> String,
    of: fn(&TextureDesc) -> T,
    texture: &TextureDesc,
    resolved: &BTreeMap<String, ResourceDesc>,
) -> Result<(String, Vec<String>), GraphError> {
    let allowed = match rule {
        Rule::Any => Vec::new(),
        Rule::Exact(value) => vec![text(value)],
        Rule::OneOf(values) => values.iter().map(&text).collect(),
        Rule::SameAs(slot) => vec![text(&of(texture_of(slot, resolved)?))],
    };
    Ok((text(&of(texture)), allowed))
}

/// Sizes of storage buffers are multiples of this in WebGPU.
const BUFFER_ALIGNMENT: u64 = 4;
