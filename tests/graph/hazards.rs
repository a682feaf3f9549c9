//! What plans tell frame graphs that order passes and share memory by themselves.

use std::collections::BTreeSet;

use moment_shadows::Profile;
use moment_shadows_graph::{Capabilities, Home, Lives, Plan, PlannedBindingResource, PlannedUse};

use crate::example::compiled;
use crate::techniques::{STORAGES, TECHNIQUES, example};

const EXAMPLES: [&str; 8] = [
    include_str!("../../examples/hard_shadows.json"),
    include_str!("../../examples/soft_shadows.json"),
    include_str!("../../examples/volumetric_scattering.json"),
    include_str!("../../examples/mipmapped_shadows.json"),
    include_str!("../../examples/forward_shading.json"),
    include_str!("../../examples/translucent.json"),
    include_str!("../../examples/fitted_range.json"),
    include_str!("../../examples/contact_shadows.json"),
];

/// Scattering in a map of six moments, whose planes are integrated one by one, with layers of a light that are placed.
const PLACED: &str = r#"{
  "version": 2,
  "imports": [
    { "name": "light_depth", "texture": { "format": "depth32float", "size": [512, 256], "layers": 3 } },
    { "name": "camera_depth", "texture": { "format": "depth32float", "size": [320, 200] } }
  ],
  "nodes": [
    { "name": "place", "type": "place_layers", "properties": { "layers": 3 } },
    { "name": "resolve", "type": "resolve",
      "properties": { "technique": { "lvsm": { "layers": 3, "splits": "lloyd" } }, "storage": "float32" } },
    { "name": "blur", "type": "blur", "properties": { "kernel": { "radius": 3 }, "mip_levels": 3 } },
    { "name": "downsample", "type": "downsample" },
    { "name": "shade", "type": "shade_hard" }
  ],
  "edges": [
    { "from": "light_depth", "to": "place.depth" },
    { "from": "light_depth", "to": "resolve.depth" },
    { "from": "place.splits", "to": "resolve.splits" },
    { "from": "resolve.map", "to": "blur.map" },
    { "from": "blur.blurred", "to": "downsample.map" },
    { "from": "downsample.map", "to": "shade.map" },
    { "from": "place.splits", "to": "shade.splits" },
    { "from": "camera_depth", "to": "shade.camera_depth" }
  ],
  "outputs": [{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }]
}"#;

fn plans() -> Vec<(String, Plan)> {
    plans_of(&Capabilities::of_profile(Profile::NativeAdapter))
}

/// Graph files and their plans: of the examples, and of every technique with each storage, on a device that has what all need.
pub(crate) fn plans_of(device: &Capabilities) -> Vec<(String, Plan)> {
    let texts = EXAMPLES.into_iter().chain([PLACED]).map(str::to_owned);
    let mut plans: Vec<_> = texts
        .map(|text| (text.clone(), compiled(&text, device).unwrap()))
        .collect();
    assert_eq!(plans.len(), 9);
    for (_, technique) in TECHNIQUES {
        for storage in STORAGES {
            let text = example(technique, storage.name());
            if let Ok(plan) = compiled(&text, device) {
                plans.push((text, plan));
            }
        }
    }
    assert!(plans.len() > 25, "{}", plans.len());
    plans
}

/// Every mip level of every texture layer that a pass uses, one by one; of a buffer one.
fn pieces(plan: &Plan, layers: u32, uses: &[PlannedUse]) -> BTreeSet<(usize, u32, u32)> {
    let mut pieces = BTreeSet::new();
    for used in uses {
        let Some(texture) = plan.resources[used.resource].desc.texture() else {
            pieces.insert((used.resource, 0, 0));
            continue;
        };
        for level in 0..texture.mips {
            for layer in 0..texture.array_layers() {
                let of_pass = layer / texture.planes < layers || used.plane.is_none();
                let plane = used
                    .plane
                    .is_none_or(|plane| plane == layer % texture.planes);
                if of_pass && plane && used.level.is_none_or(|of| of == level) {
                    pieces.insert((used.resource, level, layer));
                }
            }
        }
    }
    pieces
}

