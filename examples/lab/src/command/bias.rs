//! `moment-shadows-lab bias`: the smallest safe moment bias of a storage, by search.

use moment_shadows::Storage;

use super::{CommandResult, argument, print};
use crate::bias::{BiasTechnique, Form, search, search_tables, steps, table_steps};
use crate::progress;

/// What `bias` takes.
#[derive(clap::Args)]
pub struct Options {
    /// The solver that the moments are for.
    #[arg(long, value_enum, default_value = "hamburger4")]
    technique: BiasTechnique,
    /// One storage of the library; all of them and the published forms if none is given.
    #[arg(long, value_parser = argument::storage())]
    storage: Option<Storage>,
    /// Summed-area tables of every storage instead, for both solvers and for two moments.
    #[arg(long, conflicts_with_all = ["technique", "storage"])]
    tables: bool,
    /// Translucent casters that are blended over each patch between resolve and blur.
    #[arg(long, default_value_t = 0, value_parser = clap::value_parser!(u32).range(..=64), conflicts_with = "tables")]
    blends: u32,
    /// Patches per row of the table.
    #[arg(long, default_value_t = 1_000_000, value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    samples: u64,
    /// Seed of the random numbers.
    #[arg(long, default_value_t = 2015)]
    seed: u64,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

impl Options {
    /// Searches one storage, all of them and the published forms, or summed-area tables, and prints what is found.
    pub fn run(self) -> CommandResult {
        let Self {
            technique,
            storage,
            seed,
            ..
        } = self;
        let samples = self.samples as usize;
        if self.tables {
            let bar = progress::bar(table_steps(samples) as u64, "summing patches");
            let tables = search_tables(samples, seed, || bar.inc(1));
            bar.finish_and_clear();
            return print(&tables?, self.json);
        }
        let rows = match (storage, technique) {
            (Some(_), _) => 1,
            (None, BiasTechnique::Hamburger4) => {
                technique.storages().len() + Form::published().len()
            }
            (None, _) => technique.storages().len(),
        };
        let bar = progress::bar((rows * steps(samples)) as u64, "filtering patches");
        let table = search(technique, storage, (self.blends, samples, seed), || {
            bar.inc(1)
        });
        bar.finish_and_clear();
        print(&table?, self.json)
    }
}
