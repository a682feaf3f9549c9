//! Several views of one map, and drawing into the host's own render pass.

use moment_shadows::TextureFormat;
use moment_shadows_graph::record::{ImportedResource, Recording};
use moment_shadows_graph::{Capabilities, GraphError, GraphErrorKind, Plan, Stage, TextureDesc};
use moment_shadows_lab::gpu::Gpu;

use crate::depth_map;
use crate::setup::{Bound, EXAMPLE, IDENTITY, bind, block, capabilities, compiled, gpu, view};

const MAP: [u32; 2] = [32, 32];
const PICTURE: [u32; 2] = [40, 30];

fn plan(capabilities: &Capabilities) -> Plan {
    let depth = |size| TextureDesc::new(TextureFormat::Depth32Float, size);
    compiled(
        EXAMPLE,
        capabilities,
        &[
            ("light_depth", depth(MAP)),
            ("camera_depth", depth(PICTURE)),
        ],
    )
}

/// The example, bound with two views whose lights are mirrored.
fn two_views(gpu: &Gpu, plan: Plan) -> Bound {
    let light = depth_map::of(gpu, MAP, |x, y| if x + y < 20 { 0.2 } else { 1.0 });
    let camera = depth_map::of(gpu, PICTURE, |_, _| 0.7);
    let mut mirrored = IDENTITY;
    mirrored[0][0] = -1.0;
    let views = [view(IDENTITY, IDENTITY, 0), view(IDENTITY, mirrored, 0)];
    let bytes: Vec<u8> = views.iter().flat_map(|view| block(&plan, view)).collect();
    let imports = [
        ("light_depth", ImportedResource::from(&light)),
        ("camera_depth", ImportedResource::from(&camera)),
    ];
    bind(gpu, plan, &imports, &bytes)
}

fn target(gpu: &Gpu, format: wgpu::TextureFormat) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("the host's target"),
        size: wgpu::Extent3d {
            width: PICTURE[0],
            height: PICTURE[1],
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

fn with_pass(
    encoder: &mut wgpu::CommandEncoder,
    target: &wgpu::Texture,
    draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
) {
    let view = target.create_view(&Default::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("the host's pass"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::WHITE),
                store: wgpu::StoreOp::Store,
            },
        })],
        ..Default::default()
    });
    draw(&mut pass);
}

fn read(gpu: &Gpu, texture: &wgpu::Texture) -> Vec<u8> {
    gpu.read_texture(texture, 0, "picture").unwrap()
}

#[test]
fn two_views_recorded_in_one_submission_each_have_their_own_parameters() {
    let gpu = gpu();
    let bound = two_views(&gpu, plan(&capabilities(&gpu)));
    let size = u64::from(bound.plan.parameters.size);
    let copies = [0, 1].map(|_| target(&gpu, wgpu::TextureFormat::R8Unorm));
    let output = bound.bindings.output("shadow_intensity").unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    for (view, copy) in (0..).zip(&copies) {
        for stage in Stage::ALL {
            let recording = Recording {
                parameter_offset: view * size,
                ..Recording::default()
            };
            bound
                .bindings
                .record(stage, &mut encoder, recording)
                .unwrap();
        }
        encoder.copy_texture_to_texture(
            output.as_image_copy(),
            copy.as_image_copy(),
            output.size(),
        );
    }
    gpu.queue.submit([encoder.finish()]);
    gpu.check().unwrap();
    let [first, second] = copies.map(|copy| read(&gpu, &copy));
    assert!(first.contains(&0) && first.contains(&255));
    assert_ne!(first, second);
    // The light of the second view is the first's mirror image.
    let mirrored: Vec<u8> = first
        .chunks_exact(PICTURE[0] as usize)
        .flat_map(|row| row.iter().rev().copied())
        .collect();
    let largest = mirrored
        .iter()
        .zip(&second)
        .map(|(a, b)| a.abs_diff(*b))
        .max()
        .unwrap();
    assert!(largest <= 1, "rounding of mirrored positions: {largest}");
}

