//! What is drawn for a graph: what its file says of its imports, unless a flag says otherwise.

use std::fmt;

use moment_shadows::TextureFormat;
use moment_shadows_graph::TextureDesc;
use serde::Serialize;

use super::render::RenderOptions;
use crate::error::LabError;
use crate::graph_file::GraphFile;

/// Sizes, samples and formats of what the host draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Drawn {
    /// Width and height of the light's map.
    pub map: [u32; 2],
    /// Samples per texel of the light's depth.
    pub samples: u32,
    /// The format of the light's depth.
    pub format: TextureFormat,
    /// Width and height of the picture.
    pub picture: [u32; 2],
    /// Samples per pixel of the camera's depth. Truths are of pixels' middles.
    pub camera_samples: u32,
    /// The format of the camera's depth.
    pub camera_format: TextureFormat,
}

impl Default for Drawn {
    /// What is drawn where nothing is said.
    fn default() -> Self {
        Self {
            map: [1024; 2],
            samples: 4,
            format: TextureFormat::Depth32Float,
            picture: [1280, 720],
            camera_samples: 1,
            camera_format: TextureFormat::Depth32Float,
        }
    }
}

impl RenderOptions {
    /// What is drawn for a graph. A technique that reads the plain depth map gets one sample per texel.
    pub fn drawn(&self, file: &GraphFile) -> Result<Drawn, LabError> {
        let mut drawn = Drawn::default();
        if let Some(light) = drawable(file, "light_depth")? {
            (drawn.map, drawn.samples, drawn.format) = (light.size, light.samples, light.format);
        }
        if let Some(camera) = drawable(file, "camera_depth")? {
            (drawn.picture, drawn.camera_samples) = (camera.size, camera.samples);
            drawn.camera_format = camera.format;
        }
        drawn = self.sized(drawn);
        drawn.samples = file.samples(drawn.samples);
        if file.reads_depth() && self.samples.is_some_and(|samples| samples != drawn.samples) {
            return Err(file.unsuitable(
                "its technique reads the plain depth map, which has one sample per texel; leave out --samples",
            ));
        }
        Ok(drawn)
    }

    /// What is drawn, where flags do not say otherwise.
    #[must_use]
    pub fn sized(&self, otherwise: Drawn) -> Drawn {
        Drawn {
            map: self.map.map_or(otherwise.map, |side| [side; 2]),
            samples: self.samples.unwrap_or(otherwise.samples),
            picture: self.size.unwrap_or(otherwise.picture),
            ..otherwise
        }
    }
}

/// What a file says of an import, if the host can draw it: one view of one light, and of one camera.
fn drawable(file: &GraphFile, name: &str) -> Result<Option<TextureDesc>, LabError> {
    let Some(desc) = file.import(name) else {
        return Ok(None);
    };
    let one = [
        ("layers", desc.layers),
        ("regions", desc.regions),
        ("mip levels", desc.mips),
    ];
    if let Some((what, count)) = one.into_iter().find(|(_, count)| *count != 1) {
        return Err(file.unsuitable(format!(
            "its import '{name}' has {count} {what}, but what is drawn here is one view of one light: give the import one"
        )));
    }
    Ok(Some(desc.clone()))
}

impl fmt::Display for Drawn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [[width, height], [columns, rows]] = [self.map, self.picture];
        let counted = |samples: u32| match samples {
            1 => "1 sample".to_owned(),
            _ => format!("{samples} samples"),
        };
        let (format, samples) = (self.format, counted(self.samples));
        write!(
            f,
            "map {width}x{height} of {format} with {samples} per texel, picture {columns}x{rows}"
        )?;
        let usual = Self::default();
        let (format, samples) = (self.camera_format, self.camera_samples);
        if (format, samples) != (usual.camera_format, usual.camera_samples) {
            let samples = counted(samples);
            write!(f, " from {format} with {samples} per pixel")?;
        }
        Ok(())
    }
}
