//! The shaders of every node, in every variant that changes their text.

use std::collections::BTreeMap;

use moment_shadows::{LayerSplits, MapEncoding, Profile, Storage, Technique, TextureFormat};
use moment_shadows_graph::nodes::{
    Blur, CompositeScattering, DebugMoments, Downsample, IntegrateScattering, Interpolation,
    KernelProperty, MipLevels, PlaceLayers, RectifyMoments, Resolve, ShadeHard, ShadeSoft, Show,
    SummedAreaTable,
};
use moment_shadows_graph::{
    Capabilities, Connected, Direction, Node, Pass, ResourceDesc, TextureDesc,
};

use super::{Kind, Shader, ShadersError};
use crate::techniques;

/// A pass of a variant of a node.
#[derive(Clone, Debug)]
pub struct NodeShader {
    /// The node's name, by which the registry knows it.
    pub node: String,
    /// The names of the slots that edges lead to or from.
    pub slots: Vec<String>,
    /// Its linked text.
    pub shader: Shader,
}

/// A node with what changes its text.
struct Variant {
    name: String,
    node: Box<dyn Node>,
    /// Samples per texel of the depth map.
    samples: u32,
    /// Mip levels of the map of moments.
    mips: u32,
    /// Regions of a layer of either.
    regions: u32,
    /// How the map is encoded.
    encoding: Option<MapEncoding>,
    capabilities: Capabilities,
}

impl Variant {
    /// A node between maps of one sample, level and region.
    fn new(name: String, node: impl Node + 'static, capabilities: &Capabilities) -> Self {
        Self {
            name,
            node: Box::new(node),
            samples: 1,
            mips: 1,
            regions: 1,
            encoding: None,
            capabilities: capabilities.clone(),
        }
    }
}

/// Every node with its variants, for one storage. A new node is added here; a test asks for one variant at least of each
/// node in the registry.
fn variants(storage: Storage, capabilities: &Capabilities) -> Vec<Variant> {
    let mut variants = Vec::new();
    for (samples, regions) in [(1, 1), (2, 1), (4, 1), (8, 1), (4, 16)] {
        let node = Resolve {
            technique: Technique::Hamburger4,
            storage,
            mip_levels: MipLevels::default(),
        };
        let name = format!("resolve_{storage}_{samples}{}", suffix(regions));
        variants.push(Variant {
            samples,
            regions,
            ..Variant::new(name, node, capabilities)
        });
    }
    for (kind, radius, per_frame, regions) in [
        ("unrolled", 1, false, 1),
        ("unrolled_radius_4", 4, false, 1),
        ("unrolled_radius_12", 12, false, 1),
        ("unrolled_radius_12", 12, false, 16),
        // The weights are parameters: one text for every radius.
        ("uniform", 1, true, 1),
        ("uniform", 1, true, 16),
    ] {
        let node = Blur {
            kernel: KernelProperty::gaussian(radius, 0.6 * radius as f32),
            per_frame,
            mip_levels: MipLevels::default(),
        };
        let name = format!("blur_{kind}_{storage}{}", suffix(regions));
        variants.push(Variant {
            regions,
            ..Variant::new(name, node, capabilities)
        });
    }
    for regions in [1, 16] {
        let name = format!("downsample_{storage}{}", suffix(regions));
        variants.push(Variant {
            mips: 4,
            regions,
            ..Variant::new(name, Downsample, capabilities)
        });
    }
    for (name, show) in [
        ("moments", Show::Moments),
        ("mean", Show::Mean),
        ("deviation", Show::Deviation),
        ("validity", Show::Validity),
    ] {
        let name = format!("debug_moments_{storage}_{name}");
        variants.push(Variant::new(
            name,
            DebugMoments { show, level: 0 },
            capabilities,
        ));
    }
    variants.extend(summing(storage, capabilities));
    variants.extend(shading(storage, capabilities));
    variants.extend(soft_shading(storage, capabilities));
    variants.extend(scattering(storage, capabilities));
    variants
}

/// Summed-area tables with both tiles, of four moments and of two.
fn summing(storage: Storage, capabilities: &Capabilities) -> Vec<Variant> {
    let software = Capabilities {
        software_adapter: true,
        ..capabilities.clone()
    };
    let variance = MapEncoding::new(Technique::Vsm, storage).ok();
    [
        ("", capabilities, None, 1),
        ("_software", &software, None, 1),
        ("", capabilities, None, 16),
        ("_vsm", capabilities, variance, 1),
    ]
    .into_iter()
    .map(|(kind, capabilities, encoding, regions)| Variant {
        regions,
        encoding,
        ..Variant::new(
            format!("summed_area_table{kind}_{storage}{}", suffix(regions)),
            SummedAreaTable::default(),
            capabilities,
        )
    })
    .collect()
}

