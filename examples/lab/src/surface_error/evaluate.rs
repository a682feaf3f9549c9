//! The technique at points of its map, on the device.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{AreaLight, DepthConversion, FourMomentsBias, LeakReduction, ReceiverBias};
use moment_shadows_graph::nodes::ShadeHard;
use moment_shadows_graph::{BindingResource, Capabilities};
use wgpu::util::DeviceExt;

use super::judged_map::JudgedMap;
use super::map_point::MapPoint;
use crate::error::LabError;
use crate::gpu::Gpu;

const SHADER: &str = include_str!("evaluate.wgsl");
const AS_THE_LIBRARY: &str = include_str!("point_intensity.wgsl");
const BIASED: &str = include_str!("point_intensity_biased.wgsl");
const LABEL: &str = "lab/surface shadows";

/// Points of one dispatch: 24 MiB of them, 16,384 workgroups.
const POINTS: usize = 1 << 20;
const WORKGROUP: u32 = 64;

/// The group of the map, beside the evaluator's own.
const MAP_GROUP: u32 = 1;

/// How a fragment is evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluation {
    /// How far fragments move towards the light.
    pub receiver_bias: ReceiverBias,
    /// What is done about light leaking after the bound.
    pub leak_reduction: LeakReduction,
    /// How the light's map stores depth: for techniques that read the plain depth map.
    pub conversion: DepthConversion,
    /// The light's size: for percentage-closer soft shadows.
    pub light: AreaLight,
}

/// `Parameters` of the shader.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Uniform {
    receiver_bias: ReceiverBias,
    leak_reduction: LeakReduction,
    moment_bias: FourMomentsBias,
    padding: f32,
    conversion: DepthConversion,
    light: AreaLight,
}

/// Evaluates a map at any points, by the functions that `shade_hard` calls on this device.
pub struct MapEvaluator<'a> {
    gpu: &'a Gpu,
    moment_bias: FourMomentsBias,
    own: wgpu::BindGroupLayout,
    map: wgpu::BindGroup,
    pipeline: wgpu::ComputePipeline,
}

impl<'a> MapEvaluator<'a> {
    /// For layer 0 of a map. With a bias of the filtered moments (`alpha` above 0) four moments are evaluated with that
    /// instead of their storage's.
    pub fn new(
        gpu: &'a Gpu,
        map: &JudgedMap<'_>,
        moment_bias: Option<FourMomentsBias>,
    ) -> Result<Self, LabError> {
        let device = &gpu.device;
        let capabilities = Capabilities {
            bind_group: MAP_GROUP,
            ..Capabilities::of_device(&gpu.adapter, device)
        };
        let node = ShadeHard {
            technique: map.technique.clone(),
            ..ShadeHard::default()
        };
        let intensity = moment_bias.map_or(AS_THE_LIBRARY, |_| BIASED);
        let (wgsl, bindings) = node
            .link_shader(
                &map.desc,
                &capabilities,
                "evaluate.wgsl",
                SHADER,
                &[("point_intensity", intensity)],
            )
            .map_err(|error| LabError::Graph {
                file: map.name.clone(),
                error,
            })?;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(LABEL),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
        let own = own_layout(device);
        let map_layout = map_layout(device, &bindings, map.texture);
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(LABEL),
            layout: Some(
                &device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                    label: Some(LABEL),
                    bind_group_layouts: &[Some(&own), Some(&map_layout)],
                    immediate_size: 0,
                }),
            ),
            module: &module,
            entry_point: Some("evaluate"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        let map = map_bindings(device, &bindings, &map_layout, map.texture);
        gpu.check()?;
        Ok(Self {
            gpu,
            moment_bias: moment_bias.unwrap_or(FourMomentsBias {
                alpha: 0.0,
                second: 0.0,
                fourth: 0.0,
            }),
            own,
            map,
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
        let uniform = Uniform {
            receiver_bias: evaluation.receiver_bias,
            leak_reduction: evaluation.leak_reduction,
            moment_bias: self.moment_bias,
            padding: 0.0,
            conversion: evaluation.conversion,
            light: evaluation.light,
        };
        let parameters = filled(bytemuck::bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let input = filled(bytemuck::cast_slice(points), wgpu::BufferUsages::STORAGE);
        let output = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(LABEL),
            size: 4 * points.len() as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let entries = [
            entry(0, parameters.as_entire_binding()),
            entry(1, input.as_entire_binding()),
            entry(2, output.as_entire_binding()),
        ];
        let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(LABEL),
            layout: &self.own,
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
            pass.set_bind_group(MAP_GROUP, &self.map, &[]);
            pass.dispatch_workgroups((points.len() as u32).div_ceil(WORKGROUP), 1, 1);
        }
        self.gpu.queue.submit([encoder.finish()]);
        Ok(self.gpu.read_buffer(&output, LABEL)?)
    }
}

fn entry(binding: u32, resource: wgpu::BindingResource<'_>) -> wgpu::BindGroupEntry<'_> {
    wgpu::BindGroupEntry { binding, resource }
}

fn group_layout(
    device: &wgpu::Device,
    bindings: impl Iterator<Item = (u32, wgpu::BindingType)>,
) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = bindings
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

/// Parameters, points and intensities.
fn own_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let buffer = |ty| wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let storage = |read_only| buffer(wgpu::BufferBindingType::Storage { read_only });
    let types = [
        buffer(wgpu::BufferBindingType::Uniform),
        storage(true),
        storage(false),
    ];
    group_layout(device, (0..).zip(types))
}

/// The map, and a sampler where the shader wants one.
fn map_layout(
    device: &wgpu::Device,
    bindings: &[(u32, BindingResource)],
    map: &wgpu::Texture,
) -> wgpu::BindGroupLayout {
    let sampled = bindings.len() > 1;
    let sample_type = if map.format().is_depth_stencil_format() {
        wgpu::TextureSampleType::Depth
    } else {
        wgpu::TextureSampleType::Float {
            filterable: sampled,
        }
    };
    let bindings = bindings.iter().map(|(binding, resource)| {
        let ty = match resource {
            BindingResource::ComparisonSampler { .. } => {
                wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison)
            }
            BindingResource::Sampler { .. } => {
                wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)
            }
            _ => wgpu::BindingType::Texture {
                sample_type,
                view_dimension: wgpu::TextureViewDimension::D2Array,
                multisampled: false,
            },
        };
        (*binding, ty)
    });
    group_layout(device, bindings)
}

fn map_bindings(
    device: &wgpu::Device,
    bindings: &[(u32, BindingResource)],
    layout: &wgpu::BindGroupLayout,
    map: &wgpu::Texture,
) -> wgpu::BindGroup {
    let view = map.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    });
    let compare = bindings.iter().find_map(|(_, resource)| match resource {
        BindingResource::ComparisonSampler { reversed: true } => Some(wgpu::CompareFunction::Less),
        BindingResource::ComparisonSampler { .. } => Some(wgpu::CompareFunction::Greater),
        _ => None,
    });
    let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some(LABEL),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        compare,
        ..Default::default()
    });
    let entries: Vec<_> = bindings
        .iter()
        .map(|(binding, resource)| {
            let resource = match resource {
                BindingResource::ComparisonSampler { .. } | BindingResource::Sampler { .. } => {
                    wgpu::BindingResource::Sampler(&sampler)
                }
                _ => wgpu::BindingResource::TextureView(&view),
            };
            entry(*binding, resource)
        })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(LABEL),
        layout,
        entries: &entries,
    })
}
