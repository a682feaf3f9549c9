//! A renderer of one's own, as small as one can be, with the library's shadows in it. `check/first_hour.sh` builds it in an empty folder.

use glam::{DMat4, DVec3};
use moment_shadows_graph::{CameraView, Graph, LightView, Session, Stage};
use pollster::block_on;
use wgpu::util::DeviceExt;

const SIZE: u32 = 512;
const BOXES: [[f32; 6]; 4] = [
    [0.0, -0.5, 0.0, 6.0, 0.5, 6.0],
    [-1.0, 1.0, 0.0, 0.6, 1.0, 0.6],
    [1.2, 0.5, 0.8, 0.5, 0.5, 0.5],
    [0.4, 2.2, -0.6, 1.2, 0.08, 0.4],
];
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth24PlusStencil8;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let instance = wgpu::Instance::default();
    let adapter = block_on(instance.request_adapter(&Default::default()))?;
    let (device, queue) = block_on(adapter.request_device(&Default::default()))?;
    let texture = |format, samples| {
        device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: SIZE,
                height: SIZE,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: samples,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | if samples == 1 && !format.is_depth_stencil_format() {
                    wgpu::TextureUsages::COPY_SRC
                } else {
                    wgpu::TextureUsages::empty()
                },
            view_formats: &[],
        })
    };
    let (sun_map, depth, colour, resolved) = (
        texture(wgpu::TextureFormat::Depth24Plus, 1),
        texture(DEPTH, 4),
        texture(wgpu::TextureFormat::Rgba8UnormSrgb, 4),
        texture(wgpu::TextureFormat::Rgba8UnormSrgb, 1),
    );
    // The shadows.
    let graph: Graph = include_str!("graph.json").parse()?;
    let imports = [("sun", (&sun_map).into()), ("depth", (&depth).into())];
    let mut session = block_on(Session::new(
        &adapter,
        &device,
        graph,
        &imports,
        Default::default(),
    ))?;

    let camera = glam::dcamera::rh::proj::directx::perspective(0.9, 1.0, 0.1, 100.0)
        * glam::dcamera::rh::view::look_at_mat4(
            DVec3::new(3.0, 3.5, 5.0),
            DVec3::Y * 0.6,
            DVec3::Y,
        );
    let sun = glam::dcamera::rh::proj::directx::orthographic(-5.0, 5.0, -5.0, 5.0, 0.0, 20.0)
        * glam::dcamera::rh::view::look_at_mat4(DVec3::new(5.0, 8.0, 4.0), DVec3::ZERO, DVec3::Y);
    session.view(
        &queue,
        0,
        &CameraView {
            clip_from_world: camera.to_cols_array_2d(),
            far_depth: 1.0,
        },
        &[LightView::orthographic(sun.to_cols_array_2d())],
    )?;

    // The renderer.
    let module = device.create_shader_module(wgpu::include_wgsl!("scene.wgsl"));
    let boxes = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: bytemuck::cast_slice(&BOXES),
        usage: wgpu::BufferUsages::VERTEX,
    });
    let pipeline = |format: wgpu::TextureFormat, samples, fragment| {
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vs"),
                compilation_options: Default::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: 24,
                    step_mode: wgpu::VertexStepMode::Instance,
                    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3],
                })],
            },
            primitive: Default::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::LessEqual),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: samples,
                ..Default::default()
            },
            fragment,
            multiview_mask: None,
            cache: None,
        })
    };
    let draw = |encoder: &mut wgpu::CommandEncoder,
                pipeline: &wgpu::RenderPipeline,
                matrix: DMat4,
                depth: &wgpu::Texture,
                load: wgpu::LoadOp<f32>,
                shadow: Option<&wgpu::Texture>| {
        let uniform = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: bytemuck::cast_slice(&matrix.as_mat4().to_cols_array()),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: uniform.as_entire_binding(),
            }],
        });
        let depth_view = depth.create_view(&Default::default());
        let (colour_view, resolved_view) = (
            colour.create_view(&Default::default()),
            resolved.create_view(&Default::default()),
        );
        let colours = [Some(wgpu::RenderPassColorAttachment {
            view: &colour_view,
            depth_slice: None,
            resolve_target: Some(&resolved_view),
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color {
                    r: 0.4,
                    g: 0.5,
                    b: 0.7,
                    a: 1.0,
                }),
                store: wgpu::StoreOp::Store,
            },
        })];
        let shadow_group = shadow.map(|shadow| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &pipeline.get_bind_group_layout(1),
                entries: &[wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::TextureView(
                        &shadow.create_view(&Default::default()),
                    ),
                }],
            })
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: if shadow.is_some() { &colours } else { &[] },
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth_view,
                depth_ops: Some(wgpu::Operations {
                    load,
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &group, &[]);
        if let Some(group) = &shadow_group {
            pass.set_bind_group(1, group, &[]);
        }
        pass.set_vertex_buffer(0, boxes.slice(..));
        pass.draw(0..36, 0..BOXES.len() as u32);
    };
    let targets = [Some(wgpu::TextureFormat::Rgba8UnormSrgb.into())];
    let of_sun = pipeline(wgpu::TextureFormat::Depth24Plus, 1, None);
    let first = pipeline(DEPTH, 4, None);
    let main = pipeline(
        DEPTH,
        4,
        Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fs"),
            compilation_options: Default::default(),
            targets: &targets,
        }),
    );
    let mut encoder = device.create_command_encoder(&Default::default());
    draw(
        &mut encoder,
        &of_sun,
        sun,
        &sun_map,
        wgpu::LoadOp::Clear(1.0),
        None,
    );
    session.record(Stage::AfterShadowMaps, &mut encoder)?;
    draw(
        &mut encoder,
        &first,
        camera,
        &depth,
        wgpu::LoadOp::Clear(1.0),
        None,
    );
    session.record(Stage::AfterMainPass, &mut encoder)?;
    draw(
        &mut encoder,
        &main,
        camera,
        &depth,
        wgpu::LoadOp::Load,
        session.output(0, "shadow"),
    );
    // The picture.
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(SIZE * SIZE * 4),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    encoder.copy_texture_to_buffer(
        resolved.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(SIZE * 4),
                rows_per_image: None,
            },
        },
        resolved.size(),
    );
    queue.submit([encoder.finish()]);
    buffer
        .slice(..)
        .map_async(wgpu::MapMode::Read, |result| result.unwrap());
    device.poll(wgpu::PollType::wait_indefinitely())?;
    image::save_buffer(
        "picture.png",
        &buffer.slice(..).get_mapped_range()?,
        SIZE,
        SIZE,
        image::ExtendedColorType::Rgba8,
    )?;
    Ok(())
}
