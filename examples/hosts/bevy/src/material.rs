//! The material extension, on Bevy's hook for shadows of one's own.

use bevy::asset::uuid_handle;
use bevy::ecs::system::SystemParamItem;
use bevy::ecs::system::lifetimeless::SRes;
use bevy::pbr::MaterialExtension;
use bevy::prelude::*;
use bevy::render::render_resource::{
    AsBindGroup, AsBindGroupError, BindGroupBuilder, BindGroupLayout, BindGroupLayoutEntry,
    BindingType, BufferBindingType, SamplerBindingType, ShaderStages, TextureSampleType,
    TextureViewDimension, UnpreparedBindingResource,
};
use bevy::render::renderer::RenderDevice;
use bevy::shader::ShaderRef;

use crate::maps::Maps;

/// The shader of extended materials.
pub(crate) const FILTERED_SHADOWS_SHADER: Handle<Shader> =
    uuid_handle!("6b6f7f52-6d6f-4d65-8e74-736861646f77");

/// Extends `StandardMaterial` by filtered shadows of the directional light and of spot lights:
/// `ExtendedMaterial<StandardMaterial, FilteredShadows>`.
#[derive(Asset, TypePath, Clone, Debug, Default)]
pub struct FilteredShadows {}

/// Bindings in the material's group; `lookup_*.wesl`, `table.wesl` and `shadow_view.wesl` have the same numbers.
const TEXTURES: [u32; 3] = [100, 102, 103];
const SAMPLER: u32 = 101;
const TABLE: u32 = 104;

impl MaterialExtension for FilteredShadows {
    fn fragment_shader() -> ShaderRef {
        ShaderRef::Handle(FILTERED_SHADOWS_SHADER)
    }
}

impl AsBindGroup for FilteredShadows {
    type Data = ();
    type Param = SRes<Maps>;

    fn label() -> &'static str {
        "moment-shadows"
    }

    fn bind_group_data(&self) -> Self::Data {}

    fn build_bind_group(
        &self,
        _: &BindGroupLayout,
        _: &RenderDevice,
        maps: &mut SystemParamItem<'_, '_, Self::Param>,
        _: bool,
        output: &mut BindGroupBuilder,
    ) -> Result<(), AsBindGroupError> {
        let bound = maps.bound.as_ref();
        let bound = bound.ok_or(AsBindGroupError::RetryNextUpdate)?;
        let textures = TEXTURES.iter().zip(&bound.views).map(|(number, view)| {
            let dimension = TextureViewDimension::D2Array;
            let view = UnpreparedBindingResource::TextureView(dimension, view.clone());
            (*number, view)
        });
        output.extend(textures);
        let sampler = (SamplerBindingType::Filtering, bound.sampler.clone());
        output.push((
            SAMPLER,
            UnpreparedBindingResource::Sampler(sampler.0, sampler.1),
        ));
        let table = UnpreparedBindingResource::Buffer(bound.table.clone());
        output.push((TABLE, table));
        Ok(())
    }

    fn bind_group_layout_entries(_: &RenderDevice, _: bool) -> Vec<BindGroupLayoutEntry> {
        let texture = |sample_type| BindingType::Texture {
            sample_type,
            view_dimension: TextureViewDimension::D2Array,
            multisampled: false,
        };
        let float = |filterable| texture(TextureSampleType::Float { filterable });
        let table = BindingType::Buffer {
            ty: BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let entries = [
            (TEXTURES[0], float(true)),
            (SAMPLER, BindingType::Sampler(SamplerBindingType::Filtering)),
            (TEXTURES[1], float(false)),
            (TEXTURES[2], texture(TextureSampleType::Uint)),
            (TABLE, table),
        ];
        let entries = entries.map(|(binding, ty)| BindGroupLayoutEntry {
            binding,
            visibility: ShaderStages::FRAGMENT,
            ty,
            count: None,
        });
        entries.to_vec()
    }
}
