//! The one list of the library's nodes, with every setting that changes the text or the cost of their shaders.
//!
//! `moment-shadows-lab shaders`, `moment-shadows-lab isa` and the tests go through it. A new node adds its variants to the file of
//! its stage: each variant may be a file of shaders, of whose passes some are kept as snapshots, and a row of the ISA table.

mod air;
mod map;
mod shade;

use std::collections::BTreeMap;

use moment_shadows::{LayerSplits, MapEncoding, Profile, Storage, Technique, TextureFormat};
use moment_shadows_graph::{Capabilities, Connected, Node, NodeDesc, ResourceDesc, TextureDesc};

use crate::error::LabError;
use crate::techniques;

/// Texels per side of all textures. Shaders do not depend on it, but how often some loops run does.
pub const SIZE: [u32; 2] = [1024, 1024];

/// What ranges are named by.
const RANGES: &str = "fit.ranges";

/// A node with settings, and what is connected to it.
pub struct Variant {
    node: Box<dyn Node>,
    /// The map of moments, or the table of one.
    map: TextureDesc,
    /// Samples per texel of the depth maps of light and camera.
    samples: u32,
    /// The format of the light's depth map.
    depth: TextureFormat,
    /// Normals, if there are any.
    normals: Option<TextureFormat>,
    /// What maps say of shadows, if anything.
    intensity: Option<TextureFormat>,
    /// Whether the camera's depth is connected.
    camera: bool,
    /// Whether the input for ranges is connected.
    fitted: bool,
    /// Whether the input for view rays is connected.
    view_rays: bool,
    capabilities: Capabilities,
    /// The beginning of the names of its files, if it has any.
    pub file: Option<String>,
    /// Files whose text is kept as a snapshot, from the first on. What is left out differs by a constant or repeats lines.
    pub kept: usize,
    /// Its rows of the ISA table, if it has any.
    pub row: Option<Row>,
}

/// What the ISA table says and needs of a variant.
pub struct Row {
    /// The settings in the row's name.
    pub settings: String,
    /// How often each loop of the code runs, in the order in which they begin, by the label of the pass; without a label
    /// for all other passes.
    trips: Vec<(&'static str, Vec<u32>)>,
}

impl Row {
    /// How often the loops of a pass run.
    #[must_use]
    pub fn trips(&self, pass: &str) -> &[u32] {
        let of = |label: &str| self.trips.iter().find(|(name, _)| *name == label);
        of(pass).or_else(|| of("")).map_or(&[], |(_, trips)| trips)
    }
}

impl Variant {
    /// A node that is connected to a map with one level and region, and to a depth map with one sample, on the least
    /// demanding profile that can write the map.
    fn new(node: impl Node + 'static, map: &MapEncoding) -> Self {
        Self {
            node: Box::new(node),
            map: TextureDesc::of_map(map.clone(), SIZE),
            samples: 1,
            depth: TextureFormat::Depth32Float,
            normals: None,
            intensity: None,
            camera: true,
            fitted: false,
            view_rays: false,
            capabilities: Capabilities::of_profile(profile(map)),
            file: None,
            kept: 0,
            row: None,
        }
    }

    /// Connects the node to this map, or table, on the same profile.
    fn connected(mut self, map: &MapEncoding) -> Self {
        self.map = TextureDesc::of_map(map.clone(), SIZE);
        self
    }

    /// Samples per texel of the depth maps.
    fn samples(self, samples: u32) -> Self {
        Self { samples, ..self }
    }

    /// The format of the light's depth map.
    fn depth(self, depth: TextureFormat) -> Self {
        Self { depth, ..self }
    }

    /// Connects normals of this format.
    fn normals(self, format: TextureFormat) -> Self {
        let normals = Some(format);
        Self { normals, ..self }
    }

    /// Connects what maps say of shadows, in this format.
    fn intensity(self, format: TextureFormat) -> Self {
        let intensity = Some(format);
        Self { intensity, ..self }
    }

    /// Leaves the camera's depth out.
    fn without_camera(self) -> Self {
        let camera = false;
        Self { camera, ..self }
    }

    /// Connects ranges, to which the depths of the map are fitted.
    fn fitted(mut self) -> Self {
        self.map.range = Some(RANGES.to_owned());
        self.fitted = true;
        self
    }

    /// Connects what is known of the picture's view rays.
    fn view_rays(self) -> Self {
        let view_rays = true;
        Self { view_rays, ..self }
    }

    fn mips(mut self, mips: u32) -> Self {
        self.map.mips = mips;
        self
    }

    fn regions(mut self, regions: u32) -> Self {
        self.map.regions = regions;
        self
    }

    fn on(mut self, change: impl FnOnce(&mut Capabilities)) -> Self {
        change(&mut self.capabilities);
        self
    }

    /// Files with names that begin with this, and end with whether there are several regions; the first ones are kept.
    fn file(mut self, name: impl Into<String>, kept: impl Into<usize>) -> Self {
        let many = if self.map.regions > 1 { "_regions" } else { "" };
        self.file = Some(name.into() + many);
        self.kept = kept.into();
        self
    }

    /// A row with these settings, if it is listed; loops of passes that are not named next run so often.
    fn row(mut self, listed: bool, settings: impl Into<String>, trips: &[u32]) -> Self {
        self.row = listed.then(|| Row {
            settings: settings.into(),
            trips: vec![("", trips.to_vec())],
        });
        self
    }

    /// How often the loops of the pass with this label run.
    fn pass(mut self, label: &'static str, trips: &[u32]) -> Self {
        if let Some(row) = &mut self.row {
            row.trips.push((label, trips.to_vec()));
        }
        self
    }

    /// The profile that it is for.
    #[must_use]
    pub fn profile(&self) -> Profile {
        self.capabilities.profile
    }

