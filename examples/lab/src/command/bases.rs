//! `moment-shadows bases`: choices of four functions of depth, compared, and their histogram.

use std::path::{Path, PathBuf};

use crate::basis::{SubsetError, Subsets, save_plot};
use crate::plot::PlotError;
use crate::progress;

/// Of the random distributions.
const SEED: u64 = 2015;

/// Why there is no comparison.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BasesError {
    /// The bounds.
    #[error(transparent)]
    Subsets(#[from] SubsetError),
    /// The plot.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// The folder for the plot.
    #[error("the folder '{}' cannot be made: {source}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
}

/// Compares all choices on `samples` distributions that leave `margin` at the ends free of surfaces, and saves the histogram as SVG and PNG.
pub fn run(out: &Path, samples: usize, margin: f64) -> Result<(Subsets, [PathBuf; 2]), BasesError> {
    // Before the work, so that a wrong path is told at once.
    std::fs::create_dir_all(out).map_err(|source| BasesError::Folder {
        folder: out.to_owned(),
        source,
    })?;
    let bar = progress::bar(Subsets::COUNT, "linear programs");
    let subsets = Subsets::evaluate(samples, margin, SEED, || bar.inc(1));
    bar.finish_and_clear();
    let subsets = subsets?;
    let files = save_plot(&subsets, out)?;
    Ok((subsets, files))
}
