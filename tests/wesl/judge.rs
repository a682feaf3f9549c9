//! What another linker made of the shaders, against what ours makes of them.

use moment_shadows::{Profile, Source, link, validate};
use moment_shadows_lab::gpu::Gpu;

use crate::roots::{Place, Root, roots};

/// Invocations of each shader that writes values.
const INVOCATIONS: usize = 1024;

/// Validates what `link_root` makes of every root in every place, and compares the bits that it writes. Says how many
/// texts there were.
pub(crate) fn judge(link_root: impl Fn(&Root, Place) -> Result<String, String>) -> usize {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let mut count = 0;
    let mut failures = Vec::new();
    for root in roots() {
        let name = root.name.as_str();
        let ours = linked_by_us(&root);
        let expected = root.words.map(|words| (words, run(&gpu, &ours, words)));
        for place in Place::ALL {
            count += 1;
            let fault = link_root(&root, place).and_then(|text| {
                let source = Source { name, text: &text };
                validate(source, &[], Profile::WebgpuCore).map_err(|error| error.to_string())?;
                let Some((words, ours)) = &expected else {
                    return Ok(());
                };
                difference(*words, ours, &run(&gpu, &text, *words)).map_or(Ok(()), Err)
            });
            if let Err(fault) = fault {
                failures.push(format!("{name}, {place:?}: {fault}"));
            }
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
    count
}

fn linked_by_us(root: &Root) -> String {
    let source = Source {
        name: &root.name,
        text: &root.text(Place::Package),
    };
    link(source, &[]).unwrap().into_wgsl()
}

/// What the compute shader of `linked` writes, `words` words for each invocation.
pub(crate) fn run(gpu: &Gpu, linked: &str, words: usize) -> Vec<u32> {
    let device = &gpu.device;
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(linked.into()),
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: None,
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let written = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: (4 * words * INVOCATIONS) as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[wgpu::BindGroupEntry {
            binding: 0,
            resource: written.as_entire_binding(),
        }],
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &bindings, &[]);
        pass.dispatch_workgroups(INVOCATIONS as u32 / 64, 1, 1);
    }
    gpu.queue.submit([encoder.finish()]);
    let bytes = gpu.read_buffer(&written, "written").unwrap();
    gpu.check().unwrap();
    bytemuck::pod_collect_to_vec(&bytes)
}

/// Where two texts of a shader that writes values differ, bit by bit.
pub(crate) fn difference(words: usize, ours: &[u32], theirs: &[u32]) -> Option<String> {
    assert_eq!(ours.len(), theirs.len());
    let mut differing = (0..ours.len()).filter(|&at| ours[at] != theirs[at]);
    let first = differing.next()?;
    let (ours, theirs) = (ours[first], theirs[first]);
    Some(format!(
        "{} words differ; the first is word {} of invocation {}: {ours:#x} ({}) as we link it, {theirs:#x} ({}) here",
        1 + differing.count(),
        first % words,
        first / words,
        f32::from_bits(ours),
        f32::from_bits(theirs),
    ))
}
