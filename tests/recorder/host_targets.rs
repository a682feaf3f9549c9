//! Fullscreen passes in render passes of the host that look different from the plan's.

use moment_shadows::TextureFormat;
use moment_shadows_graph::record::{
    Bindings, HostTarget, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{GraphError, GraphErrorKind, Plan, Stage, TextureDesc};
use moment_shadows_lab::gpu::Gpu;
use pollster::block_on;

use crate::depth_map;
use crate::setup::{EXAMPLE, aligned_view, block, capabilities, compiled, gpu, uniform};

const MAP: [u32; 2] = [32, 32];
const PICTURE: [u32; 2] = [40, 30];
/// The host's pass is larger than the picture, which has a place in it.
const WINDOW: [u32; 2] = [64, 48];
const AT: [u32; 2] = [7, 5];
const PASS: &str = "shade/shade";

fn plan(gpu: &Gpu) -> Plan {
    let depth = |size| TextureDesc::new(TextureFormat::Depth32Float, size);
    let imports = [
        ("light_depth", depth(MAP)),
        ("camera_depth", depth(PICTURE)),
    ];
    compiled(EXAMPLE, &capabilities(gpu), &imports)
}

fn texture(gpu: &Gpu, format: wgpu::TextureFormat, samples: u32) -> wgpu::Texture {
    let mut usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
    usage.set(wgpu::TextureUsages::COPY_SRC, samples == 1);
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("the host's"),
        size: wgpu::Extent3d {
            width: WINDOW[0],
            height: WINDOW[1],
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

#[test]
fn a_multisampled_pass_with_depth_is_darkened_within_its_viewport() {
    let gpu = gpu();
    let plan = plan(&gpu);
    let target = HostTarget {
        depth_stencil: Some(wgpu::TextureFormat::Depth24PlusStencil8),
        samples: 4,
        ..HostTarget::darkened(wgpu::TextureFormat::Rgba8Unorm)
    };
    let options = PipelineOptions {
        host_targets: vec![(PASS.to_owned(), target)],
        ..PipelineOptions::default()
    };
    let mut pipelines = block_on(Pipelines::create(&gpu.device, &plan, options.clone())).unwrap();
    let of_plan = Pipelines::create(&gpu.device, &plan, PipelineOptions::default());
    assert_eq!(pipelines.len(), block_on(of_plan).unwrap().len() + 1);
    let again = block_on(pipelines.extend(&gpu.device, &plan, options));
    assert_eq!(again, Ok(0));

    let light = depth_map::of(&gpu, MAP, |x, y| if x + y < 20 { 0.2 } else { 1.0 });
    let camera = depth_map::of(&gpu, PICTURE, |_, _| 0.7);
    let imports = [
        ("light_depth", ImportedResource::from(&light)),
        ("camera_depth", ImportedResource::from(&camera)),
    ];
    let resources = block_on(Resources::create(&gpu.device, &plan)).unwrap();
    let parameters = uniform(&gpu, &block(&plan, &aligned_view(0)));
    let bindings = block_on(Bindings::create(
        &gpu.device,
        &plan,
        &pipelines,
        &resources,
        &imports,
        Some(&parameters),
    ))
    .unwrap();

    let samples = texture(&gpu, wgpu::TextureFormat::Rgba8Unorm, 4);
    let depth = texture(&gpu, wgpu::TextureFormat::Depth24PlusStencil8, 4);
    let resolved = texture(&gpu, wgpu::TextureFormat::Rgba8Unorm, 1);
    let view = |texture: &wgpu::Texture| texture.create_view(&Default::default());
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    for stage in Stage::ALL {
        let recorded = bindings.record(stage, &mut encoder, Recording::default());
        recorded.unwrap();
    }
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("the host's pass"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &view(&samples),
            depth_slice: None,
            resolve_target: Some(&view(&resolved)),
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color {
                    r: 1.0,
                    g: 0.6,
                    b: 0.2,
                    a: 0.8,
                }),
                store: wgpu::StoreOp::Store,
            },
        })],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &view(&depth),
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(0.0),
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(0),
                store: wgpu::StoreOp::Store,
            }),
        }),
        ..Default::default()
    });
    let [x, y, width, height] = [AT[0], AT[1], PICTURE[0], PICTURE[1]].map(|length| length as f32);
    pass.set_viewport(x, y, width, height, 0.0, 1.0);
    bindings.draw(PASS, &mut pass, 0).unwrap();
    drop(pass);
    gpu.queue.submit([encoder.finish()]);
    gpu.check().unwrap();

    let shadow = bindings.output("shadow_intensity").unwrap();
    let shadow = gpu.read_texture(shadow, 0, "shadow intensity").unwrap();
    assert!(shadow.contains(&0) && shadow.iter().any(|&byte| byte > 200));
    let found = gpu
        .read_texture(&resolved, 0, "the host's picture")
        .unwrap();
    for (index, found) in (0..).zip(found.chunks_exact(4)) {
        let [x, y] = [index % WINDOW[0], index / WINDOW[0]];
        let within = |at: u32, from: u32, length: u32| (from..from + length).contains(&at);
        let intensity = if within(x, AT[0], PICTURE[0]) && within(y, AT[1], PICTURE[1]) {
            f32::from(shadow[((y - AT[1]) * PICTURE[0] + x - AT[0]) as usize]) / 255.0
        } else {
            0.0
        };
        for (found, clear) in found.iter().zip([255.0, 153.0, 51.0]) {
            let expected = clear * (1.0 - intensity);
            // The intensity that is read back and the result are both rounded to a byte.
            let difference = (f32::from(*found) - expected).abs();
            assert!(difference <= 1.01, "({x}, {y}): {found}, not {expected}");
        }
        assert_eq!(found[3], 204, "({x}, {y}): alpha stays");
    }
}

#[test]
fn a_target_for_no_fullscreen_pass_is_an_error() {
    let gpu = gpu();
    let plan = plan(&gpu);
    let target = HostTarget::new(wgpu::TextureFormat::Rgba8Unorm);
    for pass in ["shade", "resolve/resolve"] {
        let options = PipelineOptions {
            host_targets: vec![(pass.to_owned(), target)],
            ..PipelineOptions::default()
        };
        let refused = block_on(Pipelines::create(&gpu.device, &plan, options));
        let says = format!(
            "there is no fullscreen pass '{pass}'; the nearest are `{PASS}` (written 'node/pass')"
        );
        let expected = GraphError::new(GraphErrorKind::UnknownName, says);
        assert_eq!(refused.err(), Some(expected));
    }
}
