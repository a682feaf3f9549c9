//! Plans: what stands between a file and a recorder.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use moment_shadows::{MapRegion, Profile, TextureFormat};
use moment_shadows_graph::{
    Capabilities, Graph, NodeRegistry, Plan, PlannedPass, PlannedWork, ResourceDesc, Usage,
};
use serde_json::Value;

use crate::json::{mutate as mutate_json, mutate_input};
use crate::{Random, Target, graph_file};

/// Plans as JSON.
pub const TARGET: Target = Target {
    name: "plan",
    seeds,
    mutate,
    try_out,
};

/// Plans of few passes.
const SMALL: [&str; 3] = [
    r#"{"version": 2, "imports": [{"name": "d", "texture": {"format": "depth32float", "size": [32, 16], "layers": 2}}],
 "nodes": [{"name": "r", "type": "resolve", "properties": {"technique": "hamburger6", "storage": "unorm10"}}],
 "edges": [{"from": "d", "to": "r.depth"}], "outputs": [{"name": "o", "from": "r.map"}]}"#,
    r#"{"version": 2, "imports": [{"name": "d", "texture": {"format": "depth32float", "size": [64, 64]}}, {"name": "c", "texture":
 {"format": "depth32float", "size": [64, 48]}}], "nodes": [{"name": "r", "type": "resolve"}, {"name": "s", "type": "shade_hard"}],
 "edges": [{"from": "d", "to": "r.depth"}, {"from": "r.map", "to": "s.map"}, {"from": "c", "to": "s.camera_depth"}],
 "outputs": [{"name": "o", "from": "s.shadow_intensity"}]}"#,
    r#"{"version": 2, "imports": [{"name": "d", "texture": {"format": "depth32float", "size": [64, 64], "layers": 3}}],
 "nodes": [{"name": "p", "type": "place_layers", "properties": {"layers": 3}}], "edges": [{"from": "d", "to": "p.depth"}],
 "outputs": [{"name": "o", "from": "p.splits"}]}"#,
];

/// The plans of graph files. Nothing but recorders read shaders: most have none worth the time that their text takes, and not all of what
/// repeats.
fn seeds() -> Vec<Vec<u8>> {
    let small = SMALL.iter().filter_map(|it| plan(it.as_bytes()));
    let whole = small.clone().next();
    let files = graph_file::seeds();
    let mut plans: Vec<Plan> = small
        .chain(files.iter().filter_map(|it| plan(it)))
        .collect();
    for plan in &mut plans {
        for shader in &mut plan.shaders {
            *shader = "const GROUP = 0;".to_owned();
        }
        for block in &mut plan.parameters.blocks {
            block.initial.truncate(8);
            block.fields.truncate(2);
        }
    }
    let drawn: Vec<Plan> = plans.iter().filter_map(drawn_by_host).collect();
    // Mostly small ones, since time grows with the text.
    let small = plans.iter().take(SMALL.len()).chain(drawn.first()).cloned();
    let small: Vec<Plan> = small.collect();
    let small = std::iter::repeat_n(small, 8).flatten();
    let all = plans.into_iter().chain(drawn).chain(whole).chain(small);
    all.filter_map(|plan| serde_json::to_vec(&plan).ok())
        .collect()
}

fn plan(file: &[u8]) -> Option<Plan> {
    let graph = Graph::parse(std::str::from_utf8(file).ok()?, &NodeRegistry::new()).ok()?;
    let mut plan = graph
        .compile(&Capabilities::of_profile(Profile::NativeAdapter), &[])
        .ok()?;
    plan.compact().ok()?;
    Some(plan)
}

/// The plan whose fullscreen pass, if there is one, the host draws.
fn drawn_by_host(plan: &Plan) -> Option<Plan> {
    let mut plan = plan.clone();
    let target = |pass: &PlannedPass| match pass.work {
        PlannedWork::Fullscreen { target, .. } => Some(target),
        PlannedWork::Compute { .. } | PlannedWork::Host { .. } => None,
    };
    let (pass, target) = plan
        .passes
        .iter_mut()
        .find_map(|pass| target(pass).map(|target| (pass, target)))?;
    pass.work = PlannedWork::Host {
        targets: vec![target],
        planes: 1,
        blend: true,
        depth: None,
    };
    (pass.shader, pass.visibility, pass.vertex_entry_point) = (None, None, None);
    plan.update_hazards();
    Some(plan)
}

fn mutate(data: &[u8], seeds: &[Vec<u8>], times: usize, random: &mut Random) -> Vec<u8> {
    mutate_input(data, seeds, times, random, |document, random| {
        mutate_json(document, &WORDS, random);
    })
}

/// The keys and words of all seeds, and formats.
static WORDS: LazyLock<Vec<String>> = LazyLock::new(|| {
    fn add(value: &Value, words: &mut BTreeSet<String>) {
        match value {
            Value::String(text) if text.len() < 40 => drop(words.insert(text.clone())),
            Value::Array(items) => items.iter().for_each(|item| add(item, words)),
            Value::Object(fields) => {
                for (name, field) in fields {
                    words.insert(name.clone());
                    add(field, words);
                }
            }
            _ => {}
        }
    }
    let formats = TextureFormat::ALL.iter().map(ToString::to_string);
    let mut words: BTreeSet<String> = formats.collect();
    for seed in seeds() {
        if let Ok(document) = serde_json::from_slice(&seed) {
            add(&document, &mut words);
        }
    }
    words.into_iter().collect()
});

