//! The `moment-shadows` command.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};
use moment_shadows::{Profile, Storage, TechniqueError, nearest};
use moment_shadows_lab::bias::BiasTechnique;
use moment_shadows_lab::candidate::{Candidate, TechniqueChoice, candidates};
use moment_shadows_lab::command::cost::CostOptions;
use moment_shadows_lab::command::cost_growth::GrowthOptions;
use moment_shadows_lab::command::error_table::TableOptions;
use moment_shadows_lab::command::render::{LightChoice, RenderOptions};
use moment_shadows_lab::command::{
    bases, bias, contacts, cost, cost_growth, error, error_table, graph, isa, layers_figure,
    measure, minification, orderings, render, scattering_error, scattering_flicker, shaders,
    soft_error, stability, technique_pictures, validate,
};

use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::isa::child;
use moment_shadows_lab::isa::chip::Chip;
use moment_shadows_lab::stability::Effort;
use moment_shadows_lab::technique_argument::TechniqueArgument;
use moment_shadows_lab::vectors;

/// Filterable shadows: validate shaders, check graphs, render, and measure.
#[derive(Parser)]
#[command(name = "moment-shadows", version, about)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Prints the graphics adapter that the other commands use; fails if there is none.
    Adapter,
    /// Renders a scene with the shadows of a graph.
    Render {
        #[command(flatten)]
        frame: FrameArguments,
        /// A glTF or GLB file, or a procedural scene: fence-and-foliage, hall.
        #[arg(long, default_value = "fence-and-foliage")]
        scene: String,
        /// The graph file.
        #[arg(long)]
        graph: PathBuf,
        /// The picture to write.
        #[arg(long)]
        out: PathBuf,
        /// A technique in place of the graph's own: a name, or settings as in a graph file. Tests on the plain depth map
        /// (binary, pcf_..., pcss) get a map of one sample per texel.
        #[arg(long, value_name = "NAME|JSON")]
        technique: Option<TechniqueArgument>,
        /// Also writes the brute-force picture and the difference, and prints the error.
        #[arg(long)]
        truth: bool,
    },
    /// Validates shaders, linked with the modules they import, for every backend.
    Validate {
        /// WGSL files.
        #[arg(required = true)]
        files: Vec<PathBuf>,
        /// What the shaders may rely on.
        #[arg(long, value_enum)]
        profile: Option<ProfileArgument>,
    },
    /// Checks and prints a graph file.
    Graph {
        /// The graph file.
        file: PathBuf,
        /// Also prints the compiled plan.
        #[arg(long)]
        plan: bool,
        /// Prints the plan as JSON.
        #[arg(long, requires = "plan")]
        json: bool,
        /// What the plan may rely on.
        #[arg(long, value_enum, default_value = "native")]
        profile: ProfileArgument,
    },
    /// Runs the shader on vectors with known bounds.
    Vectors {
        /// A file in the format of tests/vectors/moment_problem.json.
        file: PathBuf,
    },
    /// Prints the error of every storage on several scenes, beside that of the exact bound.
    Measure {
        #[command(flatten)]
        frame: FrameArguments,
        /// A technique in place of the graph's own: a name, or settings as in a graph file.
        #[arg(long, value_name = "NAME|JSON")]
        technique: Option<TechniqueArgument>,
        /// glTF or GLB files, or procedural scenes.
        #[arg(long, num_args = 1.., default_values = ["fence-and-foliage", "hall"])]
        scene: Vec<String>,
        /// The graph file.
        #[arg(long)]
        graph: PathBuf,
    },
    /// Prints the error of a graph with mip levels on a scene from afar, over the whole of each pixel, and how much it
    /// flickers while the camera comes nearer; and the same without mip levels.
    Minification {
        #[command(flatten)]
        frame: FrameArguments,
        /// A glTF or GLB file, or a procedural scene: fence-and-foliage, hall.
        #[arg(long, default_value = "fence-and-foliage")]
        scene: String,
        /// The graph file, with a downsample node.
        #[arg(long)]
        graph: PathBuf,
        /// The camera's distance, as a multiple of the viewpoint's.
        #[arg(long, default_value_t = 8.0, value_parser = distance)]
        distance: f64,
        /// Prints JSON.
        #[arg(long)]
        json: bool,
    },
    /// Writes a picture of every technique: a view and the technique's typical failure, each with its difference from the
    /// truth beside it.
    TechniquePictures {
        /// The folder to make.
        #[arg(long)]
        out: PathBuf,
        /// A glTF or GLB file, or a procedural scene: fence-and-foliage, hall.
        #[arg(long, default_value = "hall")]
        scene: String,
        /// Only the technique of this name.
        #[arg(long)]
        only: Option<String>,
    },
    /// Writes every linked shader of the library, as WGSL and SPIR-V with an index, for other compilers.
    Shaders(shaders::Options),
    /// Prints the error of a graph over all surfaces that the light's rays meet, and over a picture.
    Error {
        #[command(flatten)]
        frame: FrameArguments,
        /// A glTF or GLB file, or a procedural scene: fence-and-foliage, hall.
        #[arg(long, default_value = "fence-and-foliage")]
        scene: String,
        /// The graph file.
        #[arg(long)]
        graph: PathBuf,
        /// A Gaussian of this radius, in texels, in place of the graph's own kernel.
        #[arg(long, value_parser = clap::value_parser!(u32).range(1..=64))]
        radius: Option<u32>,
        /// A technique in place of the graph's own: a name with usual settings (vsm, evsm4, pcf, ...), or an object as in
        /// graph files ({"esm":{"exponent":80}}).
        #[arg(long)]
        technique: Option<TechniqueChoice>,
        /// Prints JSON.
        #[arg(long)]
        json: bool,
    },
    /// Prints the error over all surfaces of several scenes, for several radii, techniques and storages.
    ErrorTable(TableArguments),
    /// Prints the errors of layered variance and of convolution shadow maps of as many bits, with 2 to 8 layers and 4 to 16
    /// terms, and plots them.
    LayersFigure {
        #[command(flatten)]
        frame: FrameArguments,
        /// A glTF or GLB file, or a procedural scene: fence-and-foliage, hall, chairs.
        #[arg(long, default_value = "hall")]
        scene: String,
        /// The graph file.
        #[arg(long)]
        graph: PathBuf,
        /// Of the Gaussian, in texels.
        #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=64))]
        radius: u32,
        /// Of the map's texels one of so many along either axis counts.
        #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
        stride: u32,
        /// The folder for the plot, as SVG and PNG; it is made if need be.
        #[arg(long)]
        out: Option<PathBuf>,
        /// Prints JSON.
        #[arg(long)]
        json: bool,
    },
    /// Prints how much light leaks where the thin legs of chairs meet the ground.
    Contacts {
        #[command(flatten)]
        frame: FrameArguments,
        /// The graph file.
        #[arg(long)]
        graph: PathBuf,
        /// Radii of the Gaussian, in texels.
        #[arg(long, num_args = 1.., default_values = ["1", "4", "12"], value_parser = clap::value_parser!(u32).range(1..=64))]
        radius: Vec<u32>,
        /// Techniques in place of all: names with usual settings, or objects as in graph files.
        #[arg(long, num_args = 1..)]
        technique: Vec<TechniqueChoice>,
        /// Prints JSON.
        #[arg(long)]
        json: bool,
    },
    /// Prints how far soft shadows are from those of an area light that is sampled at many places: hard moment shadows,
    /// percentage closer soft shadows, and graphs of your own.
    SoftError(soft_error::SoftErrorOptions),
    /// Renders the light that a medium scatters by every technique beside marched rays, and prints errors and costs.
    ScatteringError(scattering_error::ScatteringErrorOptions),
    /// Walks a slow path of camera and light, and prints how much the air flickers with filtered resampling and without. Fails
    /// where it is more than a third as much. Takes minutes.
    ScatteringFlicker(scattering_flicker::FlickerOptions),
    /// Times the passes of a graph, blurs of several radii, summed-area tables or single scattering, as ratios to copies, and counts
    /// their bytes.
    Cost(CostOptions),
    /// Times the nodes of a graph at several sizes of the map and of the output and at several radii, and plots how their
    /// cost grows. Takes minutes.
    CostGrowth(GrowthOptions),
    /// Finds the smallest safe moment bias of each storage by search over filtered patches of depth.
    Bias {
        /// The solver that the moments are for.
        #[arg(long, value_enum, default_value = "hamburger4")]
        technique: BiasTechniqueArgument,
        /// One storage of the library; all of them and the published forms if none is given.
        #[arg(long, value_enum)]
        storage: Option<StorageArgument>,
        /// Summed-area tables of every storage instead, for both solvers and for two moments.
        #[arg(long, conflicts_with_all = ["technique", "storage"])]
        tables: bool,
        /// Patches per row of the table.
        #[arg(long, default_value_t = 1_000_000, value_parser = sample_count)]
        samples: usize,
        /// Of the random numbers.
        #[arg(long, default_value_t = 2015)]
        seed: u64,
        /// Prints JSON.
        #[arg(long)]
        json: bool,
    },
    /// Compares all choices of four among twelve functions of depth by linear programming, and plots a histogram.
    Bases {
        /// The folder for the plot, as SVG and PNG; it is made if need be.
        #[arg(long)]
        out: PathBuf,
        /// The share of the depth range at either end that is free of surfaces: sine and cosine cannot tell the ends apart.
        #[arg(long, default_value_t = 0.0)]
        margin: f64,
        /// Random depth distributions, each with eight receivers.
        #[arg(long, default_value_t = 300, value_parser = sample_count)]
        samples: usize,
        /// Prints JSON.
        #[arg(long)]
        json: bool,
    },
    /// Prints how the bounds of techniques compare on the same surfaces while the light's depth range grows around them.
    Orderings {
        /// Random depth distributions.
        #[arg(long, default_value_t = 20_000, value_parser = sample_count)]
        samples: usize,
        /// Of the random numbers.
        #[arg(long, default_value_t = 2015)]
        seed: u64,
        /// Prints JSON.
        #[arg(long)]
        json: bool,
    },
    /// Tries every technique with every storage on random, extreme and invalid inputs, and on hill-climbs towards the worst,
    /// and prints how far results are above the truth. Takes about a quarter of an hour. Exits with 3 if a result is NaN,
    /// infinite, outside of 0 to 1 or farther above the truth than is documented.
    Stability(StabilityArguments),
    /// Compiles every shader for chips that need not be there, and counts what the code does (Linux, Mesa's RADV).
    Isa(isa::Options),
    /// The process that compiles for one chip, which its environment names.
    #[command(name = child::COMMAND, hide = true)]
    IsaChip {
        #[arg(value_enum)]
        chip: Chip,
        shader: Option<String>,
    },
}

