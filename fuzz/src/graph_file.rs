//! Graph files, compiled for devices and imports of all kinds.

use std::sync::LazyLock;

use moment_shadows::{Profile, TextureFormat};
use moment_shadows_graph::{Capabilities, Graph, NodeRegistry, Plan, ResourceDesc, TextureDesc};
use serde_json::{Value, json};

use crate::json::{mutate as mutate_json, mutate_input};
use crate::{Random, Target};

/// Graph files.
pub const TARGET: Target = Target {
    name: "graph_file",
    seeds,
    mutate,
    try_out,
};

const EXAMPLES: [&str; 8] = [
    include_str!("../../examples/hard_shadows.json"),
    include_str!("../../examples/mipmapped_shadows.json"),
    include_str!("../../examples/forward_shading.json"),
    include_str!("../../examples/soft_shadows.json"),
    include_str!("../../examples/fitted_range.json"),
    include_str!("../../examples/contact_shadows.json"),
    include_str!("../../examples/translucent.json"),
    include_str!("../../examples/volumetric_scattering.json"),
];

/// More ways to write what the examples do not have.
const FURTHER: [&str; 3] = [
    r#"{"version": 2, "imports": [{"name": "d", "texture": {"format": "depth32float", "size": [100, 60], "layers": 4}},
  {"name": "c", "texture": {"format": "depth32float", "size": [64, 48], "samples": 4}}],
 "nodes": [{"name": "r", "type": "resolve", "properties": {"storage": "float16", "mip_levels": "all"}},
  {"name": "a", "type": "blur", "properties": {"kernel": {"radius": 8, "sigma": 3.0}, "per_frame": true, "mip_levels": "all"}},
  {"name": "m", "type": "downsample"},
  {"name": "g", "type": "debug_moments", "properties": {"level": 1}},
  {"name": "s", "type": "shade_hard", "properties": {"lights": 3, "views": 5, "anisotropy": 4}}],
 "edges": [{"from": "d", "to": "r.depth"}, {"from": "r.map", "to": "a.map"}, {"from": "a.blurred", "to": "m.map"},
  {"from": "m.map", "to": "g.map"}, {"from": "m.map", "to": "s.map"}, {"from": "c", "to": "s.camera_depth"}],
 "outputs": [{"name": "o", "from": "s.shadow_intensity"}]}"#,
    r#"{"version": 2, "imports": [{"name": "d", "texture": {"format": "depth16unorm", "size": [64, 48], "layers": 3}}],
 "nodes": [{"name": "r", "type": "resolve", "properties": {"storage": "float32"}},
  {"name": "a", "type": "blur", "properties": {"kernel": {"weights": [1, 0.5, 0.25]}}},
  {"name": "b", "type": "blur", "properties": {"kernel": {"radius": 1, "sigma": 0.5}}}],
 "edges": [{"from": "d", "to": "r.depth"}, {"from": "r.map", "to": "a.map"}, {"from": "a.blurred", "to": "b.map"}],
 "outputs": [{"name": "m", "from": "b.blurred"}, {"name": "n", "from": "a.blurred"}]}"#,
    r#"{"version": 2, "imports": [{"name": "d", "texture": {"format": "depth32float", "size": [40, 40]}},
  {"name": "c", "texture": {"format": "depth24plus", "size": [64, 48]}}],
 "nodes": [{"name": "r", "type": "resolve", "properties": {"storage": "float16"}},
  {"name": "s", "type": "shade_hard", "properties": {"format": "r32float", "technique": "hamburger4"}}],
 "edges": [{"from": "d", "to": "r.depth"}, {"from": "r.map", "to": "s.map"}, {"from": "c", "to": "s.camera_depth"}],
 "outputs": [{"name": "o", "from": "s.shadow_intensity"}]}"#,
];

pub(crate) fn seeds() -> Vec<Vec<u8>> {
    EXAMPLES
        .iter()
        .chain(&FURTHER)
        .map(|text| text.as_bytes().to_vec())
        .collect()
}

fn mutate(data: &[u8], seeds: &[Vec<u8>], times: usize, random: &mut Random) -> Vec<u8> {
    mutate_input(data, seeds, times, random, |document, random| {
        // Rarely, since it takes as long as hundreds of other inputs.
        if random.once_in(100) {
            lengthen(document, random);
        } else {
            mutate_json(document, &WORDS, random);
        }
    })
}

/// What graph files know, and invalid names.
static WORDS: LazyLock<Vec<String>> = LazyLock::new(|| {
    const FURTHER: &str = " . .. a.b.c \u{0} \u{1f312} properties version texture buffer_size samples layers mips planes regions size \
        format encoding table blends deviation width range rounded_inwards kernel radius sigma weights storage unorm16 float16 float32 \
        packed64 unorm10 technique hamburger4 hamburger6 lvsm convolution mip_levels all per_frame views lights anisotropy show level";
    let words = REGISTRY.type_names().map(str::to_owned);
    words
        .chain(TextureFormat::ALL.iter().map(ToString::to_string))
        .chain(FURTHER.split(' ').map(str::to_owned))
        .collect()
});

static REGISTRY: LazyLock<NodeRegistry> = LazyLock::new(NodeRegistry::new);

