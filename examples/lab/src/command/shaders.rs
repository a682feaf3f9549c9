//! `moment-shadows shaders`: every linked shader as a file, for other compilers to judge.

use std::path::Path;

use crate::shaders::{self, ShadersError};

/// Writes every shader of the library into the new folder `out`. Gives their number.
///
/// # Errors
/// [`ShadersError`]; there is then no folder.
pub fn run(out: &Path) -> Result<usize, ShadersError> {
    let all = shaders::all()?;
    shaders::write(&all, out)?;
    Ok(all.len())
}
