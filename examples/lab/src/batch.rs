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
        Self::with_table(gpu, label, wgsl, &[])
    }

    /// Links and compiles, as [`new`](Self::new) does, a shader that also reads `table` as the `batch_table: array<f32>` that all
    /// its invocations share. Without a number there is no table.
    pub fn with_table(
        gpu: &'gpu Gpu,
        label: &str,
        wgsl: &str,
        table: &[f32],
    ) -> Result<Self, LabError> {
        let declared = if table.is_empty() { "" } else { TABLE };
        let linked = link(
            Source {
                name: label,
                text: wgsl,
            },
            &[],
        )?;
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let wgsl = format!("{}{declared}{ENTRY_POINT}", linked.wgsl());
        let pipeline = gpu.compute(label, &wgsl, "batch_main");
        if let Some(error) = pollster::block_on(scope.pop()) {
            return Err(LabError::refused(format!(
                "the shader of batch '{label}' was refused: {error}"
            )));
        }
        Ok(Self {
            gpu,
            label: label.to_owned(),
            pipeline,
            table: (!table.is_empty()).then(|| {
                let contents = bytemuck::cast_slice(table);
                gpu.filled(label, contents, wgpu::BufferUsages::STORAGE)
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
            return Err(LabError::refused(format!(
                "batch '{}' has items of {input} and {output} bytes; arrays in storage buffers need positive multiples of 4 that \
                 fit into {largest} bytes",
                self.label
            )));
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
        let (gpu, label) = (self.gpu, self.label.as_str());
        let contents = bytemuck::cast_slice(inputs);
        let input = gpu.filled(label, contents, wgpu::BufferUsages::STORAGE);
        let output = gpu.output(label, (inputs.len() * size_of::<O>()) as u64);
        let bound = [&input, &output].into_iter().chain(&self.table);
        let bindings = gpu.bind(
            &self.pipeline.get_bind_group_layout(0),
            bound.map(wgpu::Buffer::as_entire_binding),
        );
        let groups = (inputs.len() as u64).div_ceil(WORKGROUP);
        // At most `max_compute_workgroups_per_dimension`, a u32.
        gpu.dispatch(&self.pipeline, &[&bindings], [groups as u32, 1]);
        let bytes = gpu.read_buffer(&output, label)?;
        Ok(bytes
            .chunks_exact(size_of::<O>())
            .map(bytemuck::pod_read_unaligned)
            .collect())
    }
}
