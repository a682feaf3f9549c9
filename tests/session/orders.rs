//! Passes recorded in other orders that the plan allows, and with the memory that it says they need: the same to the bit.

use moment_shadows::SingleScattering;
use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{Capabilities, Home, Plan, PlannedMemory, PlannedPass, Usage};
use moment_shadows_lab::frame::Frame;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_file::GraphFile;
use moment_shadows_lab::graph_frame;
use moment_shadows_lab::scattering::Air;
use pollster::block_on;
use wgpu::util::DeviceExt as _;

use crate::{frame, gpu};

const SIZE: [u32; 2] = [96, 54];

const ORDERS: u64 = 20;

const EXAMPLES: [&str; 5] = [
    include_str!("../../examples/hard_shadows.json"),
    include_str!("../../examples/soft_shadows.json"),
    include_str!("../../examples/volumetric_scattering.json"),
    include_str!("../../examples/mipmapped_shadows.json"),
    include_str!("../../examples/forward_shading.json"),
];

/// An order of all passes in which each comes after those that it follows, by chance.
fn order(plan: &Plan, followed: fn(&PlannedPass) -> &[usize], seed: u64) -> Vec<usize> {
    let mut state = seed;
    let mut order = Vec::new();
    while order.len() < plan.passes.len() {
        let is_ready = |pass: &usize| {
            let mut before = followed(&plan.passes[*pass]).iter();
            !order.contains(pass) && before.all(|pass| order.contains(pass))
        };
        let ready: Vec<usize> = (0..plan.passes.len()).filter(is_ready).collect();
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        order.push(ready[(state >> 33) as usize % ready.len()]);
    }
    order
}

/// The plan with memory of its own for each resource.
pub(crate) fn with_memory_apart(plan: &Plan) -> Plan {
    let mut plan = plan.clone();
    plan.memory.clear();
    for (index, resource) in plan.resources.iter_mut().enumerate() {
        if matches!(resource.home, Home::Import(_)) {
            continue;
        }
        let mut usage = resource.usage.clone();
        if plan.outputs.iter().any(|output| output.value == index) {
            usage.push(Usage::CopySrc);
        }
        resource.home = Home::Memory(plan.memory.len());
        plan.memory.push(PlannedMemory {
            label: resource.name.clone(),
            desc: resource.desc.clone(),
            usage,
        });
    }
    plan.update_hazards();
    plan.check().unwrap();
    plan
}

/// A plan with what its recordings have in common.
pub(crate) struct Recorder<'a> {
    gpu: &'a Gpu,
    frame: &'a Frame,
    plan: Plan,
    pipelines: Pipelines,
    parameters: wgpu::Buffer,
}

impl<'a> Recorder<'a> {
    pub(crate) fn new(gpu: &'a Gpu, frame: &'a Frame, plan: Plan, parameters: &[u8]) -> Self {
        let options = PipelineOptions::default();
        Self {
            gpu,
            frame,
            pipelines: block_on(Pipelines::create(&gpu.device, &plan, options)).unwrap(),
            plan,
            parameters: gpu
                .device
                .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                    label: None,
                    contents: parameters,
                    usage: wgpu::BufferUsages::UNIFORM,
                }),
        }
    }

    /// All outputs, after the passes were recorded in this order on textures that hold nothing yet.
    pub(crate) fn outputs(
        &self,
        order: &[usize],
        further: &[(&str, ImportedResource)],
    ) -> Vec<Vec<u8>> {
        let (device, plan) = (&self.gpu.device, &self.plan);
        let resources = block_on(Resources::create(device, plan)).unwrap();
        let mut imports = vec![
            (
                "light_depth",
                ImportedResource::from(&self.frame.light_map.texture),
            ),
            (
                "camera_depth",
                ImportedResource::from(self.frame.camera_depth()),
            ),
        ];
        imports.extend_from_slice(further);
        let bindings = Bindings::create(
            device,
            plan,
            &self.pipelines,
            &resources,
            &imports,
            Some(&self.parameters),
        );
        let bindings = block_on(bindings).unwrap();
        let mut encoder = device.create_command_encoder(&Default::default());
        for &pass in order {
            let recording = Recording {
                passes: Some(&[pass]),
                ..Recording::default()
            };
            let stage = plan.passes[pass].stage;
            bindings.record(stage, &mut encoder, recording).unwrap();
        }
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.check().unwrap();
        let outputs = plan.outputs.iter().map(|output| {
            let texture = bindings.output(&output.name).unwrap();
            self.gpu.read_texture(texture, 0, &output.name).unwrap()
        });
        outputs.collect()
    }
}

#[test]
fn every_order_that_the_plan_allows_gives_the_same_bits() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, SIZE);
    let medium = SingleScattering::new([0.02; 3], [0.018; 3], 0.4, [9.0, 8.4, 7.5]).unwrap();
    let air = Air { medium, far: 40.0 };
    let six = EXAMPLES[3].replace(
        r#""storage": "unorm16""#,
        r#""technique": "hamburger6", "storage": "float16""#,
    );
    let (mut orders_apart, mut orders_shared) = (0, 0);
    for text in EXAMPLES.iter().copied().chain([six.as_str()]) {
        let file = GraphFile::parse("graph", text.to_owned(), None).unwrap();
        let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
        let graph = &file.graph;
        let imports = graph_frame::imports(&frame.desc).unwrap();
        let asked =
            |(name, _): &&(&str, _)| graph.imports.iter().any(|import| import.name == *name);
        let imports: Vec<_> = imports.iter().filter(asked).cloned().collect();
        let plan = graph.compile(&capabilities, &imports).unwrap();
        let bytes = graph_frame::parameter_bytes(&plan, &frame.desc, &file, Some(&air)).unwrap();
        let in_order: Vec<usize> = (0..plan.passes.len()).collect();
        let shared = Recorder::new(&gpu, &frame, plan.clone(), &bytes);
        let apart = Recorder::new(&gpu, &frame, with_memory_apart(&plan), &bytes);
        let expected = shared.outputs(&in_order, &[]);
        for output in &expected {
            assert!(output.iter().any(|&byte| byte != output[0]), "{text}");
        }
        for seed in 0..ORDERS {
            let by_memory = order(&shared.plan, |pass| &pass.after_in_memory, seed);
            assert!(
                shared.outputs(&by_memory, &[]) == expected,
                "{by_memory:?} of {text}"
            );
            orders_shared += usize::from(by_memory != in_order);
            let by_resource = order(&apart.plan, |pass| &pass.after, seed);
            assert!(
                apart.outputs(&by_resource, &[]) == expected,
                "{by_resource:?} of {text}"
            );
            orders_apart += usize::from(by_resource != in_order);
        }
    }
    // Orders differ where planes, bounds or pictures do not wait for each other.
    assert!(orders_apart > 20, "{orders_apart}");
    assert!(
        orders_shared <= orders_apart,
        "{orders_shared} {orders_apart}"
    );
}