    /// What the node says of itself.
    pub fn describe(&self) -> Result<NodeDesc, LabError> {
        let row = || self.row.as_ref().map(|row| row.settings.clone());
        self.node
            .describe(&Connected::new(&self.inputs(), &self.capabilities))
            .map_err(|error| {
                let name = self.file.clone().or_else(row).unwrap_or_default();
                LabError::unsuitable(format!("the variant '{name}' of a node"), error)
            })
    }

    /// Whatever nodes take, by the names that their slots have.
    #[must_use]
    pub fn inputs(&self) -> BTreeMap<String, ResourceDesc> {
        let depth = TextureDesc {
            samples: self.samples,
            regions: self.map.regions,
            ..TextureDesc::new(self.depth, SIZE)
        };
        let splits = TextureDesc::new(TextureFormat::Rgba32Float, [2, 1]);
        let ranges = self.fitted.then(|| TextureDesc {
            range: self.map.range.clone(),
            ..TextureDesc::new(TextureFormat::Rgba32Float, [self.map.regions, 1])
        });
        let view_rays = (self.view_rays).then(|| TextureDesc::new(TextureFormat::Rg32Uint, SIZE));
        let camera = self.camera.then(|| TextureDesc {
            samples: self.samples,
            ..TextureDesc::new(TextureFormat::Depth32Float, SIZE)
        });
        let normals = self.normals.map(|format| TextureDesc::new(format, SIZE));
        let normals = normals.iter().map(|desc| ("normals", desc));
        let intensity = self.intensity.map(|format| TextureDesc::new(format, SIZE));
        let intensity = intensity.iter().map(|desc| ("intensity", desc));
        let marched = TextureDesc::new(TextureFormat::Rgba16Float, SIZE.map(|side| side / 2));
        let map = ["map", "table", "rectified", "integrated"].map(|name| (name, &self.map));
        map.into_iter()
            .chain([
                ("depth", &depth),
                ("splits", &splits),
                ("scattering", &marched),
            ])
            .chain(camera.iter().map(|desc| ("camera_depth", desc)))
            .chain(normals)
            .chain(intensity)
            .chain(ranges.iter().map(|desc| ("ranges", desc)))
            .chain(view_rays.iter().map(|desc| ("view_rays", desc)))
            .map(|(name, desc)| (name.to_owned(), ResourceDesc::Texture(desc.clone())))
            .collect()
    }
}

/// The least demanding profile that can write a map: as a storage texture, or by drawing where it is drawn.
fn profile(map: &MapEncoding) -> Profile {
    let writes = |profile: &Profile| {
        let support = map.format().support(*profile);
        if map.storage().is_drawn() {
            support.renderable
        } else {
            support.storage_write
        }
    };
    let least = Profile::ALL.into_iter().find(writes);
    least.unwrap_or(Profile::NativeAdapter)
}

/// Whether the texts for another technique's map are kept: where its row evaluates by more than one call, and once for all storages,
/// which change a constant.
fn is_kept(map: &MapEncoding) -> bool {
    let is_first = matches!(map.storage(), Storage::Float32 | Storage::Unorm8);
    let row = map.technique().row();
    (is_first || row.places_layers) && row.technique().contains("let ")
}

/// Every node with its variants: all that four moments allow in every storage, what works on plain depth, and what the
/// maps of other techniques change.
pub fn variants() -> Result<Vec<Variant>, LabError> {
    let mut all = Vec::new();
    for storage in Storage::OF_FOUR_MOMENTS {
        let four = MapEncoding::new(Technique::Hamburger4, storage)?;
        all.extend(map::of_four_moments(&four)?);
        all.extend(shade::of_four_moments(&four)?);
        all.extend(air::of_storage(&four)?);
    }
    let any = MapEncoding::new(Technique::Hamburger4, Storage::Float16)?;
    all.extend(air::of_eight_bits(&any)?);
    all.extend(air::marched(&any)?);
    all.extend(shade::of_depth(&any));
    all.extend(map::of_depth(&any));
    all.extend(shade::contacts(&any));
    let mut encodings = techniques::filterable();
    let is_done =
        |it: &MapEncoding| *it.technique() == Technique::Hamburger4 && !it.storage().is_packed();
    encodings.retain(|encoding| !is_done(encoding));
    let lloyd = Technique::Lvsm {
        layers: 4,
        overlap: Default::default(),
        splits: LayerSplits::Lloyd,
    };
    encodings.push(MapEncoding::new(lloyd, Storage::Unorm16)?);
    for encoding in &encodings {
        all.extend(shade::of_technique(encoding));
        all.extend(map::of_technique(encoding));
        all.extend(shade::of_series(encoding));
    }
    all.retain(|variant| variant.file.is_some() || variant.row.is_some());
    Ok(all)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use moment_shadows_graph::NodeRegistry;

    use super::*;

    #[test]
    fn every_node_type_has_a_file_and_a_row() -> Result<(), LabError> {
        let (mut files, mut rows) = (BTreeSet::new(), BTreeSet::new());
        for variant in variants()? {
            let node = variant.describe()?.name;
            if variant.file.is_some() {
                files.insert(node.clone());
            }
            if variant.row.is_some() {
                rows.insert(node);
            }
        }
        let registry = NodeRegistry::new();
        // The host draws it.
        let drawn = |name: &&str| *name != "translucent_casters";
        let nodes = registry.type_names().filter(drawn);
        let nodes: BTreeSet<String> = nodes.map(str::to_owned).collect();
        assert_eq!(files, nodes, "add a variant with a file to the catalogue");
        assert_eq!(rows, nodes, "add a variant with a row to the catalogue");
        Ok(())
    }
}
