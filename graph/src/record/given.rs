//! What the host gives to be bound, compared with what the plan was compiled for.

use super::RecordError;
use super::format::texture_difference;
use crate::{Plan, ResourceDesc};

/// A resource that the host owns, as it is bound.
#[derive(Clone, Copy, Debug)]
pub enum ImportedResource<'a> {
    /// A texture with all its layers.
    Texture(&'a wgpu::Texture),
    /// One texture per layer: the form of multisampled textures with several layers.
    Layers(&'a [wgpu::Texture]),
    /// A buffer.
    Buffer(&'a wgpu::Buffer),
}

impl<'a> From<&'a wgpu::Texture> for ImportedResource<'a> {
    fn from(texture: &'a wgpu::Texture) -> Self {
        Self::Texture(texture)
    }
}

pub(super) fn check_parameters(
    plan: &Plan,
    parameters: Option<&wgpu::Buffer>,
) -> Result<(), RecordError> {
    let needed = u64::from(plan.parameters.size);
    let problem = match parameters {
        None if needed > 0 => Some("is missing".to_owned()),
        Some(buffer) if buffer.size() < needed => Some(format!("has {} bytes", buffer.size())),
        Some(buffer) if !buffer.usage().contains(wgpu::BufferUsages::UNIFORM) => {
            Some("has no usage UNIFORM".to_owned())
        }
        _ => None,
    };
    problem.map_or(Ok(()), |problem| {
        Err(RecordError::ParameterBuffer { problem, needed })
    })
}

pub(super) fn check_alignment(plan: &Plan, alignment: u32) -> Result<(), RecordError> {
    let blocks = plan.parameters.blocks.iter();
    let blocks = blocks.map(|block| (&block.node, block.offset, block.stride));
    let tables = plan.parameters.regions.iter();
    let tables = tables.map(|table| (&table.map, table.offset, table.stride));
    let uneven = blocks.chain(tables).find(|(_, offset, stride)| {
        !(offset.is_multiple_of(alignment) && stride.is_multiple_of(alignment))
    });
    uneven.map_or(Ok(()), |(name, _, stride)| {
        Err(RecordError::Alignment {
            node: name.clone(),
            spacing: stride,
            alignment,
        })
    })
}

pub(super) fn find_import<'a>(
    plan: &Plan,
    name: &str,
    resource: usize,
    imports: &[(&str, ImportedResource<'a>)],
) -> Result<ImportedResource<'a>, RecordError> {
    let planned = &plan.resources[resource];
    let expected = planned.desc.to_string();
    let Some((_, given)) = imports.iter().find(|(given, _)| *given == name) else {
        return Err(RecordError::MissingImport {
            name: name.to_owned(),
            expected,
        });
    };
    let difference = match (given, &planned.desc) {
        (ImportedResource::Texture(texture), ResourceDesc::Texture(desc)) => {
            texture_difference(texture, desc, desc.array_layers(), planned.access)
        }
        (ImportedResource::Layers(textures), ResourceDesc::Texture(desc)) => {
            if textures.len() == desc.array_layers() as usize {
                textures
                    .iter()
                    .find_map(|texture| texture_difference(texture, desc, 1, planned.access))
            } else {
                Some(format!("a list of {} textures", textures.len()))
            }
        }
        (ImportedResource::Buffer(buffer), ResourceDesc::Buffer { size }) => (buffer.size()
            < *size
            || !buffer.usage().contains(wgpu::BufferUsages::STORAGE))
        .then(|| {
            format!(
                "a buffer of {} bytes with {:?}",
                buffer.size(),
                buffer.usage()
            )
        }),
        (ImportedResource::Buffer(_), ResourceDesc::Texture(_)) => Some("a buffer".to_owned()),
        (_, ResourceDesc::Buffer { .. }) => Some("a texture".to_owned()),
    };
    match difference {
        None => Ok(*given),
        Some(given) => Err(RecordError::WrongImport {
            name: name.to_owned(),
            expected,
            given,
        }),
    }
}
