//! `moment-shadows-lab ports`: exported functions in other languages, run on the adapter.

use std::path::PathBuf;
use std::process::ExitCode;

use super::CommandResult;
use crate::ports;

/// What `ports` takes.
#[derive(clap::Args)]
pub struct Options {
    /// The folder for compute shaders around what is exported as GLSL and HLSL.
    folder: PathBuf,
    /// Runs what other compilers made of them instead, `NAME.spv` beside each.
    #[arg(long)]
    compiled: bool,
}

impl Options {
    /// Writes the shaders, or runs what was compiled and fails where a row is beyond its tolerance.
    pub fn run(self) -> CommandResult {
        if !self.compiled {
            let count = ports::write(&self.folder)?;
            println!("{count} shaders in {}", self.folder.display());
            return Ok(ExitCode::SUCCESS);
        }
        let all = ports::run(&self.folder)?;
        println!(
            "exported                     as    functions   rows  equal  fused  within  beyond  not as WGSL"
        );
        let mut beyond = 0;
        for compared in &all {
            println!("{compared}");
            beyond += compared.total().beyond;
        }
        for target in [
            moment_shadows::Target::Wgsl,
            moment_shadows::Target::Glsl,
            moment_shadows::Target::Hlsl,
        ] {
            let of_target = all
                .iter()
                .filter(|it| it.target == target)
                .map(ports::Compared::total);
            let totals: Vec<_> = of_target.collect();
            let sum = |of: fn(&ports::Counts) -> usize| totals.iter().map(of).sum::<usize>();
            println!(
                "{target}: {} files, {} rows, {} equal to the bit, {} where fused, {} within the tolerance, {} beyond; {} not as WGSL",
                totals.len(),
                sum(|it| it.rows),
                sum(|it| it.equal),
                sum(|it| it.fused),
                sum(|it| it.within),
                sum(|it| it.beyond),
                sum(|it| it.other_than_wgsl)
            );
        }
        Ok(if beyond == 0 {
            ExitCode::SUCCESS
        } else {
            ExitCode::FAILURE
        })
    }
}
