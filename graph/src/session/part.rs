//! One part of a graph, ready to be recorded.

use super::contacts::Contacts;
use super::given::{Given, described};
use super::kernels::SceneBlur;
use super::seen::Seen;
use super::shading::Shading;
use crate::record::{Bindings, ImportedResource, PipelineOptions, Pipelines, Resources, scoped};
use crate::{Capabilities, Graph, GraphError, Plan};

/// The label of the buffers of uniform data.
pub(super) const PARAMETERS: &str = "moment-shadows/parameters";

/// What all parts of a session are made with.
#[derive(Debug)]
pub(super) struct Maker {
    pub(super) device: wgpu::Device,
    pub(super) capabilities: Capabilities,
    pub(super) pipelines: Pipelines,
    pub(super) options: PipelineOptions,
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
    /// The nodes that fit ranges to what the camera sees.
    pub(super) seen: Vec<Seen>,
    /// The nodes that find shadows at contacts.
    pub(super) contacts: Vec<Contacts>,
    /// The nodes that filter over a width in scene units.
    pub(super) blurs: Vec<SceneBlur>,
}

impl Maker {
    /// Makes a part of what is given, where the first of each name counts.
    pub(super) async fn part(
        &mut self,
        graph: &Graph,
        given: &[&[Given]],
    ) -> Result<Part, GraphError> {
        let find = |name: &str| given.iter().copied().flatten().find(|it| it.name == name);
        let imports = graph.imports.iter();
        let used: Vec<Given> = imports.filter_map(|it| find(&it.name).cloned()).collect();
        let plan = graph.compile(&self.capabilities, &described(&used))?;
        let pipelines = &mut self.pipelines;
        let extended = pipelines.extend_by_part(&self.device, &plan, &self.options);
        extended.await?;
        let resources = Resources::create(&self.device, &plan).await?;
        let size = u64::from(plan.parameters.size);
        let create = || {
            self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(PARAMETERS),
                size,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let buffer = match size {
            0 => None,
            _ => Some(scoped(&self.device, PARAMETERS, create).await?),
        };
        let imports = used.iter();
        let imports = imports.map(|it| (it.name.as_str(), it.resource.clone()));
        let imports: Vec<(&str, ImportedResource)> = imports.collect();
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
            seen: Seen::all(&plan),
            contacts: Contacts::all(graph, &plan),
            blurs: SceneBlur::all(&plan),
            plan,
        })
    }
}

impl Part {
    /// The outputs, as another part imports them.
    pub(super) fn outputs(&self) -> Vec<Given> {
        let given = |(name, resource): &(String, ImportedResource)| {
            let mut planned = self.plan.outputs.iter();
            let output = planned.find(|output| output.name == *name)?;
            Some(Given {
                name: name.clone(),
                desc: self.plan.resources[output.value].desc.clone(),
                resource: resource.clone(),
            })
        };
        self.bindings.outputs.iter().filter_map(given).collect()
    }

    /// Writes uniform data to the device.
    pub(super) fn upload(&self, queue: &wgpu::Queue) {
        if let Some(buffer) = &self.buffer {
            queue.write_buffer(buffer, 0, &self.block);
        }
    }
}
