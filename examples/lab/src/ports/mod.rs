//! What `moment-shadows export` writes, run in the languages that it is written in: with the vectors beside it, as a user of another
//! engine proves a port.

mod compare;
mod run;
mod wrap;

use std::fs;
use std::path::Path;

use moment_shadows::{Exported, MapEncoding, Target, Vectors, export};

use crate::error::LabError;
use crate::techniques::{filterable, label, variant};

pub use compare::{Compared, Counts};
pub use run::{Runner, Shader};
pub use wrap::wrapper;

/// The languages whose compilers make SPIR-V, with how the names of their compute shaders end.
pub const COMPILED: [(Target, &str); 2] = [(Target::Glsl, "comp"), (Target::Hlsl, "hlsl")];

/// Every technique in every storage that it takes, with usual settings and with others that make other functions.
#[must_use]
pub fn encodings() -> Vec<MapEncoding> {
    let mut all = filterable();
    let others = all.clone().into_iter().filter_map(|encoding| {
        let other = variant(encoding.technique())?;
        MapEncoding::new(other, encoding.storage()).ok()
    });
    // Layers that are placed on the device are not exported.
    let others = others.filter(|other| !other.technique().row().places_layers);
    all.extend(others.collect::<Vec<_>>());
    all
}

/// A name that can be a file's.
#[must_use]
pub fn name(encoding: &MapEncoding) -> String {
    format!("{}_{}", label(encoding.technique()), encoding.storage())
}

/// The export of an encoding; none of [`encodings`] is refused.
pub fn exported(encoding: &MapEncoding, target: Target) -> Result<Exported, LabError> {
    export(encoding, target).map_err(|error| LabError::unsuitable(name(encoding), error.message))
}

/// The vectors of an encoding.
pub fn vectors(encoding: &MapEncoding) -> Result<Vectors, LabError> {
    let vectors = exported(encoding, Target::Wgsl)?.vectors();
    vectors.map_err(|error| LabError::unsuitable(name(encoding), error.message))
}

/// Writes a compute shader for each of [`encodings`] and [`COMPILED`], in a folder for each language.
pub fn write(folder: &Path) -> Result<usize, LabError> {
    let mut count = 0;
    for encoding in encodings() {
        let vectors = vectors(&encoding)?;
        for (target, extension) in COMPILED {
            let folder = folder.join(target.name());
            let failed = |error| LabError::unsuitable(folder.display(), format!("{error}"));
            fs::create_dir_all(&folder).map_err(failed)?;
            let text = wrapper(&encoding, target, &vectors)?;
            let path = folder.join(name(&encoding)).with_extension(extension);
            fs::write(path, text).map_err(failed)?;
            count += 1;
        }
    }
    Ok(count)
}

/// Runs what other compilers made of the shaders in a folder, `NAME.spv` beside each, and compares it with the vectors and with WGSL.
pub fn run(folder: &Path) -> Result<Vec<Compared>, LabError> {
    let runner = Runner::open()?;
    let mut all = Vec::new();
    for encoding in encodings() {
        let vectors = &vectors(&encoding)?;
        let text = wrapper(&encoding, Target::Wgsl, vectors)?;
        let wgsl = runner.run(&Shader::Wgsl(&text), vectors)?;
        let as_wgsl = Compared::new(name(&encoding), Target::Wgsl, vectors, &wgsl, &wgsl);
        all.push(as_wgsl);
        for (target, _) in COMPILED {
            let path = folder
                .join(target.name())
                .join(name(&encoding))
                .with_extension("spv");
            let bytes = fs::read(&path).map_err(|error| {
                let reason = format!("{error}; compile the shader beside it first");
                LabError::unsuitable(path.display(), reason)
            })?;
            let words: Vec<u32> = bytemuck::pod_collect_to_vec(&bytes);
            let given = runner.run(&Shader::Spirv(&words), vectors)?;
            all.push(Compared::new(
                name(&encoding),
                target,
                vectors,
                &given,
                &wgsl,
            ));
        }
    }
    Ok(all)
}
