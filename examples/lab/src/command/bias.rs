//! `moment-shadows bias`: the smallest safe moment bias of a storage, by search.

use moment_shadows::{Storage, SummedAreaTableError};

use crate::bias::{
    BiasError, BiasTable, BiasTechnique, Form, TableBiases, search, search_tables, steps,
    table_steps,
};
use crate::progress;

/// Searches one storage, or all and the published forms.
pub fn run(
    technique: BiasTechnique,
    storage: Option<Storage>,
    samples: usize,
    seed: u64,
) -> Result<BiasTable, BiasError> {
    let rows = match (storage, technique) {
        (Some(_), _) => 1,
        (None, BiasTechnique::Hamburger4) => technique.storages().len() + Form::published().len(),
        (None, _) => technique.storages().len(),
    };
    let bar = progress::bar((rows * steps(samples)) as u64, "filtering patches");
    let table = search(technique, storage, samples, seed, || bar.inc(1));
    bar.finish_and_clear();
    table
}

/// Searches summed-area tables of every storage with several kernels.
pub fn tables(samples: usize, seed: u64) -> Result<TableBiases, SummedAreaTableError> {
    let bar = progress::bar(table_steps(samples) as u64, "summing patches");
    let tables = search_tables(samples, seed, || bar.inc(1));
    bar.finish_and_clear();
    tables
}