#[derive(clap::Args)]
struct StabilityArguments {
    /// Tries a hundredth of the inputs, and shorter climbs.
    #[arg(long)]
    quick: bool,
    /// A folder for the report as text, JSON and a picture; it is made if need be.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Only this technique.
    #[arg(long, value_parser = technique)]
    technique: Option<String>,
    /// Only this storage.
    #[arg(long, value_parser = ["unorm8", "unorm10", "unorm16", "float16", "float32"])]
    storage: Option<String>,
    /// Inputs per technique and storage in place of 10000000, or of 100000 if quick.
    #[arg(long, value_parser = clap::value_parser!(u64).range(10..=1_000_000_000))]
    samples: Option<u64>,
    /// The same seed gives the same inputs.
    #[arg(long, default_value_t = Effort::FULL.seed)]
    seed: u64,
}

#[derive(clap::Args)]
struct TableArguments {
    #[command(flatten)]
    frame: FrameArguments,
    /// glTF or GLB files, or procedural scenes.
    #[arg(long, num_args = 1.., default_values = ["fence-and-foliage", "hall"])]
    scene: Vec<String>,
    /// The graph file.
    #[arg(long)]
    graph: PathBuf,
    /// Radii of the Gaussian, in texels, in place of the graph's own kernel.
    #[arg(long, num_args = 1.., default_values = ["1", "4", "12"], value_parser = clap::value_parser!(u32).range(1..=64))]
    radius: Vec<u32>,
    /// Techniques in place of the graph's own, each in all of its storages: names with usual settings (vsm, evsm4, pcf,
    /// ...), or objects as in graph files.
    #[arg(long, num_args = 1.., conflicts_with = "all")]
    technique: Vec<TechniqueChoice>,
    /// All techniques in all of their storages, and as references the binary test and percentage-closer filtering with the
    /// same kernel.
    #[arg(long)]
    all: bool,
    /// Of the map's texels one of so many along either axis counts: 2 takes a quarter of the time.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    stride: u32,
    /// A folder for a plot of error against bits per texel, as SVG and PNG; it is made if need be.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

impl TableArguments {
    /// What is measured: all techniques, those that are named, or the graph's own in all of its storages.
    fn candidates(&self, storage: Option<Storage>) -> Result<Vec<Candidate>, TechniqueError> {
        if !self.all && self.technique.is_empty() {
            let own = storage.map_or(Storage::OF_FOUR_MOMENTS.to_vec(), |storage| vec![storage]);
            return Ok(own.into_iter().map(Candidate::Storage).collect());
        }
        candidates(&self.technique, storage)
    }
}

#[derive(clap::Args)]
struct FrameArguments {
    /// One of the numbered viewpoints and light directions.
    #[arg(long, default_value_t = 0)]
    view: u32,
    /// The light.
    #[arg(long, value_enum, default_value = "sun")]
    light: LightArgument,
    /// Stores the light's depth reversed.
    #[arg(long)]
    reversed: bool,
    /// Width of the picture; the height follows at 16 to 9.
    #[arg(long, default_value_t = 1280, value_parser = clap::value_parser!(u32).range(16..=8192))]
    width: u32,
    /// Texels per side of the light's map.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(16..=8192))]
    map: u32,
    /// Samples per texel of the light's map: 1 and 4 everywhere, 2 and 8 where the device can.
    #[arg(long, default_value_t = 4)]
    samples: u32,
    /// A storage in place of the graph's own.
    #[arg(long, value_enum)]
    storage: Option<StorageArgument>,
}

#[derive(Clone, Copy, ValueEnum)]
enum ProfileArgument {
    WebgpuCore,
    Native,
    NativeAdapter,
}

#[derive(Clone, Copy, ValueEnum)]
enum LightArgument {
    Sun,
    Spot,
}

#[derive(Clone, Copy, ValueEnum)]
enum BiasTechniqueArgument {
    Hamburger4,
    Hausdorff4,
    Hamburger6,
}

impl From<BiasTechniqueArgument> for BiasTechnique {
    fn from(argument: BiasTechniqueArgument) -> Self {
        match argument {
            BiasTechniqueArgument::Hamburger4 => BiasTechnique::Hamburger4,
            BiasTechniqueArgument::Hausdorff4 => BiasTechnique::Hausdorff4,
            BiasTechniqueArgument::Hamburger6 => BiasTechnique::Hamburger6,
        }
    }
}

#[derive(Clone, Copy, ValueEnum)]
enum StorageArgument {
    Unorm8,
    Unorm10,
    Unorm16,
    Float16,
    Float32,
}

impl From<StorageArgument> for Storage {
    fn from(argument: StorageArgument) -> Self {
        match argument {
            StorageArgument::Unorm16 => Storage::Unorm16,
            StorageArgument::Float16 => Storage::Float16,
            StorageArgument::Float32 => Storage::Float32,
            StorageArgument::Unorm8 => Storage::Unorm8,
            StorageArgument::Unorm10 => Storage::Unorm10,
        }
    }
}

impl From<ProfileArgument> for Profile {
    fn from(argument: ProfileArgument) -> Self {
        match argument {
            ProfileArgument::WebgpuCore => Profile::WebgpuCore,
            ProfileArgument::Native => Profile::Native,
            ProfileArgument::NativeAdapter => Profile::NativeAdapter,
        }
    }
}

impl FrameArguments {
    fn options(&self, scene: String) -> RenderOptions {
        RenderOptions {
            scene,
            view: self.view,
            light: match self.light {
                LightArgument::Sun => LightChoice::Sun,
                LightArgument::Spot => LightChoice::Spot,
            },
            reversed: self.reversed,
            size: [self.width, (self.width * 9 / 16).max(1)],
            map: self.map,
            samples: self.samples,
            storage: self.storage.map(Storage::from),
            technique: None,
        }
    }
}

/// How many samples to draw.
fn sample_count(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(count) if (1..=1_000_000_000).contains(&count) => Ok(count),
        _ => Err("a number of samples is an integer from 1 to 1000000000".to_owned()),
    }
}

