//! The textures and buffers that a plan's resources are: the host's imports, and those created for it.

use super::Resources;
use super::given::{ImportedResource, wrong_import};
use crate::plan::Part;
use crate::{GraphError, Home, Plan, PlannedResource};

/// What passes are bound to: where a plan's resources are found.
pub(super) struct Objects<'a> {
    pub(super) device: &'a wgpu::Device,
    pub(super) plan: &'a Plan,
    pub(super) resources: &'a Resources,
    pub(super) imports: Vec<&'a ImportedResource>,
    pub(super) parameters: Option<&'a wgpu::Buffer>,
}

impl Objects<'_> {
    /// A view of a part of a texture: of one mip level of one plane of `layer`, or an array view of all.
    pub(super) fn view(
        &self,
        resource: usize,
        part: Part,
        layer: u32,
    ) -> Result<wgpu::TextureView, GraphError> {
        let planned = &self.plan.resources[resource];
        let planes = planned.desc.texture().map_or(1, |texture| texture.planes);
        let (layer, level) = match part {
            Part::Level { level, plane } => (Some(layer * planes + plane), Some(level)),
            Part::Layers | Part::Buffer => (None, None),
        };
        let (texture, layer) = match self.object(planned) {
            Some(ImportedResource::Texture(texture)) => (texture, layer),
            Some(ImportedResource::Layers(textures)) => {
                // An array view needs an array texture; a list of one layer is one.
                let chosen = layer.or((textures.len() == 1).then_some(0));
                let texture = chosen.and_then(|layer| textures.get(layer as usize));
                let texture = texture.ok_or_else(|| wrong_import(planned, "a list of textures"))?;
                (texture, layer.map(|_| 0))
            }
            Some(ImportedResource::Buffer(_)) | None => {
                return Err(wrong_import(planned, "a buffer"));
            }
        };
        // A stencil beside the depth is nothing that a shader reads with it.
        let is_depth = texture.format().has_depth_aspect();
        Ok(texture.create_view(&wgpu::TextureViewDescriptor {
            label: Some(&planned.name),
            dimension: Some(match layer {
                Some(_) => wgpu::TextureViewDimension::D2,
                None => wgpu::TextureViewDimension::D2Array,
            }),
            aspect: match is_depth {
                true => wgpu::TextureAspect::DepthOnly,
                false => wgpu::TextureAspect::All,
            },
            base_array_layer: layer.unwrap_or(0),
            array_layer_count: layer.map(|_| 1),
            base_mip_level: level.unwrap_or(0),
            mip_level_count: level.map(|_| 1),
            ..Default::default()
        }))
    }

    pub(super) fn buffer(&self, resource: usize) -> Result<wgpu::Buffer, GraphError> {
        let planned = &self.plan.resources[resource];
        if let Some(ImportedResource::Buffer(buffer)) = self.object(planned) {
            Ok(buffer.clone())
        } else {
            Err(wrong_import(planned, "a texture"))
        }
    }

    fn object(&self, planned: &PlannedResource) -> Option<&ImportedResource> {
        match planned.home {
            Home::Import(index) => self.imports.get(index).copied(),
            Home::Memory(_) => self.resources.get(planned),
        }
    }
}
