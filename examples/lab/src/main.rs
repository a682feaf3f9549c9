//! The `moment-shadows` command.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};
use moment_shadows_graph::nodes::Overestimation;
use moment_shadows_lab::command::cost::CostOptions;
use moment_shadows_lab::command::scattering_error::ScatteringErrorOptions;
use moment_shadows_lab::command::soft_error::SoftErrorOptions;
use moment_shadows_lab::command::{
    CommandResult, adapter, bias, contacts, error, error_table, graph, isa, measure, minification,
    print, render, scattering_error, scattering_flicker, shaders, soft_error, stability,
    technique_pictures, validate, vectors,
};
use moment_shadows_lab::isa::child;
use moment_shadows_lab::scattering::{FRAMES, FlickerDesc, Look, LookDesc, ScatteringStageDesc};
use moment_shadows_lab::soft::{LightSize, NamedGraph, SoftLightChoice, StageDesc};
use moment_shadows_lab::truth::area_light::{MOST_PLACES, USUAL_PLACES};

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
    Render(render::Options),
    /// Validates shaders, linked with the modules they import, for every backend.
    Validate(validate::Options),
    /// Checks and prints a graph file.
    Graph(graph::Options),
    /// Runs the shader on vectors with known bounds.
    Vectors(vectors::Options),
    /// Prints the error of every storage on several scenes, beside that of the exact bound.
    Measure(measure::Options),
    /// Prints the error of a graph with mip levels on a scene from afar, over the whole of each pixel, and how much it
    /// flickers while the camera comes nearer; and the same without mip levels.
    Minification(minification::Options),
    /// Writes a picture of every technique: a view and the technique's typical failure, each with its difference from the
    /// truth beside it.
    TechniquePictures(technique_pictures::Options),
    /// Writes every linked shader of the library, as WGSL and SPIR-V with an index, for other compilers.
    Shaders(shaders::Options),
    /// Prints the error of a graph over all surfaces that the light's rays meet, and over a picture.
    Error(error::Options),
    /// Prints the error over all surfaces of several scenes, for several radii, techniques and storages.
    ErrorTable(error_table::Options),
    /// Prints how much light leaks where the thin legs of chairs meet the ground.
    Contacts(contacts::Options),
    /// Prints how far soft shadows are from those of an area light that is sampled at many places: hard moment shadows,
    /// percentage closer soft shadows, and graphs of your own.
    SoftError(SoftErrorArguments),
    /// Renders the light that a medium scatters by every technique beside marched rays, and prints errors and costs.
    ScatteringError(ScatteringErrorArguments),
    /// Walks a slow path of camera and light, and prints how much the air flickers with filtered resampling and without. Fails
    /// where it is more than a third as much. Takes minutes.
    ScatteringFlicker(ScatteringFlickerArguments),
    /// Times the passes of a graph, blurs of several radii, summed-area tables or single scattering, as ratios to copies, and counts
    /// their bytes.
    Cost(CostOptions),
    /// Finds the smallest safe moment bias of each storage by search over filtered patches of depth.
    Bias(bias::Options),
    /// Tries every technique with every storage on random, extreme and invalid inputs, and on hill-climbs towards the worst,
    /// and prints how far results are above the truth. Takes about a quarter of an hour. Exits with 3 if a result is NaN,
    /// infinite, outside of 0 to 1 or farther above the truth than is documented.
    Stability(stability::Options),
    /// Compiles every shader for chips that need not be there, and counts what the code does (Linux, Mesa's RADV).
    Isa(isa::Options),
    /// The process that compiles for one chip, which its environment names.
    #[command(name = child::COMMAND, hide = true)]
    IsaChip(isa::ChildOptions),
}

#[derive(clap::Args)]
struct SoftErrorArguments {
    /// glTF or GLB files, or procedural scenes: fence-and-foliage, hall, chairs, edge, hole.
    #[arg(required = true)]
    scene: Vec<String>,
    /// The light.
    #[arg(long, value_enum, default_value = "directional")]
    light: SoftLightArgument,
    /// The light's size: degrees for a directional one, a diameter in scene units for a spot, WIDTHxHEIGHT for a rectangle. 0
    /// gives hard shadows.
    #[arg(long)]
    size: Option<LightSize>,
    /// One of the numbered viewpoints and light directions.
    #[arg(long, default_value_t = 0)]
    view: u32,
    /// Texels per side of the light's map.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(16..=8192))]
    map: u32,
    /// Width of the picture.
    #[arg(long, default_value_t = 640, value_parser = clap::value_parser!(u32).range(16..=8192))]
    width: u32,
    /// Height of the picture.
    #[arg(long, default_value_t = 360, value_parser = clap::value_parser!(u32).range(16..=8192))]
    height: u32,
    /// Places on the light that the truth is the mean of.
    #[arg(long, default_value_t = USUAL_PLACES, value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_PLACES)))]
    samples: u32,
    /// Another technique: a graph file, with a name before it if you like (NAME=FILE). Several may be given.
    #[arg(long)]
    graph: Vec<NamedGraph>,
    /// Only the techniques of these names.
    #[arg(long)]
    only: Vec<String>,
    /// Also times the techniques, in so many rounds, at least 9.
    #[arg(long, value_name = "ROUNDS", num_args = 0..=1, require_equals = true, default_missing_value = "9", value_parser = clap::value_parser!(u32).range(9..=1000))]
    cost: Option<u32>,
    /// A folder for pictures of the truth and of each technique with its difference; it is made if need be.
    #[arg(long)]
    out: Option<PathBuf>,
    /// A file for the figures as JSON.
    #[arg(long)]
    json: Option<PathBuf>,
}