/// A multiple of a distance.
fn distance(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(distance) if (1.0..=1000.0).contains(&distance) => Ok(distance),
        _ => Err("a distance is a number from 1 to 1000".to_owned()),
    }
}

/// The label of a technique with a filterable map.
fn technique(text: &str) -> Result<String, String> {
    let labels = stability::techniques();
    if labels.iter().any(|label| label == text) {
        return Ok(text.to_owned());
    }
    let meant = nearest(text, labels.iter().map(String::as_str));
    Err(format!("the nearest techniques are {meant}"))
}

fn main() -> ExitCode {
    moment_shadows_lab::runtime_dir::ensure();
    match run(Cli::parse().command) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(command: Command) -> Result<ExitCode, Box<dyn std::error::Error>> {
    match command {
        Command::Adapter => {
            let info = Gpu::open(Profile::WebgpuCore)?.adapter.get_info();
            println!(
                "{} ({:?}, {:?}, {})",
                info.name, info.device_type, info.backend, info.driver_info
            );
        }
        Command::Render {
            frame,
            scene,
            graph,
            out,
            technique,
            truth,
        } => {
            let options = RenderOptions {
                technique,
                ..frame.options(scene)
            };
            if let Some((judgement, truth)) = render::run(&options, &graph, &out, truth)? {
                println!("{}", judgement.error);
                println!("exact bound on the same depths\n{}", truth.bound_error);
                println!("{}", judgement.excess);
                println!(
                    "mean absolute error {:.6}",
                    judgement.error.facing.mean_absolute
                );
            }
        }
        Command::Validate { files, profile } => {
            return Ok(validate::run(&files, profile.map(Profile::from)));
        }
        Command::Graph {
            file,
            plan,
            json,
            profile,
        } => {
            let (file, compiled) = graph::check(&file, profile.into())?;
            if json {
                println!("{}", serde_json::to_string_pretty(&compiled)?);
            } else {
                println!("{}", graph::summary(&file));
                if plan {
                    println!("\n{compiled}");
                }
            }
        }
        Command::Vectors { file } => {
            let report = vectors::run(&file)?;
            println!("{report}");
            if !report.passed() {
                return Ok(ExitCode::FAILURE);
            }
        }
        Command::Measure {
            frame,
            technique,
            scene,
            graph,
        } => {
            let options = RenderOptions {
                technique,
                ..frame.options(String::new())
            };
            let rows = measure::run(&scene, &graph, &options)?;
            print!("{}", measure::table(&rows));
        }
        Command::Minification {
            frame,
            scene,
            graph,
            distance,
            json,
        } => print(
            &minification::run(&frame.options(scene), &graph, distance)?,
            json,
        )?,
        Command::TechniquePictures { out, scene, only } => {
            let made = technique_pictures::run(&out, &scene, only.as_deref())?;
            print!("{}", technique_pictures::table(&made));
        }
        Command::Shaders(options) => shaders::run(&options)?,
        Command::Bias {
            technique,
            storage,
            tables: false,
            samples,
            seed,
            json,
        } => print(
            &bias::run(technique.into(), storage.map(Storage::from), samples, seed)?,
            json,
        )?,
        Command::Bias {
            tables: true,
            samples,
            seed,
            json,
            ..
        } => print(&bias::tables(samples, seed)?, json)?,
        Command::Bases {
            out,
            margin,
            samples,
            json,
        } => {
            let (subsets, files) = bases::run(&out, samples, margin)?;
            print(&subsets, json)?;
            if !json {
                println!("\n{}\n{}", files[0].display(), files[1].display());
            }
        }
        Command::Orderings {
            samples,
            seed,
            json,
        } => print(&orderings::run(samples, seed), json)?,
        Command::Stability(arguments) => return run_stability(&arguments),
        Command::Isa(options) => return Ok(isa::run(&options)?),
        Command::IsaChip { chip, shader } => {
            print!("{}", child::compile(chip, shader.as_deref())?);
        }
        Command::Error {
            frame,
            scene,
            graph,
            radius,
            technique,
            json,
        } => print(
            &error::run(&frame.options(scene), &graph, radius, technique.as_ref())?,
            json,
        )?,
        Command::ErrorTable(arguments) => run_error_table(arguments)?,
        Command::LayersFigure {
            frame,
            scene,
            graph,
            radius,
            stride,
            out,
            json,
        } => {
            let options = frame.options(scene);
            if options.storage.is_some() {
                return Err(
                    "the storages of the figure are those of equal memory; leave out --storage"
                        .into(),
                );
            }
            let mut figure = layers_figure::run(&options, &graph, radius, stride)?;
            if let Some(out) = out {
                figure.plot(&out)?;
            }
            print(&figure, json)?;
        }
        Command::Contacts {
            frame,
            graph,
            radius,
            technique,
            json,
        } => {
            let candidates = candidates(&technique, None)?;
            let options = frame.options(String::new());
            print(
                &contacts::run(&options, &graph, &radius, &candidates)?,
                json,
            )?;
        }
        Command::SoftError(options) => {
            for report in soft_error::run(&options)? {
                println!("{report}");
            }
        }
        Command::ScatteringError(options) => {
            for report in scattering_error::run(&options)? {
                println!("{report}");
            }
        }
        Command::ScatteringFlicker(options) => {
            let report = scattering_flicker::run(&options)?;
            print(&report, options.json)?;
            if !report.passed() {
                return Ok(ExitCode::FAILURE);
            }
        }
        Command::CostGrowth(options) => print(&cost_growth::run(&options)?, options.json)?,
        Command::Cost(options) => match options.subject.graph {
            Some(graph) => {
                let cost = cost::graph(&graph, options.size, options.rounds, options.bandwidth)?;
                print(&cost, options.json)?;
            }
            None => {
                let cost = cost::table(&options.subject.list(), options.size, options.rounds)?;
                print(&cost, options.json)?;
                if !cost.passed() {
                    return Ok(ExitCode::FAILURE);
                }
            }
        },
    }
    Ok(ExitCode::SUCCESS)
}

fn run_error_table(arguments: TableArguments) -> Result<(), Box<dyn std::error::Error>> {
    let render = arguments.frame.options(String::new());
    let options = TableOptions {
        candidates: arguments.candidates(render.storage)?,
        scenes: arguments.scene,
        radii: arguments.radius,
        stride: arguments.stride,
        render,
    };
    let mut table = error_table::run(&arguments.graph, &options)?;
    if let Some(out) = &arguments.out {
        table.plot(out)?;
    }
    print(&table, arguments.json)?;
    Ok(())
}

fn run_stability(arguments: &StabilityArguments) -> Result<ExitCode, Box<dyn std::error::Error>> {
    let usual = if arguments.quick {
        Effort::QUICK
    } else {
        Effort::FULL
    };
    let effort = Effort {
        samples: arguments.samples.unwrap_or(usual.samples),
        seed: arguments.seed,
        ..usual
    };
    let pairs = stability::pairs(arguments.technique.as_deref(), arguments.storage.as_deref())?;
    let report = stability::run(&pairs, effort, arguments.out.as_deref())?;
    print!("{report}");
    Ok(if report.faults() == 0 {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(stability::FAULT_CODE)
    })
}

fn print<T: serde::Serialize + std::fmt::Display>(
    report: &T,
    json: bool,
) -> Result<(), serde_json::Error> {
    if json {
        println!("{}", serde_json::to_string_pretty(report)?);
    } else {
        print!("{report}");
    }
    Ok(())
}
