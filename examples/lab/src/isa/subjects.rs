//! The shaders of the table. A new node gets an entry in `nodes`; a test asks for one of every node type.

use std::collections::BTreeMap;

use moment_shadows::{
    LinkError, MapEncoding, PcfTaps, Profile, Source, Storage, Technique, TextureFormat, link,
};
use moment_shadows_graph::nodes::{
    Blur, BlurParameters, CompositeScattering, DebugMoments, Downsample, IntegrateScattering,
    Interpolation, KernelProperty, MipLevels, PlaceLayers, RectifyMoments, Resolve, ShadeHard,
    ShadeSoft, Show, SummedAreaTable,
};
use moment_shadows_graph::{Capabilities, Node, ResourceDesc, TextureDesc};

use super::described::describe;
use super::error::IsaError;
use crate::summed_area::naive;
use crate::techniques;

/// A shader that is compiled.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The name in the table.
    pub name: String,
    /// Linked WGSL. A fragment shader also has a vertex entry point named `fullscreen`.
    pub wgsl: String,
    /// The compute or fragment entry point.
    pub entry_point: String,
    /// Values of `override` constants.
    pub constants: BTreeMap<String, f64>,
    /// What an invocation makes.
    pub work: SubjectWork,
    /// Bytes of the widest texel that the shader reads or writes.
    pub texel_bytes: u32,
    /// How often each loop of the code runs, in the order in which they begin.
    pub trips: Vec<u32>,
}

/// What a subject's invocations make.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SubjectWork {
    /// Texels of a storage texture.
    Compute {
        /// Per workgroup.
        texels_per_workgroup: u32,
    },
    /// A pixel of each target.
    Fragment {
        /// Their formats.
        targets: Vec<TextureFormat>,
    },
}

/// A node with settings.
pub(super) struct Entry {
    /// What tells it apart from the same node with other settings.
    pub(super) settings: String,
    pub(super) node: Box<dyn Node>,
    pub(super) inputs: BTreeMap<String, ResourceDesc>,
    pub(super) capabilities: Capabilities,
    /// Of each of its passes.
    pub(super) trips: Vec<u32>,
    /// Of passes whose loops are others, by their labels.
    pub(super) pass_trips: BTreeMap<&'static str, Vec<u32>>,
}

/// Every shader of the table: the references first.
pub fn subjects() -> Result<Vec<Subject>, IsaError> {
    let mut subjects = vec![
        reference(
            "reference: one bilinear fetch",
            include_str!("reference/bilinear.wgsl"),
        )?,
        reference(
            "reference: Hamburger 4 (fetch, decoding, bias, leak reduction)",
            include_str!("reference/hamburger.wgsl"),
        )?,
    ];
    for (name, text) in [
        (
            "reference: summed-area table, nine rectangles",
            include_str!("reference/summed_area_interpolated.wgsl"),
        ),
        (
            "reference: summed-area table, whole texels",
            include_str!("reference/summed_area_plain.wgsl"),
        ),
    ] {
        subjects.push(Subject {
            texel_bytes: 16,
            ..reference(name, text)?
        });
    }
    for (name, text, entry_point) in naive::SHADERS {
        subjects.push(Subject {
            entry_point: entry_point.to_owned(),
            work: SubjectWork::Compute {
                texels_per_workgroup: naive::LINES * SIZE[0],
            },
            texel_bytes: 16,
            trips: vec![SIZE[0]],
            name: format!("reference: summed-area table, {name}"),
            wgsl: naive::linked(name, text).map_err(|error| IsaError::Shader {
                shader: name.to_owned(),
                reason: error.to_string(),
            })?,
            constants: BTreeMap::new(),
        });
    }
    for entry in nodes()? {
        subjects.extend(describe(&entry)?);
    }
    Ok(subjects)
}