/// Shading with a lookup by the sampler and in the shader, with and without mip levels, for one light and for several.
fn shading(storage: Storage, capabilities: &Capabilities) -> Vec<Variant> {
    let mut all = vec![("", capabilities.clone())];
    if storage == Storage::Float32 {
        let filterable = Capabilities {
            float32_filterable: true,
            ..capabilities.clone()
        };
        all.push(("_filterable", filterable));
    }
    let mut variants = Vec::new();
    for (kind, capabilities) in all {
        for (levels, mips) in [("", 1), ("_mips", 4)] {
            for (views, lights) in [(1, 1), (6, 2)] {
                let node = ShadeHard {
                    lights,
                    views,
                    ..ShadeHard::default()
                };
                let many = if views > 1 { "_views" } else { "" };
                let name = format!("shade_hard_{storage}{kind}{levels}{many}");
                variants.push(Variant {
                    mips,
                    ..Variant::new(name, node, &capabilities)
                });
            }
        }
    }
    variants
}

/// Soft shadows from a table of a map: all ways to look it up, two moments, several lights.
fn soft_shading(storage: Storage, capabilities: &Capabilities) -> Vec<Variant> {
    let table = |technique| {
        let table = moment_shadows::SummedAreaTable::new(storage, [65, 65]).ok()?;
        MapEncoding::of_table(technique, table).ok()
    };
    let four = table(Technique::Hamburger4);
    let shade = |interpolation| ShadeSoft {
        interpolation,
        ..ShadeSoft::default()
    };
    let lights = ShadeSoft {
        lights: 2,
        views: 6,
        ..ShadeSoft::default()
    };
    [
        ("", shade(Interpolation::Filter), four.clone()),
        ("_both", shade(Interpolation::Both), four.clone()),
        ("_neither", shade(Interpolation::Neither), four.clone()),
        ("_vsm", ShadeSoft::default(), table(Technique::Vsm)),
        ("_views", lights, four),
    ]
    .into_iter()
    .map(|(kind, node, encoding)| Variant {
        encoding,
        ..Variant::new(format!("shade_soft{kind}_{storage}"), node, capabilities)
    })
    .collect()
}

/// Single scattering with four and six moments; sums in parallel and, on a software adapter, row by row.
fn scattering(storage: Storage, capabilities: &Capabilities) -> Vec<Variant> {
    let software = Capabilities {
        software_adapter: true,
        ..capabilities.clone()
    };
    let mut variants = Vec::new();
    for technique in [Technique::Hamburger4, Technique::Hamburger6] {
        let kind = format!("{}_{storage}", techniques::label(&technique));
        let encoding = MapEncoding::new(technique.clone(), storage).ok();
        let rectify = RectifyMoments {
            technique,
            storage,
            extent: [256, 256],
        };
        let name = format!("rectify_moments_{kind}");
        variants.push(Variant::new(name, rectify, capabilities));
        let nodes: [(&str, Box<dyn Node>, &Capabilities); 3] = [
            (
                "integrate_scattering",
                Box::new(IntegrateScattering),
                capabilities,
            ),
            (
                "integrate_scattering_software",
                Box::new(IntegrateScattering),
                &software,
            ),
            (
                "composite_scattering",
                Box::new(CompositeScattering::default()),
                capabilities,
            ),
        ];
        // Sums know nothing of moments: their text is the same for both.
        let six = kind.starts_with("hamburger6");
        let nodes = nodes
            .into_iter()
            .filter(|node| !(six && node.0.starts_with("integrate")));
        variants.extend(nodes.map(|(name, node, capabilities)| Variant {
            name: format!("{name}_{kind}"),
            node,
            samples: 1,
            mips: 1,
            regions: 1,
            encoding: encoding.clone(),
            capabilities: capabilities.clone(),
        }));
    }
    variants
}

