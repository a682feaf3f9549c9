//! What does not fit the plan is an error value before anything is recorded.

use moment_shadows::TextureFormat;
use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Resources,
};
use moment_shadows_graph::{
    Access, Graph, GraphError, GraphErrorKind, NodeDesc, Plan, PlannedWork, Slot, SlotResource,
    Stage, TextureDesc, bind,
};
use moment_shadows_lab::gpu::Gpu;
use pollster::block_on;

use crate::depth_map;
use crate::host_node::{compute, copy, graph, output};
use crate::recording::bound;
use crate::setup::{EXAMPLE, capabilities, compiled, gpu, try_bind, uniform};

const SIZE: [u32; 2] = [32, 24];

pub(crate) fn plan(gpu: &Gpu) -> Plan {
    let depth = |size| TextureDesc::new(TextureFormat::Depth32Float, size);
    compiled(
        EXAMPLE,
        &capabilities(gpu),
        &[("light_depth", depth(SIZE)), ("camera_depth", depth(SIZE))],
    )
}

pub(crate) fn depth(gpu: &Gpu) -> wgpu::Texture {
    depth_map::texture(gpu, wgpu::TextureFormat::Depth32Float, SIZE, 1, 1)
}

/// An import is refused with these words.
pub(crate) fn is_wrong(error: &GraphError, says: &str) {
    assert_eq!(error.kind, GraphErrorKind::Import, "{error}");
    assert!(error.message.contains(says), "{error}");
}

/// The error of binding the example to these imports.
fn refused(gpu: &Gpu, imports: &[(&str, ImportedResource)]) -> GraphError {
    let plan = plan(gpu);
    let bytes = plan.parameters.initial();
    try_bind(gpu, plan, imports, &bytes).err().unwrap()
}

#[test]
fn imports_have_to_be_there_and_as_the_plan_describes_them() {
    let gpu = gpu();
    let good = depth(&gpu);
    let camera = ("camera_depth", ImportedResource::from(&good));
    let missing = refused(&gpu, std::slice::from_ref(&camera));
    assert_eq!(
        missing,
        GraphError::new(
            GraphErrorKind::MissingImport,
            "import 'light_depth' is missing; bind it as the plan describes it: depth32float 32x24"
        )
    );

    let texture =
        |format, size, layers, samples| depth_map::texture(&gpu, format, size, layers, samples);
    let depth32 = wgpu::TextureFormat::Depth32Float;
    let wrong = [
        (
            texture(wgpu::TextureFormat::Depth16Unorm, SIZE, 1, 1),
            "Depth16Unorm 32x24 x 1 layers, 1 mips, 1 samples",
        ),
        (
            texture(depth32, [24, 32], 1, 1),
            "Depth32Float 24x32 x 1 layers, 1 mips, 1 samples",
        ),
        (
            texture(depth32, SIZE, 2, 1),
            "Depth32Float 32x24 x 2 layers, 1 mips, 1 samples",
        ),
        (
            texture(depth32, SIZE, 1, 4),
            "Depth32Float 32x24 x 1 layers, 1 mips, 4 samples",
        ),
    ];
    for (texture, given) in &wrong {
        let error = refused(
            &gpu,
            &[
                ("light_depth", ImportedResource::from(texture)),
                camera.clone(),
            ],
        );
        let says = format!(
            "import 'light_depth' is {given}, but the plan was compiled for depth32float 32x24; compile the graph for what is bound"
        );
        assert_eq!(error, GraphError::new(GraphErrorKind::Import, says));
    }
    let unbound = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: good.size(),
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: depth32,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    let error = refused(
        &gpu,
        &[
            ("light_depth", ImportedResource::from(&unbound)),
            camera.clone(),
        ],
    );
    is_wrong(&error, "is without the usage");
    is_wrong(&error, "TEXTURE_BINDING");
    let buffer = uniform(&gpu, &[]);
    let error = refused(
        &gpu,
        &[
            ("light_depth", ImportedResource::Buffer(buffer)),
            camera.clone(),
        ],
    );
    is_wrong(&error, "is a buffer,");
}

