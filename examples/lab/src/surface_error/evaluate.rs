//! The technique at points of its map, on the device.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{AreaLight, DepthConversion, FourMomentsBias, LeakReduction, ReceiverBias};
use moment_shadows_graph::nodes::ShadeHard;
use moment_shadows_graph::{BindingResource, Capabilities};

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
    /// Middle and scale of what the map's depths are fitted to, 0 and 1 where they are not; points and bias are those of the host's range.
    pub range: [f32; 2],
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
    range: [f32; 2],
}

/// Evaluates a map at any points, by the functions that `shade_hard` calls on this device.
pub struct MapEvaluator<'a> {
    gpu: &'a Gpu,
    moment_bias: FourMomentsBias,
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
            .map_err(LabError::graph(&map.name))?;
        let pipeline = gpu.compute(LABEL, &wgsl, "evaluate");
        let map = map_bindings(device, &bindings, &pipeline, map.texture);
        gpu.check()?;
        Ok(Self {
            gpu,
            moment_bias: moment_bias.unwrap_or(FourMomentsBias {
                alpha: 0.0,
                second: 0.0,
                fourth: 0.0,
            }),
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
        let gpu = self.gpu;
        let uniform = Uniform {
            receiver_bias: evaluation.receiver_bias,
            leak_reduction: evaluation.leak_reduction,
            moment_bias: self.moment_bias,
            padding: 0.0,
            conversion: evaluation.conversion,
            light: evaluation.light,
            range: evaluation.range,
        };
        let contents = bytemuck::bytes_of(&uniform);
        let parameters = gpu.filled(LABEL, contents, wgpu::BufferUsages::UNIFORM);
        let contents = bytemuck::cast_slice(points);
        let input = gpu.filled(LABEL, contents, wgpu::BufferUsages::STORAGE);
        let output = gpu.output(LABEL, 4 * points.len() as u64);
        let own = gpu.bind(
            &self.pipeline.get_bind_group_layout(0),
            [&parameters, &input, &output].map(wgpu::Buffer::as_entire_binding),
        );
        let workgroups = (points.len() as u32).div_ceil(WORKGROUP);
        gpu.dispatch(&self.pipeline, &[&own, &self.map], [workgroups, 1]);
        gpu.read_buffer(&output, LABEL)
    }
}

/// The map, and a sampler where the shader wants one.
fn map_bindings(
    device: &wgpu::Device,
    bindings: &[(u32, BindingResource)],
    pipeline: &wgpu::ComputePipeline,
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
            wgpu::BindGroupEntry {
                binding: *binding,
                resource,
            }
        })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(LABEL),
        layout: &pipeline.get_bind_group_layout(MAP_GROUP),
        entries: &entries,
    })
}
