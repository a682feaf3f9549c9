//! The command line: every sub-command with what it takes.

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::command::cost::CostOptions;
use crate::command::{
    CommandResult, best, bias, choose, claims, contact_shadows, cost_chart, error, error_table,
    first_frame, inspect, isa, march_error, measure, ports, print_all, probe, render,
    scattering_error, scattering_flicker, scores, shaders, soak, soft_error, stability, sweep,
    technique_pictures, trade, transmittance, troubleshooting_pictures, vectors,
};
use crate::isa::child;

/// The instrument of moment-shadows: renders scenes with the library's nodes, and measures errors, costs and stability. It has the
/// sub-commands of the library's own command, too.
#[derive(Parser)]
#[command(name = "moment-shadows-lab", version, about, long_about = None)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    #[command(flatten)]
    Library(moment_shadows_graph::command::Command),
    /// Renders a scene with the shadows of a graph.
    Render(render::Options),
    /// Runs the shader on vectors with known bounds.
    Vectors(vectors::Options),
    /// Prints the error of every storage on several scenes, beside that of the exact bound.
    Measure(measure::Options),
    /// Writes a picture of every technique: a view and the technique's typical failure, each with its difference from the
    /// truth beside it.
    TechniquePictures(technique_pictures::Options),
    /// Writes a picture of every symptom of `docs/troubleshooting.md`, with a mistake and without it.
    TroubleshootingPictures(troubleshooting_pictures::Options),
    /// Writes every linked shader of the library, as WGSL, SPIR-V and GLSL with an index, for other compilers.
    Shaders(shaders::Options),
    /// Prints the error of a graph over all surfaces that the light's rays meet, and over a picture.
    Error(error::Options),
    /// Prints the error over all surfaces of several scenes, for several radii, techniques and storages.
    ErrorTable(error_table::Options),
    /// Measures what every technique and storage costs and how far it is off, on your scenes, as a page with fronts of error against time,
    /// bytes and instructions.
    Trade(trade::Options),
    /// Chooses technique, storage, map and samples for a scene within bounds, and writes the graph. Exits with 3 if nothing keeps to the
    /// bounds; the nearest is printed then.
    Choose(choose::Options),
    /// Scores acne, peter-panning, contact and flicker of every technique and storage, with a picture of each.
    Scores(scores::Options),
    /// Prints how much light at contacts a march through the camera's depth takes away, and what false shadow it makes.
    ContactShadows(contact_shadows::Options),
    /// Times all techniques over the size of the map, that of the picture and the width of the filter, as ratios to percentage-closer
    /// filtering.
    Sweep(sweep::Options),
    /// Measures what papers claim of shadow maps, soft shadows, light in the air and times, and prints a verdict on each.
    Claims(claims::Options),
    /// Prints which technique and storage errs least for its bits in a finished trade.
    Best(best::Options),
    /// Prints what a scene asks of its shadows: surfaces under the filter, the part of the light's range that is used, texels per pixel.
    Probe(probe::Options),
    /// Times what passes before the first frame of a graph: its compilation and its pipelines.
    FirstFrame(first_frame::Options),
    /// Looks at one pixel: the depths under its filter, and what each technique makes of them, step by step from the truth to what is shown.
    Inspect(inspect::Options),
    /// Keeps a session for many frames, while maps and pictures are resized, layers are made anew one by one and regions move. Exits with 3
    /// if a session that is made anew shows something else, or memory grows. Takes minutes.
    Soak(soak::Options),
    /// Prints how far soft shadows are from those of an area light that is sampled at many places: hard moment shadows,
    /// percentage closer soft shadows, and graphs of your own.
    SoftError(soft_error::SoftErrorOptions),
    /// Renders the light that a medium scatters by every technique beside marched rays, and prints errors and costs.
    ScatteringError(scattering_error::ScatteringErrorOptions),
    /// Marches the light of a sun, a spot or a point light in height fog, with filtered maps and with plain ones, at full, half and a
    /// quarter of the resolution, and prints errors, bytes and costs.
    MarchError(march_error::MarchErrorOptions),
    /// Walks a slow path of camera and light, and prints how much the air flickers with filtered resampling and without. Fails
    /// where it is more than a third as much. Takes minutes.
    ScatteringFlicker(scattering_flicker::Options),
    /// Times the passes of a graph, blurs of several radii, summed-area tables or single scattering, as ratios to copies, and counts
    /// their bytes.
    Cost(CostOptions),
    /// Draws what a graph costs over the sizes of map and picture and over the kernel's radius, by this build and another one.
    CostChart(cost_chart::Options),
    /// Finds the smallest safe moment bias of each storage by search over filtered patches of depth.
    Bias(bias::Options),
    /// Blends translucent casters into every map, and prints how far its bound is from the exact transmittance.
    Transmittance(transmittance::Options),
    /// Tries every technique with every storage on random, extreme and invalid inputs, and on hill-climbs towards the worst,
    /// and prints how far results are above the truth. Takes about a quarter of an hour. Exits with 3 if a result is NaN,
    /// infinite, outside of 0 to 1 or farther above the truth than is documented.
    Stability(stability::Options),
    /// Compiles every shader for chips that need not be there, and counts what the code does (Linux, Mesa's RADV).
    Isa(isa::Options),
    /// Writes compute shaders around what `export` writes as GLSL and HLSL; with `--compiled`, runs what other compilers made of
    /// them and compares it with the vectors and with WGSL. Exits with 1 where a row is beyond its tolerance.
    Ports(ports::Options),
    /// The process that compiles for one chip, which its environment names.
    #[command(name = child::COMMAND, hide = true)]
    IsaChip(isa::ChildOptions),
}