const READS: &str = "
@group(0) @binding(0) var<storage, read> data: array<vec4f>;
@group(0) @binding(1) var copied: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) { textureStore(copied, id.xy, data[0]); }
";

/// A graph of a node that reads a buffer of so many bytes.
fn reading(size: u64) -> Graph {
    let node = NodeDesc {
        slots: vec![
            Slot::input(
                "data",
                "Numbers.",
                SlotResource::Buffer {
                    access: Access::READ,
                    size,
                },
            ),
            output("to", 1),
        ],
        passes: vec![compute(
            READS,
            "to",
            true,
            [
                ("data", bind::buffer("data")),
                ("copied", bind::store("to")),
            ],
        )],
        ..copy(Stage::AfterShadowMaps, 1)
    };
    let desc = moment_shadows_graph::ResourceDesc::Buffer { size };
    graph(
        &[("data", desc)],
        vec![("host", node)],
        &[("data", "host.data")],
        &[("out", "host.to")],
    )
}

#[test]
fn a_buffer_import_has_the_size_and_usage_of_storage() {
    let gpu = gpu();
    let plan = reading(64).compile(&capabilities(&gpu), &[]).unwrap();
    let buffer = |size, usage| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage,
            mapped_at_creation: false,
        })
    };
    let with =
        |import: ImportedResource| try_bind(&gpu, plan.clone(), &[("data", import)], &[]).err();
    assert_eq!(
        with(ImportedResource::Buffer(buffer(
            64,
            wgpu::BufferUsages::STORAGE
        ))),
        None
    );
    let small = with(ImportedResource::Buffer(buffer(
        32,
        wgpu::BufferUsages::STORAGE,
    )))
    .unwrap();
    is_wrong(&small, "is a buffer of 32 bytes");
    let usage = with(ImportedResource::Buffer(buffer(
        64,
        wgpu::BufferUsages::COPY_DST,
    )))
    .unwrap();
    is_wrong(&usage, "compiled for buffer of 64 bytes;");
    let texture = depth(&gpu);
    let kind = with(ImportedResource::from(&texture)).unwrap();
    is_wrong(&kind, "is a texture,");
}

#[test]
fn pipelines_and_resources_belong_to_their_plan() {
    let gpu = gpu();
    let device = &gpu.device;
    let plan = plan(&gpu);
    let map = depth(&gpu);
    let imports = [
        ("light_depth", ImportedResource::from(&map)),
        ("camera_depth", ImportedResource::from(&map)),
    ];
    let parameters = uniform(&gpu, &plan.parameters.initial());
    let resources = block_on(Resources::create(device, &plan)).unwrap();
    let none = Pipelines::default();
    let error = block_on(Bindings::create(
        device,
        &plan,
        &none,
        &resources,
        &imports,
        Some(&parameters),
    ))
    .err();
    assert_eq!(
        error,
        Some(GraphError::new(
            GraphErrorKind::Plan,
            "pass 'resolve/resolve' has no pipeline; extend the pipelines with this plan first"
        ))
    );
    let pipelines = block_on(Pipelines::create(device, &plan, PipelineOptions::default())).unwrap();
    let other = compiled(
        &EXAMPLE.replace("unorm16", "float16"),
        &capabilities(&gpu),
        &[],
    );
    let resources = block_on(Resources::create(device, &other)).unwrap();
    let error = block_on(Bindings::create(
        device,
        &plan,
        &pipelines,
        &resources,
        &imports,
        Some(&parameters),
    ))
    .err();
    assert_eq!(
        error,
        Some(GraphError::new(
            GraphErrorKind::Plan,
            "the resources were created for another plan; create them from this one"
        ))
    );
}

