//! The linked text of every node's shader: valid under the profiles that it is for, and equal to its snapshot.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test --test node_shaders` writes the snapshots anew.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

use std::collections::BTreeSet;
use std::path::PathBuf;

use moment_shadows::{Backend, Profile, Source, Storage, TextureFormat, validate};
use moment_shadows_graph::nodes::{BlurMoments, KernelProperty, ResolveMoments, ShadeHard};
use moment_shadows_graph::{Capabilities, Connected, Node, ResourceDesc, TextureDesc};

/// A node's shader for one storage, number of samples or axis.
struct Variant {
    name: String,
    wgsl: String,
    profile: Profile,
}

/// The least demanding profile that offers a storage.
fn profile(storage: Storage) -> Profile {
    match storage {
        Storage::Unorm16 => Profile::Native,
        _ => Profile::WebgpuCore,
    }
}

fn describe(
    node: &dyn Node,
    storage: Storage,
    samples: u32,
    capabilities: &Capabilities,
) -> Vec<String> {
    let depth = TextureDesc {
        samples,
        ..TextureDesc::new(TextureFormat::Depth32Float, [256, 256])
    };
    let camera = TextureDesc::new(TextureFormat::Depth32Float, [256, 256]);
    let inputs = [
        ("depth".to_owned(), ResourceDesc::Texture(depth)),
        (
            "moments".to_owned(),
            ResourceDesc::Texture(TextureDesc::new(storage.format(), [256, 256])),
        ),
        ("camera_depth".to_owned(), ResourceDesc::Texture(camera)),
    ]
    .into();
    let desc = node
        .describe(&Connected::new(&inputs, capabilities))
        .unwrap();
    desc.passes.into_iter().map(|pass| pass.wgsl).collect()
}

fn variants() -> Vec<Variant> {
    let mut all = Vec::new();
    for storage in Storage::ALL {
        let profile = profile(storage);
        let capabilities = Capabilities::of_profile(profile);
        let mut add = |name: String, wgsl: String| {
            all.push(Variant {
                name,
                wgsl,
                profile,
            })
        };
        for samples in [1, 4] {
            let mut texts = describe(
                &ResolveMoments {
                    storage,
                    mip_levels: Default::default(),
                },
                storage,
                samples,
                &capabilities,
            );
            add(
                format!("resolve_moments_{storage}_{samples}"),
                texts.remove(0),
            );
        }
        for per_frame in [false, true] {
            let node = BlurMoments {
                kernel: KernelProperty::gaussian(1, 0.6),
                per_frame,
                mip_levels: Default::default(),
            };
            let kind = if per_frame { "uniform" } else { "unrolled" };
            for (axis, wgsl) in
                ["x", "y"]
                    .into_iter()
                    .zip(describe(&node, storage, 1, &capabilities))
            {
                add(format!("blur_moments_{kind}_{storage}_{axis}"), wgsl);
            }
        }
        let mut texts = describe(&ShadeHard::default(), storage, 1, &capabilities);
        add(format!("shade_hard_{storage}"), texts.remove(0));
        let filterable = Capabilities {
            float32_filterable: true,
            ..capabilities
        };
        if storage == Storage::Float32 {
            let mut texts = describe(&ShadeHard::default(), storage, 1, &filterable);
            add(format!("shade_hard_{storage}_filterable"), texts.remove(0));
        }
    }
    all
}

/// Variants whose text is kept. The axis and the other storages of the blur change one constant each.
fn is_kept(name: &str) -> bool {
    !name.starts_with("blur_moments") || name.ends_with("unorm16_x")
}

fn snapshot(name: &str) -> PathBuf {
    [
        env!("CARGO_MANIFEST_DIR"),
        "tests",
        "snapshots",
        &format!("{name}.wgsl"),
    ]
    .iter()
    .collect()
}

#[test]
fn every_linked_shader_equals_its_snapshot() {
    let update = std::env::var_os("UPDATE_SNAPSHOTS").is_some();
    let mut names = BTreeSet::new();
    for variant in variants()
        .into_iter()
        .filter(|variant| is_kept(&variant.name))
    {
        let path = snapshot(&variant.name);
        names.insert(path.file_name().unwrap().to_owned());
        if update {
            std::fs::write(&path, &variant.wgsl).unwrap();
            continue;
        }
        let kept = std::fs::read_to_string(&path)
            .unwrap_or_default()
            .replace("\r\n", "\n");
        let difference = kept
            .lines()
            .zip(variant.wgsl.lines())
            .position(|(kept, new)| kept != new);
        let line = difference.unwrap_or(kept.lines().count().min(variant.wgsl.lines().count())) + 1;
        assert!(
            kept == variant.wgsl,
            "{} differs from the shader from line {line} on; if that is meant, run \
             `UPDATE_SNAPSHOTS=1 cargo test --test node_shaders` and look at the difference",
            path.display()
        );
    }
    let folder = snapshot("any").parent().unwrap().to_owned();
    for file in std::fs::read_dir(folder).unwrap() {
        let name = file.unwrap().file_name();
        assert!(
            names.contains(&name),
            "{} belongs to no shader; remove it",
            name.display()
        );
    }
}

#[test]
fn every_linked_shader_is_valid_on_every_backend_that_can_express_it() {
    for variant in variants() {
        let source = Source {
            name: &variant.name,
            text: &variant.wgsl,
        };
        let report = validate(source, &[], variant.profile)
            .unwrap_or_else(|error| panic!("{}: {error}", variant.name));
        let written: Vec<Backend> = report.written().collect();
        for backend in [Backend::SpirV, Backend::Hlsl, Backend::Msl] {
            assert!(
                written.contains(&backend),
                "{} on {backend:?}: {:?}",
                variant.name,
                report.outcome(backend)
            );
        }
    }
}

#[test]
fn a_storage_beyond_the_core_is_refused_there() {
    for variant in variants() {
        let source = Source {
            name: &variant.name,
            text: &variant.wgsl,
        };
        let refused = validate(source, &[], Profile::WebgpuCore).is_err();
        // Shading reads the map: an rgba16unorm texture that is sampled has no format in its type.
        let stores = variant.name.contains("unorm16") && !variant.name.starts_with("shade");
        assert_eq!(refused, stores, "{}", variant.name);
    }
}

#[test]
fn the_texts_of_variants_differ() {
    let texts: BTreeSet<String> = variants().into_iter().map(|variant| variant.wgsl).collect();
    assert_eq!(texts.len(), variants().len());
}