/// The settings of every node, for every storage, and of what loops over regions and views for one.
pub(super) fn nodes() -> Result<Vec<Entry>, IsaError> {
    let mut entries = Vec::new();
    for storage in Storage::OF_FOUR_MOMENTS {
        for samples in [1, 4] {
            entries.push(resolve(storage, samples));
        }
        for radius in [4, 12, 32, 64] {
            entries.push(blur(storage, radius, 1)?);
        }
        entries.push(downsample(storage));
        entries.push(shade(storage, 1, 1, false));
        entries.push(shade(storage, MIPS, 1, false));
    }
    for storage in Storage::OF_FOUR_MOMENTS {
        entries.push(table(storage, false));
    }
    entries.push(table(Storage::Unorm16, true));
    for interpolation in [
        Interpolation::Both,
        Interpolation::Filter,
        Interpolation::Neither,
    ] {
        entries.push(shade_soft(Technique::Hamburger4, interpolation)?);
    }
    entries.push(shade_soft(Technique::Vsm, Interpolation::Filter)?);
    for technique in [Technique::Hamburger4, Technique::Hamburger6] {
        entries.extend(scattering(technique)?);
    }
    entries.push(place(1));
    entries.push(debug(Storage::Unorm16));
    // Other storages can be filtered everywhere.
    entries.push(shade(Storage::Float32, 1, 1, true));
    entries.push(blur(Storage::Unorm16, 4, MANY)?);
    entries.push(shade(Storage::Unorm16, 1, MANY, false));
    let mut encodings = techniques::filterable();
    encodings.retain(|encoding| *encoding.technique() != Technique::Hamburger4);
    // The storage that a native device would choose; others change how a texel is decoded.
    encodings.retain(|encoding| {
        encoding.technique().best_storage(Profile::Native) == Some(encoding.storage())
    });
    entries.extend(encodings.iter().map(of_technique));
    entries.extend(drawn()?);
    entries.extend(techniques::reading_depth().iter().map(reading_depth));
    Ok(entries)
}

/// Texels per side of all maps. The code does not depend on it.
pub(super) const SIZE: [u32; 2] = [1024, 1024];

/// Mip levels of a map that has them.
const MIPS: u32 = 6;

/// Regions of an atlas, and views of a node that has several.
const MANY: u32 = 4;

fn texture(format: TextureFormat) -> TextureDesc {
    TextureDesc::new(format, SIZE)
}

fn inputs<const N: usize>(textures: [(&str, TextureDesc); N]) -> BTreeMap<String, ResourceDesc> {
    textures
        .map(|(slot, texture)| (slot.to_owned(), ResourceDesc::Texture(texture)))
        .into()
}

fn native() -> Capabilities {
    Capabilities::of_profile(Profile::Native)
}

fn resolve(storage: Storage, samples: u32) -> Entry {
    let depth = TextureDesc {
        samples,
        ..texture(TextureFormat::Depth32Float)
    };
    let mip_levels = MipLevels::default();
    Entry {
        settings: format!("{storage}, {samples} samples"),
        node: Box::new(Resolve {
            technique: Technique::Hamburger4,
            storage,
            mip_levels,
        }),
        inputs: inputs([("depth", depth)]),
        capabilities: native(),
        trips: Vec::new(),
        pass_trips: BTreeMap::new(),
    }
}

fn blur(storage: Storage, radius: u32, regions: u32) -> Result<Entry, IsaError> {
    let kernel = KernelProperty {
        radius: Some(radius),
        ..KernelProperty::default()
    };
    let mut settings = format!("{storage}, radius {radius}");
    let mut trips = Vec::new();
    if regions > 1 {
        // A workgroup looks for its region; it may be the last.
        settings += &format!(", {regions} regions");
        trips.push(regions);
    }
    if radius > LARGEST_UNROLLED_RADIUS {
        let weights = kernel.kernel().map_err(|error| IsaError::Node {
            shader: settings.clone(),
            error,
        })?;
        trips.push(BlurParameters::new(&weights).blocks);
    }
    let moments = TextureDesc {
        regions,
        ..texture(storage.format())
    };
    Ok(Entry {
        settings,
        node: Box::new(Blur {
            kernel,
            per_frame: false,
            mip_levels: MipLevels::default(),
        }),
        inputs: inputs([("map", moments)]),
        capabilities: native(),
        trips,
        pass_trips: BTreeMap::new(),
    })
}

/// Up to this radius the blur has no loop.
const LARGEST_UNROLLED_RADIUS: u32 = 12;