/// The array of that name, where the document has one.
fn array<'a>(document: &'a mut Value, name: &str) -> Option<&'a mut Vec<Value>> {
    document.get_mut(name)?.as_array_mut()
}

/// Appends a chain of blurs, each with a kernel and so a shader of its own.
fn lengthen(document: &mut Value, random: &mut Random) {
    let from = document.pointer("/edges/0/from").cloned();
    let mut before = from.unwrap_or_default();
    let Some(nodes) = array(document, "nodes") else {
        return;
    };
    let mut edges = Vec::new();
    for number in 0..random.count(3000) {
        let name = format!("blur {number}");
        let sigma = 0.5 + number as f64 / 1000.0;
        nodes.push(json!({ "name": name, "type": "blur", "properties": { "kernel": { "radius": 1 + number % 9, "sigma": sigma } } }));
        edges.push(json!({ "from": before, "to": format!("{name}.map") }));
        before = json!(format!("{name}.blurred"));
    }
    if let Some(all) = array(document, "edges") {
        all.extend(edges);
    }
    if let Some(outputs) = array(document, "outputs") {
        outputs.push(json!({ "name": "lengthened", "from": before }));
    }
}

/// Reads a graph file and compiles it for a device and imports that depend on its bytes.
pub fn try_out(data: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(data) else {
        return false;
    };
    let graph = match Graph::parse(text, &REGISTRY) {
        Ok(graph) => graph,
        Err(error) => {
            assert!(!error.message.is_empty() && !error.to_string().is_empty());
            return false;
        }
    };
    let mut random = Random::of_input(data);
    let capabilities = capabilities(&mut random);
    let imports = imports(&graph, &mut random);
    match graph.compile(&capabilities, &imports) {
        Err(error) => {
            assert!(!error.message.is_empty() && !error.to_string().is_empty());
            false
        }
        Ok(plan) => {
            plan.check().expect("a compiled plan is whole");
            assert!(!plan.to_string().is_empty());
            let _ = plan.bytes_resident();
            // What takes as long as all that is above, of some.
            if random.once_in(8) {
                check(&plan);
                let again = graph.compile(&capabilities, &imports);
                assert_eq!(again.as_ref(), Ok(&plan), "compiling is repeatable");
            }
            true
        }
    }
}

fn check(plan: &Plan) {
    let json = serde_json::to_string(plan).expect("a plan can be written");
    let read: Plan = serde_json::from_str(&json).expect("a plan can be read");
    assert_eq!(&read, plan, "a plan is read as it was written");
    let block = plan.parameters.initial();
    assert_eq!(
        block.len(),
        plan.parameters.size as usize,
        "a view's block has the plan's size"
    );
}

/// Mostly what real devices offer.
fn capabilities(random: &mut Random) -> Capabilities {
    if random.once_in(2) {
        return Capabilities::of_profile(Profile::NativeAdapter);
    }
    let profile = Profile::ALL[random.below(Profile::ALL.len())];
    let mut capabilities = Capabilities::of_profile(profile);
    capabilities.float32_filterable = random.once_in(2);
    capabilities.anisotropic_sampling = random.once_in(2);
    capabilities.software_adapter = random.once_in(2);
    if random.once_in(3) {
        capabilities.depth_samples = vec![1, 2, 4, 8];
    }
    if random.once_in(4) {
        capabilities.bind_group = [1, 3, 255, u32::MAX][random.below(4)];
    }
    if random.once_in(4) {
        capabilities.uniform_alignment = [0, 1, 16, 48, 1 << 31, u32::MAX][random.below(6)];
    }
    if random.once_in(4) {
        capabilities.max_texture_size = [0, 1, 16, 16384, u32::MAX][random.below(5)];
        // Nodes make a pass for each plane, which no device has billions of.
        capabilities.max_texture_layers = [0, 1, 256, 2048][random.below(4)];
        capabilities.max_workgroups = [0, 1, 8, u32::MAX][random.below(4)];
    }
    capabilities
}

/// Descriptions of some imports.
fn imports<'a>(graph: &'a Graph, random: &mut Random) -> Vec<(&'a str, ResourceDesc)> {
    const COUNTS: [u32; 8] = [1, 1, 1, 2, 4, 8, 0, u32::MAX];
    const SIZES: [u32; 9] = [1, 7, 64, 640, 1024, 8192, 0, 65_536, u32::MAX];
    let mut imports = Vec::new();
    if random.once_in(2) {
        return imports;
    }
    for import in graph.imports.iter().take(16) {
        if random.below(3) > 0 {
            continue;
        }
        let desc = if random.once_in(8) {
            ResourceDesc::Buffer {
                size: [0, 16, u64::MAX][random.below(3)],
            }
        } else {
            let formats = TextureFormat::ALL;
            let format = if random.once_in(3) {
                formats[random.below(formats.len())]
            } else {
                TextureFormat::Depth32Float
            };
            ResourceDesc::Texture(TextureDesc {
                layers: COUNTS[random.below(COUNTS.len())],
                mips: COUNTS[random.below(COUNTS.len())],
                samples: COUNTS[random.below(COUNTS.len())],
                ..TextureDesc::new(
                    format,
                    [
                        SIZES[random.below(SIZES.len())],
                        SIZES[random.below(SIZES.len())],
                    ],
                )
            })
        };
        imports.push((import.name.as_str(), desc));
    }
    imports
}