#[test]
fn passes_follow_all_of_which_one_writes_what_the_other_touches() {
    for (text, plan) in plans() {
        let touched: Vec<_> = plan
            .passes
            .iter()
            .map(|pass| [&pass.reads, &pass.writes].map(|uses| pieces(&plan, pass.layers, uses)))
            .collect();
        for (number, pass) in plan.passes.iter().enumerate() {
            let [reads, writes] = &touched[number];
            let conflicts = |[read, written]: &[BTreeSet<_>; 2]| {
                !written.is_disjoint(writes)
                    || !written.is_disjoint(reads)
                    || !read.is_disjoint(writes)
            };
            let expected: Vec<usize> = (0..number)
                .filter(|&earlier| conflicts(&touched[earlier]))
                .collect();
            assert_eq!(pass.after, expected, "{} of {text}", pass.name());
            // Memory that is shared adds to them.
            let memory = |uses: &[PlannedUse]| -> BTreeSet<usize> {
                let homes = uses.iter().map(|used| plan.resources[used.resource].home);
                homes
                    .filter_map(|home| match home {
                        Home::Memory(memory) => Some(memory),
                        Home::Import(_) => None,
                    })
                    .collect()
            };
            for earlier in 0..number {
                let of = &plan.passes[earlier];
                let [a, b] = [[&of.reads, &of.writes], [&pass.reads, &pass.writes]];
                let alias = |x: &[PlannedUse], y: &[PlannedUse]| {
                    x.iter().any(|x| {
                        y.iter().any(|y| {
                            x.resource != y.resource && !memory(&[*x]).is_disjoint(&memory(&[*y]))
                        })
                    })
                };
                let aliased = alias(a[1], b[0]) || alias(a[1], b[1]) || alias(a[0], b[1]);
                let follows = pass.after_in_memory.contains(&earlier);
                assert_eq!(follows, aliased || expected.contains(&earlier), "{text}");
            }
        }
    }
}

/// The first pass that overwrites what an earlier one still has to read, and that one, where nothing but chains of writers orders passes.
fn overwritten(plan: &Plan) -> Option<(String, String)> {
    let uses = |of: &[PlannedUse]| of.iter().map(|used| used.resource).collect::<BTreeSet<_>>();
    let mut before: Vec<BTreeSet<usize>> = Vec::new();
    for pass in &plan.passes {
        let touched = [&pass.reads, &pass.writes].map(|of| uses(of));
        let mut known = BTreeSet::new();
        for (earlier, of) in before.iter().enumerate() {
            let written = uses(&plan.passes[earlier].writes);
            if touched.iter().any(|touched| !written.is_disjoint(touched)) {
                known.insert(earlier);
                known.extend(of.iter().copied());
            }
        }
        let mut followed = pass.after.iter();
        if let Some(&unknown) = followed.find(|earlier| !known.contains(earlier)) {
            return Some((pass.name(), plan.passes[unknown].name()));
        }
        before.push(known);
    }
    None
}

/// Some frame graphs know that a reader follows a writer and a writer the writer before, and not that a writer follows the
/// readers before it.
#[test]
fn nothing_is_overwritten_that_is_still_to_be_read() {
    for (text, plan) in plans() {
        assert_eq!(overwritten(&plan), None, "{text}");
    }
}

/// As it was when the planes of a blurred map took turns with one intermediate map.
#[test]
fn planes_that_share_an_intermediate_map_are_found() {
    let text = example("\"hamburger6\"", "float16");
    let mut plan = compiled(&text, &Capabilities::of_profile(Profile::WebgpuCore)).unwrap();
    let find = |name: &str| {
        plan.resources
            .iter()
            .position(|it| it.name == name)
            .unwrap()
    };
    let [first, second] = ["blur.half_blurred_0", "blur.half_blurred_1"].map(find);
    for binding in plan.passes.iter_mut().flat_map(|pass| &mut pass.bindings) {
        if let PlannedBindingResource::Texture { resource, .. }
        | PlannedBindingResource::StorageTexture { resource, .. } = &mut binding.resource
            && *resource == second
        {
            *resource = first;
        }
    }
    plan.update_hazards();
    let names = ["blur/plane 1: blur along x", "blur/plane 0: blur along y"].map(str::to_owned);
    assert_eq!(overwritten(&plan), Some(names.into()));
}

#[test]
fn each_shader_is_there_once() {
    for (text, plan) in plans() {
        let distinct: BTreeSet<_> = plan.shaders.iter().collect();
        assert_eq!(distinct.len(), plan.shaders.len(), "{text}");
        let used: BTreeSet<_> = plan.passes.iter().filter_map(|pass| pass.shader).collect();
        assert_eq!(used, (0..plan.shaders.len()).collect(), "{text}");
    }
}

/// What a frame graph has to keep beyond the frame, where layers that did not change are left out.
#[test]
fn resources_say_how_long_they_live() {
    let plan = compiled(PLACED, &Capabilities::of_profile(Profile::Native)).unwrap();
    let lives = |name: &str| {
        plan.resources
            .iter()
            .find(|it| it.name == name)
            .unwrap()
            .lives
    };
    for (name, expected) in [
        ("place.splits", Lives::Always),
        ("place.state", Lives::Always),
        ("place.next", Lives::Frame),
        ("resolve.map", Lives::Frame),
        ("blur.half_blurred_0", Lives::Frame),
        // The picture reads all of its layers.
        ("blur.blurred", Lives::LayersLeftOut),
        // It is drawn whole each time.
        ("shade.shadow_intensity", Lives::Frame),
    ] {
        assert_eq!(lives(name), expected, "{name}");
    }
}
