//! From a node's declaration to its shaders.

use std::collections::BTreeMap;

use moment_shadows::TextureFormat;
use moment_shadows_graph::{
    Binding, BindingResource, Connected, FormatRule, NodeDesc, Pass, ResourceDesc, SlotResource,
    TextureRule, Work,
};

use super::error::IsaError;
use super::subjects::{Entry, SIZE, Subject, SubjectWork};

/// The shaders of every pass that the node itself records.
pub(super) fn describe(entry: &Entry) -> Result<Vec<Subject>, IsaError> {
    let desc = entry
        .node
        .describe(&Connected::new(&entry.inputs, &entry.capabilities))
        .map_err(|error| IsaError::Node {
            shader: entry.settings.clone(),
            error,
        })?;
    let formats = Formats {
        desc: &desc,
        inputs: &entry.inputs,
    };
    desc.passes
        .iter()
        .filter_map(|pass| {
            let name = format!("{}, {}: {}", desc.name, entry.settings, pass.label);
            let work = match &pass.work {
                Work::Compute {
                    texels_per_workgroup,
                    ..
                }
                | Work::ComputeRegions {
                    texels_per_workgroup,
                    ..
                } => SubjectWork::Compute {
                    // A workgroup for whole lines covers no more than there is.
                    texels_per_workgroup: texels_per_workgroup
                        .iter()
                        .zip(SIZE)
                        .map(|(&texels, side)| texels.min(side))
                        .product(),
                },
                Work::Fullscreen { target, .. } | Work::FullscreenRegions { target, .. } => {
                    match formats.of(target) {
                        Some(format) => SubjectWork::Fragment {
                            targets: vec![format],
                        },
                        None => {
                            return Some(Err(IsaError::Shader {
                                shader: name,
                                reason: format!("its target '{target}' has no format"),
                            }));
                        }
                    }
                }
                Work::Host { .. } => return None,
            };
            Some(Ok(Subject {
                name,
                wgsl: pass.wgsl.clone(),
                entry_point: pass.entry_point.clone(),
                constants: pass.constants.clone(),
                work,
                texel_bytes: formats.widest(pass),
                trips: entry
                    .pass_trips
                    .get(pass.label.as_str())
                    .unwrap_or(&entry.trips)
                    .clone(),
            }))
        })
        .collect()
}

/// The formats of a node's slots.
struct Formats<'a> {
    desc: &'a NodeDesc,
    inputs: &'a BTreeMap<String, ResourceDesc>,
}

impl Formats<'_> {
    /// That of what is connected to the slot, or of what the node makes for it.
    fn of(&self, slot: &str) -> Option<TextureFormat> {
        if let Some(resource) = self.inputs.get(slot) {
            return resource.texture().map(|texture| texture.format);
        }
        let slot = self.desc.slots.iter().find(|other| other.name == slot)?;
        let SlotResource::Texture(TextureRule { format, .. }) = &slot.resource else {
            return None;
        };
        match format {
            FormatRule::Exact(format) => Some(*format),
            FormatRule::Encoded(encoding) => Some(encoding.format()),
            FormatRule::SameAs(input) => {
                let texture = self.inputs.get(input)?.texture()?;
                Some(texture.format)
            }
            FormatRule::OneOf(formats) => formats.first().copied(),
        }
    }

    /// Bytes of the widest texel that a pass touches through a binding.
    fn widest(&self, pass: &Pass) -> u32 {
        let slot = |binding: &Binding| match &binding.resource {
            BindingResource::Layers(slot) => self.of(slot),
            BindingResource::Level(level) | BindingResource::StorageLevel(level) => {
                self.of(&level.slot)
            }
            _ => None,
        };
        pass.bindings
            .iter()
            .filter_map(slot)
            .map(TextureFormat::bytes_per_texel)
            .max()
            .unwrap_or(0)
    }
}
