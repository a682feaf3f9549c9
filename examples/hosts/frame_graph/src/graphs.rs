//! The graphs that are drawn: the three examples of the library, two with two lights, and one with planes and mip levels.

use moment_shadows::Profile;
use moment_shadows_graph::{Capabilities, Graph, Plan, ResourceDesc};

use crate::error::HostError;

/// Names, and texts of graph files.
pub const ALL: [(&str, &str); 6] = [
    ("hard_shadows", include_str!("../../../hard_shadows.json")),
    ("soft_shadows", include_str!("../../../soft_shadows.json")),
    (
        "volumetric_scattering",
        include_str!("../../../volumetric_scattering.json"),
    ),
    ("two_lights", include_str!("../graphs/two_lights.json")),
    ("six_moments", include_str!("../graphs/six_moments.json")),
    ("two_layers", include_str!("../graphs/two_layers.json")),
];

/// Width and height of the light's maps and of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    pub map: [u32; 2],
    pub picture: [u32; 2],
}

impl Sizes {
    /// The size of an import.
    #[must_use]
    pub fn of(&self, import: &str) -> [u32; 2] {
        if import == "camera_depth" {
            self.picture
        } else {
            self.map
        }
    }
}

/// The plan of a graph file, for any device with core WebGPU.
pub fn compile(text: &str, sizes: Sizes) -> Result<Plan, HostError> {
    let graph: Graph = text.parse()?;
    let imports = graph.imports.iter().filter_map(|import| {
        let mut desc = import.value.clone()?;
        if let ResourceDesc::Texture(texture) = &mut desc {
            texture.size = sizes.of(&import.name);
        }
        Some((import.name.as_str(), desc))
    });
    let imports: Vec<_> = imports.collect();
    Ok(graph.compile(&Capabilities::of_profile(Profile::WebgpuCore), &imports)?)
}
