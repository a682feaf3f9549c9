//! The adapter, with resources of every kind that functions take.

use moment_shadows::Profile;
use moment_shadows_lab::gpu::Gpu;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use wgpu::util::{BufferInitDescriptor, DeviceExt, TextureDataOrder};

use crate::values::RESOURCES;

/// Invocations of each shader.
const INVOCATIONS: usize = 512;

/// Texels along each side of each texture.
const SIDE: u32 = 64;

pub(crate) struct Adapter {
    gpu: Gpu,
    /// A uniform buffer, the resources of [`RESOURCES`], and what is written.
    layouts: [wgpu::BindGroupLayout; 3],
    uniform: wgpu::BindGroup,
    resources: wgpu::BindGroup,
}

impl Adapter {
    pub(crate) fn open() -> Self {
        let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
        let device = &gpu.device;
        let mut random = ChaCha8Rng::seed_from_u64(13);
        let buffer = |ty| wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let storage = buffer(wgpu::BufferBindingType::Storage { read_only: false });
        let layouts = [
            layout(&gpu, &[buffer(wgpu::BufferBindingType::Uniform)]),
            layout(&gpu, &RESOURCES.map(binding_type)),
            layout(&gpu, &[storage]),
        ];
        // Everything is in the range of a matrix that keeps a scene within a map.
        let numbers: Vec<f32> = (0..256).map(|_| random.random_range(-1.0..1.0)).collect();
        let numbers = device.create_buffer_init(&BufferInitDescriptor {
            label: None,
            contents: bytemuck::cast_slice(&numbers),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let uniform = group(&gpu, &layouts[0], &[numbers.as_entire_binding()]);
        let textures = RESOURCES.map(|ty| texture(&gpu, ty, &mut random));
        let sampler = |compare| {
            device.create_sampler(&wgpu::SamplerDescriptor {
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                mipmap_filter: wgpu::MipmapFilterMode::Linear,
                compare,
                ..Default::default()
            })
        };
        let linear = sampler(None);
        let comparison = sampler(Some(wgpu::CompareFunction::Less));
        let mut bound = Vec::new();
        for (ty, texture) in RESOURCES.iter().zip(&textures) {
            bound.push(match (texture, *ty) {
                (Some(view), _) => wgpu::BindingResource::TextureView(view),
                (None, "sampler") => wgpu::BindingResource::Sampler(&linear),
                (None, _) => wgpu::BindingResource::Sampler(&comparison),
            });
        }
        let resources = group(&gpu, &layouts[1], &bound);
        Self {
            layouts,
            uniform,
            resources,
            gpu,
        }
    }

    /// What the compute shader of `linked` writes, `words` words for each invocation.
    pub(crate) fn run(&self, linked: &str, words: usize) -> Vec<u32> {
        let device = &self.gpu.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(linked.into()),
        });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &self.layouts.each_ref().map(Some),
            immediate_size: 0,
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: Some(&layout),
            module: &module,
            entry_point: None,
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let written = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: (4 * words * INVOCATIONS) as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let output = group(&self.gpu, &self.layouts[2], &[written.as_entire_binding()]);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&pipeline);
            for (index, group) in (0..).zip([&self.uniform, &self.resources, &output]) {
                pass.set_bind_group(index, group, &[]);
            }
            pass.dispatch_workgroups(INVOCATIONS as u32 / 64, 1, 1);
        }
        self.gpu.queue.submit([encoder.finish()]);
        let bytes = self.gpu.read_buffer(&written, "written").unwrap();
        self.gpu.check().unwrap();
        bytemuck::pod_collect_to_vec(&bytes)
    }
}

/// The format and sample type of a texture, unless it is a sampler.
fn format(ty: &str) -> Option<(wgpu::TextureFormat, wgpu::TextureSampleType)> {
    let filterable = wgpu::TextureSampleType::Float { filterable: true };
    match ty {
        "texture_2d<f32>" | "texture_2d_array<f32>" => {
            Some((wgpu::TextureFormat::Rgba16Float, filterable))
        }
        "texture_2d_array<u32>" => {
            let format = wgpu::TextureFormat::Rgba32Uint;
            Some((format, wgpu::TextureSampleType::Uint))
        }
        "texture_depth_2d_array" => {
            let format = wgpu::TextureFormat::Depth16Unorm;
            Some((format, wgpu::TextureSampleType::Depth))
        }
        "texture_depth_multisampled_2d" => {
            let format = wgpu::TextureFormat::Depth32Float;
            Some((format, wgpu::TextureSampleType::Depth))
        }
        _ => None,
    }
}

fn dimension(ty: &str) -> wgpu::TextureViewDimension {
    match ty.contains("array") {
        true => wgpu::TextureViewDimension::D2Array,
        false => wgpu::TextureViewDimension::D2,
    }
}

fn binding_type(ty: &str) -> wgpu::BindingType {
    match format(ty) {
        Some((_, sample_type)) => wgpu::BindingType::Texture {
            sample_type,
            view_dimension: dimension(ty),
            multisampled: ty.contains("multisampled"),
        },
        None if ty == "sampler" => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        None => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison),
    }
}

/// A depth texture with four samples per texel, all alike: nothing but drawing writes to them.
fn samples(gpu: &Gpu, format: wgpu::TextureFormat) -> wgpu::TextureView {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: SIDE,
            height: SIDE,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 4,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    let view = texture.create_view(&Default::default());
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    drop(encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &view,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(0.7),
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    }));
    gpu.queue.submit([encoder.finish()]);
    view
}

/// A texture of random texels, for floats from 0.5 to 1, with three mip levels of two layers at most.
fn texture(gpu: &Gpu, ty: &str, random: &mut impl Rng) -> Option<wgpu::TextureView> {
    let (format, _) = format(ty)?;
    if ty.contains("multisampled") {
        return Some(samples(gpu, format));
    }
    let float = format == wgpu::TextureFormat::Rgba16Float;
    let descriptor = wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: SIDE,
            height: SIDE,
            depth_or_array_layers: if ty.contains("array") { 2 } else { 1 },
        },
        mip_level_count: if float { 3 } else { 1 },
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    };
    // More than two layers of texels of 16 bytes.
    let halves: Vec<u16> = (0..4 * SIDE * SIDE * 8)
        .map(|_| random.random::<u16>())
        .map(|bits| if float { 0x3800 | bits & 0x3ff } else { bits })
        .collect();
    let texture = gpu.device.create_texture_with_data(
        &gpu.queue,
        &descriptor,
        TextureDataOrder::LayerMajor,
        bytemuck::cast_slice(&halves),
    );
    Some(texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(dimension(ty)),
        ..Default::default()
    }))
}

fn layout(gpu: &Gpu, types: &[wgpu::BindingType]) -> wgpu::BindGroupLayout {
    let entry = |(binding, &ty)| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty,
        count: None,
    };
    let entries: Vec<_> = (0..).zip(types).map(entry).collect();
    let descriptor = wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &entries,
    };
    gpu.device.create_bind_group_layout(&descriptor)
}

fn group(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let mut entries = Vec::new();
    for (binding, resource) in (0..).zip(resources.iter().cloned()) {
        entries.push(wgpu::BindGroupEntry { binding, resource });
    }
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout,
        entries: &entries,
    })
}
