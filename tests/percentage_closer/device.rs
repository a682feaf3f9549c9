//! Runs a WGSL function over queries to a depth map.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{DepthConversion, MapRegion, Profile, Source, link};
use moment_shadows_lab::gpu::Gpu;
use wgpu::util::DeviceExt as _;

use crate::depth_map;

/// What a shader is asked; the struct `Query` of [`DECLARATIONS`].
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Query {
    pub(crate) uv: [f32; 2],
    pub(crate) gradient: [f32; 2],
    pub(crate) region: MapRegion,
    pub(crate) depth: f32,
    pub(crate) light_depth: f32,
    pub(crate) radius: f32,
    pub(crate) angle: f32,
    pub(crate) layer: u32,
    pub(crate) taps: u32,
    pub(crate) steepest: f32,
    pub(crate) bias: f32,
}

/// Any separable kernel: the struct `PercentageCloserKernel` of the library.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct PercentageCloserKernel {
    pub(crate) radius: u32,
    pub(crate) padding: [u32; 3],
    pub(crate) weights: [[f32; 4]; 33],
}

impl Query {
    /// One without a gradient or a bias, of parallel rays, in the whole of layer 0.
    pub(crate) fn new(uv: [f32; 2], depth: f32, size: [u32; 2]) -> Self {
        Self {
            uv,
            gradient: [0.0; 2],
            region: MapRegion::new([0, 0], size),
            depth,
            light_depth: -1e30,
            radius: 0.0,
            angle: 0.0,
            layer: 0,
            taps: 1,
            steepest: 1e9,
            bias: 0.0,
        }
    }
}

/// What every shader starts with: its own imports and `alias Extra` come before.
const DECLARATIONS: &str = "
import moment_shadows::map::depth::{DepthConversion};
import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::shade::receiver_plane::{ReceiverPlane, receiver_plane_biased, receiver_plane_through};

struct Query {
    uv: vec2f,
    gradient: vec2f,
    region: MapRegion,
    depth: f32,
    light_depth: f32,
    radius: f32,
    angle: f32,
    layer: u32,
    taps: u32,
    steepest: f32,
    bias: f32,
}

@group(0) @binding(0) var<storage, read> queries: array<Query>;
@group(0) @binding(1) var<storage, read_write> answers: array<f32>;
@group(0) @binding(2) var map: texture_depth_2d_array;
@group(0) @binding(3) var comparison: sampler_comparison;
@group(0) @binding(4) var<uniform> conversion: DepthConversion;
@group(0) @binding(5) var<uniform> extra: Extra;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&queries) {
        let query = queries[id.x];
        let plane = receiver_plane_biased(receiver_plane_through(query.uv, query.depth, query.gradient, query.steepest, query.light_depth), query.bias);
        answers[id.x] = answer(query, plane);
    }
}
";

pub(crate) fn open() -> Gpu {
    Gpu::open(Profile::WebgpuCore).unwrap()
}

/// A depth map whose layers hold the given stored depths, row by row.
pub(crate) fn map(
    gpu: &Gpu,
    format: wgpu::TextureFormat,
    [width, height]: [u32; 2],
    layers: &[Vec<f32>],
) -> wgpu::Texture {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("depth map"),
        size: wgpu::Extent3d {
            width,
            height,
            // An array, whatever it holds.
            depth_or_array_layers: layers.len() as u32 + 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    for (layer, depths) in layers.iter().enumerate() {
        depth_map::draw(gpu, &texture, layer as u32, depths);
    }
    depth_map::clear(gpu, &texture, layers.len() as u32, 0.5);
    texture
}

/// A shader that answers queries.
pub(crate) struct Shader<'gpu> {
    gpu: &'gpu Gpu,
    pipeline: wgpu::ComputePipeline,
}

impl<'gpu> Shader<'gpu> {
    /// `imports` are import lines; `body` holds `alias Extra` and `fn answer(query: Query, plane: ReceiverPlane) -> f32`.
    pub(crate) fn new(gpu: &'gpu Gpu, imports: &str, body: &str) -> Self {
        let text = format!("{imports}{DECLARATIONS}{body}");
        let linked = link(
            Source {
                name: "percentage_closer.wgsl",
                text: &text,
            },
            &[],
        )
        .unwrap();
        let device = &gpu.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(linked.wgsl().into()),
        });
        let buffer = |ty| wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let kinds = [
            buffer(wgpu::BufferBindingType::Storage { read_only: true }),
            buffer(wgpu::BufferBindingType::Storage { read_only: false }),
            wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Depth,
                view_dimension: wgpu::TextureViewDimension::D2Array,
                multisampled: false,
            },
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison),
            buffer(wgpu::BufferBindingType::Uniform),
            buffer(wgpu::BufferBindingType::Uniform),
        ];
        let entries: Vec<_> = (0..)
            .zip(kinds)
            .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty,
                count: None,
            })
            .collect();
        let group = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &entries,
        });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&group)],
            immediate_size: 0,
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: Some(&layout),
            module: &module,
            entry_point: Some("main"),
            compilation_options: Default::default(),
            cache: None,
        });
        Self { gpu, pipeline }
    }

    /// Answers to `queries`. `extra` has the layout of the shader's `Extra`.
    pub(crate) fn run(
        &self,
        map: &wgpu::Texture,
        compare: wgpu::CompareFunction,
        conversion: DepthConversion,
        extra: &[u8],
        queries: &[Query],
    ) -> Vec<f32> {
        let device = &self.gpu.device;
        let buffer = |contents: &[u8], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: None,
                contents,
                usage,
            })
        };
        let input = buffer(bytemuck::cast_slice(queries), wgpu::BufferUsages::STORAGE);
        let output = buffer(
            bytemuck::cast_slice(&vec![f32::NAN; queries.len()]),
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        );
        let conversion = buffer(bytemuck::bytes_of(&conversion), wgpu::BufferUsages::UNIFORM);
        let extra = buffer(extra, wgpu::BufferUsages::UNIFORM);
        let view = map.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(compare),
            ..Default::default()
        });
        let resources = [
            input.as_entire_binding(),
            output.as_entire_binding(),
            wgpu::BindingResource::TextureView(&view),
            wgpu::BindingResource::Sampler(&sampler),
            conversion.as_entire_binding(),
            extra.as_entire_binding(),
        ];
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups((queries.len() as u32).div_ceil(64), 1, 1);
        drop(pass);
        self.gpu.queue.submit([encoder.finish()]);
        let bytes = self.gpu.read_buffer(&output, "answers").unwrap();
        self.gpu.check().unwrap();
        bytemuck::pod_collect_to_vec(&bytes)
    }
}
