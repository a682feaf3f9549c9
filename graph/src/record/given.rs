//! What the host gives to be bound, compared with what the plan was compiled for.

use super::format::texture_difference;
use crate::error::ensure;
use crate::{GraphError, GraphErrorKind, Named, Plan, PlannedResource, ResourceDesc};

/// A handle of a resource that the host owns, as it is bound.
#[derive(Clone, Debug)]
pub enum ImportedResource {
    /// A texture with all its layers.
    Texture(wgpu::Texture),
    /// One texture per layer: the form of multisampled textures with several layers.
    Layers(Vec<wgpu::Texture>),
    /// A buffer.
    Buffer(wgpu::Buffer),
}

impl From<&wgpu::Texture> for ImportedResource {
    fn from(texture: &wgpu::Texture) -> Self {
        Self::Texture(texture.clone())
    }
}

pub(super) fn check_parameters(
    plan: &Plan,
    parameters: Option<&wgpu::Buffer>,
    alignment: u32,
) -> Result<(), GraphError> {
    let needed = u64::from(plan.parameters.size);
    let problem = match parameters {
        None if needed > 0 => Some("is missing".to_owned()),
        Some(buffer) if buffer.size() < needed => Some(format!("has {} bytes", buffer.size())),
        Some(buffer) if !buffer.usage().contains(wgpu::BufferUsages::UNIFORM) => {
            Some("has no usage UNIFORM".to_owned())
        }
        _ => None,
    };
    if let Some(problem) = problem {
        let message = format!("the parameter buffer {problem}; a view's block has {needed} bytes");
        return Err(GraphError::new(GraphErrorKind::Parameters, message));
    }
    let blocks = plan.parameters.blocks.iter();
    let blocks = blocks.map(|block| (&block.node, block.offset, block.stride));
    let tables = plan.parameters.regions.iter();
    let tables = tables.map(|table| (&table.map, table.offset, table.stride));
    for (name, offset, stride) in blocks.chain(tables) {
        let even = offset.is_multiple_of(alignment) && stride.is_multiple_of(alignment);
        ensure(even, GraphErrorKind::Plan, || {
            format!(
                "the parameters of '{name}' lie at multiples of {stride} bytes, but this device takes multiples of \
                 {alignment}; compile the graph for this device"
            )
        })?;
    }
    Ok(())
}

pub(super) fn find_import<'a>(
    plan: &Plan,
    import: &Named<usize>,
    imports: &'a [(&str, ImportedResource)],
) -> Result<&'a ImportedResource, GraphError> {
    let (name, planned) = (&import.name, &plan.resources[import.value]);
    let expected = &planned.desc;
    let Some((_, given)) = imports.iter().find(|(given, _)| given == name) else {
        let message =
            format!("import '{name}' is missing; bind it as the plan describes it: {expected}");
        return Err(GraphError::new(GraphErrorKind::MissingImport, message));
    };
    let difference = match (given, &planned.desc) {
        (ImportedResource::Texture(texture), ResourceDesc::Texture(desc)) => {
            texture_difference(texture, desc, desc.array_layers(), &planned.usage)
        }
        (ImportedResource::Layers(textures), ResourceDesc::Texture(desc)) => {
            let listed = textures.len();
            let mut all = textures.iter();
            (listed != desc.array_layers() as usize)
                .then(|| format!("a list of {listed} textures"))
                .or_else(|| all.find_map(|it| texture_difference(it, desc, 1, &planned.usage)))
        }
        (ImportedResource::Buffer(buffer), ResourceDesc::Buffer { size }) => {
            let (given, usage) = (buffer.size(), buffer.usage());
            let fits = given >= *size && usage.contains(wgpu::BufferUsages::STORAGE);
            (!fits).then(|| format!("a buffer of {given} bytes with {usage:?}"))
        }
        (ImportedResource::Buffer(_), ResourceDesc::Texture(_)) => Some("a buffer".to_owned()),
        (_, ResourceDesc::Buffer { .. }) => Some("a texture".to_owned()),
    };
    match difference {
        None => Ok(given),
        Some(given) => Err(wrong_import(planned, &given)),
    }
}

/// The error about an import that is something else.
pub(super) fn wrong_import(planned: &PlannedResource, given: &str) -> GraphError {
    let PlannedResource { name, desc, .. } = planned;
    GraphError::new(
        GraphErrorKind::Import,
        format!(
            "import '{name}' is {given}, but the plan was compiled for {desc}; compile the graph for what is bound"
        ),
    )
}
