//! What figures belong to: this build of the command, and files as they are now.

use std::path::Path;

use sha2::{Digest, Sha256};

use crate::error::LabError;
use crate::trade::setup::path_beside;

/// The beginning of the SHA-256 of the running command.
pub(crate) fn of_command() -> Result<String, LabError> {
    let command = std::env::current_exe().map_err(|error| {
        LabError::refused(format!("the command does not know its file: {error}"))
    })?;
    of_files(&[&command])
}

/// The same, and that of each scene: of its file and of that of its views. A procedural scene has none.
pub(crate) fn identity(scenes: &[String]) -> Result<Vec<String>, LabError> {
    let mut all = vec![of_command()?];
    for scene in scenes {
        let views = path_beside(scene);
        all.push(of_files(&[Path::new(scene), &views])?);
    }
    Ok(all)
}

/// Of what there is of some files.
fn of_files(paths: &[&Path]) -> Result<String, LabError> {
    let mut hash = Sha256::new();
    for path in paths.iter().filter(|path| path.is_file()) {
        let bytes =
            std::fs::read(path).map_err(|error| LabError::unsuitable(path.display(), error))?;
        hash.update((bytes.len() as u64).to_le_bytes());
        hash.update(&bytes);
    }
    Ok(data_encoding::HEXLOWER.encode(&hash.finalize()[..8]))
}

#[cfg(test)]
mod tests {
    use super::identity;

    #[test]
    fn a_scene_that_changes_is_another() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let scene = folder.path().join("garden.glb");
        let name = [scene.display().to_string()];
        std::fs::write(&scene, "one")?;
        let first = identity(&name)?;
        assert_eq!(identity(&name)?, first);
        std::fs::write(&scene, "two")?;
        let second = identity(&name)?;
        std::fs::write(folder.path().join("garden.views.json"), "{}")?;
        let third = identity(&name)?;
        assert!(first[1] != second[1] && second[1] != third[1] && first[0] == third[0]);
        // A procedural scene is what the command makes of it.
        assert_eq!(identity(&["hall".to_owned()])?.len(), 2);
        Ok(())
    }
}
