//! `moment-shadows-lab first-frame`: the time before a graph's first frame, and whose it is.

use std::path::PathBuf;
use std::time::Instant;

use cpu_time::ProcessTime;
use moment_shadows::Profile;
use moment_shadows_graph::record::{PipelineOptions, Pipelines};
use moment_shadows_graph::{Capabilities, Graph, Plan};
use naga::valid::{Capabilities as NagaCapabilities, ValidationFlags, Validator};

use super::CommandResult;
use crate::cost::statistics::Distribution;
use crate::error::LabError;
use crate::gpu::Gpu;

/// What `first-frame` takes.
#[derive(clap::Args)]
pub struct Options {
    /// A graph file.
    graph: PathBuf,
    /// How often everything is done.
    #[arg(long, default_value_t = 15, value_parser = clap::value_parser!(u32).range(1..=1000))]
    rounds: u32,
}

/// What is timed, in order.
const PARTS: [&str; 7] = [
    "compile the graph",
    "create all pipelines",
    "both",
    "create all pipelines, by the clock",
    "of the pipelines: parse the WGSL once per shader",
    "of the pipelines: parse, validate it",
    "of the pipelines: make shader modules in wgpu",
];

impl Options {
    /// Prints milliseconds of processor time, of all threads of this process, and of the clock where pipelines are made on several.
    pub fn run(self) -> CommandResult {
        let path = &self.graph;
        let unsuitable =
            |error: &dyn core::fmt::Display| LabError::unsuitable(path.display(), error);
        let text = std::fs::read_to_string(path).map_err(|error| unsuitable(&error))?;
        let gpu = Gpu::open(Profile::NativeAdapter)?;
        let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
        let mut seconds = [const { Vec::new() }; PARTS.len()];
        // The first round fills the caches of the processor.
        for round in 0..=self.rounds {
            let start = ProcessTime::now();
            let graph: Graph = text.parse().map_err(|error| unsuitable(&error))?;
            let plan = graph
                .compile(&capabilities, &[])
                .map_err(|error| unsuitable(&error))?;
            let compiled = start.elapsed();
            let clock = Instant::now();
            let made = Pipelines::create(&gpu.device, &plan, PipelineOptions::default());
            pollster::block_on(made).map_err(|error| unsuitable(&error))?;
            let elapsed = clock.elapsed();
            let both = start.elapsed();
            let parts = parts(&gpu, &plan);
            if round > 0 {
                let times = [compiled, both - compiled, both, elapsed].map(|it| it.as_secs_f64());
                for (all, time) in seconds.iter_mut().zip(times.into_iter().chain(parts)) {
                    all.push(time);
                }
            }
        }
        for (name, times) in PARTS.iter().zip(seconds) {
            let times = Distribution::of(times).scaled(1e3);
            println!(
                "{:8.2} ms (+-{:.2})  {name}",
                times.median, times.interquartile_range
            );
        }
        gpu.check()?;
        Ok(std::process::ExitCode::SUCCESS)
    }
}

/// Seconds to parse each text, to parse and validate it, and to make it a shader module.
fn parts(gpu: &Gpu, plan: &Plan) -> [f64; 3] {
    let timed = |work: &dyn Fn(&str)| {
        let start = ProcessTime::now();
        plan.shaders.iter().for_each(|text| work(text));
        start.elapsed().as_secs_f64()
    };
    [
        timed(&|text| drop(naga::front::wgsl::parse_str(text))),
        timed(&|text| {
            if let Ok(module) = naga::front::wgsl::parse_str(text) {
                let all = NagaCapabilities::all();
                drop(Validator::new(ValidationFlags::all(), all).validate(&module));
            }
        }),
        timed(&|text| {
            drop(
                gpu.device
                    .create_shader_module(wgpu::ShaderModuleDescriptor {
                        label: None,
                        source: wgpu::ShaderSource::Wgsl(text.into()),
                    }),
            );
        }),
    ]
}
