//! Per frame a session allocates what wgpu does for the same calls, and nothing of its own.

use std::time::Instant;

use moment_shadows_graph::Stage;
use moment_shadows_graph::record::Recording;
use moment_shadows_lab::gpu::Gpu;

use crate::{AIR, HARD, frame, gpu, imports, places, session};

/// The fewest allocations of several tries, once everything is warm. Other threads are not counted.
fn fewest(gpu: &Gpu, mut act: impl FnMut()) -> u64 {
    let counts = (0..8).map(|_| {
        let counted = allocation_counter::measure(&mut act).count_total;
        gpu.queue.submit([]);
        counted
    });
    counts.min().unwrap()
}

/// The median time of a call, in microseconds.
fn median(gpu: &Gpu, mut act: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..501)
        .map(|_| {
            let start = Instant::now();
            act();
            let time = start.elapsed().as_secs_f64() * 1e6;
            gpu.queue.submit([]);
            time
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

#[test]
#[ignore = "a benchmark: cargo test --release --test session -- --ignored --nocapture"]
fn time_of_a_frame_beside_its_objects() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [96, 54]);
    let (camera, light) = places(&frame);
    for (name, graph) in [("hard shadows", HARD), ("scattering", AIR)] {
        let mut session = session(&gpu, graph, &imports(&frame));
        session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
        let new_encoder = || gpu.device.create_command_encoder(&Default::default());
        for round in 0..3 {
            let ours = median(&gpu, || {
                let mut encoder = new_encoder();
                for stage in Stage::ALL {
                    session.record(stage, &mut encoder).unwrap();
                }
            });
            let theirs = median(&gpu, || {
                let mut encoder = new_encoder();
                for stage in Stage::ALL {
                    for bindings in [session.maps(), session.bindings(0).unwrap()] {
                        let recording = Recording::default();
                        bindings.record(stage, &mut encoder, recording).unwrap();
                    }
                }
            });
            let told = median(&gpu, || {
                session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
            });
            println!(
                "{name}, round {round}: {ours:.1} us by the session, {theirs:.1} us by its objects, ratio {:.3}; view {told:.1} us",
                ours / theirs
            );
        }
    }
}

#[test]
fn a_frame_allocates_what_its_objects_do() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, [96, 54]);
    let (camera, light) = places(&frame);
    for graph in [HARD, AIR] {
        let mut session = session(&gpu, graph, &imports(&frame));
        session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
        let new_encoder = || gpu.device.create_command_encoder(&Default::default());
        let ours = fewest(&gpu, || {
            let mut encoder = new_encoder();
            for stage in Stage::ALL {
                session.record(stage, &mut encoder).unwrap();
            }
        });
        let theirs = fewest(&gpu, || {
            let mut encoder = new_encoder();
            for stage in Stage::ALL {
                for bindings in [session.maps(), session.bindings(0).unwrap()] {
                    bindings
                        .record(stage, &mut encoder, Recording::default())
                        .unwrap();
                }
            }
        });
        assert_eq!(ours, theirs);

        // Two uniform buffers are written, of the light maps and of the camera.
        let targets = [512, 768].map(|size| {
            let target = gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("moment-shadows/parameters"),
                size,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            (target, vec![0; size as usize])
        });
        // Whether there is memory for that is asked by an error scope.
        let written = fewest(&gpu, || {
            let memory = gpu.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
            for (target, bytes) in &targets {
                gpu.queue.write_buffer(target, 0, bytes);
            }
            drop(memory.pop());
        });
        let told = fewest(&gpu, || {
            session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
        });
        assert_eq!(told, written);
    }
}
