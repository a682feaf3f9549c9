//! Recording makes nothing: it allocates exactly what the same wgpu calls allocate when they are written by hand.
//!
//! A view, a bind group or a string of our own would be seen here, since making any of them allocates.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

use moment_shadows::{Profile, TextureFormat};
use moment_shadows_graph::record::{
    Bindings, ImportedResource, Layers, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{
    Capabilities, NodeDesc, ParameterBlock, Pass, Plan, Stage, TextureRule, bind,
};
use moment_shadows_lab::gpu::Gpu;
use pollster::block_on;
use wgpu::util::DeviceExt as _;

#[allow(
    dead_code,
    reason = "shared with the tests of the compiler and the recorder"
)]
#[path = "support/host_node.rs"]
mod host_node;

use host_node::{SIDE, graph};

const STAGE: Stage = Stage::AfterShadowMaps;
const LAYERS: u32 = 3;

const COMPUTE: &str = "
@group(0) @binding(0) var<uniform> value: vec4f;
@group(0) @binding(1) var filled: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) { textureStore(filled, id.xy, value); }
";

const DRAW: &str = "
@group(0) @binding(0) var<uniform> value: vec4f;
@vertex fn fullscreen(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0, 0.0, 1.0);
}
@fragment fn main() -> @location(0) vec4f { return value; }
";

/// A node of one pass per layer that writes its parameter to the output `to`.
fn node(draws: bool) -> NodeDesc {
    let (format, pass) = if draws {
        let pass = Pass::fullscreen("main", "to").shader(DRAW, "main");
        (TextureFormat::R32Float, pass)
    } else {
        let pass = Pass::compute("main", "to", [8, 8]).shader(COMPUTE, "main");
        let pass = pass.bind("filled", bind::store("to"));
        (TextureFormat::Rgba32Float, pass)
    };
    let square = TextureRule::new(format).extent([SIDE, SIDE]).layers(LAYERS);
    NodeDesc::new("host", STAGE)
        .output("to", "The value.", square)
        .pass(pass.each_layer().bind("value", bind::parameters()))
        .parameters(ParameterBlock::of::<[f32; 4]>("Value"))
}

fn plan(gpu: &Gpu, draws: bool) -> Plan {
    let graph = graph(&[], vec![("host", node(draws))], &[], &[("out", "host.to")]);
    let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
    graph.compile(&capabilities, &[]).unwrap()
}

fn bound(
    gpu: &Gpu,
    plan: &Plan,
    imports: &[(&str, ImportedResource)],
    parameters: &wgpu::Buffer,
) -> Bindings {
    let device = &gpu.device;
    let pipelines = block_on(Pipelines::create(device, plan, PipelineOptions::default())).unwrap();
    let resources = block_on(Resources::create(device, plan)).unwrap();
    block_on(Bindings::create(
        device,
        plan,
        &pipelines,
        &resources,
        imports,
        Some(parameters),
    ))
    .unwrap()
}

fn uniform(gpu: &Gpu, size: u32) -> wgpu::Buffer {
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: &vec![0; size as usize],
            usage: wgpu::BufferUsages::UNIFORM,
        })
}

/// The fewest allocations of a recording, once everything is warm. Other threads are not counted.
fn allocations(gpu: &Gpu, record: &dyn Fn(&mut wgpu::CommandEncoder)) -> u64 {
    (0..8)
        .map(|_| {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let counted = allocation_counter::measure(|| record(&mut encoder));
            gpu.queue.submit([encoder.finish()]);
            counted.count_total
        })
        .min()
        .unwrap()
}

fn layer_views(texture: &wgpu::Texture) -> Vec<wgpu::TextureView> {
    (0..LAYERS)
        .map(|layer| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2),
                base_array_layer: layer,
                array_layer_count: Some(1),
                ..Default::default()
            })
        })
        .collect()
}

fn texture(gpu: &Gpu, format: wgpu::TextureFormat, usage: wgpu::TextureUsages) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: SIDE,
            height: SIDE,
            depth_or_array_layers: LAYERS,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

