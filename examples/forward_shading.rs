//! Forward shading: the graph ends with the filtered map, and the renderer's own lit shader samples it.
//!
//! `cargo run --release --example forward_shading [PICTURE]`. Runs on core WebGPU: half-precision storage.

use std::error::Error;
use std::path::Path;

use glam::camera::rh::proj::directx::{orthographic, perspective_infinite_reverse};
use glam::camera::rh::view::look_at_mat4;
use moment_shadows::{Kernel, LightDepth, Profile, ReceiverBias, Source, TextureFormat, link};
use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{Capabilities, Graph, NodeRegistry, ResourceDesc, Stage, TextureDesc};
use moment_shadows_lab::{gpu::Gpu, picture};
use pollster::block_on;

const PICTURE: [u32; 2] = [1280, 720];
const MAP: u32 = 1024;
/// Half the width of the light's box, and its depth, in scene units.
const LIGHT_EXTENT: f32 = 3.4;
const LIGHT_RANGE: f32 = 7.5;
const INSTANCES: u32 = 9;

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct FrameUniform {
    clip_from_world: [[f32; 4]; 4],
    light_clip_from_world: [[f32; 4]; 4],
    moment_depth: [f32; 4],
    light: [f32; 4],
    receiver_bias: ReceiverBias,
}

fn frame_uniform() -> Result<FrameUniform, Box<dyn Error>> {
    let towards_light = glam::vec3(0.75, 0.6, -0.35).normalize();
    let light_clip = orthographic(
        -LIGHT_EXTENT,
        LIGHT_EXTENT,
        -LIGHT_EXTENT,
        LIGHT_EXTENT,
        0.0,
        LIGHT_RANGE,
    ) * look_at_mat4(
        0.5 * LIGHT_RANGE * towards_light,
        glam::Vec3::ZERO,
        glam::Vec3::Y,
    );
    let camera = perspective_infinite_reverse(0.7, 16.0 / 9.0, 0.1)
        * look_at_mat4(
            glam::vec3(-1.6, 3.2, 5.0),
            glam::vec3(-0.2, 0.3, 0.3),
            glam::Vec3::Y,
        );
    let light_clip_from_world = light_clip.to_cols_array_2d();
    let moment_depth =
        LightDepth::Orthographic { reversed: false }.moment_depth_row(&light_clip_from_world);
    let depth_per_texel = 2.0 * (2.0 * LIGHT_EXTENT / MAP as f32) / LIGHT_RANGE;
    Ok(FrameUniform {
        clip_from_world: camera.to_cols_array_2d(),
        light_clip_from_world,
        moment_depth,
        light: towards_light.extend(0.0).to_array(),
        receiver_bias: ReceiverBias::for_kernel(
            Kernel::gaussian(4, 2.4)?.standard_deviation(),
            depth_per_texel,
        ),
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let out = std::env::args()
        .nth(1)
        .unwrap_or("pictures/forward_shading.png".to_owned());
    let gpu = Gpu::open(Profile::WebgpuCore)?;
    let device = &gpu.device;

    // The graph: from the light's depth to the filtered map.
    let graph = Graph::parse(include_str!("forward_shading.json"), &NodeRegistry::new())?;
    let light_depth = TextureDesc {
        samples: 4,
        ..TextureDesc::new(TextureFormat::Depth32Float, [MAP, MAP])
    };
    let plan = graph.compile(
        &Capabilities::of_device(&gpu.adapter, device),
        &[("light_depth", ResourceDesc::Texture(light_depth))],
    )?;
    let pipelines = block_on(Pipelines::create(device, &plan, PipelineOptions::default()))?;
    let resources = block_on(Resources::create(device, &plan))?;
    let parameters = uniform_buffer(&gpu, &plan.parameters.initial());
    let light_map = texture(device, [MAP, MAP], 4, wgpu::TextureFormat::Depth32Float);
    let imports = [("light_depth", ImportedResource::Texture(&light_map))];
    let bindings = block_on(Bindings::create(
        device,
        &plan,
        &pipelines,
        &resources,
        &imports,
        Some(&parameters),
    ))?;
    let shadow_map = bindings
        .output("shadow_map")
        .ok_or("the graph has no such output")?;

    // The renderer: its shader is linked with the modules that it imports.
    let source = Source {
        name: "forward_shading.wgsl",
        text: include_str!("forward_shading.wgsl"),
    };
    let shader = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("forward shading"),
        source: wgpu::ShaderSource::Wgsl(link(source, &[])?.into_wgsl().into()),
    });
    let depth_pipeline = pipeline(device, &shader, "light_depth", None, 4);
    let colour = wgpu::TextureFormat::Rgba8UnormSrgb;
    let lit_pipeline = pipeline(device, &shader, "scene", Some(colour), 1);
    let frame = uniform_buffer(&gpu, bytemuck::bytes_of(&frame_uniform()?));
    let group =
        |pipeline: &wgpu::RenderPipeline, index: u32, entries: &[wgpu::BindGroupEntry<'_>]| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &pipeline.get_bind_group_layout(index),
                entries,
            })
        };
    let frame_entry = [wgpu::BindGroupEntry {
        binding: 0,
        resource: frame.as_entire_binding(),
    }];
    let shadow_view = shadow_map.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    });
    let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        anisotropy_clamp: 8,
        ..Default::default()
    });
    let shadow_entries = [
        wgpu::BindGroupEntry {
            binding: 0,
            resource: wgpu::BindingResource::TextureView(&shadow_view),
        },
        wgpu::BindGroupEntry {
            binding: 1,
            resource: wgpu::BindingResource::Sampler(&sampler),
        },
    ];

    // A frame: the light's depth, our stage, the lit pass.
    let picture = texture(device, PICTURE, 1, colour);
    let depth = texture(device, PICTURE, 1, wgpu::TextureFormat::Depth32Float);
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = render_pass(&mut encoder, None, &light_map, 1.0);
        pass.set_pipeline(&depth_pipeline);
        pass.set_bind_group(0, &group(&depth_pipeline, 0, &frame_entry), &[]);
        pass.draw(0..36, 0..INSTANCES);
    }
    bindings.record(Stage::AfterShadowMaps, &mut encoder, Recording::default())?;
    {
        let mut pass = render_pass(&mut encoder, Some(&picture), &depth, 0.0);
        pass.set_pipeline(&lit_pipeline);
        pass.set_bind_group(0, &group(&lit_pipeline, 0, &frame_entry), &[]);
        pass.set_bind_group(1, &group(&lit_pipeline, 1, &shadow_entries), &[]);
        pass.draw(0..36, 0..INSTANCES);
    }
    gpu.queue.submit([encoder.finish()]);
    let pixels = gpu.read_texture(&picture, 0, "picture")?;
    picture::save_rgba(Path::new(&out), PICTURE[0], PICTURE[1], &pixels)?;
    println!("{out}");
    Ok(())
}

