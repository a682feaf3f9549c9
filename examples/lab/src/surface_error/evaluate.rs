//! The technique at points of its map, on the device.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{LeakReduction, MomentBias, ReceiverBias, Source, Storage, link};
use moment_shadows_graph::Capabilities;
use wgpu::util::DeviceExt;

use crate::error::LabError;
use crate::gpu::Gpu;

const SHADER: &str = include_str!("evaluate.wgsl");
const SAMPLED_LOOKUP: &str = include_str!("point_lookup_sampled.wgsl");
const LOADED_LOOKUP: &str = include_str!("point_lookup_loaded.wgsl");
const LABEL: &str = "lab/surface shadows";

/// Points of one dispatch: 16 MiB of them, 16,384 workgroups.
const POINTS: usize = 1 << 20;
const WORKGROUP: u32 = 64;

/// How a fragment is evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluation {
    /// How far fragments move towards the light.
    pub receiver_bias: ReceiverBias,
    /// What is done about light leaking after the bound.
    pub leak_reduction: LeakReduction,
    /// A bias of the filtered moments in place of that of their storage; its `alpha` is above 0.
    pub moment_bias: Option<MomentBias>,
}

/// `Parameters` of the shader.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Uniform {
    receiver_bias: ReceiverBias,
    leak_reduction: LeakReduction,
    moment_bias: MomentBias,
    padding: f32,
}

/// A point of a surface, `Point` of the shader.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct MapPoint {
    /// The place in the map, from 0 to 1.
    pub uv: [f32; 2],
    /// Moment depth, not clamped.
    pub moment_depth: f32,
    /// Length of the gradient of moment depth per texel of the map, finite.
    pub gradient: f32,
}

/// Evaluates a filtered map of moments at any points, with the same lookup as `shade_hard` on this device.
pub struct MapEvaluator<'a> {
    gpu: &'a Gpu,
    map: wgpu::TextureView,
    sampler: Option<wgpu::Sampler>,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

impl<'a> MapEvaluator<'a> {
    /// For layer 0 of a map that holds moments in `storage`.
    pub fn new(gpu: &'a Gpu, map: &wgpu::Texture, storage: Storage) -> Result<Self, LabError> {
        let device = &gpu.device;
        let capabilities = Capabilities::of_device(&gpu.adapter, device);
        let filterable = capabilities.support(storage.format()).filterable;
        let lookup = if filterable {
            SAMPLED_LOOKUP
        } else {
            LOADED_LOOKUP
        };
        let specialization = format!("const STORAGE: u32 = {}u;\n", storage.wgsl_index());
        let source = |name, text| Source { name, text };
        let shader = link(
            source("evaluate.wgsl", SHADER),
            &[
                source("point_lookup", lookup),
                source("specialization", &specialization),
            ],
        )?;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(LABEL),
            source: wgpu::ShaderSource::Wgsl(shader.wgsl().into()),
        });
        let layout = layout(device, filterable);
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(LABEL),
            layout: Some(
                &device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                    label: Some(LABEL),
                    bind_group_layouts: &[Some(&layout)],
                    immediate_size: 0,
                }),
            ),
            module: &module,
            entry_point: Some("evaluate"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let sampler = filterable.then(|| {
            device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some(LABEL),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            })
        });
        gpu.check()?;
        Ok(Self {
            gpu,
            map: map.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2Array),
                ..Default::default()
            }),
            sampler,
            layout,
            pipeline,
        })
    }

    /// The shadow intensity at each point.
    pub fn run(&self, evaluation: Evaluation, points: &[MapPoint]) -> Result<Vec<f32>, LabError> {
        let mut intensities = Vec::with_capacity(points.len());
        for points in points.chunks(POINTS) {
            let bytes = self.dispatch(evaluation, points)?;
            intensities.extend(bytemuck::pod_collect_to_vec::<u8, f32>(&bytes));
        }
        Ok(intensities)
    }

    fn dispatch(&self, evaluation: Evaluation, points: &[MapPoint]) -> Result<Vec<u8>, LabError> {
        let device = &self.gpu.device;
        let filled = |contents: &[u8], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some(LABEL),
                contents,
                usage,
            })
        };
        let storage_s_own = MomentBias {
            alpha: 0.0,
            second: 0.0,
            fourth: 0.0,
        };
        let uniform = Uniform {
            receiver_bias: evaluation.receiver_bias,
            leak_reduction: evaluation.leak_reduction,
            moment_bias: evaluation.moment_bias.unwrap_or(storage_s_own),
            padding: 0.0,
        };
        let parameters = filled(bytemuck::bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let input = filled(bytemuck::cast_slice(points), wgpu::BufferUsages::STORAGE);
        let output = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(LABEL),
            size: 4 * points.len() as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let mut entries = vec![
            entry(0, parameters.as_entire_binding()),
            entry(1, input.as_entire_binding()),
            entry(2, output.as_entire_binding()),
            entry(3, wgpu::BindingResource::TextureView(&self.map)),
        ];
        let sampler = self.sampler.as_ref().map(wgpu::BindingResource::Sampler);
        entries.extend(sampler.map(|sampler| entry(4, sampler)));
        let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(LABEL),
            layout: &self.layout,
            entries: &entries,
        });
        let mut encoder =
            device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some(LABEL) });
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some(LABEL),
                timestamp_writes: None,
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &bindings, &[]);
            pass.dispatch_workgroups((points.len() as u32).div_ceil(WORKGROUP), 1, 1);
        }
        self.gpu.queue.submit([encoder.finish()]);
        Ok(self.gpu.read_buffer(&output, LABEL)?)
    }
}

fn entry(binding: u32, resource: wgpu::BindingResource<'_>) -> wgpu::BindGroupEntry<'_> {
    wgpu::BindGroupEntry { binding, resource }
}

/// The bindings of the shader, with a sampler where the map is filterable.
fn layout(device: &wgpu::Device, filterable: bool) -> wgpu::BindGroupLayout {
    let buffer = |ty| wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let storage = |read_only| buffer(wgpu::BufferBindingType::Storage { read_only });
    let mut types = vec![
        buffer(wgpu::BufferBindingType::Uniform),
        storage(true),
        storage(false),
        wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable },
            view_dimension: wgpu::TextureViewDimension::D2Array,
            multisampled: false,
        },
    ];
    types.extend(filterable.then_some(wgpu::BindingType::Sampler(
        wgpu::SamplerBindingType::Filtering,
    )));
    let entries: Vec<_> = (0..)
        .zip(types)
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty,
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(LABEL),
        entries: &entries,
    })
}