#[test]
fn a_plan_for_another_alignment_is_refused() {
    let gpu = gpu();
    let alignment = gpu.device.limits().min_uniform_buffer_offset_alignment;
    let mut finer = capabilities(&gpu);
    finer.uniform_alignment = 16;
    let plan = compiled(EXAMPLE, &finer, &[]);
    if plan
        .parameters
        .blocks
        .iter()
        .all(|block| block.offset % alignment == 0 && block.stride % alignment == 0)
    {
        return;
    }
    let bytes = plan.parameters.initial();
    let error = try_bind(&gpu, plan, &[], &bytes).err().unwrap();
    let says = format!(
        "the parameters of 'resolve' lie at multiples of 32 bytes, but this device takes multiples of {alignment}; compile \
         the graph for this device"
    );
    assert_eq!(error, GraphError::new(GraphErrorKind::Plan, says));
}

#[test]
fn a_broken_plan_is_refused_before_it_is_used() {
    let gpu = gpu();
    let mut broken = plan(&gpu);
    broken.outputs[0].value = 77;
    let count = broken.resources.len();
    let says = format!(
        "output 'shadow_intensity' refers to resource 77, but there are {count}; compile the graph again"
    );
    let error = GraphError::new(GraphErrorKind::Plan, says);
    let device = &gpu.device;
    assert_eq!(
        block_on(Pipelines::create(
            device,
            &broken,
            PipelineOptions::default()
        ))
        .err(),
        Some(error.clone())
    );
    assert_eq!(
        block_on(Resources::create(device, &broken)).err(),
        Some(error.clone())
    );
    let bound = bound(&gpu, 1);
    let bindings = block_on(Bindings::create(
        device,
        &broken,
        &bound.pipelines,
        &bound.resources,
        &[],
        None,
    ));
    assert_eq!(bindings.err(), Some(error));
}

#[test]
fn what_the_device_refuses_is_an_error_with_the_label() {
    let gpu = gpu();
    // A plan for a bind group beyond the device's.
    let mut beyond = capabilities(&gpu);
    beyond.bind_group = gpu.device.limits().max_bind_groups;
    let plan = compiled(EXAMPLE, &beyond, &[]);
    refused_by_device(&gpu, &plan, "moment-shadows/resolve/resolve");
    // One from elsewhere may claim so many that a list of them has no room.
    let plan = Plan {
        bind_group: u32::MAX,
        ..plan
    };
    refused_by_device(&gpu, &plan, "moment-shadows/resolve/resolve");
}

/// The device could not make the pipelines of a plan.
fn refused_by_device(gpu: &Gpu, plan: &Plan, label: &str) {
    let created = block_on(Pipelines::create(
        &gpu.device,
        plan,
        PipelineOptions::default(),
    ));
    let error = created.err().unwrap();
    assert_eq!(error.kind, GraphErrorKind::Device);
    let says = format!("the device could not create {label}: ");
    assert!(error.message.starts_with(&says), "{error}");
}

#[test]
fn a_dispatch_beyond_the_device_is_refused_before_it_is_recorded() {
    let gpu = gpu();
    let mut plan = plan(&gpu);
    let most = gpu.device.limits().max_compute_workgroups_per_dimension;
    let map = depth(&gpu);
    let imports = [
        ("light_depth", ImportedResource::from(&map)),
        ("camera_depth", ImportedResource::from(&map)),
    ];
    for (wanted, fits) in [([1, most], true), ([most + 1, 1], false)] {
        if let PlannedWork::Compute { workgroups, .. } = &mut plan.passes[0].work {
            *workgroups = wanted;
        }
        let bytes = plan.parameters.initial();
        let error = try_bind(&gpu, plan.clone(), &imports, &bytes).err();
        assert_eq!(error.is_none(), fits, "{error:?}");
        if let Some(error) = error {
            assert_eq!(error.kind, GraphErrorKind::Capability);
            assert!(error.message.contains("allows"), "{error}");
        }
    }
}

#[test]
fn a_shader_that_reads_beyond_its_buffer_is_refused_before_it_is_recorded() {
    let gpu = gpu();
    let mut plan = reading(64).compile(&capabilities(&gpu), &[]).unwrap();
    block_on(Pipelines::create(
        &gpu.device,
        &plan,
        PipelineOptions::default(),
    ))
    .unwrap();
    plan.shaders[0] = plan.shaders[0].replace("array<vec4f>", "array<vec4f, 2>");
    refused_by_device(&gpu, &plan, "moment-shadows/host/main");
}
