//! Shaders on the adapter: WGSL, and SPIR-V of other compilers as it stands.

use std::borrow::Cow;

use moment_shadows::{Profile, Vectors};

use super::wrap::{INPUT_WORDS, OUTPUT_WORDS, WORKGROUP};
use crate::error::LabError;
use crate::gpu::Gpu;

/// A compute shader that [`wrapper`](super::wrapper) wrote.
#[derive(Debug)]
pub enum Shader<'a> {
    /// As WGSL.
    Wgsl(&'a str),
    /// What another compiler made of it.
    Spirv(&'a [u32]),
}

/// An adapter.
pub struct Runner {
    gpu: Gpu,
    layout: wgpu::BindGroupLayout,
}

impl Runner {
    /// Opens the best adapter.
    pub fn open() -> Result<Self, LabError> {
        let gpu = Gpu::open_with(Profile::WebgpuCore, wgpu::Features::PASSTHROUGH_SHADERS)?;
        let entry = |binding, read_only| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let descriptor = wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &[entry(0, true), entry(1, false)],
        };
        let layout = gpu.device.create_bind_group_layout(&descriptor);
        Ok(Self { gpu, layout })
    }

    /// What the functions give for the inputs of the vectors, row by row.
    pub fn run(&self, shader: &Shader<'_>, vectors: &Vectors) -> Result<Vec<Vec<u32>>, LabError> {
        let gpu = &self.gpu;
        let mut inputs: Vec<u32> = Vec::new();
        for (number, function) in (0..).zip(&vectors.functions) {
            for row in &function.rows {
                let end = inputs.len() + INPUT_WORDS;
                inputs.push(number);
                inputs.extend(row.inputs.iter().map(|it| it.0));
                inputs.resize(end, 0);
            }
        }
        let rows = inputs.len() / INPUT_WORDS;
        let label = "a port";
        let bytes = bytemuck::cast_slice(&inputs);
        let input = gpu.filled(label, bytes, wgpu::BufferUsages::STORAGE);
        let output = gpu.output(label, (4 * rows * OUTPUT_WORDS) as u64);
        let bound = [&input, &output].map(wgpu::Buffer::as_entire_binding);
        let group = gpu.bind(&self.layout, bound);
        let pipeline = self.pipeline(&self.module(shader)?);
        gpu.dispatch(&pipeline, &[&group], [rows.div_ceil(WORKGROUP) as u32, 1]);
        let bytes = gpu.read_buffer(&output, label)?;
        let words: Vec<u32> = bytemuck::pod_collect_to_vec(&bytes);
        let mut words = words.chunks_exact(OUTPUT_WORDS);
        let rows = vectors.functions.iter().flat_map(|it| &it.rows);
        let given = rows.map(|row| {
            let words = words.next().unwrap_or_default();
            words.iter().copied().take(row.bits.len()).collect()
        });
        Ok(given.collect())
    }

    fn module(&self, shader: &Shader<'_>) -> Result<wgpu::ShaderModule, LabError> {
        let device = &self.gpu.device;
        match shader {
            Shader::Wgsl(text) => Ok(device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: None,
                source: wgpu::ShaderSource::Wgsl((*text).into()),
            })),
            Shader::Spirv(_)
                if !device
                    .features()
                    .contains(wgpu::Features::PASSTHROUGH_SHADERS) =>
            {
                let reason = "the adapter takes no SPIR-V; use one with a Vulkan driver";
                Err(LabError::refused(reason.to_owned()))
            }
            Shader::Spirv(words) => Ok(of_spirv(device, words)),
        }
    }

    fn pipeline(&self, module: &wgpu::ShaderModule) -> wgpu::ComputePipeline {
        let device = &self.gpu.device;
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&self.layout)],
            immediate_size: 0,
        });
        device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: Some(&layout),
            module,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        })
    }
}

#[allow(unsafe_code)]
fn of_spirv(device: &wgpu::Device, words: &[u32]) -> wgpu::ShaderModule {
    let entry_point = wgpu::PassthroughShaderEntryPoint {
        name: "main".into(),
        workgroup_size: (WORKGROUP as u32, 1, 1),
    };
    let descriptor = wgpu::ShaderModuleDescriptorPassthrough {
        entry_points: Cow::Owned(vec![entry_point]),
        spirv: Some(words.into()),
        ..Default::default()
    };
    // SAFETY: it is what a compiler made of a shader whose every index is within the buffers.
    unsafe { device.create_shader_module_passthrough(descriptor) }
}
