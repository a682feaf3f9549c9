//! A marching graph, bound to the maps of all views of a light.

use moment_shadows::{
    CameraView, LeakReduction, LightView, MarchScatteringParameters, MarchedAir,
    ScatteringParameters, SingleScattering, UpsampleScatteringParameters,
};
use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{Capabilities, Plan, ResourceDesc, Stage, TextureDesc};
use pollster::block_on;

use super::candidate::MarchCandidate;
use crate::compare::Technique;
use crate::error::LabError;
use crate::gpu::Gpu;

/// What a graph is bound to.
pub(super) struct Bound<'a> {
    /// The light's depth maps with several samples per texel, and all of them in one texture with one.
    pub(super) maps: &'a [wgpu::Texture],
    pub(super) plain: &'a wgpu::Texture,
    pub(super) camera_depth: &'a wgpu::Texture,
    pub(super) camera: CameraView,
    pub(super) far: f64,
    pub(super) views: &'a [LightView],
    pub(super) medium: SingleScattering,
    pub(super) air: MarchedAir,
}

impl Bound<'_> {
    /// What the nodes of prefiltered scattering are told.
    fn prefiltered(&self) -> Result<ScatteringParameters, LabError> {
        let light = self.views.first();
        let light = light.ok_or_else(|| LabError::refused("there is no light; give one"))?;
        Ok(ScatteringParameters::new(
            &self.camera,
            self.far,
            light,
            self.medium,
        )?)
    }
}

/// A bound graph.
pub(super) struct BoundMarch {
    plan: Plan,
    bindings: Bindings,
}

impl BoundMarch {
    /// The plan alone, for what it says of memory.
    pub(super) fn plan(
        capabilities: &Capabilities,
        candidate: &MarchCandidate,
        bound: &Bound<'_>,
    ) -> Result<Plan, LabError> {
        let map = bound.maps.first().unwrap_or(bound.plain);
        let map = if candidate.plain { bound.plain } else { map };
        let texture = |texture: &wgpu::Texture, layers: u32| {
            let size = [texture.width(), texture.height()];
            ResourceDesc::Texture(TextureDesc {
                layers,
                samples: texture.sample_count(),
                ..TextureDesc::new(moment_shadows::TextureFormat::Depth32Float, size)
            })
        };
        let imports = [
            ("light_depth", texture(map, bound.views.len() as u32)),
            ("camera_depth", texture(bound.camera_depth, 1)),
        ];
        let graph = &candidate.file.graph;
        let plan = graph.compile(capabilities, &imports);
        plan.map_err(LabError::graph(&candidate.name))
    }

    /// Compiles a graph, binds it and fills in its parameters.
    pub(super) fn new(
        gpu: &Gpu,
        candidate: &MarchCandidate,
        bound: &Bound<'_>,
    ) -> Result<Self, LabError> {
        let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
        let plan = Self::plan(&capabilities, candidate, bound)?;
        let device = &gpu.device;
        let pipelines = block_on(Pipelines::create(device, &plan, PipelineOptions::default()))?;
        let resources = block_on(Resources::create(device, &plan))?;
        let parameters = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("lab/parameters"),
            size: u64::from(plan.parameters.size.max(16)),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let light = match candidate.plain {
            true => ImportedResource::from(bound.plain),
            false => ImportedResource::Layers(bound.maps.to_vec()),
        };
        let imports = [
            ("light_depth", light),
            ("camera_depth", ImportedResource::from(bound.camera_depth)),
        ];
        let bindings = block_on(Bindings::create(
            device,
            &plan,
            &pipelines,
            &resources,
            &imports,
            Some(&parameters),
        ))?;
        gpu.queue
            .write_buffer(&parameters, 0, &bytes(&plan, bound)?);
        Ok(Self { plan, bindings })
    }
}

fn bytes(plan: &Plan, bound: &Bound<'_>) -> Result<Vec<u8>, LabError> {
    let layout = &plan.parameters;
    let mut bytes = layout.initial();
    for block in &layout.blocks {
        let node = block.node.as_str();
        match block.name.as_str() {
            "MarchScatteringParameters" => {
                let structs: Result<Vec<_>, _> = (bound.views.iter())
                    .map(|view| {
                        MarchScatteringParameters::new(
                            &bound.camera,
                            bound.far,
                            view,
                            bound.medium,
                            &bound.air,
                            LeakReduction::DEFAULT,
                        )
                    })
                    .collect();
                layout.write_all(&mut bytes, node, 0, &structs?)?;
            }
            "UpsampleScatteringParameters" => {
                let parameters = UpsampleScatteringParameters::new(&bound.camera, bound.far)?;
                layout.write(&mut bytes, node, 0, &parameters)?;
            }
            "DepthConversion" => {
                for (layer, view) in (0..).zip(bound.views) {
                    layout.write(&mut bytes, node, layer, &view.depth.conversion()?)?;
                }
            }
            "RectifyMomentsParameters" => {
                layout.write(&mut bytes, node, 0, &bound.prefiltered()?.rectify)?;
            }
            "IntegrateScatteringParameters" => {
                layout.write(&mut bytes, node, 0, &bound.prefiltered()?.integrate)?;
            }
            "CompositeScatteringParameters" => {
                layout.write(&mut bytes, node, 0, &bound.prefiltered()?.composite)?;
            }
            // Kernels are those of the graph.
            _ => {}
        }
    }
    Ok(bytes)
}

impl Technique for BoundMarch {
    fn works_in(&self, stage: Stage) -> bool {
        self.plan.passes.iter().any(|pass| pass.stage == stage)
    }

    fn record(&self, stage: Stage, encoder: &mut wgpu::CommandEncoder) -> Result<(), LabError> {
        Ok(self.bindings.record(stage, encoder, Recording::default())?)
    }

    fn output(&self) -> Result<&wgpu::Texture, LabError> {
        let output = self.bindings.output("scattering");
        output.ok_or_else(|| LabError::unsuitable("march", "it has no output 'scattering'"))
    }
}
