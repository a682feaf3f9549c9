//! What recording is asked for: offsets, layers and queries that are there, and errors before anything is recorded.

use moment_shadows_graph::record::{Bindings, ImportedResource, Layers, Recording};
use moment_shadows_graph::{GraphError, GraphErrorKind, Stage};
use moment_shadows_lab::gpu::Gpu;
use pollster::block_on;

use crate::errors::{depth, plan};
use crate::setup::{Bound, aligned_view, bind, block, gpu, uniform};

/// The example, bound with `views` blocks of parameters.
pub(crate) fn bound(gpu: &Gpu, views: usize) -> Bound {
    let plan = plan(gpu);
    let map = depth(gpu);
    let imports = [
        ("light_depth", ImportedResource::from(&map)),
        ("camera_depth", ImportedResource::from(&map)),
    ];
    let bytes = block(&plan, &aligned_view(0)).repeat(views);
    bind(gpu, plan, &imports, &bytes)
}

#[test]
fn the_parameter_buffer_holds_a_views_block() {
    let gpu = gpu();
    let bound = bound(&gpu, 1);
    let map = depth(&gpu);
    let imports = [
        ("light_depth", ImportedResource::from(&map)),
        ("camera_depth", ImportedResource::from(&map)),
    ];
    let with = |buffer: Option<&wgpu::Buffer>| {
        let bindings = block_on(Bindings::create(
            &gpu.device,
            &bound.plan,
            &bound.pipelines,
            &bound.resources,
            &imports,
            buffer,
        ));
        bindings.err().unwrap()
    };
    let needed = u64::from(bound.plan.parameters.size);
    let problem = |problem: &str| {
        let says = format!("the parameter buffer {problem}; a view's block has {needed} bytes");
        GraphError::new(GraphErrorKind::Parameters, says)
    };
    assert_eq!(with(None), problem("is missing"));
    assert_eq!(
        with(Some(&uniform(&gpu, &[0; 32]))),
        problem("has 32 bytes")
    );
    let usage = wgpu::BufferUsages::STORAGE;
    let storage = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: needed,
        usage,
        mapped_at_creation: false,
    });
    assert_eq!(with(Some(&storage)), problem("has no usage UNIFORM"));
}

fn record(
    bound: &Bound,
    gpu: &Gpu,
    stage: Stage,
    recording: Recording<'_>,
) -> Result<(), GraphError> {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let result = bound.bindings.record(stage, &mut encoder, recording);
    gpu.queue.submit([encoder.finish()]);
    gpu.check().unwrap();
    result
}

#[test]
fn a_views_offset_is_aligned_and_within_the_buffer() {
    let gpu = gpu();
    let bound = bound(&gpu, 2);
    let needed = u64::from(bound.plan.parameters.size);
    let at = |parameter_offset| {
        record(
            &bound,
            &gpu,
            Stage::AfterShadowMaps,
            Recording {
                parameter_offset,
                ..Recording::default()
            },
        )
    };
    assert_eq!(at(0), Ok(()));
    assert_eq!(at(needed), Ok(()));
    let alignment = gpu.device.limits().min_uniform_buffer_offset_alignment;
    for offset in [
        1,
        2 * needed,
        needed + u64::from(alignment),
        u64::MAX,
        u64::MAX - 3,
    ] {
        let size = 2 * needed;
        let says = format!(
            "a view's parameters cannot begin at byte {offset}: offsets are multiples of {alignment}, and {needed} bytes \
             have to follow in a buffer of {size}"
        );
        assert_eq!(
            at(offset),
            Err(GraphError::new(GraphErrorKind::Parameters, says))
        );
    }
}

#[test]
fn dirty_layers_exist() {
    let gpu = gpu();
    let bound = bound(&gpu, 1);
    let with = |layers| {
        record(
            &bound,
            &gpu,
            Stage::AfterShadowMaps,
            Recording {
                layers: Layers::Only(layers),
                ..Recording::default()
            },
        )
    };
    assert_eq!(with(&[0]), Ok(()));
    for (layers, beyond) in [(&[0, 1][..], 1), (&[u32::MAX], u32::MAX)] {
        let says =
            format!("layer {beyond} is marked dirty, but pass 'resolve/resolve' has 1 layers");
        assert_eq!(
            with(layers),
            Err(GraphError::new(GraphErrorKind::Recording, says))
        );
    }
}

#[test]
fn timestamps_have_room_for_every_pass() {
    let gpu = Gpu::open_with(
        moment_shadows::Profile::Native,
        wgpu::Features::TIMESTAMP_QUERY,
    )
    .unwrap();
    if !gpu
        .device
        .features()
        .contains(wgpu::Features::TIMESTAMP_QUERY)
    {
        return;
    }
    let bound = bound(&gpu, 1);
    let queries = gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
        label: None,
        ty: wgpu::QueryType::Timestamp,
        count: 9,
    });
    let with = |first| {
        let timestamps = Some((&queries, first));
        record(
            &bound,
            &gpu,
            Stage::AfterShadowMaps,
            Recording {
                timestamps,
                ..Recording::default()
            },
        )
    };
    assert_eq!((with(0), with(1)), (Ok(()), Ok(())));
    for first in [2, u32::MAX] {
        let says = format!("timestamps need 8 queries from index {first}, but the query set has 9");
        assert_eq!(
            with(first),
            Err(GraphError::new(GraphErrorKind::Recording, says))
        );
    }
}