/// The command line's parser. Numbers may be negative.
#[must_use]
pub fn parser() -> clap::Command {
    Cli::command().mut_subcommands(|command| command.allow_negative_numbers(true))
}

impl Cli {
    /// What the process was called with; ends it with a message where that is wrong.
    #[must_use]
    pub fn of_process() -> Self {
        let cli = Self::from_arg_matches(&parser().get_matches());
        cli.unwrap_or_else(|error| error.exit())
    }

    /// Runs the sub-command.
    pub fn run(self) -> CommandResult {
        run(self.command)
    }
}

fn run(command: Command) -> CommandResult {
    match command {
        Command::Library(command) => Ok(command.run()),
        Command::Render(options) => options.run(),
        Command::Vectors(options) => options.run(),
        Command::Measure(options) => options.run(),
        Command::TechniquePictures(options) => options.run(),
        Command::TroubleshootingPictures(options) => options.run(),
        Command::Shaders(options) => options.run(),
        Command::Error(options) => options.run(),
        Command::ErrorTable(options) => options.run(),
        Command::Trade(options) => options.run(),
        Command::Choose(options) => options.run(),
        Command::Scores(options) => options.run(),
        Command::ContactShadows(options) => options.run(),
        Command::Sweep(options) => options.run(),
        Command::Claims(options) => options.run(),
        Command::Best(options) => options.run(),
        Command::Probe(options) => options.run(),
        Command::FirstFrame(options) => options.run(),
        Command::Inspect(options) => options.run(),
        Command::Soak(options) => options.run(),
        Command::SoftError(options) => print_all(&soft_error::run(&options)?, false),
        Command::MarchError(options) => print_all(&march_error::run(&options)?, false),
        Command::ScatteringError(options) => print_all(&scattering_error::run(&options)?, false),
        Command::ScatteringFlicker(options) => options.run(),
        Command::Cost(options) => options.run(),
        Command::CostChart(options) => options.run(),
        Command::Bias(options) => options.run(),
        Command::Transmittance(options) => options.run(),
        Command::Stability(options) => options.run(),
        Command::Isa(options) => options.run(),
        Command::Ports(options) => options.run(),
        Command::IsaChip(options) => options.run(),
    }
}