fn downsample(storage: Storage) -> Entry {
    // Every level but the first has a pass with the same shader.
    let moments = TextureDesc {
        mips: 2,
        ..texture(storage.format())
    };
    Entry {
        settings: storage.to_string(),
        node: Box::new(Downsample),
        inputs: inputs([("map", moments)]),
        capabilities: native(),
        trips: Vec::new(),
        pass_trips: BTreeMap::new(),
    }
}

fn table(storage: Storage, software_adapter: bool) -> Entry {
    let tile = if software_adapter { [16, 16] } else { [8, 16] };
    // Tiles but the last, four or two at a time.
    let steps = |axis: usize, unrolled: u32| vec![(SIZE[axis] / tile[axis] - 1).div_ceil(unrolled)];
    Entry {
        settings: format!("{storage}, tiles of {}x{}", tile[0], tile[1]),
        node: Box::new(SummedAreaTable::default()),
        inputs: inputs([("map", texture(storage.format()))]),
        capabilities: Capabilities {
            software_adapter,
            ..native()
        },
        // Rows of a tile.
        trips: vec![tile[1]],
        pass_trips: BTreeMap::from([("sum rows", steps(0, 4)), ("sum columns", steps(1, 2))]),
    }
}

fn place(samples: u32) -> Entry {
    let depth = TextureDesc {
        samples,
        ..texture(TextureFormat::Depth32Float)
    };
    let node = PlaceLayers::default();
    // Splits of layers of equal depth, where there is no state yet; parts of a tile, or tiles per invocation; halvings of a
    // workgroup's sums.
    let sum = vec![3, 4, 8];
    // And for either of two splits the others that it may pass, in front and behind.
    let step = [&sum[..], &[2, 2, 2, 2]].concat();
    Entry {
        settings: format!("{} layers, {samples} samples", node.layers),
        node: Box::new(node),
        inputs: inputs([("depth", depth)]),
        capabilities: native(),
        trips: Vec::new(),
        pass_trips: BTreeMap::from([("sum tiles", sum), ("step splits", step)]),
    }
}

fn debug(storage: Storage) -> Entry {
    Entry {
        settings: storage.to_string(),
        node: Box::new(DebugMoments {
            show: Show::Validity,
            level: 0,
        }),
        inputs: inputs([("map", texture(storage.format()))]),
        capabilities: native(),
        trips: Vec::new(),
        pass_trips: BTreeMap::new(),
    }
}

fn shade(storage: Storage, mips: u32, views: u32, float32_filterable: bool) -> Entry {
    let node = ShadeHard {
        views,
        ..ShadeHard::default()
    };
    let mut settings = storage.to_string();
    let sampled = storage != Storage::Float32 || float32_filterable;
    settings += if sampled { ", sampled" } else { ", loaded" };
    let mut trips = Vec::new();
    if views > 1 {
        settings += &format!(", {views} views");
        trips.push(views);
    }
    if mips > 1 {
        settings += ", mip levels";
        // Each of at most so many probes looks for the coarsest level with texels: the last one, in a large region.
        trips.extend([u32::from(node.anisotropy), 1]);
    }
    let moments = TextureDesc {
        mips,
        ..texture(storage.format())
    };
    Entry {
        settings,
        node: Box::new(node),
        inputs: inputs([
            ("map", moments),
            ("camera_depth", texture(TextureFormat::Depth32Float)),
        ]),
        capabilities: Capabilities {
            float32_filterable,
            ..native()
        },
        trips,
        pass_trips: BTreeMap::new(),
    }
}

/// Soft shadows from the table of a float32 map.
fn shade_soft(technique: Technique, interpolation: Interpolation) -> Result<Entry, IsaError> {
    let settings = format!(
        "{technique}, {} interpolated",
        match interpolation {
            Interpolation::Both => "search and filter",
            Interpolation::Filter => "filter",
            Interpolation::Neither => "nothing",
        }
    );
    let refused = |reason: String| IsaError::Shader {
        shader: settings.clone(),
        reason,
    };
    let table = moment_shadows::SummedAreaTable::new(Storage::Float32, [65, 65])
        .map_err(|error| refused(error.to_string()))?;
    let encoding =
        MapEncoding::of_table(technique, table).map_err(|error| refused(error.to_string()))?;
    Ok(Entry {
        settings,
        node: Box::new(ShadeSoft {
            interpolation,
            ..ShadeSoft::default()
        }),
        inputs: inputs([
            ("table", TextureDesc::of_map(encoding, SIZE)),
            ("camera_depth", texture(TextureFormat::Depth32Float)),
        ]),
        capabilities: native(),
        // The loop over the only view, which a compiler unrolls unless it is long.
        trips: vec![1],
        pass_trips: BTreeMap::new(),
    })
}

