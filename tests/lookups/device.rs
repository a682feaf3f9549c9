//! Runs lookups on the adapter.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{MapRegion, Profile, Source, link};
use moment_shadows_lab::gpu::Gpu;
use wgpu::util::DeviceExt as _;

use crate::map::Map;

/// The lookups of a query.
pub(crate) const SAMPLED: u32 = 0;
pub(crate) const LOADED: u32 = 1;
pub(crate) const TRILINEAR: u32 = 2;
pub(crate) const GRADIENT: u32 = 3;

/// The struct `Query` of [`SHADER`].
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Query {
    pub(crate) uv: [f32; 2],
    pub(crate) difference_x: [f32; 2],
    pub(crate) difference_y: [f32; 2],
    pub(crate) region: MapRegion,
    pub(crate) lookup: u32,
    pub(crate) levels: u32,
    pub(crate) level: f32,
    pub(crate) anisotropy: f32,
}

/// The map is the second layer of two; the first holds nothing like it.
const SHADER: &str = "
import moment_shadows::map::map_load::{map_load_bilinear, map_load_trilinear};
import moment_shadows::map::map_lookup::{map_lookup_bilinear, map_lookup_gradient};
import moment_shadows::map::map_region::{MapRegion};

struct Query {
    uv: vec2f,
    difference_x: vec2f,
    difference_y: vec2f,
    region: MapRegion,
    lookup: u32,
    levels: u32,
    level: f32,
    anisotropy: f32,
}

@group(0) @binding(0) var<storage, read> queries: array<Query>;
@group(0) @binding(1) var<storage, read_write> answers: array<vec4f>;
@group(0) @binding(2) var map: texture_2d_array<f32>;
@group(0) @binding(3) var linear: sampler;

fn answer(query: Query) -> vec4f {
    switch query.lookup {
        case 0u: {
            return map_lookup_bilinear(map, linear, 1u, query.region, query.uv, u32(query.level));
        }
        case 1u: {
            return map_load_bilinear(map, 1u, query.region, query.uv, u32(query.level));
        }
        case 2u: {
            return map_load_trilinear(map, 1u, query.region, query.levels, query.uv, query.level);
        }
        default: {
            return map_lookup_gradient(map, linear, 1u, query.region, query.levels, query.uv, query.difference_x, query.difference_y, query.anisotropy);
        }
    }
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&queries) {
        answers[id.x] = answer(queries[id.x]);
    }
}
";

pub(crate) struct Shader {
    gpu: Gpu,
    pipeline: wgpu::ComputePipeline,
    sampler: wgpu::Sampler,
}

impl Shader {
    pub(crate) fn new() -> Self {
        let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
        let source = Source {
            name: "lookups.wgsl",
            text: SHADER,
        };
        let linked = link(source, &[]).unwrap();
        let device = &gpu.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(linked.wgsl().into()),
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: None,
            module: &module,
            entry_point: Some("main"),
            compilation_options: Default::default(),
            cache: None,
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        Self {
            gpu,
            pipeline,
            sampler,
        }
    }

    /// A texture of half precision, which every adapter filters.
    fn texture(&self, map: &Map) -> wgpu::Texture {
        let texels = |of: &dyn Fn(f64) -> f64| -> Vec<u16> {
            let channels = map.levels.iter().flatten().flatten();
            channels
                .map(|&channel| half::f16::from_f64(of(channel)).to_bits())
                .collect()
        };
        let layers = [texels(&|_| -9.0), texels(&|channel| channel)].concat();
        self.gpu.device.create_texture_with_data(
            &self.gpu.queue,
            &wgpu::TextureDescriptor {
                label: Some("map"),
                size: wgpu::Extent3d {
                    width: map.size[0],
                    height: map.size[1],
                    depth_or_array_layers: 2,
                },
                mip_level_count: map.levels.len() as u32,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::Rgba16Float,
                usage: wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            },
            wgpu::util::TextureDataOrder::LayerMajor,
            bytemuck::cast_slice(&layers),
        )
    }

    pub(crate) fn run(&self, map: &Map, queries: &[Query]) -> Vec<[f32; 4]> {
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
            bytemuck::cast_slice(&vec![[f32::NAN; 4]; queries.len()]),
            wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        );
        let view = self.texture(map).create_view(&Default::default());
        let resources = [
            input.as_entire_binding(),
            output.as_entire_binding(),
            wgpu::BindingResource::TextureView(&view),
            wgpu::BindingResource::Sampler(&self.sampler),
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
