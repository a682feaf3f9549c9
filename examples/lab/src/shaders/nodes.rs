//! The shaders of every node, in every variant that changes their text.

use std::collections::BTreeMap;

use moment_shadows::{Profile, Storage, TextureFormat};
use moment_shadows_graph::nodes::{BlurMoments, KernelProperty, ResolveMoments, ShadeHard};
use moment_shadows_graph::{Capabilities, Connected, Node, ResourceDesc, TextureDesc};

use super::{Kind, Shader, ShadersError};

/// A pass of a variant of a node.
#[derive(Clone, Debug)]
pub struct NodeShader {
    /// The node's name, by which the registry knows it.
    pub node: String,
    /// Its linked text.
    pub shader: Shader,
}

/// A node with what changes its text.
struct Variant {
    name: String,
    node: Box<dyn Node>,
    /// Samples per texel of the depth map.
    samples: u32,
    capabilities: Capabilities,
}

/// Every node with its variants, for one storage. A new node is added here; a test asks for one variant at least of each
/// node in the registry.
fn variants(storage: Storage, capabilities: &Capabilities) -> Vec<Variant> {
    let mut variants = Vec::new();
    let mut add = |name: String, node: Box<dyn Node>, samples: u32| {
        variants.push(Variant {
            name,
            node,
            samples,
            capabilities: capabilities.clone(),
        });
    };
    for samples in [1, 2, 4, 8] {
        let node = ResolveMoments { storage };
        add(
            format!("resolve_moments_{storage}_{samples}"),
            Box::new(node),
            samples,
        );
    }
    let blur = |radius: u32, sigma, per_frame| BlurMoments {
        kernel: KernelProperty::gaussian(radius, sigma),
        per_frame,
    };
    let unrolled = format!("blur_moments_unrolled_{storage}");
    add(unrolled, Box::new(blur(1, 0.6, false)), 1);
    for radius in [4, 12] {
        let name = format!("blur_moments_unrolled_radius_{radius}_{storage}");
        add(name, Box::new(blur(radius, 0.6 * radius as f32, false)), 1);
    }
    // The weights are parameters: one text for every radius.
    let uniform = format!("blur_moments_uniform_{storage}");
    add(uniform, Box::new(blur(1, 0.6, true)), 1);
    add(
        format!("shade_hard_{storage}"),
        Box::<ShadeHard>::default(),
        1,
    );
    if storage == Storage::Float32 {
        variants.push(Variant {
            name: format!("shade_hard_{storage}_filterable"),
            node: Box::<ShadeHard>::default(),
            samples: 1,
            capabilities: Capabilities {
                float32_filterable: true,
                ..capabilities.clone()
            },
        });
    }
    variants
}

/// The least demanding profile that offers a storage.
fn profile(storage: Storage) -> Profile {
    match storage {
        Storage::Unorm16 => Profile::Native,
        _ => Profile::WebgpuCore,
    }
}

/// The shader of each pass of every variant of every node.
pub fn nodes() -> Result<Vec<NodeShader>, ShadersError> {
    let mut all = Vec::new();
    for storage in Storage::ALL {
        let profile = profile(storage);
        for variant in variants(storage, &Capabilities::of_profile(profile)) {
            describe(&variant, storage, profile, &mut all)?;
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
    let inputs = inputs(storage, variant.samples);
    let desc = variant
        .node
        .describe(&Connected::new(&inputs, &variant.capabilities))
        .map_err(|error| ShadersError::Node {
            name: variant.name.clone(),
            error: Box::new(error),
        })?;
    let several = desc.passes.len() > 1;
    for pass in desc.passes {
        // Passes are told apart by the last words of their labels: "blur along x", "blur along y".
        let last = pass.label.rsplit(' ').next().filter(|_| several);
        let suffix = last.map(|word| format!("_{word}")).unwrap_or_default();
        all.push(NodeShader {
            node: desc.name.clone(),
            shader: Shader {
                name: variant.name.clone() + &suffix,
                kind: Kind::Node,
                profile,
                wgsl: pass.wgsl,
            },
        });
    }
    Ok(())
}

/// Whatever nodes take, by the names that their slots have.
fn inputs(storage: Storage, samples: u32) -> BTreeMap<String, ResourceDesc> {
    let size = [256, 256];
    let depth = TextureDesc {
        samples,
        ..TextureDesc::new(TextureFormat::Depth32Float, size)
    };
    [
        ("depth", depth),
        ("moments", TextureDesc::new(storage.format(), size)),
        (
            "camera_depth",
            TextureDesc::new(TextureFormat::Depth32Float, size),
        ),
    ]
    .map(|(name, desc)| (name.to_owned(), ResourceDesc::Texture(desc)))
    .into()
}
