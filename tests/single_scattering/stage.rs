//! A graph, recorded on textures of a test.

use moment_shadows::{MapEncoding, Profile};
use moment_shadows_graph::record::{
    Bindings, HostTarget, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{
    Capabilities, Graph, NodeRegistry, Plan, ResourceDesc, Stage, TextureDesc,
};
use moment_shadows_lab::gpu::Gpu;
use pollster::block_on;
use wgpu::util::DeviceExt as _;

/// The parameters of a node, by its name.
pub(crate) type Block<'a> = (&'a str, &'a [u8]);

pub(crate) fn gpu() -> Gpu {
    Gpu::open(Profile::Native).unwrap()
}

pub(crate) fn capabilities(gpu: &Gpu) -> Capabilities {
    Capabilities::of_device(&gpu.adapter, &gpu.device)
}

/// A map of four or six moments with the given channels: all texels of the first plane, then those of the second.
pub(crate) fn upload(
    gpu: &Gpu,
    encoding: &MapEncoding,
    size: [u32; 2],
    channels: &[[f32; 4]],
) -> (TextureDesc, wgpu::Texture) {
    upload_layers(gpu, encoding, size, 1, channels)
}

/// A map of several layers with the given channels.
pub(crate) fn upload_layers(
    gpu: &Gpu,
    encoding: &MapEncoding,
    size: [u32; 2],
    layers: u32,
    channels: &[[f32; 4]],
) -> (TextureDesc, wgpu::Texture) {
    use moment_shadows::TextureFormat::{Rgba8Unorm, Rgba16Float, Rgba16Unorm, Rgba32Float};
    let values = channels.iter().flatten();
    let (format, bytes): (_, Vec<u8>) = match encoding.format() {
        Rgba32Float => (
            wgpu::TextureFormat::Rgba32Float,
            bytemuck::cast_slice(channels).to_vec(),
        ),
        Rgba16Float => (
            wgpu::TextureFormat::Rgba16Float,
            values
                .flat_map(|&value| half::f16::from_f32(value).to_le_bytes())
                .collect(),
        ),
        Rgba16Unorm => (
            wgpu::TextureFormat::Rgba16Unorm,
            values
                .flat_map(|&value| ((value * 65535.0).round() as u16).to_le_bytes())
                .collect(),
        ),
        Rgba8Unorm => (
            wgpu::TextureFormat::Rgba8Unorm,
            values.map(|&value| (value * 255.0).round() as u8).collect(),
        ),
        other => panic!("{other}"),
    };
    let texture = gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: Some("map"),
            size: wgpu::Extent3d {
                width: size[0],
                height: size[1],
                depth_or_array_layers: layers * encoding.planes(),
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        &bytes,
    );
    let desc = TextureDesc {
        layers,
        ..TextureDesc::of_map(encoding.clone(), size)
    };
    (desc, texture)
}

/// A camera's depth of nothing but sky: zeros, infinitely far.
pub(crate) fn sky(gpu: &Gpu, size: [u32; 2]) -> (TextureDesc, wgpu::Texture) {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("sky"),
        size: wgpu::Extent3d {
            width: size[0],
            height: size[1],
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Depth32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    let desc = TextureDesc::new(moment_shadows::TextureFormat::Depth32Float, size);
    (desc, texture)
}

/// A camera's depth of 16 bits.
pub(crate) fn depths(gpu: &Gpu, size: [u32; 2], stored: &[u16]) -> (TextureDesc, wgpu::Texture) {
    let desc = TextureDesc::new(moment_shadows::TextureFormat::Depth16Unorm, size);
    let format = wgpu::TextureFormat::Depth16Unorm;
    let texture = upload_bytes(gpu, format, size, bytemuck::cast_slice(stored));
    (desc, texture)
}

/// A texture of pairs of whole numbers.
pub(crate) fn upload_words(
    gpu: &Gpu,
    size: [u32; 2],
    bytes: &[u8],
) -> (TextureDesc, wgpu::Texture) {
    let desc = TextureDesc::new(moment_shadows::TextureFormat::Rg32Uint, size);
    let texture = upload_bytes(gpu, wgpu::TextureFormat::Rg32Uint, size, bytes);
    (desc, texture)
}

fn upload_bytes(
    gpu: &Gpu,
    format: wgpu::TextureFormat,
    [width, height]: [u32; 2],
    bytes: &[u8],
) -> wgpu::Texture {
    let descriptor = wgpu::TextureDescriptor {
        label: Some("upload"),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    (gpu.device).create_texture_with_data(&gpu.queue, &descriptor, order, bytes)
}

/// A plan with all that recording it needs.
pub(crate) struct Bound {
    plan: Plan,
    parameters: wgpu::Buffer,
    bindings: Bindings,
    // What the bindings refer to.
    _resources: Resources,
}

/// All layers of an output as bytes.
pub(crate) fn run(
    gpu: &Gpu,
    capabilities: &Capabilities,
    graph: &str,
    imports: &[(&str, &(TextureDesc, wgpu::Texture))],
    blocks: &[Block<'_>],
    output: &str,
) -> Vec<Vec<u8>> {
    bind(gpu, capabilities, graph, imports, blocks, &[]).run(gpu, blocks, output)
}

impl Bound {
    /// All layers of an output as bytes, with these parameters.
    pub(crate) fn run(&self, gpu: &Gpu, blocks: &[Block<'_>], output: &str) -> Vec<Vec<u8>> {
        gpu.queue
            .write_buffer(&self.parameters, 0, &contents(&self.plan, blocks));
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for stage in Stage::ALL {
            self.bindings
                .record(stage, &mut encoder, Recording::default())
                .unwrap();
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.check().unwrap();
        let texture = self.bindings.output(output).unwrap();
        (0..texture.depth_or_array_layers())
            .map(|layer| gpu.read_texture(texture, layer, output).unwrap())
            .collect()
    }
}

/// The parameter buffer of a plan with some blocks filled.
fn contents(plan: &Plan, blocks: &[Block<'_>]) -> Vec<u8> {
    let mut bytes = plan.parameters.initial();
    for (node, block) in blocks {
        let planned = plan
            .parameters
            .blocks
            .iter()
            .find(|planned| planned.node == *node)
            .unwrap();
        let start = planned.offset as usize;
        bytes[start..start + block.len()].copy_from_slice(block);
    }
    bytes
}

/// Runs a graph with the pass `composite/composite` drawn into a host's pass of rgba16float, which holds `behind`.
pub(crate) fn draw_over(
    gpu: &Gpu,
    graph: &str,
    imports: &[(&str, &(TextureDesc, wgpu::Texture))],
    blocks: &[Block<'_>],
    size: [u32; 2],
    behind: wgpu::Color,
) -> Vec<u8> {
    const PASS: &str = "composite/composite";
    let format = wgpu::TextureFormat::Rgba16Float;
    let targets = [(PASS, HostTarget::scattered(format))];
    let bound = bind(gpu, &capabilities(gpu), graph, imports, blocks, &targets);
    let target = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("the host's"),
        size: wgpu::Extent3d {
            width: size[0],
            height: size[1],
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    bound
        .bindings
        .record(Stage::AfterShadowMaps, &mut encoder, Recording::default())
        .unwrap();
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("the host's pass"),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &target.create_view(&Default::default()),
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(behind),
                store: wgpu::StoreOp::Store,
            },
        })],
        ..Default::default()
    });
    bound.bindings.draw(PASS, &mut pass, 0).unwrap();
    drop(pass);
    gpu.queue.submit([encoder.finish()]);
    gpu.check().unwrap();
    gpu.read_texture(&target, 0, "the host's").unwrap()
}

/// A graph, compiled and bound.
pub(crate) fn bind(
    gpu: &Gpu,
    capabilities: &Capabilities,
    graph: &str,
    imports: &[(&str, &(TextureDesc, wgpu::Texture))],
    blocks: &[Block<'_>],
    host_targets: &[(&str, HostTarget)],
) -> Bound {
    let graph = Graph::parse(graph, &NodeRegistry::new()).unwrap();
    let descs: Vec<(&str, ResourceDesc)> = imports
        .iter()
        .map(|(name, (desc, _))| (*name, ResourceDesc::Texture(desc.clone())))
        .collect();
    let plan = graph
        .compile(capabilities, &descs)
        .unwrap_or_else(|error| panic!("{error}"));
    let device = &gpu.device;
    let host_targets = host_targets.iter();
    let options = PipelineOptions {
        host_targets: host_targets
            .map(|(pass, target)| ((*pass).to_owned(), *target))
            .collect(),
        ..PipelineOptions::default()
    };
    let pipelines = block_on(Pipelines::create(device, &plan, options)).unwrap();
    let resources = block_on(Resources::create(device, &plan)).unwrap();
    let parameters = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("parameters"),
        contents: &contents(&plan, blocks),
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
    });
    let imports: Vec<(&str, ImportedResource)> = imports
        .iter()
        .map(|(name, (_, texture))| (*name, ImportedResource::from(texture)))
        .collect();
    let bindings = block_on(Bindings::create(
        device,
        &plan,
        &pipelines,
        &resources,
        &imports,
        Some(&parameters),
    ))
    .unwrap();
    Bound {
        plan,
        parameters,
        bindings,
        _resources: resources,
    }
}