/// Single scattering in the portable storage, from a map of four moments in it.
fn scattering(technique: Technique) -> Result<Vec<Entry>, IsaError> {
    let storage = Storage::Float16;
    let label = techniques::label(&technique);
    let encoding =
        MapEncoding::new(technique.clone(), storage).map_err(|error| IsaError::Shader {
            shader: label.clone(),
            reason: error.to_string(),
        })?;
    let entry = |kind: &str, node: Box<dyn Node>, slot, map, software_adapter, trips| Entry {
        settings: format!("{label}, {storage}{kind}"),
        node,
        inputs: inputs([
            (slot, map),
            ("camera_depth", texture(TextureFormat::Depth32Float)),
        ]),
        capabilities: Capabilities {
            software_adapter,
            ..native()
        },
        trips,
        pass_trips: BTreeMap::new(),
    };
    let map = TextureDesc::of_map(encoding, SIZE);
    let rectify = RectifyMoments {
        technique,
        storage,
        extent: SIZE,
    };
    let source = texture(storage.format());
    let integrate = || Box::new(IntegrateScattering);
    // Shared memory that is cleared; 512 columns at a time, with six steps of the scan.
    let parallel = vec![64, SIZE[0] / 512, 6];
    Ok(vec![
        entry("", Box::new(rectify), "map", source, false, Vec::new()),
        entry("", integrate(), "rectified", map.clone(), false, parallel),
        entry(
            ", row by row",
            integrate(),
            "rectified",
            map.clone(),
            true,
            // Four columns at a time.
            vec![SIZE[0] / 4],
        ),
        entry(
            "",
            Box::<CompositeScattering>::default(),
            "integrated",
            map,
            false,
            Vec::new(),
        ),
    ])
}

/// Shading with another technique's map.
fn of_technique(encoding: &MapEncoding) -> Entry {
    Entry {
        settings: format!(
            "{}, {}",
            techniques::label(encoding.technique()),
            encoding.storage()
        ),
        node: Box::new(ShadeHard::default()),
        inputs: inputs([
            ("map", TextureDesc::of_map(encoding.clone(), SIZE)),
            ("camera_depth", texture(TextureFormat::Depth32Float)),
        ]),
        capabilities: Capabilities {
            float32_filterable: true,
            ..native()
        },
        trips: trips(encoding.technique()),
        pass_trips: BTreeMap::new(),
    }
}

/// What makes and reads a map that is drawn.
fn drawn() -> Result<Vec<Entry>, IsaError> {
    let (technique, storage) = (Technique::Hamburger6, Storage::Unorm10);
    let encoding =
        MapEncoding::new(technique.clone(), storage).map_err(|error| IsaError::Shader {
            shader: techniques::label(&technique),
            reason: error.to_string(),
        })?;
    let map = TextureDesc::of_map(encoding.clone(), SIZE);
    let levels = TextureDesc {
        mips: 2,
        ..map.clone()
    };
    let entry =
        |settings: &str, node: Box<dyn Node>, slot: &str, given: TextureDesc, trips| Entry {
            settings: format!("{encoding}{settings}"),
            node,
            inputs: inputs([(slot, given)]),
            capabilities: native(),
            trips,
            pass_trips: BTreeMap::new(),
        };
    let resolve = Resolve {
        technique,
        storage,
        mip_levels: MipLevels::default(),
    };
    let blur = |radius| Blur {
        kernel: KernelProperty {
            radius: Some(radius),
            ..KernelProperty::default()
        },
        per_frame: false,
        mip_levels: MipLevels::default(),
    };
    let depth = texture(TextureFormat::Depth32Float);
    Ok(vec![
        // One region, which is looked for.
        entry("", Box::new(resolve), "depth", depth, vec![1]),
        entry(", radius 4", Box::new(blur(4)), "map", map.clone(), vec![1]),
        // A loop over all taps.
        entry(", radius 32", Box::new(blur(32)), "map", map, vec![65]),
        entry("", Box::new(Downsample), "map", levels, vec![1]),
        of_technique(&encoding),
    ])
}

