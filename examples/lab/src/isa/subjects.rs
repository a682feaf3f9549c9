//! The shaders of the table. A new node gets an entry in [`nodes`]; a test asks for one of every node type.

use std::collections::BTreeMap;

use moment_shadows::{LinkError, Profile, Source, Storage, TextureFormat, link};
use moment_shadows_graph::nodes::{
    BlurMoments, BlurParameters, DownsampleMoments, KernelProperty, MipLevels, ResolveMoments,
    ShadeHard,
};
use moment_shadows_graph::{Capabilities, Node, ResourceDesc, TextureDesc};

use super::described::describe;
use super::error::IsaError;

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
}

/// Every shader of the table: the references first.
pub fn subjects() -> Result<Vec<Subject>, IsaError> {
    let mut subjects = vec![
        reference(
            "reference: one bilinear fetch",
            include_str!("reference/bilinear.wgsl"),
        )?,
        reference(
            "reference: Hamburger 4 with one fetch, dequantisation, bias and leak reduction",
            include_str!("reference/hamburger.wgsl"),
        )?,
    ];
    for entry in nodes()? {
        subjects.extend(describe(&entry)?);
    }
    Ok(subjects)
}

/// The settings of every node, for every storage.
fn nodes() -> Result<Vec<Entry>, IsaError> {
    let mut entries = Vec::new();
    for storage in Storage::ALL {
        for samples in [1, 4] {
            entries.push(resolve(storage, samples));
        }
        for radius in [4, 12, 32, 64] {
            entries.push(blur(storage, radius)?);
        }
        entries.push(downsample(storage));
        for mips in [1, 10] {
            entries.push(shade(storage, false, mips));
            // Other storages can be filtered everywhere.
            if storage == Storage::Float32 {
                entries.push(shade(storage, true, mips));
            }
        }
    }
    Ok(entries)
}

/// Texels per side of all maps. The code does not depend on it.
const SIZE: [u32; 2] = [1024, 1024];

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
    Entry {
        settings: format!("{storage}, {samples} samples"),
        node: Box::new(ResolveMoments {
            storage,
            mip_levels: MipLevels::default(),
        }),
        inputs: inputs([("depth", depth)]),
        capabilities: native(),
        trips: Vec::new(),
    }
}

fn blur(storage: Storage, radius: u32) -> Result<Entry, IsaError> {
    let kernel = KernelProperty {
        radius: Some(radius),
        ..KernelProperty::default()
    };
    let settings = format!("{storage}, radius {radius}");
    let blocks = kernel
        .kernel()
        .map(|kernel| BlurParameters::new(&kernel).blocks)
        .map_err(|error| IsaError::Node {
            shader: settings.clone(),
            error,
        })?;
    Ok(Entry {
        settings,
        node: Box::new(BlurMoments {
            kernel,
            per_frame: false,
            mip_levels: MipLevels::default(),
        }),
        inputs: inputs([("moments", texture(storage.format()))]),
        capabilities: native(),
        // Up to radius 12 all is unrolled.
        trips: if radius > 12 {
            vec![blocks]
        } else {
            Vec::new()
        },
    })
}

/// One mip level: the same code makes all.
fn downsample(storage: Storage) -> Entry {
    let moments = TextureDesc {
        mips: 2,
        ..texture(storage.format())
    };
    Entry {
        settings: storage.to_string(),
        node: Box::new(DownsampleMoments::default()),
        inputs: inputs([("moments", moments)]),
        capabilities: native(),
        trips: Vec::new(),
    }
}

fn shade(storage: Storage, float32_filterable: bool, mips: u32) -> Entry {
    let lookup = if storage == Storage::Float32 && !float32_filterable {
        "loaded"
    } else {
        "sampled"
    };
    Entry {
        settings: match mips {
            1 => format!("{storage}, {lookup}"),
            _ => format!("{storage}, {lookup}, mip levels"),
        },
        node: Box::new(ShadeHard::default()),
        inputs: inputs([
            (
                "moments",
                TextureDesc {
                    mips,
                    ..texture(storage.format())
                },
            ),
            ("camera_depth", texture(TextureFormat::Depth32Float)),
        ]),
        capabilities: Capabilities {
            float32_filterable,
            ..native()
        },
        trips: Vec::new(),
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
