//! What the host gives: textures and buffers, described by what they are.

use super::unsuitable;
use crate::record::ImportedResource;
use crate::{GraphError, Named, ResourceDesc, TextureDesc};
use moment_shadows::{Finite, TextureFormat};

/// An import by name, with its description.
#[derive(Clone, Debug)]
pub(super) struct Given {
    pub(super) name: String,
    pub(super) desc: ResourceDesc,
    pub(super) resource: Owned,
}

/// The session's own handles of what the host gives.
#[derive(Clone, Debug)]
pub(super) enum Owned {
    Texture(wgpu::Texture),
    Layers(Vec<wgpu::Texture>),
    Buffer(wgpu::Buffer),
}

impl Owned {
    pub(super) fn as_imported(&self) -> ImportedResource<'_> {
        match self {
            Owned::Texture(texture) => ImportedResource::Texture(texture),
            Owned::Layers(textures) => ImportedResource::Layers(textures),
            Owned::Buffer(buffer) => ImportedResource::Buffer(buffer),
        }
    }
}

/// Keeps what the host gives. Regions and encodings are not to be seen in a texture: they are those that the graph file
/// expects.
pub(super) fn take(
    imports: &[(&str, ImportedResource<'_>)],
    expected: &[Named<Option<ResourceDesc>>],
) -> Result<Vec<Given>, GraphError> {
    let mut taken: Vec<Given> = Vec::with_capacity(imports.len());
    for &(name, resource) in imports {
        let expected = expected.iter().find(|import| import.name == name);
        let expected = expected.and_then(|import| import.value.as_ref());
        let expected = expected.and_then(ResourceDesc::texture);
        let (resource, desc) = match resource {
            ImportedResource::Texture(texture) => {
                let layers = texture.depth_or_array_layers();
                let desc = described_texture(name, texture, layers, expected)?;
                (Owned::Texture(texture.clone()), desc)
            }
            ImportedResource::Layers(textures) => {
                let first = textures.first().ok_or_else(|| {
                    unsuitable(
                        format!("import '{name}'"),
                        "it is a list of no textures; give one per layer",
                    )
                })?;
                let desc = described_texture(name, first, textures.len() as u32, expected)?;
                (Owned::Layers(textures.to_vec()), desc)
            }
            ImportedResource::Buffer(buffer) => {
                let size = buffer.size();
                (Owned::Buffer(buffer.clone()), ResourceDesc::Buffer { size })
            }
        };
        taken.retain(|earlier| earlier.name != name);
        taken.push(Given {
            name: name.to_owned(),
            desc,
            resource,
        });
    }
    Ok(taken)
}

fn described_texture(
    name: &str,
    texture: &wgpu::Texture,
    array_layers: u32,
    expected: Option<&TextureDesc>,
) -> Result<ResourceDesc, GraphError> {
    let mut formats = TextureFormat::ALL.into_iter();
    let is_same = |format: &TextureFormat| {
        TextureDesc::new(*format, [1; 2]).wgpu_format() == texture.format()
    };
    let format = formats.find(is_same);
    let format = format.ok_or_else(|| {
        let known = TextureFormat::ALL.map(TextureFormat::name).join(", ");
        let reason = format!("its format is {:?}; nodes take {known}", texture.format());
        unsuitable(format!("import '{name}'"), reason)
    })?;
    let planes = expected.map_or(1, |expected| expected.planes.max(1));
    Ok(ResourceDesc::Texture(TextureDesc {
        format,
        size: [texture.width(), texture.height()],
        layers: array_layers / planes,
        mips: texture.mip_level_count(),
        regions: expected.map_or(1, |expected| expected.regions),
        planes,
        encoding: expected.and_then(|expected| expected.encoding.clone()),
        deviation: expected.map_or(Finite::ZERO, |expected| expected.deviation),
        samples: texture.sample_count(),
    }))
}

/// The descriptions of what is given.
pub(super) fn described(given: &[Given]) -> Vec<(&str, ResourceDesc)> {
    let each = given.iter();
    each.map(|given| (given.name.as_str(), given.desc.clone()))
        .collect()
}

/// What is given now, and what was given before and is not replaced.
pub(super) fn merged(before: &[Given], now: Vec<Given>) -> Vec<Given> {
    let stays = |it: &&Given| now.iter().all(|given| given.name != it.name);
    let mut all: Vec<Given> = before.iter().filter(stays).cloned().collect();
    all.extend(now);
    all
}