fn uniform_buffer(gpu: &Gpu, contents: &[u8]) -> wgpu::Buffer {
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: contents.len() as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    gpu.queue.write_buffer(&buffer, 0, contents);
    buffer
}

fn texture(
    device: &wgpu::Device,
    size: [u32; 2],
    samples: u32,
    format: wgpu::TextureFormat,
) -> wgpu::Texture {
    let mut usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
    usage.set(wgpu::TextureUsages::COPY_SRC, samples == 1);
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d {
            width: size[0],
            height: size[1],
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

/// The light's depth is forward (no colour), the camera's reversed.
fn pipeline(
    device: &wgpu::Device,
    shader: &wgpu::ShaderModule,
    vertex: &str,
    colour: Option<wgpu::TextureFormat>,
    samples: u32,
) -> wgpu::RenderPipeline {
    let targets = [colour.map(Into::into)];
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(vertex),
        layout: None,
        vertex: wgpu::VertexState {
            module: shader,
            entry_point: Some(vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: wgpu::TextureFormat::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(if colour.is_some() {
                wgpu::CompareFunction::Greater
            } else {
                wgpu::CompareFunction::Less
            }),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState {
            count: samples,
            ..Default::default()
        },
        fragment: colour.map(|_| wgpu::FragmentState {
            module: shader,
            entry_point: Some("lit"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn render_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    colour: Option<&wgpu::Texture>,
    depth: &wgpu::Texture,
    far: f32,
) -> wgpu::RenderPass<'a> {
    let view =
        |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
    let colour = colour.map(view);
    let sky = wgpu::Color {
        r: 0.35,
        g: 0.5,
        b: 0.75,
        a: 1.0,
    };
    let attachments = colour.as_ref().map(|view| wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Clear(sky),
            store: wgpu::StoreOp::Store,
        },
    });
    let attachments = [attachments];
    let used = if attachments[0].is_some() {
        &attachments[..]
    } else {
        &[]
    };
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: None,
        color_attachments: used,
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &view(depth),
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(far),
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}