/// What another technique's map changes: how it is made, filtered and shaded with. Each with one lookup; four moments have all.
fn of_technique(encoding: &MapEncoding, capabilities: &Capabilities) -> Vec<Variant> {
    let (technique, storage) = (encoding.technique(), encoding.storage());
    let suffix = format!("{}_{storage}", techniques::label(technique));
    let with_map = |name: &str, node: Box<dyn Node>, mips: u32| Variant {
        name: format!("{name}_{suffix}"),
        node,
        samples: 4,
        mips,
        regions: 1,
        encoding: Some(encoding.clone()),
        capabilities: capabilities.clone(),
    };
    let shade = |technique: Option<Technique>| {
        Box::new(ShadeHard {
            technique,
            ..ShadeHard::default()
        })
    };
    let mut variants = vec![with_map("shade_hard", shade(None), 1)];
    let resolve = Resolve {
        technique: technique.clone(),
        storage,
        mip_levels: MipLevels::default(),
    };
    // Four moments are made and filtered alike for all that read them.
    if *technique != Technique::Hausdorff4 {
        variants.push(with_map("resolve", Box::new(resolve), 1));
    }
    let blur = Blur {
        kernel: KernelProperty::gaussian(1, 0.6),
        per_frame: false,
        mip_levels: MipLevels::default(),
    };
    // Only logarithms are filtered otherwise.
    if techniques::label(technique).contains("logarithmic") {
        variants.push(with_map("blur", Box::new(blur), 1));
    }
    if storage.is_drawn() {
        variants.extend(drawn(encoding, capabilities));
    }
    if let Technique::Convolution { terms, .. } = technique {
        let series = Technique::Convolution {
            terms: *terms,
            lower_bound: false,
        };
        variants.push(Variant {
            name: format!("shade_hard_{}_{storage}", techniques::label(&series)),
            ..with_map("", shade(Some(series)), 1)
        });
    }
    variants
}

/// A map that is drawn: whatever changes the text of what draws it, and of lookups in its mip levels.
fn drawn(encoding: &MapEncoding, capabilities: &Capabilities) -> Vec<Variant> {
    let suffixed = |regions| {
        let label = techniques::label(encoding.technique());
        format!("{label}_{}{}", encoding.storage(), suffix(regions))
    };
    let with_map = |name: &str, node: Box<dyn Node>, samples, mips, regions| Variant {
        name: format!("{name}_{}", suffixed(regions)),
        node,
        samples,
        mips,
        regions,
        encoding: Some(encoding.clone()),
        capabilities: capabilities.clone(),
    };
    let resolve = || Resolve {
        technique: encoding.technique().clone(),
        storage: encoding.storage(),
        mip_levels: MipLevels::default(),
    };
    let mut variants = vec![
        with_map("resolve_single", Box::new(resolve()), 1, 1, 1),
        with_map("resolve", Box::new(resolve()), 4, 1, 16),
        with_map("shade_hard_mips", Box::<ShadeHard>::default(), 1, 4, 1),
    ];
    for regions in [1, 16] {
        for (kind, per_frame) in [("unrolled", false), ("uniform", true)] {
            let node = Blur {
                kernel: KernelProperty::gaussian(1, 0.6),
                per_frame,
                mip_levels: MipLevels::default(),
            };
            let name = format!("blur_{kind}");
            variants.push(with_map(&name, Box::new(node), 1, 1, regions));
        }
        let node = Box::new(Downsample);
        variants.push(with_map("downsample", node, 1, 4, regions));
    }
    variants
}

/// Placing layers, for one depth map with one region and one with several.
fn placing(capabilities: &Capabilities) -> Vec<Variant> {
    [(1, 1), (4, 1), (4, 16)]
        .into_iter()
        .map(|(samples, regions)| Variant {
            samples,
            regions,
            ..Variant::new(
                format!("place_layers_{samples}{}", suffix(regions)),
                PlaceLayers::default(),
                capabilities,
            )
        })
        .collect()
}

/// Techniques without a filterable map.
fn reading_depth(capabilities: &Capabilities) -> Vec<Variant> {
    let variant = |technique: Technique| {
        let name = format!("shade_hard_{}", techniques::label(&technique));
        let node = ShadeHard {
            technique: Some(technique),
            ..ShadeHard::default()
        };
        Variant::new(name, node, capabilities)
    };
    techniques::reading_depth()
        .into_iter()
        .map(variant)
        .collect()
}

/// What the names of variants with several regions end with.
fn suffix(regions: u32) -> &'static str {
    if regions > 1 { "_regions" } else { "" }
}