/// Layout, pipeline layout and bind groups of the pass, written by hand.
fn by_hand(
    gpu: &Gpu,
    visibility: wgpu::ShaderStages,
    stored: Option<&[wgpu::TextureView]>,
    parameters: &wgpu::Buffer,
) -> (wgpu::PipelineLayout, Vec<wgpu::BindGroup>) {
    let uniform = wgpu::BindGroupLayoutEntry {
        binding: 0,
        visibility,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: true,
            min_binding_size: wgpu::BufferSize::new(16),
        },
        count: None,
    };
    let store = wgpu::BindGroupLayoutEntry {
        binding: 1,
        ty: wgpu::BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            format: wgpu::TextureFormat::Rgba32Float,
            view_dimension: wgpu::TextureViewDimension::D2,
        },
        ..uniform
    };
    let entries = if stored.is_some() {
        vec![uniform, store]
    } else {
        vec![uniform]
    };
    let layout = gpu
        .device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &entries,
        });
    let pipeline_layout = gpu
        .device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
    let groups = (0..LAYERS as usize)
        .map(|layer| {
            let uniform = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: parameters,
                offset: 0,
                size: wgpu::BufferSize::new(16),
            });
            let mut entries = vec![wgpu::BindGroupEntry {
                binding: 0,
                resource: uniform,
            }];
            entries.extend(stored.map(|views| wgpu::BindGroupEntry {
                binding: 1,
                resource: wgpu::BindingResource::TextureView(&views[layer]),
            }));
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &layout,
                entries: &entries,
            })
        })
        .collect();
    (pipeline_layout, groups)
}

fn shader(gpu: &Gpu, wgsl: &str) -> wgpu::ShaderModule {
    let source = wgpu::ShaderSource::Wgsl(wgsl.into());
    gpu.device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source,
        })
}

#[test]
fn a_compute_pass_allocates_what_wgpu_does() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let plan = plan(&gpu, false);
    let parameters = uniform(&gpu, plan.parameters.size);
    let bindings = bound(&gpu, &plan, &[], &parameters);

    let filled = texture(
        &gpu,
        wgpu::TextureFormat::Rgba32Float,
        wgpu::TextureUsages::STORAGE_BINDING,
    );
    let views = layer_views(&filled);
    let (layout, groups) = by_hand(&gpu, wgpu::ShaderStages::COMPUTE, Some(&views), &parameters);
    let pipeline = gpu
        .device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: Some(&layout),
            module: &shader(&gpu, COMPUTE),
            entry_point: Some("main"),
            compilation_options: Default::default(),
            cache: None,
        });
    let hand = |layers: &[u32]| {
        allocations(&gpu, &|encoder| {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("moment-shadows/host/main"),
                timestamp_writes: None,
            });
            pass.set_pipeline(&pipeline);
            for &layer in layers {
                pass.set_bind_group(0, &groups[layer as usize], &[0]);
                pass.dispatch_workgroups(2, 2, 1);
            }
        })
    };
    let ours = |layers: Layers<'_>| {
        allocations(&gpu, &|encoder| {
            bindings
                .record(
                    STAGE,
                    encoder,
                    Recording {
                        layers,
                        ..Recording::default()
                    },
                )
                .unwrap();
        })
    };
    let by_hand = hand(&[0, 1, 2]);
    assert!(by_hand > 0, "allocations are counted");
    assert_eq!(ours(Layers::All), by_hand);
    assert_eq!(ours(Layers::Only(&[2])), hand(&[2]));
    assert_eq!(
        ours(Layers::Only(&[])),
        0,
        "nothing is recorded where no layer is dirty"
    );
    gpu.check().unwrap();
}

#[test]
fn a_fullscreen_pass_allocates_what_wgpu_does() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let plan = plan(&gpu, true);
    let parameters = uniform(&gpu, plan.parameters.size);
    let bindings = bound(&gpu, &plan, &[], &parameters);

    let target = texture(
        &gpu,
        wgpu::TextureFormat::R32Float,
        wgpu::TextureUsages::RENDER_ATTACHMENT,
    );
    let views = layer_views(&target);
    let (layout, groups) = by_hand(&gpu, wgpu::ShaderStages::FRAGMENT, None, &parameters);
    let module = shader(&gpu, DRAW);
    let pipeline = gpu
        .device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("fullscreen"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("main"),
                compilation_options: Default::default(),
                targets: &[Some(wgpu::TextureFormat::R32Float.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
    let hand = allocations(&gpu, &|encoder| {
        for (view, group) in views.iter().zip(&groups) {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("moment-shadows/host/main"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                ..Default::default()
            });
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, group, &[0]);
            pass.draw(0..3, 0..1);
        }
    });
    let ours = allocations(&gpu, &|encoder| {
        bindings
            .record(STAGE, encoder, Recording::default())
            .unwrap();
    });
    assert_eq!(ours, hand);
    gpu.check().unwrap();
}
