//! What materials are bound to: the filtered maps of all cameras in one texture, and the table.

use bevy::light::DirectionalLightShadowMap;
use bevy::prelude::*;
use bevy::render::Extract;
use bevy::render::render_resource::{Buffer, Sampler, Texture, TextureView};
use bevy::render::renderer::RenderDevice;
use moment_shadows::TextureFormat;
use moment_shadows_graph::TextureDesc;
use wgpu::{BufferUsages, FilterMode, MipmapFilterMode, TextureUsages};

use crate::compiled::Compiled;
use crate::table::{ShadowCamera, ShadowView};

/// The filtered map that materials see.
#[derive(Resource)]
pub struct Maps {
    /// None before the first frame.
    pub(crate) bound: Option<Bound>,
    /// The map of one layer of one camera, without its size.
    map: Option<TextureDesc>,
    pub(crate) cameras: u32,
    pub(crate) layers: u32,
}

/// The objects of one size.
pub(crate) struct Bound {
    pub(crate) size: u32,
    pub(crate) texture: Texture,
    /// By what shaders read: filterable floats, other floats, integers. One of them is the texture.
    pub(crate) views: [TextureView; 3],
    pub(crate) sampler: Sampler,
    pub(crate) table: Buffer,
}

impl Maps {
    pub(crate) fn new(compiled: &Compiled) -> Self {
        Self {
            bound: None,
            map: compiled.map.as_ref().map(|(map, _)| map.clone()),
            cameras: compiled.cameras,
            layers: compiled.layers,
        }
    }

    /// Bytes of a camera's row of the table.
    pub(crate) fn row(&self) -> usize {
        size_of::<ShadowCamera>() + self.layers as usize * size_of::<ShadowView>()
    }

    /// Layers of the texture that a camera has.
    pub(crate) fn planes(&self) -> u32 {
        self.layers * self.map.as_ref().map_or(1, |map| map.planes)
    }
}

/// Makes the objects, and again when the size of Bevy's map is another.
pub(crate) fn prepare_maps(
    mut maps: ResMut<Maps>,
    compiled: Res<Compiled>,
    device: Res<RenderDevice>,
    bevy: Extract<Res<DirectionalLightShadowMap>>,
) {
    let size = bevy.size as u32;
    let size = size.min(device.limits().max_texture_dimension_2d);
    if maps.bound.as_ref().is_some_and(|bound| bound.size == size) {
        return;
    }
    let texture = |format, size, layers, mips| {
        device.create_texture(&wgpu::TextureDescriptor {
            label: Some("moment-shadows/shadow_map"),
            size: wgpu::Extent3d {
                width: size,
                height: size,
                depth_or_array_layers: layers,
            },
            mip_level_count: mips,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
            view_formats: &[],
        })
    };
    let small = wgpu::TextureFormat::Rgba8Unorm;
    let small_integer = wgpu::TextureFormat::Rgba32Uint;
    let layers = maps.cameras * maps.planes();
    let whole = match &maps.map {
        None => texture(small, 1, 1, 1),
        Some(map) => {
            let mips = match map.mips {
                all if all == TextureDesc::most_levels(map.size) => {
                    TextureDesc::most_levels([size; 2])
                }
                mips => mips,
            };
            texture(map.wgpu_format(), size, layers, mips)
        }
    };
    let kind = maps.map.as_ref().map_or(0, |map| kind(map, &compiled));
    let views = [small, small, small_integer].map(|format| texture(format, 1, 1, 1));
    let mut number = 0;
    let views = views.map(|unused| {
        let of = if number == kind { &whole } else { &unused };
        number += 1;
        of.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        })
    });
    let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("moment-shadows/shadow_map"),
        mag_filter: FilterMode::Linear,
        min_filter: FilterMode::Linear,
        mipmap_filter: MipmapFilterMode::Linear,
        // Only where there are mip levels: some drivers filter anisotropically by where the next pixel looks, which may be another layer.
        anisotropy_clamp: if whole.mip_level_count() > 1 { 8 } else { 1 },
        ..Default::default()
    });
    let table = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("moment-shadows/table"),
        size: u64::from(maps.cameras) * maps.row() as u64,
        usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    maps.bound = Some(Bound {
        size,
        texture: whole,
        views,
        sampler,
        table,
    });
}

/// Which of the three textures a map is.
pub(crate) fn kind(map: &TextureDesc, compiled: &Compiled) -> usize {
    let filterable = |format: TextureFormat| compiled.capabilities.support(format).filterable;
    match map.format {
        format if format.is_integer() => 2,
        format if filterable(format) => 0,
        _ => 1,
    }
}
