//! Depth maps with given contents. Depth of 32 bits cannot be copied to, so it is drawn.

use moment_shadows_lab::gpu::Gpu;
use wgpu::util::DeviceExt as _;

const DRAW: &str = "
override width: u32;
override samples: u32;
@group(0) @binding(0) var<storage, read> depths: array<f32>;
@vertex fn triangle(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0, 0.0, 1.0);
}
@fragment fn depth(@builtin(position) position: vec4f, @builtin(sample_index) sample: u32) -> @builtin(frag_depth) f32 {
    return depths[(u32(position.y) * width + u32(position.x)) * samples + sample];
}
";

/// A pipeline that draws depth to a texture, by `triangle` of a shader and a fragment stage, if it has one.
fn pipeline(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    shader: &str,
    fragment: Option<(&str, &[(&str, f64)])>,
) -> wgpu::RenderPipeline {
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(shader.into()),
        });
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("triangle"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: texture.format(),
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Always),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: texture.sample_count(),
                ..Default::default()
            },
            fragment: fragment.map(|(entry_point, constants)| wgpu::FragmentState {
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants,
                    ..Default::default()
                },
                targets: &[],
            }),
            multiview_mask: None,
            cache: None,
        })
}

/// Draws the triangle of a shader's vertex stage, for the rasteriser to say what depth samples have.
pub(crate) fn draw_by(gpu: &Gpu, texture: &wgpu::Texture, shader: &str) {
    let pipeline = pipeline(gpu, texture, shader, None);
    with_pass(gpu, texture, 0, 1.0, |pass| {
        pass.set_pipeline(&pipeline);
        pass.draw(0..3, 0..1);
    });
}

/// Draws depths, row by row and sample by sample, to a layer of a depth texture.
pub(crate) fn draw(gpu: &Gpu, texture: &wgpu::Texture, layer: u32, depths: &[f32]) {
    let device = &gpu.device;
    let samples = texture.sample_count();
    assert_eq!(
        depths.len() as u32,
        texture.width() * texture.height() * samples
    );
    let values = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(depths),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let constants = [
        ("width", f64::from(texture.width())),
        ("samples", f64::from(samples)),
    ];
    let pipeline = pipeline(gpu, texture, DRAW, Some(("depth", &constants)));
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[wgpu::BindGroupEntry {
            binding: 0,
            resource: values.as_entire_binding(),
        }],
    });
    with_pass(gpu, texture, layer, 1.0, |pass| {
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    });
}

/// Clears a layer.
pub(crate) fn clear(gpu: &Gpu, texture: &wgpu::Texture, layer: u32, depth: f32) {
    with_pass(gpu, texture, layer, depth, |_| ());
}

fn with_pass(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    layer: u32,
    depth: f32,
    record: impl FnOnce(&mut wgpu::RenderPass<'_>),
) {
    let view = texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2),
        base_array_layer: layer,
        array_layer_count: Some(1),
        ..Default::default()
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: None,
        color_attachments: &[],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &view,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(depth),
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    });
    record(&mut pass);
    drop(pass);
    gpu.queue.submit([encoder.finish()]);
    gpu.check().unwrap();
}

/// An empty depth texture.
pub(crate) fn texture(
    gpu: &Gpu,
    format: wgpu::TextureFormat,
    size: [u32; 2],
    layers: u32,
    samples: u32,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("depth map"),
        size: wgpu::Extent3d {
            width: size[0],
            height: size[1],
            depth_or_array_layers: layers,
        },
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    })
}

/// A single-sampled Depth32Float map whose depth is a function of the texel.
pub(crate) fn of(gpu: &Gpu, size: [u32; 2], depth: impl Fn(u32, u32) -> f32) -> wgpu::Texture {
    let map = texture(gpu, wgpu::TextureFormat::Depth32Float, size, 1, 1);
    draw(gpu, &map, 0, &values(size, depth));
    map
}

pub(crate) fn values(size: [u32; 2], depth: impl Fn(u32, u32) -> f32) -> Vec<f32> {
    (0..size[1])
        .flat_map(|y| (0..size[0]).map(move |x| (x, y)))
        .map(|(x, y)| depth(x, y))
        .collect()
}
