//! What recording is asked for: offsets, layers and queries that are there, and errors before anything is recorded.

use moment_shadows_graph::Stage;
use moment_shadows_graph::record::{
    Bindings, ImportedResource, Layers, RecordError, Recording, Timestamps,
};
use moment_shadows_lab::gpu::Gpu;
use pollster::block_on;

use crate::errors::{depth, plan};
use crate::setup::{Bound, aligned_view, bind, block, gpu, uniform};

/// The example, bound with `views` blocks of parameters.
pub(crate) fn bound(gpu: &Gpu, views: usize) -> Bound {
    let plan = plan(gpu);
    let map = depth(gpu);
    let imports = [
        ("light_depth", ImportedResource::Texture(&map)),
        ("camera_depth", ImportedResource::Texture(&map)),
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
        ("light_depth", ImportedResource::Texture(&map)),
        ("camera_depth", ImportedResource::Texture(&map)),
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
    let problem = |problem: &str| RecordError::ParameterBuffer {
        problem: problem.to_owned(),
        needed,
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
) -> Result<(), RecordError> {
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
        assert_eq!(
            at(offset),
            Err(RecordError::ParameterOffset {
                offset,
                alignment,
                needed,
                size
            })
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
    let pass = "resolve/resolve".to_owned();
    assert_eq!(
        with(&[0, 1]),
        Err(RecordError::NoSuchLayer {
            layer: 1,
            pass: pass.clone(),
            layers: 1
        })
    );
    assert_eq!(
        with(&[u32::MAX]),
        Err(RecordError::NoSuchLayer {
            layer: u32::MAX,
            pass,
            layers: 1
        })
    );
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
        let timestamps = Some(Timestamps {
            queries: &queries,
            first,
        });
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
        assert_eq!(
            with(first),
            Err(RecordError::Timestamps {
                first,
                needed: 8,
                count: 9
            })
        );
    }
}
