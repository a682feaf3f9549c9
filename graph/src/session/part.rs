//! One part of a graph, ready to be recorded.

use super::given::{Given, Owned};
use super::shading::Shading;
use crate::record::{
    Bindings, HostTarget, ImportedResource, PipelineOptions, Pipelines, Resources,
};
use crate::{Capabilities, Graph, GraphError, Named, Plan, ResourceDesc};

/// What all parts of a session are made with.
#[derive(Debug)]
pub(super) struct Maker {
    device: wgpu::Device,
    pub(super) capabilities: Capabilities,
    pipelines: Pipelines,
    cache: Option<wgpu::PipelineCache>,
    host_targets: Vec<(String, HostTarget)>,
}

/// A compiled and bound part.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) plan: Plan,
    pub(super) bindings: Bindings,
    /// Uniform data, and the buffer that it is written to; `None` where no node has any.
    pub(super) block: Vec<u8>,
    buffer: Option<wgpu::Buffer>,
    /// The nodes that shade.
    pub(super) shading: Vec<Shading>,
}

impl Maker {
    pub(super) fn new(
        device: &wgpu::Device,
        capabilities: Capabilities,
        options: PipelineOptions<'_>,
    ) -> Self {
        let targets = options.host_targets.iter();
        Self {
            device: device.clone(),
            capabilities,
            pipelines: Pipelines::default(),
            cache: options.cache.cloned(),
            host_targets: targets
                .map(|&(pass, target)| (pass.to_owned(), target))
                .collect(),
        }
    }

    /// Makes a part of what is given, where the first of each name counts.
    pub(super) async fn part(
        &mut self,
        graph: &Graph,
        given: &[&[Given]],
    ) -> Result<Part, GraphError> {
        let find = |name: &str| {
            given
                .iter()
                .copied()
                .flatten()
                .find(|given| given.name == name)
        };
        let used: Vec<&Given> = graph
            .imports
            .iter()
            .filter_map(|import| find(&import.name))
            .collect();
        let described = used
            .iter()
            .map(|given| (given.name.as_str(), given.desc.clone()));
        let described: Vec<(&str, ResourceDesc)> = described.collect();
        let plan = graph.compile(&self.capabilities, &described)?;
        let is_of_plan = |(pass, _): &&(String, HostTarget)| {
            let mut passes = plan.passes.iter();
            passes.any(|planned| *pass == planned.name())
        };
        let host_targets: Vec<(&str, HostTarget)> = self
            .host_targets
            .iter()
            .filter(is_of_plan)
            .map(|(pass, target)| (pass.as_str(), *target))
            .collect();
        let options = PipelineOptions {
            cache: self.cache.as_ref(),
            host_targets: &host_targets,
        };
        self.pipelines.extend(&self.device, &plan, options).await?;
        let resources = Resources::create(&self.device, &plan).await?;
        let size = u64::from(plan.parameters.size);
        let buffer = (size > 0).then(|| {
            self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("moment-shadows/parameters"),
                size,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        });
        let imports: Vec<(&str, ImportedResource<'_>)> = used
            .iter()
            .map(|given| (given.name.as_str(), given.resource.as_imported()))
            .collect();
        let bindings = Bindings::create(
            &self.device,
            &plan,
            &self.pipelines,
            &resources,
            &imports,
            buffer.as_ref(),
        );
        Ok(Part {
            bindings: bindings.await?,
            block: plan.parameters.initial(),
            buffer,
            shading: Shading::all(graph, &plan)?,
            plan,
        })
    }
}

impl Part {
    /// The outputs, as another part imports them.
    pub(super) fn outputs(&self) -> Vec<Given> {
        let given = |output: &Named<usize>| {
            let resource = match self.bindings.output(&output.name) {
                Some(texture) => Owned::Texture(texture.clone()),
                None => Owned::Buffer(self.bindings.output_buffer(&output.name)?.clone()),
            };
            Some(Given {
                name: output.name.clone(),
                desc: self.plan.resources[output.value].desc.clone(),
                resource,
            })
        };
        self.plan.outputs.iter().filter_map(given).collect()
    }

    /// Writes uniform data to the device.
    pub(super) fn upload(&self, queue: &wgpu::Queue) {
        if let Some(buffer) = &self.buffer {
            queue.write_buffer(buffer, 0, &self.block);
        }
    }
}