#[derive(clap::Args)]
struct ScatteringErrorArguments {
    /// glTF or GLB files, or procedural scenes: fence-and-foliage, hall, chairs, edge, hole.
    #[arg(required = true)]
    scene: Vec<String>,
    /// A numbered viewpoint, or how the camera looks: towards the light, away from it, straight into it, or straight along it.
    #[arg(
        long,
        default_value = "0",
        value_name = "NUMBER|towards|away|into|along"
    )]
    view: Look,
    /// The light's height above the horizon in degrees, in place of the viewpoint's own.
    #[arg(long)]
    elevation: Option<f64>,
    /// Optical thickness between the camera and the far end.
    #[arg(long, default_value_t = 0.7)]
    thickness: f64,
    /// Of the phase function, from -0.99 (backwards) to 0.99 (forwards).
    #[arg(long, default_value_t = 0.4, allow_negative_numbers = true)]
    anisotropy: f32,
    /// Texels per side of the light's map.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(16..=8192))]
    map: u32,
    /// Radius in texels of the blur of the light's map.
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u32).range(1..=64))]
    radius: u32,
    /// Columns of rectified maps.
    #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(2..=8192))]
    columns: u32,
    /// Rows of rectified maps.
    #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(2..=8192))]
    rows: u32,
    /// How strongly our nodes lean towards a bound, looking towards the light and away from it: from 0, the middle of the bounds,
    /// to 1, as published.
    #[arg(long, num_args = 2, value_names = ["TOWARDS", "AWAY"])]
    overestimation: Option<Vec<f32>>,
    /// Width of the picture.
    #[arg(long, default_value_t = 640, value_parser = clap::value_parser!(u32).range(16..=8192))]
    width: u32,
    /// Height of the picture.
    #[arg(long, default_value_t = 360, value_parser = clap::value_parser!(u32).range(16..=8192))]
    height: u32,
    /// Steps of the truth.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    steps: u32,
    /// Only the techniques of these names.
    #[arg(long)]
    only: Vec<String>,
    /// Also times the techniques, in so many rounds, at least 9.
    #[arg(long, value_name = "ROUNDS", num_args = 0..=1, require_equals = true, default_missing_value = "9", value_parser = clap::value_parser!(u32).range(9..=1000))]
    cost: Option<u32>,
    /// A folder for pictures of the truth and of each technique with its difference; it is made if need be.
    #[arg(long)]
    out: Option<PathBuf>,
    /// A file for the figures as JSON.
    #[arg(long)]
    json: Option<PathBuf>,
}

#[derive(clap::Args)]
struct ScatteringFlickerArguments {
    /// glTF or GLB files, or procedural scenes: fence-and-foliage, hall, chairs, edge, hole.
    #[arg(long, required = true, num_args = 1..)]
    scene: Vec<String>,
    /// A numbered viewpoint, or how the camera looks: towards the light, away from it, straight into it, or straight along it.
    #[arg(
        long,
        default_value = "0",
        value_name = "NUMBER|towards|away|into|along"
    )]
    view: Look,
    /// The light's height above the horizon in degrees, in place of the viewpoint's own.
    #[arg(long)]
    elevation: Option<f64>,
    /// Frames from the beginning of the path on; all of it has 240.
    #[arg(long, default_value_t = FRAMES, value_parser = clap::value_parser!(u32).range(2..=10_000))]
    frames: u32,
    /// Optical thickness between the camera and the far end.
    #[arg(long, default_value_t = 0.7)]
    thickness: f64,
    /// Of the phase function, from -0.99 (backwards) to 0.99 (forwards).
    #[arg(long, default_value_t = 0.4, allow_negative_numbers = true)]
    anisotropy: f32,
    /// Texels per side of the light's map.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(16..=8192))]
    map: u32,
    /// Columns of rectified maps.
    #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(2..=8192))]
    columns: u32,
    /// Rows of rectified maps.
    #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(2..=8192))]
    rows: u32,
    /// Width of the picture.
    #[arg(long, default_value_t = 320, value_parser = clap::value_parser!(u32).range(16..=8192))]
    width: u32,
    /// Height of the picture.
    #[arg(long, default_value_t = 180, value_parser = clap::value_parser!(u32).range(16..=8192))]
    height: u32,
    /// Texels per side of the map that the truth is marched through.
    #[arg(long, default_value_t = 2048, value_parser = clap::value_parser!(u32).range(16..=8192))]
    truth_map: u32,
    /// Steps of the truth.
    #[arg(long, default_value_t = 256, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    steps: u32,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