#[test]
fn a_pass_drawn_into_the_hosts_render_pass_is_the_recorded_one() {
    let gpu = gpu();
    let bound = two_views(&gpu, plan(&capabilities(&gpu)));
    let size = u64::from(bound.plan.parameters.size);
    let targets = [0, 1].map(|_| target(&gpu, wgpu::TextureFormat::R8Unorm));
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    bound
        .bindings
        .record(Stage::AfterShadowMaps, &mut encoder, Recording::default())
        .unwrap();
    for (view, target) in (0..).zip(&targets) {
        with_pass(&mut encoder, target, |pass| {
            bound
                .bindings
                .draw("shade/shade", pass, view * size)
                .unwrap()
        });
    }
    gpu.queue.submit([encoder.finish()]);
    gpu.check().unwrap();
    assert_ne!(read(&gpu, &targets[0]), read(&gpu, &targets[1]));
    for (view, target) in (0..).zip(&targets) {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let recording = Recording {
            parameter_offset: view * size,
            ..Recording::default()
        };
        bound
            .bindings
            .record(Stage::AfterMainPass, &mut encoder, recording)
            .unwrap();
        gpu.queue.submit([encoder.finish()]);
        assert_eq!(
            read(&gpu, target),
            bound.read(&gpu, "shadow_intensity", 0),
            "view {view}"
        );
    }
}

#[test]
fn drawing_names_the_passes_that_can_be_drawn() {
    let gpu = gpu();
    let bound = two_views(&gpu, plan(&capabilities(&gpu)));
    let host = target(&gpu, wgpu::TextureFormat::R8Unorm);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    with_pass(&mut encoder, &host, |pass| {
        let no_such = |pass: &str| {
            let says = format!(
                "there is no fullscreen pass '{pass}'; the nearest are `shade/shade` (written 'node/pass')"
            );
            GraphError::new(GraphErrorKind::UnknownName, says)
        };
        assert_eq!(bound.bindings.draw("shade", pass, 0), Err(no_such("shade")));
        // Compute passes cannot be drawn.
        assert_eq!(
            bound.bindings.draw("resolve/resolve", pass, 0),
            Err(no_such("resolve/resolve"))
        );
        let error = bound.bindings.draw("shade/shade", pass, 1).unwrap_err();
        assert_eq!(error.kind, GraphErrorKind::Parameters);
        let says = "a view's parameters cannot begin at byte 1:";
        assert!(error.message.starts_with(says), "{error}");
    });
    drop(encoder);
}

#[test]
fn the_plans_bind_group_leaves_lower_ones_to_the_host() {
    let gpu = gpu();
    let device = &gpu.device;
    let capabilities = Capabilities {
        bind_group: 1,
        ..capabilities(&gpu)
    };
    let bound = two_views(&gpu, plan(&capabilities));
    let plain = two_views(&gpu, plan(&crate::setup::capabilities(&gpu)));
    // The host's own group 0 and pipeline, around the plan's pass.
    let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        }],
    });
    let value = crate::setup::uniform(&gpu, bytemuck::bytes_of(&[0.5_f32; 4]));
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &layout,
        entries: &[wgpu::BindGroupEntry {
            binding: 0,
            resource: value.as_entire_binding(),
        }],
    });
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(
            "@group(0) @binding(0) var<uniform> value: vec4f;
             @vertex fn point(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
                 return vec4f(4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0, 0.0, 1.0);
             }
             @fragment fn fill() -> @location(0) vec4f { return value; }"
                .into(),
        ),
    });
    let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(&layout)],
        immediate_size: 0,
    });
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: Some(&pipeline_layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("point"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: None,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fill"),
            compilation_options: Default::default(),
            targets: &[Some(wgpu::TextureFormat::R8Unorm.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    let host = target(&gpu, wgpu::TextureFormat::R8Unorm);
    let mut encoder = device.create_command_encoder(&Default::default());
    bound
        .bindings
        .record(Stage::AfterShadowMaps, &mut encoder, Recording::default())
        .unwrap();
    with_pass(&mut encoder, &host, |pass| {
        pass.set_bind_group(0, &group, &[]);
        bound.bindings.draw("shade/shade", pass, 0).unwrap();
        // The host's group is still set: its own pipeline draws the left half with it.
        pass.set_pipeline(&pipeline);
        pass.set_scissor_rect(0, 0, PICTURE[0] / 2, PICTURE[1]);
        pass.draw(0..3, 0..1);
    });
    gpu.queue.submit([encoder.finish()]);
    gpu.check().unwrap();
    plain.run(&gpu);
    let expected = plain.read(&gpu, "shadow_intensity", 0);
    for (index, (found, expected)) in read(&gpu, &host).iter().zip(expected).enumerate() {
        let left = index as u32 % PICTURE[0] < PICTURE[0] / 2;
        assert_eq!(*found, if left { 128 } else { expected }, "pixel {index}");
    }
}