/// The least demanding profile that can write a map: as a storage texture, or by drawing where it is drawn.
fn profile(format: TextureFormat, storage: Storage) -> Profile {
    let writes = |profile: &Profile| {
        let support = format.support(*profile);
        if storage.is_drawn() {
            support.renderable
        } else {
            support.storage_write
        }
    };
    Profile::ALL
        .into_iter()
        .find(writes)
        .unwrap_or(Profile::NativeAdapter)
}

/// The shader of each pass of every variant of every node.
pub fn nodes() -> Result<Vec<NodeShader>, ShadersError> {
    let mut all = Vec::new();
    for storage in Storage::OF_FOUR_MOMENTS {
        let profile = profile(storage.format(), storage);
        for variant in variants(storage, &Capabilities::of_profile(profile)) {
            describe(&variant, storage, profile, &mut all)?;
        }
    }
    let core = Profile::WebgpuCore;
    let capabilities = Capabilities::of_profile(core);
    let of_depth = reading_depth(&capabilities);
    for variant in of_depth.into_iter().chain(placing(&capabilities)) {
        describe(&variant, Storage::Float16, core, &mut all)?;
    }
    let mut encodings = techniques::filterable();
    encodings.retain(|encoding| *encoding.technique() != Technique::Hamburger4);
    let lloyd = Technique::Lvsm {
        layers: 4,
        overlap: Default::default(),
        splits: LayerSplits::Lloyd,
    };
    encodings.extend(MapEncoding::new(lloyd, Storage::Unorm16));
    for encoding in encodings {
        let profile = profile(encoding.format(), encoding.storage());
        for variant in of_technique(&encoding, &Capabilities::of_profile(profile)) {
            describe(&variant, encoding.storage(), profile, &mut all)?;
        }
    }
    Ok(all)
}

fn describe(
    variant: &Variant,
    storage: Storage,
    profile: Profile,
    all: &mut Vec<NodeShader>,
) -> Result<(), ShadersError> {
    let inputs = inputs(variant, storage);
    let desc = variant
        .node
        .describe(&Connected::new(&inputs, &variant.capabilities))
        .map_err(|error| ShadersError::Node {
            name: variant.name.clone(),
            error: Box::new(error),
        })?;
    // Passes that share a text differ by their constants only.
    let mut passes: Vec<Pass> = Vec::new();
    for pass in desc.passes {
        // Planes take turns, so that equal texts need not follow each other.
        if !passes.iter().any(|before| before.wgsl == pass.wgsl) {
            passes.push(pass);
        }
    }
    let several = passes.len() > 1;
    let slots: Vec<String> = desc
        .slots
        .into_iter()
        .filter(|slot| slot.direction != Direction::Internal)
        .map(|slot| slot.name)
        .collect();
    for pass in passes {
        // Passes are told apart by the last words of their labels: "blur along x", "blur along y".
        let last = pass.label.rsplit(' ').next().filter(|_| several);
        let suffix = last.map(|word| format!("_{word}")).unwrap_or_default();
        all.push(NodeShader {
            node: desc.name.clone(),
            slots: slots.clone(),
            shader: Shader {
                name: variant.name.clone() + &suffix,
                kind: Kind::Node,
                profile,
                wgsl: pass.wgsl,
                constants: pass.constants,
            },
        });
    }
    Ok(())
}

/// Whatever nodes take, by the names that their slots have.
fn inputs(variant: &Variant, storage: Storage) -> BTreeMap<String, ResourceDesc> {
    let texture = |format| TextureDesc {
        regions: variant.regions,
        ..TextureDesc::new(format, [256, 256])
    };
    let depth = TextureDesc {
        samples: variant.samples,
        ..texture(TextureFormat::Depth32Float)
    };
    let moments = match &variant.encoding {
        Some(encoding) => TextureDesc::of_map(encoding.clone(), [256, 256]),
        None => texture(storage.format()),
    };
    let moments = TextureDesc {
        mips: variant.mips,
        regions: variant.regions,
        ..moments
    };
    let splits = TextureDesc::new(TextureFormat::Rgba32Float, [2, 1]);
    let camera = TextureDesc::new(TextureFormat::Depth32Float, [256, 256]);
    [
        ("depth", depth),
        ("table", moments.clone()),
        ("rectified", moments.clone()),
        ("integrated", moments.clone()),
        ("map", moments),
        ("splits", splits),
        ("camera_depth", camera),
    ]
    .map(|(name, desc)| (name.to_owned(), ResourceDesc::Texture(desc)))
    .into()
}