/// Reads a plan as a host does, and does with it all that a host does before it records: with the plan as it was read, and with one whose
/// hazards a host filled in.
pub fn try_out(data: &[u8]) -> bool {
    let mut plan: Plan = match serde_json::from_slice(data) {
        Ok(plan) => plan,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return false;
        }
    };
    let mut random = Random::of_input(data);
    look_at(&plan);
    let as_read = try_plan(&plan, &mut random);
    plan.update_hazards();
    for pass in &mut plan.passes {
        pass.bindings.sort_by_key(|binding| binding.binding);
    }
    try_plan(&plan, &mut random) || as_read
}

/// Whether the plan is whole.
fn try_plan(plan: &Plan, random: &mut Random) -> bool {
    if let Err(error) = plan.check() {
        assert!(!error.message.is_empty() && !error.to_string().is_empty());
        return false;
    }
    sound(plan);
    write(plan, random);
    if random.once_in(4) {
        let json = serde_json::to_string(plan).expect("a plan can be written");
        let read: Plan = serde_json::from_str(&json).expect("a plan can be read");
        assert_eq!(&read, plan, "a plan is read as it was written");
        let mut compacted = plan.clone();
        match compacted.compact() {
            Err(error) => assert!(!error.message.is_empty()),
            Ok(()) => compacted.check().expect("a plan stays whole"),
        }
    }
    true
}

/// What a host asks a plan before it is checked.
fn look_at(plan: &Plan) {
    assert!(!plan.to_string().is_empty());
    let _ = (plan.bytes_resident(), plan.bytes_moved());
    for pass in &plan.passes {
        assert!(pass.name().contains('/'));
        let _ = plan.wgsl(pass);
    }
    for output in &plan.outputs {
        let _ = plan.output_texture(&output.name);
    }
    for resource in &plan.resources {
        let _ = (resource.desc.bytes(), resource.desc.layers());
        if let ResourceDesc::Texture(texture) = &resource.desc {
            let _ = (texture.array_layers(), texture.size_at(texture.mips));
        }
    }
}

/// What a recorder relies on after the check: it indexes, and makes an object for each layer.
fn sound(plan: &Plan) {
    for pass in &plan.passes {
        let used = pass.reads.iter().chain(&pass.writes);
        for used in used {
            let resource = &plan.resources[used.resource];
            let Some(texture) = resource.desc.texture() else {
                assert!(resource.usage.contains(&Usage::Storage));
                continue;
            };
            assert!(used.level.is_none_or(|level| level < texture.mips));
            assert!(used.plane.is_none_or(|plane| plane < texture.planes));
            assert!(used.level.is_none() || pass.layers <= texture.layers);
        }
        for offset in &pass.dynamic_offsets {
            let last = u64::from(pass.layers.saturating_sub(1));
            let end = u64::from(offset.offset) + last * u64::from(offset.stride);
            assert!(end < u64::from(plan.parameters.size));
        }
    }
}

/// Writes parameters and regions into a view's block.
fn write(plan: &Plan, random: &mut Random) {
    let layout = &plan.parameters;
    let mut block = layout.initial();
    assert_eq!(
        block.len(),
        layout.size as usize,
        "a view's block has the plan's size"
    );
    for planned in layout.blocks.iter().take(16) {
        let layer = random.below(1 + planned.count as usize) as u32;
        let node = &planned.node;
        let written = [
            layout.write(&mut block, node, layer, &[7_u8; 16]),
            layout.write(&mut block, node, layer, &[7_u8; 32]),
            layout.write(&mut block, node, layer, &[7_u8; 256]),
            layout.write_all(&mut block, node, layer, &[[7_u8; 4]; 8]),
        ];
        let errors = written.into_iter().filter_map(Result::err);
        errors.for_each(|error| assert!(!error.message.is_empty()));
    }
    for table in layout.regions.iter().take(16) {
        let layer = random.below(1 + table.layers as usize) as u32;
        let [width, height] = table.extent;
        let regions = [
            MapRegion::WHOLE,
            MapRegion::new([0, 0], [width / 2, height]),
            MapRegion::new([width / 2, u32::MAX], [width, height]),
        ];
        for regions in [&regions[..1], &regions[1..2], &regions[1..]] {
            if let Err(error) = layout.write_regions(&mut block, &table.map, layer, regions) {
                assert!(!error.message.is_empty());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_inputs_start_from_is_valid() {
        let files = graph_file::seeds();
        let small = SMALL.iter().map(|text| text.as_bytes());
        for file in files.iter().map(Vec::as_slice).chain(small) {
            assert!(plan(file).is_some(), "{}", String::from_utf8_lossy(file));
        }
        for target in [&TARGET, &crate::gltf::TARGET] {
            for seed in (target.seeds)() {
                assert!(
                    (target.try_out)(&seed),
                    "{}: {}",
                    target.name,
                    String::from_utf8_lossy(&seed)
                );
            }
        }
    }
}
