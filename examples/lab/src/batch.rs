//! Running a WGSL function over many inputs on the adapter, as the numeric tests and the `vectors` command do.

use core::marker::PhantomData;

use bytemuck::Pod;
use moment_shadows::{Source, link};

use crate::error::LabError;
use crate::gpu::Gpu;

/// Invocations of one workgroup.
const WORKGROUP: u64 = 64;

/// What is appended to a batch's shader.
const ENTRY_POINT: &str = "
@group(0) @binding(0) var<storage, read> batch_inputs: array<BatchInput>;
@group(0) @binding(1) var<storage, read_write> batch_outputs: array<BatchOutput>;

@compute @workgroup_size(64)
fn batch_main(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&batch_inputs) {
        batch_outputs[id.x] = batch(batch_inputs[id.x]);
    }
}
";

/// What is appended for a shader that reads a table.
const TABLE: &str = "
@group(0) @binding(2) var<storage, read> batch_table: array<f32>;
";

/// A WGSL function that is compiled once and run over slices of inputs.
///
/// `I` and `O` must have the size and layout of the shader's `BatchInput` and `BatchOutput` in a storage buffer.
pub struct Batch<'gpu, I, O> {
    gpu: &'gpu Gpu,
    label: String,
    pipeline: wgpu::ComputePipeline,
    table: Option<wgpu::Buffer>,
    items: PhantomData<fn(I) -> O>,
}

impl<'gpu, I: Pod, O: Pod> Batch<'gpu, I, O> {
    /// Links and compiles `wgsl`, a shader that may import library modules, declares the types `BatchInput` and `BatchOutput`
    /// and a function `batch(input: BatchInput) -> BatchOutput`, but no bindings.
    pub fn new(gpu: &'gpu Gpu, label: &str, wgsl: &str) -> Result<Self, LabError> {
        Self::build(gpu, label, wgsl, None)
    }

    /// Links and compiles, as [`new`](Self::new) does, a shader that also reads `table`, at least one number, as the
    /// `batch_table: array<f32>` that all its invocations share.
    pub fn with_table(
        gpu: &'gpu Gpu,
        label: &str,
        wgsl: &str,
        table: &[f32],
    ) -> Result<Self, LabError> {
        Self::build(gpu, label, wgsl, Some(table))
    }

    fn build(
        gpu: &'gpu Gpu,
        label: &str,
        wgsl: &str,
        table: Option<&[f32]>,
    ) -> Result<Self, LabError> {
        let declared = if table.is_some() { TABLE } else { "" };
        let linked = link(
            Source {
                name: label,
                text: wgsl,
            },
            &[],
        )?;
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let module = gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Wgsl(
                    format!("{}{declared}{ENTRY_POINT}", linked.wgsl()).into(),
                ),
            });
        let pipeline = gpu
            .device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(label),
                layout: None,
                module: &module,
                entry_point: Some("batch_main"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            });
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(LabError::Shader {
                label: label.to_owned(),
                reason: error.to_string(),
            });
        }
        Ok(Self {
            gpu,
            label: label.to_owned(),
            pipeline,
            table: table.map(|table| {
                let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some(label),
                    size: size_of_val(table) as u64,
                    usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
                    mapped_at_creation: false,
                });
                let bytes = bytemuck::cast_slice(table);
                gpu.queue.write_buffer(&buffer, 0, bytes);
                buffer
            }),
            items: PhantomData,
        })
    }

    /// Runs the function over all inputs, in as many dispatches as the device's limits ask for.
    pub fn run(&self, inputs: &[I]) -> Result<Vec<O>, LabError> {
        let limits = self.gpu.device.limits();
        let (input, output) = (size_of::<I>(), size_of::<O>());
        let largest = limits
            .max_storage_buffer_binding_size
            .min(limits.max_buffer_size);
        let item = input.max(output) as u64;
        if input == 0
            || output == 0
            || !input.is_multiple_of(4)
            || !output.is_multiple_of(4)
            || item > largest
        {
            return Err(LabError::ItemSize {
                label: self.label.clone(),
                input,
                output,
                largest,
            });
        }
        let groups = u64::from(limits.max_compute_workgroups_per_dimension);
        let chunk = (largest / item).min(groups * WORKGROUP).min(1 << 24) as usize;
        let mut outputs = Vec::with_capacity(inputs.len());
        for inputs in inputs.chunks(chunk) {
            outputs.extend(self.run_chunk(inputs)?);
        }
        Ok(outputs)
    }

    fn run_chunk(&self, inputs: &[I]) -> Result<Vec<O>, LabError> {
        let device = &self.gpu.device;
        let label = Some(self.label.as_str());
        let input = device.create_buffer(&wgpu::BufferDescriptor {
            label,
            size: size_of_val(inputs) as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.gpu
            .queue
            .write_buffer(&input, 0, bytemuck::cast_slice(inputs));
        let output = device.create_buffer(&wgpu::BufferDescriptor {
            label,
            size: (inputs.len() * size_of::<O>()) as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let entries: Vec<wgpu::BindGroupEntry<'_>> =
            [Some(&input), Some(&output), self.table.as_ref()]
                .into_iter()
                .zip(0..)
                .filter_map(|(buffer, binding)| {
                    let resource = buffer?.as_entire_binding();
                    Some(wgpu::BindGroupEntry { binding, resource })
                })
                .collect();
        let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label,
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label });
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label,
                timestamp_writes: None,
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &bindings, &[]);
            let groups = (inputs.len() as u64).div_ceil(WORKGROUP);
            // At most `max_compute_workgroups_per_dimension`, a u32.
            pass.dispatch_workgroups(groups as u32, 1, 1);
        }
        self.gpu.queue.submit([encoder.finish()]);
        let bytes = self.gpu.read_buffer(&output, &self.label)?;
        Ok(bytes
            .chunks_exact(size_of::<O>())
            .map(bytemuck::pod_read_unaligned)
            .collect())
    }
}