impl ScatteringFlickerArguments {
    fn desc(&self) -> FlickerDesc {
        FlickerDesc {
            look: LookDesc {
                look: self.view,
                elevation: self.elevation,
            },
            frames: self.frames,
            thickness: self.thickness,
            anisotropy: self.anisotropy,
            map: self.map,
            extent: [self.columns, self.rows],
            picture: [self.width, self.height],
            truth_map: self.truth_map,
            steps: self.steps,
        }
    }
}

#[derive(Clone, Copy, ValueEnum)]
enum SoftLightArgument {
    Directional,
    Spot,
    Rectangle,
}

impl From<SoftLightArgument> for SoftLightChoice {
    fn from(argument: SoftLightArgument) -> Self {
        match argument {
            SoftLightArgument::Directional => SoftLightChoice::Directional,
            SoftLightArgument::Spot => SoftLightChoice::Spot,
            SoftLightArgument::Rectangle => SoftLightChoice::Rectangle,
        }
    }
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

fn run(command: Command) -> CommandResult {
    match command {
        Command::Adapter => adapter::run(),
        Command::Render(options) => options.run(),
        Command::Validate(options) => options.run(),
        Command::Graph(options) => options.run(),
        Command::Vectors(options) => options.run(),
        Command::Measure(options) => options.run(),
        Command::Minification(options) => options.run(),
        Command::TechniquePictures(options) => options.run(),
        Command::Shaders(options) => options.run(),
        Command::Error(options) => options.run(),
        Command::ErrorTable(options) => options.run(),
        Command::Contacts(options) => options.run(),
        Command::SoftError(arguments) => run_soft_error(arguments),
        Command::ScatteringError(arguments) => run_scattering_error(arguments),
        Command::ScatteringFlicker(arguments) => {
            let report = scattering_flicker::run(&arguments.scene, &arguments.desc())?;
            print(&report, arguments.json)?;
            if !report.passed() {
                return Ok(ExitCode::FAILURE);
            }
            Ok(ExitCode::SUCCESS)
        }
        Command::Cost(options) => options.run(),
        Command::Bias(options) => options.run(),
        Command::Stability(options) => options.run(),
        Command::Isa(options) => options.run(),
        Command::IsaChip(options) => options.run(),
    }
}

fn run_soft_error(arguments: SoftErrorArguments) -> CommandResult {
    let options = SoftErrorOptions {
        stage: StageDesc {
            light: arguments.light.into(),
            size: arguments.size,
            view: arguments.view,
            map: arguments.map,
            picture: [arguments.width, arguments.height],
            places: arguments.samples,
        },
        graphs: arguments.graph,
        only: arguments.only,
        rounds: arguments.cost,
        out: arguments.out,
    };
    let reports = soft_error::run(&arguments.scene, &options)?;
    for report in &reports {
        println!("{report}");
    }
    if let Some(path) = &arguments.json {
        soft_error::save_json(path, &reports)?;
    }
    Ok(ExitCode::SUCCESS)
}

fn run_scattering_error(arguments: ScatteringErrorArguments) -> CommandResult {
    let options = ScatteringErrorOptions {
        stage: ScatteringStageDesc {
            look: LookDesc {
                look: arguments.view,
                elevation: arguments.elevation,
            },
            thickness: arguments.thickness,
            anisotropy: arguments.anisotropy,
            map: arguments.map,
            radius: arguments.radius,
            picture: [arguments.width, arguments.height],
            steps: arguments.steps,
        },
        extent: [arguments.columns, arguments.rows],
        overestimation: match arguments.overestimation.as_deref() {
            Some(&[towards, away]) => Overestimation { towards, away },
            _ => Overestimation::default(),
        },
        only: arguments.only,
        rounds: arguments.cost,
        out: arguments.out,
    };
    let reports = scattering_error::run(&arguments.scene, &options)?;
    for report in &reports {
        println!("{report}");
    }
    if let Some(path) = &arguments.json {
        scattering_error::save_json(path, &reports)?;
    }
    Ok(ExitCode::SUCCESS)
}