/// Shading with the plain depth map.
fn reading_depth(technique: &Technique) -> Entry {
    let node = ShadeHard {
        technique: Some(technique.clone()),
        ..ShadeHard::default()
    };
    Entry {
        settings: techniques::label(technique),
        node: Box::new(node),
        inputs: inputs([
            ("depth", texture(TextureFormat::Depth32Float)),
            ("camera_depth", texture(TextureFormat::Depth32Float)),
        ]),
        capabilities: native(),
        trips: trips(technique),
        pass_trips: BTreeMap::new(),
    }
}

/// How often the loops of a technique's evaluation run that the driver does not unroll.
fn trips(technique: &Technique) -> Vec<u32> {
    match technique {
        // The split in front of the fragment is searched for, at most through all of them.
        Technique::Lvsm { layers, .. } => vec![layers - 1],
        // Rows, one more where results are blended; the few columns of small kernels are unrolled.
        Technique::Pcf(PcfTaps::Box { radius }) => vec![2 * radius + 2],
        Technique::Pcf(PcfTaps::Gaussian { radius, .. }) => vec![2 * radius + 2; 2],
        Technique::Pcf(PcfTaps::Weights(weights)) => vec![weights.len() as u32 + 1],
        Technique::Pcf(PcfTaps::Hardware { radius, .. }) => vec![2 * radius + 1],
        Technique::Pcf(PcfTaps::Poisson { .. }) => vec![16],
        Technique::Pcss(taps) => vec![taps.search_taps, taps.filter_taps],
        _ => Vec::new(),
    }
}

/// A shader that stands alone, with a target of 16 bits per channel.
fn reference(name: &str, text: &str) -> Result<Subject, IsaError> {
    let fullscreen = Source {
        name: "fullscreen",
        text: include_str!("reference/fullscreen.wgsl"),
    };
    let linked = link(Source { name, text }, &[fullscreen]).map_err(|error: LinkError| {
        IsaError::Shader {
            shader: name.to_owned(),
            reason: error.to_string(),
        }
    })?;
    Ok(Subject {
        name: name.to_owned(),
        wgsl: linked.into_wgsl(),
        entry_point: "shade".to_owned(),
        constants: BTreeMap::new(),
        work: SubjectWork::Fragment {
            targets: vec![TextureFormat::Rgba16Float],
        },
        texel_bytes: 8,
        trips: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use moment_shadows_graph::NodeRegistry;

    use super::*;

    #[test]
    fn every_node_type_is_in_the_list_and_every_name_once() -> Result<(), IsaError> {
        let subjects = subjects()?;
        let names: BTreeSet<&str> = subjects
            .iter()
            .map(|subject| subject.name.as_str())
            .collect();
        assert_eq!(names.len(), subjects.len());
        for node in NodeRegistry::new().type_names() {
            let begins = |name: &&str| name.starts_with(&format!("{node}, "));
            assert!(names.iter().any(begins), "no shader of '{node}'");
        }
        Ok(())
    }

    #[test]
    fn a_subject_knows_its_outputs_its_texels_and_its_loops() -> Result<(), IsaError> {
        let subjects = subjects()?;
        let find = |name: &str| subjects.iter().find(|subject| subject.name == name);
        let blur = find("blur, float32, radius 64: blur along x");
        let blur = blur.map(|blur| (&blur.work, blur.texel_bytes, &blur.trips));
        let expected = SubjectWork::Compute {
            // 64 invocations of 16 texels.
            texels_per_workgroup: 1024,
        };
        // 128 + 16 taps in blocks of 16.
        assert_eq!(blur, Some((&expected, 16, &vec![9])));
        let shade = find("shade_hard, unorm16, sampled: shade");
        let shade = shade.map(|shade| (&shade.work, shade.texel_bytes));
        let expected = SubjectWork::Fragment {
            targets: vec![TextureFormat::R8Unorm],
        };
        assert_eq!(shade, Some((&expected, 8)));
        Ok(())
    }
}
