//! The textures and buffers that a plan's resources are: the host's imports, and those created for it.

use super::given::ImportedResource;
use super::resources::Created;
use super::{RecordError, Resources};
use crate::{Home, Plan, PlannedResource};

/// Where a plan's resources are found.
pub(super) struct Objects<'a> {
    pub(super) plan: &'a Plan,
    pub(super) resources: &'a Resources,
    pub(super) imports: Vec<ImportedResource<'a>>,
}

/// One mip level of one plane of a layer.
#[derive(Clone, Copy, Default)]
pub(super) struct Part {
    pub(super) layer: u32,
    pub(super) plane: u32,
    pub(super) level: u32,
}

enum Object<'a> {
    Texture(&'a wgpu::Texture),
    Layers(&'a [wgpu::Texture]),
    Buffer(&'a wgpu::Buffer),
}

impl Objects<'_> {
    /// A view of one mip level of one plane of a layer, or an array view of all.
    pub(super) fn view(
        &self,
        resource: usize,
        part: Option<Part>,
    ) -> Result<wgpu::TextureView, RecordError> {
        let planned = &self.plan.resources[resource];
        let planes = planned.desc.texture().map_or(1, |texture| texture.planes);
        let layer = part.map(|part| part.layer * planes + part.plane);
        let (texture, layer) = match self.object(planned) {
            Some(Object::Texture(texture)) => (texture, layer),
            Some(Object::Layers(textures)) => {
                // An array view needs an array texture; a list of one layer is one.
                let chosen = layer.or((textures.len() == 1).then_some(0));
                let texture = chosen.and_then(|layer| textures.get(layer as usize));
                let texture = texture.ok_or_else(|| self.wrong(planned, "a list of textures"))?;
                (texture, layer.map(|_| 0))
            }
            Some(Object::Buffer(_)) | None => return Err(self.wrong(planned, "a buffer")),
        };
        Ok(texture.create_view(&wgpu::TextureViewDescriptor {
            label: Some(&planned.name),
            dimension: Some(match layer {
                Some(_) => wgpu::TextureViewDimension::D2,
                None => wgpu::TextureViewDimension::D2Array,
            }),
            base_array_layer: layer.unwrap_or(0),
            array_layer_count: layer.map(|_| 1),
            base_mip_level: part.map_or(0, |part| part.level),
            mip_level_count: part.map(|_| 1),
            ..Default::default()
        }))
    }

    pub(super) fn buffer(&self, resource: usize) -> Result<wgpu::Buffer, RecordError> {
        let planned = &self.plan.resources[resource];
        match self.object(planned) {
            Some(Object::Buffer(buffer)) => Ok(buffer.clone()),
            Some(Object::Texture(_) | Object::Layers(_)) | None => {
                Err(self.wrong(planned, "a texture"))
            }
        }
    }

    fn object(&self, planned: &PlannedResource) -> Option<Object<'_>> {
        match planned.home {
            Home::Import(index) => self.imports.get(index).map(|import| match import {
                ImportedResource::Texture(texture) => Object::Texture(texture),
                ImportedResource::Layers(textures) => Object::Layers(textures),
                ImportedResource::Buffer(buffer) => Object::Buffer(buffer),
            }),
            Home::Memory(_) => self.resources.get(planned).map(|created| match created {
                Created::Texture(texture) => Object::Texture(texture),
                Created::Buffer(buffer) => Object::Buffer(buffer),
            }),
        }
    }

    fn wrong(&self, planned: &PlannedResource, given: &str) -> RecordError {
        RecordError::WrongImport {
            name: planned.name.clone(),
            expected: planned.desc.to_string(),
            given: given.to_owned(),
        }
    }
}
