//! What the host gives: textures and buffers, described by what they are.

use super::unsuitable;
use crate::record::ImportedResource;
use crate::{GraphError, Named, ResourceDesc, TextureDesc};
use moment_shadows::TextureFormat;

/// An import by name, with its description.
#[derive(Clone, Debug)]
pub(super) struct Given {
    pub(super) name: String,
    pub(super) desc: ResourceDesc,
    pub(super) resource: ImportedResource,
}

/// Keeps what the host gives. Regions and encodings are not to be seen in a texture: they are those that the graph file
/// expects.
pub(super) fn take(
    imports: &[(&str, ImportedResource)],
    expected: &[Named<Option<ResourceDesc>>],
) -> Result<Vec<Given>, GraphError> {
    let given = imports.iter().map(|(name, resource)| {
        let expected = expected.iter().find(|import| import.name == *name);
        let expected = expected.and_then(|import| import.value.as_ref()?.texture());
        Ok(Given {
            name: (*name).to_owned(),
            desc: describe(resource, expected)
                .map_err(|reason| unsuitable(format!("import '{name}'"), reason))?,
            resource: resource.clone(),
        })
    });
    given.collect()
}

/// What a resource is, or what is wrong with it.
fn describe(
    resource: &ImportedResource,
    expected: Option<&TextureDesc>,
) -> Result<ResourceDesc, String> {
    let (texture, array_layers) = match resource {
        ImportedResource::Texture(texture) => (Some(texture), texture.depth_or_array_layers()),
        ImportedResource::Layers(textures) => (textures.first(), textures.len() as u32),
        ImportedResource::Buffer(buffer) => {
            let size = buffer.size();
            return Ok(ResourceDesc::Buffer { size });
        }
    };
    let texture = texture.ok_or("it is a list of no textures; give one per layer")?;
    let (format, size) = (texture.format(), [texture.width(), texture.height()]);
    let mut known = TextureFormat::ALL
        .map(|format| TextureDesc::new(format, size))
        .into_iter();
    let desc = known.find(|desc| desc.wgpu_format() == format);
    let desc = desc.ok_or_else(|| {
        let known = TextureFormat::ALL.map(TextureFormat::name).join(", ");
        format!("its format is {format:?}; nodes take {known}")
    })?;
    let expected = expected.unwrap_or(&desc).clone();
    Ok(ResourceDesc::Texture(TextureDesc {
        format: desc.format,
        size,
        layers: array_layers / expected.planes.max(1),
        mips: texture.mip_level_count(),
        samples: texture.sample_count(),
        ..expected
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
