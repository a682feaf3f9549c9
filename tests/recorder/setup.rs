//! A plan, bound and ready.

use moment_shadows::{
    Border, CameraView, DepthConversion, DepthRange, LeakReduction, LightDepth, LightSize,
    LightView, MapRegion, Profile, ReceiverBias, ViewParameters,
};
use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{
    Capabilities, Graph, GraphError, NodeRegistry, Plan, ResourceDesc, Stage, TextureDesc,
};
use moment_shadows_lab::gpu::Gpu;
use pollster::block_on;
use wgpu::util::DeviceExt as _;

pub(crate) const EXAMPLE: &str = include_str!("../support/example.json");

pub(crate) const IDENTITY: [[f64; 4]; 4] = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 1.0],
];

pub(crate) fn gpu() -> Gpu {
    Gpu::open(Profile::Native).unwrap()
}

pub(crate) fn capabilities(gpu: &Gpu) -> Capabilities {
    Capabilities::of_device(&gpu.adapter, &gpu.device)
}

/// Everything that recording a plan needs.
pub(crate) struct Bound {
    pub(crate) plan: Plan,
    pub(crate) pipelines: Pipelines,
    pub(crate) resources: Resources,
    pub(crate) parameters: wgpu::Buffer,
    pub(crate) bindings: Bindings,
}

/// A uniform buffer; never empty.
pub(crate) fn uniform(gpu: &Gpu, bytes: &[u8]) -> wgpu::Buffer {
    let mut contents = bytes.to_vec();
    contents.resize(bytes.len().max(16), 0);
    gpu.device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("parameters"),
            contents: &contents,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        })
}

/// Creates what a plan needs; `views` are the parameter blocks of its views, one after the other.
pub(crate) fn try_bind(
    gpu: &Gpu,
    plan: Plan,
    imports: &[(&str, ImportedResource)],
    views: &[u8],
) -> Result<Bound, GraphError> {
    let device = &gpu.device;
    let pipelines = block_on(Pipelines::create(device, &plan, PipelineOptions::default()))?;
    let resources = block_on(Resources::create(device, &plan))?;
    let parameters = uniform(gpu, views);
    let bindings = block_on(Bindings::create(
        device,
        &plan,
        &pipelines,
        &resources,
        imports,
        Some(&parameters),
    ))?;
    Ok(Bound {
        plan,
        pipelines,
        resources,
        parameters,
        bindings,
    })
}

pub(crate) fn bind(
    gpu: &Gpu,
    plan: Plan,
    imports: &[(&str, ImportedResource)],
    views: &[u8],
) -> Bound {
    try_bind(gpu, plan, imports, views).unwrap()
}

impl Bound {
    /// Records every stage into one submission.
    pub(crate) fn run(&self, gpu: &Gpu) {
        self.run_layers(gpu, moment_shadows_graph::record::Layers::All);
    }

    /// Records every stage for the dirty layers.
    pub(crate) fn run_layers(&self, gpu: &Gpu, layers: moment_shadows_graph::record::Layers<'_>) {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for stage in Stage::ALL {
            let recording = Recording {
                layers,
                ..Recording::default()
            };
            self.bindings
                .record(stage, &mut encoder, recording)
                .unwrap();
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.check().unwrap();
    }

    /// The texels of a layer of an output.
    pub(crate) fn read(&self, gpu: &Gpu, output: &str, layer: u32) -> Vec<u8> {
        let texture = self.bindings.output(output).unwrap();
        gpu.read_texture(texture, layer, output).unwrap()
    }

    /// The channels of a layer of an output in a 32-bit floating-point format.
    pub(crate) fn read_floats(&self, gpu: &Gpu, output: &str, layer: u32) -> Vec<f32> {
        bytemuck::pod_collect_to_vec(&self.read(gpu, output, layer))
    }
}

/// Parses and compiles a text for a device and the host's imports.
pub(crate) fn compiled(
    text: &str,
    capabilities: &Capabilities,
    imports: &[(&str, TextureDesc)],
) -> Plan {
    let graph = Graph::parse(text, &NodeRegistry::new()).unwrap();
    let imports: Vec<(&str, ResourceDesc)> = imports
        .iter()
        .map(|(name, desc)| (*name, ResourceDesc::Texture(desc.clone())))
        .collect();
    graph.compile(capabilities, &imports).unwrap()
}

/// A camera and a light that look along the same axis, so that pixels are texels: stored depth is the place on it.
pub(crate) fn aligned_view(layer: u32) -> ViewParameters {
    view(IDENTITY, IDENTITY, layer)
}

/// The parameters of a light without any bias or leak reduction, which is orthographic or has a range from 0 to 1; the camera's
/// far depth is 1.
pub(crate) fn view(camera: [[f64; 4]; 4], light: [[f64; 4]; 4], layer: u32) -> ViewParameters {
    let parallel = light.iter().take(3).all(|column| column[3] == 0.0);
    let range = DepthRange {
        near: 0.0,
        far: 1.0,
    };
    let depth = match parallel {
        true => LightDepth::Orthographic { reversed: false },
        false => LightDepth::Linear { range },
    };
    ViewParameters::new(
        &CameraView {
            clip_from_world: camera,
            far_depth: 1.0,
        },
        &LightView {
            clip_from_world: light,
            depth,
            layer,
            region: MapRegion::WHOLE,
            guard: 0,
            border: Border::Sharp,
            channel: 0,
            size: LightSize::Point,
        },
        ReceiverBias::NONE,
        LeakReduction::NONE,
    )
    .unwrap()
}

/// A view's block: forward orthographic conversions, and `shade` with the given parameters.
pub(crate) fn block(plan: &Plan, shade: &ViewParameters) -> Vec<u8> {
    let mut bytes = plan.parameters.initial();
    let layers = plan.parameters.blocks[0].count;
    for layer in 0..layers {
        let conversion = DepthConversion::orthographic();
        plan.parameters
            .write(&mut bytes, "resolve", layer, &conversion)
            .unwrap();
    }
    if plan
        .parameters
        .blocks
        .iter()
        .any(|block| block.node == "shade")
    {
        plan.parameters
            .write(&mut bytes, "shade", 0, shade)
            .unwrap();
    }
    bytes
}
