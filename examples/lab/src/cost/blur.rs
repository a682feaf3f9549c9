//! The blur alone, on a map of noise: found right, and timed in both directions together against its bounds.

use moment_shadows::{Kernel, Profile, Storage};
use moment_shadows_graph::nodes::KernelProperty;
use moment_shadows_graph::record::{
    Bindings, ImportedResource, Passes, PipelineOptions, Pipelines, Recording, Resources,
    texture_format,
};
use moment_shadows_graph::{
    Capabilities, Graph, Imports, NodeRegistry, ResourceDesc, Stage, TextureDesc, compile,
};
use pollster::block_on;
use wgpu::util::DeviceExt;

use super::CostError;
use super::reference;
use super::texels::{Channels, decode, encode};
use crate::gpu::Gpu;

/// What a radius may cost, in compute copies of the map on a software adapter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// Texels on either side of the centre.
    pub radius: u32,
    /// Beyond this the command fails; none where there is no bound.
    pub gate: Option<f64>,
    /// What is aimed at.
    pub goal: Option<f64>,
}

/// The radii that are measured.
pub const BOUNDS: [Bound; 4] = [
    Bound {
        radius: 4,
        gate: Some(4.5),
        goal: Some(3.4),
    },
    Bound {
        radius: 12,
        gate: Some(8.0),
        goal: Some(5.5),
    },
    Bound {
        radius: 32,
        gate: None,
        goal: None,
    },
    Bound {
        radius: 64,
        gate: Some(24.0),
        goal: Some(15.0),
    },
];

/// A map of moments of any contents, and a blur of it.
pub struct BlurredMap {
    storage: Storage,
    kernel: Kernel,
    size: [u32; 2],
    bindings: Bindings,
}

/// A device that can store the moments of every storage.
pub const PROFILE: Profile = Profile::Native;

impl BlurredMap {
    /// Compiles a graph of one blur and binds it to a map with these channels, row by row. With `per_frame`, the weights
    /// are parameters whatever the radius.
    pub fn new(
        gpu: &Gpu,
        storage: Storage,
        size: [u32; 2],
        channels: &[[f64; 4]],
        kernel: KernelProperty,
        per_frame: bool,
    ) -> Result<Self, CostError> {
        let desc = TextureDesc::new(storage.format(), size);
        let text = serde_json::json!({
            "version": 2,
            "imports": [{ "name": "map" }],
            "nodes": [{
                "name": "blur",
                "type": "blur",
                "properties": { "kernel": kernel, "per_frame": per_frame }
            }],
            "edges": [{ "from": "map", "to": "blur.map" }],
            "outputs": [{ "name": "blurred", "from": "blur.blurred" }]
        });
        let graph = Graph::parse(&text.to_string(), &NodeRegistry::new())?;
        let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
        let imports = Imports::from([("map".to_owned(), ResourceDesc::Texture(desc.clone()))]);
        let plan = compile(&graph, &capabilities, &imports)?;
        let device = &gpu.device;
        let pipelines = block_on(Pipelines::create(device, &plan, PipelineOptions::default()))?;
        let resources = block_on(Resources::create(device, &plan))?;
        let parameters = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("cost/parameters"),
            contents: &[plan.parameters.initial(), vec![0; 16]].concat(),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let moments = moments_texture(gpu, &desc, &encode(storage, channels))?;
        let bindings = block_on(Bindings::create(
            device,
            &plan,
            &pipelines,
            &resources,
            &[("map", ImportedResource::Texture(&moments))],
            Some(&parameters),
        ))?;
        Ok(Self {
            storage,
            kernel: kernel.kernel()?,
            size,
            bindings,
        })
    }

    /// Records the blur, both directions.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder) -> Result<(), CostError> {
        self.record_passes(Passes::All, encoder)
    }

    /// Records some of its passes: number 0 blurs along x, number 1 along y.
    pub fn record_passes(
        &self,
        passes: Passes<'_>,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), CostError> {
        let recording = Recording {
            passes,
            ..Recording::default()
        };
        Ok(self
            .bindings
            .record(Stage::AfterShadowMaps, encoder, recording)?)
    }

    /// The blurred channels, row by row.
    pub fn run(&self, gpu: &Gpu) -> Result<Channels, CostError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.record(&mut encoder)?;
        gpu.queue.submit([encoder.finish()]);
        self.read(gpu)
    }

    /// What the output holds now.
    pub fn read(&self, gpu: &Gpu) -> Result<Channels, CostError> {
        let blurred = self.bindings.output("blurred").ok_or(CostError::Format {
            format: self.storage.format(),
        })?;
        let bytes = gpu.read_texture(blurred, 0, "blurred moments")?;
        Ok(decode(self.storage, &bytes))
    }

    /// Runs the blur and compares it with the reference for the same stored channels; gives the largest error.
    pub fn check(&self, gpu: &Gpu, channels: &[[f64; 4]]) -> Result<f64, CostError> {
        let stored = decode(self.storage, &encode(self.storage, channels));
        let reference = reference::blur(&stored, self.size.map(|side| side as usize), &self.kernel);
        reference::check(
            &format!(
                "a blur of radius {} of {}",
                self.kernel.radius(),
                self.storage
            ),
            &self.run(gpu)?,
            &reference,
            reference::blur_tolerance(self.storage, &self.kernel),
        )
    }
}

fn moments_texture(
    gpu: &Gpu,
    desc: &TextureDesc,
    bytes: &[u8],
) -> Result<wgpu::Texture, CostError> {
    let format = texture_format(desc.format).ok_or(CostError::Format {
        format: desc.format,
    })?;
    Ok(gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: Some("cost/moments"),
            size: wgpu::Extent3d {
                width: desc.size[0],
                height: desc.size[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        bytes,
    ))
}
