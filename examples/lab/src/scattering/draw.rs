//! Full-screen passes of the competitors.

use moment_shadows::{Source, link};

use crate::error::LabError;
use crate::gpu::Gpu;

/// What the radiance of all candidates is stored as.
pub(super) const RADIANCE: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Something that is bound.
pub(super) enum Bound<'a> {
    /// A uniform buffer.
    Uniform(&'a wgpu::Buffer),
    /// A view of a texture.
    Texture(wgpu::TextureView),
    /// A sampler.
    Sampler(&'a wgpu::Sampler),
}

/// A pass that draws over all of a texture.
pub(super) struct Draw {
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
    target: wgpu::TextureView,
}

/// Links a shader of this folder with the modules that it imports.
pub(super) fn linked(
    name: &str,
    text: &str,
    generated: &[(&str, &str)],
) -> Result<String, LabError> {
    let mut modules = vec![Source {
        name: "scattering_view",
        text: include_str!("view.wgsl"),
    }];
    modules.extend(generated.iter().map(|&(name, text)| Source { name, text }));
    Ok(link(Source { name, text }, &modules)?.into_wgsl())
}

/// A texture that is drawn, sampled and read back.
pub(super) fn target(gpu: &Gpu, label: &str, [width, height]: [u32; 2]) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: RADIANCE,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

/// Bilinear, clamped to the edge.
pub(super) fn sampler(gpu: &Gpu) -> wgpu::Sampler {
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("scattering/bilinear"),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    })
}

/// A group of what is bound, with the numbers of its bindings.
pub(super) fn group(
    gpu: &Gpu,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    bound: &[(u32, Bound<'_>)],
) -> wgpu::BindGroup {
    let entries: Vec<_> = bound
        .iter()
        .map(|(binding, bound)| wgpu::BindGroupEntry {
            binding: *binding,
            resource: match bound {
                Bound::Uniform(buffer) => buffer.as_entire_binding(),
                Bound::Texture(view) => wgpu::BindingResource::TextureView(view),
                Bound::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
            },
        })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(label),
        layout,
        entries: &entries,
    })
}

impl Draw {
    /// A pass of a linked shader with the vertex stage of `view.wgsl`.
    pub(super) fn new(
        gpu: &Gpu,
        label: &str,
        wgsl: String,
        constants: &[(&str, f64)],
        bound: &[(u32, Bound<'_>)],
        target: &wgpu::Texture,
    ) -> Result<Self, LabError> {
        let module = gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Wgsl(wgsl.into()),
            });
        let pipeline = gpu
            .device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(label),
                layout: None,
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("cover"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: None,
                    compilation_options: wgpu::PipelineCompilationOptions {
                        constants,
                        ..Default::default()
                    },
                    targets: &[Some(RADIANCE.into())],
                }),
                multiview_mask: None,
                cache: None,
            });
        let group = group(gpu, label, &pipeline.get_bind_group_layout(0), bound);
        gpu.check()?;
        Ok(Self {
            pipeline,
            group,
            target: target.create_view(&wgpu::TextureViewDescriptor::default()),
        })
    }

    /// Records it.
    pub(super) fn record(&self, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("scattering"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.draw(0..3, 0..1);
    }
}
