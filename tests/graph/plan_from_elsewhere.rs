//! Plans that a device would not take, or that claim more than there is: the check refuses them, and nothing that a host asks of them takes
//! long or panics.

use moment_shadows::TextureFormat;
use moment_shadows_graph::GraphErrorKind::{Declaration, Plan as Broken, Size};
use moment_shadows_graph::{
    Access, BindingLayout, Direction, NodeDesc, ParameterBlock, Pass, Plan, PlannedBindingResource,
    ResourceDesc, Slot, SlotResource, Stage, TextureDesc, bind,
};
use serde_json::{Value, json};

use crate::example::{TEXT, assert_error, compiled, edited, native, refused};
use crate::host_node::{COPY, compute, empty, from_and_to, graph, input, made, output, rgba32};
use crate::targets::compiled as compile;

/// JSON pointers into the example's plan with values that break it, a row each, and what the check says of it.
const BROKEN: &str = r#"
    /passes/1/layers 4294967295; pass 'blur/blur along x' binds more or less as 'regions' than there is
    /passes/3/layers 4294967295; pass 'shade/shade' on 'camera_depth' refers to layer 4294967294, but there are 1
    /passes/1/each_layer false /resources/3/desc/texture/layers 2 /memory/1/desc/texture/layers 2; OK
    /resources/3/desc/texture/layers 2 /memory/1/desc/texture/layers 2; pass 'blur/blur along x' does not fit what it covers
    /passes/0/work/compute/covers 99; pass 'resolve/resolve' refers to resource 99
    /passes/0/work/compute/level 1; pass 'resolve/resolve' does not fit what it covers
    /passes/0/bindings/0/layout/buffer/minBindingSize 31; pass 'resolve/resolve' binds more or less as 'conversions'
    /passes/0/bindings/0/layout/buffer/hasDynamicOffset false; pass 'resolve/resolve' binds 'conversions' as something else
    /passes/0/bindings/1/binding 0; pass 'resolve/resolve' says something else of its bindings
    /passes/0/bindings/1/resource/texture/resource 2; pass 'resolve/resolve' writes what it uses in another way
    /resources/0/usage []; pass 'resolve/resolve' uses resource 'light_depth' in a way that it does not allow
    /resources/3/home/memory 0; pass 'blur/blur along x' writes what it uses in another way
    /resources/3/home/memory 2; resource 'blur.half_blurred' lives in memory 2, which is something else
    /memory/1/usage ["TEXTURE_BINDING"]; resource 'blur.half_blurred' lives in memory 1, which is something else
    /memory/1/desc/texture/mips 4294967295; resource 'blur.half_blurred' lives in memory 1, which is something else
    /resources/5/desc/texture/samples 4 /memory/2/desc/texture/samples 4; pass 'shade/shade' does not fit what it covers
    /off/0/output 99; what stands in for node 'resolve' refers to resource 99
    /off/1/instead/bypass 99; what stands in for node 'blur' refers to resource 99
    /parameters/size 4294967295; a view's block has 4294967295 bytes, more than 268435456
    /parameters/blocks/0/stride 0 /parameters/blocks/0/count 4294967295; the parameters of node 'resolve' do not lie within
    /parameters/blocks/0/size 0 /parameters/blocks/0/elements 4294967295; the parameters of node 'resolve' do not lie within
    /parameters/blocks/0/count 0; the parameters of node 'resolve' do not lie within
    /parameters/regions/0/layers 4294967295 /parameters/regions/0/stride 0; the regions of map 'light_depth' do not lie within
    /parameters/regions/0/capacity 0; the regions of map 'light_depth' do not lie within
    /parameters/regions/0/stride 4294967295 /parameters/regions/0/layers 4294967295 /parameters/regions/0/offset 4294967295 /parameters/regions/0/capacity 4294967295; the regions of map 'light_depth' do not lie within
    /parameters/blocks/1/offset 256; the parameters of node 'shade' lie where the regions of map 'light_depth' do"#;

/// The example's plan with what pairs of a pointer and a value say.
fn changed(changes: &str) -> Plan {
    let mut file = serde_json::to_value(compiled(TEXT, &native()).unwrap()).unwrap();
    for change in changes.split(" /") {
        let (pointer, value) = change.trim_start_matches('/').split_once(' ').unwrap();
        let place = file.pointer_mut(&format!("/{pointer}")).unwrap();
        *place = serde_json::from_str::<Value>(value).unwrap();
    }
    serde_json::from_value(file).unwrap()
}

#[test]
fn what_a_device_would_not_take_is_refused_before() {
    for row in BROKEN.trim().lines() {
        let (changes, says) = row.trim().split_once("; ").unwrap();
        let mut plan = changed(changes);
        assert!(!plan.to_string().is_empty());
        let _ = (plan.bytes_resident(), plan.bytes_moved());
        if says == "OK" {
            plan.update_hazards();
            assert_eq!(plan.check(), Ok(()), "{changes}");
            continue;
        }
        let error = plan.check().unwrap_err();
        assert_eq!(error.kind, Broken, "{changes}");
        assert!(error.message.starts_with(says), "{changes}: {error}");
    }
}

#[test]
fn targets_without_end_are_refused_and_not_listed() {
    let mut plan = compiled(TEXT, &native()).unwrap();
    let mut file = serde_json::to_value(&plan).unwrap();
    let host = |planes: u32, depth: Value| json!({ "host": { "targets": [5], "planes": planes, "blend": true, "depth": depth } });
    for (planes, depth, says) in [
        (1, Value::Null, None),
        (2, Value::Null, Some("refers to plane 1, but there are 1")),
        (
            u32::MAX,
            Value::Null,
            Some("refers to plane 1, but there are 1"),
        ),
        (1, json!(99), Some("refers to resource 99")),
    ] {
        file["passes"][3]["work"] = host(planes, depth);
        plan = serde_json::from_value(file.clone()).unwrap();
        plan.update_hazards();
        assert!(plan.passes[3].writes.len() < 20);
        let error = plan.check().err().map(|error| error.message);
        match says {
            None => assert_eq!(error, None),
            Some(says) => assert!(error.as_ref().unwrap().contains(says), "{error:?}"),
        }
    }
    // As many planes as are claimed, but more than can be drawn to at once.
    file["passes"][3]["work"] = host(9, Value::Null);
    for of in ["resources", "memory"] {
        let place = if of == "memory" { 2 } else { 5 };
        file[of][place]["desc"]["texture"]["planes"] = json!(9);
    }
    plan = serde_json::from_value(file).unwrap();
    plan.update_hazards();
    let error = plan.check().unwrap_err().message;
    assert!(
        error.contains("does not fit what it covers or draws to"),
        "{error}"
    );
}

const READS: &str = "
@group(0) @binding(0) var<storage, read> data: array<vec4f, 3>;
@group(0) @binding(1) var copied: texture_storage_2d<rgba32float, write>;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) { textureStore(copied, id.xy, data[2]); }
";

#[test]
fn a_buffer_has_what_its_shader_reads() {
    let data = SlotResource::Buffer {
        access: Access::READ,
        size: 64,
    };
    let variables = [
        ("data", bind::buffer("data")),
        ("copied", bind::store("to")),
    ];
    let node = empty(Stage::AfterShadowMaps)
        .slots([Slot::input("data", "Numbers.", data), output("to", 1)])
        .pass(compute(READS, "to", true, variables));
    let graph = graph(
        &[("data", ResourceDesc::Buffer { size: 64 })],
        vec![("host", node)],
        &[("data", "host.data")],
        &[("out", "host.to")],
    );
    let mut plan = graph.compile(&native(), &[]).unwrap();
    let data = plan.passes[0].bindings[0].clone();
    assert!(
        matches!(
            data.layout,
            BindingLayout::Buffer {
                min_binding_size: 48,
                ..
            }
        ),
        "{data:?}"
    );
    for (size, fits) in [(0, false), (48, true), (64, true), (68, false)] {
        if let BindingLayout::Buffer {
            min_binding_size, ..
        } = &mut plan.passes[0].bindings[0].layout
        {
            *min_binding_size = size;
        }
        assert_eq!(plan.check().is_ok(), fits, "{size}");
    }
    plan.passes[0].bindings[0].resource = PlannedBindingResource::Buffer { resource: 99 };
    let error = plan.check().unwrap_err();
    assert!(error.message.contains("refers to resource 99"), "{error}");
}

#[test]
fn bytes_of_impossible_textures_are_the_most_that_a_number_holds() {
    let mut texture = TextureDesc::new(TextureFormat::Rgba32Float, [u32::MAX; 2]);
    texture.samples = u32::MAX;
    assert_eq!(texture.bytes(), u64::MAX);
    // Levels beyond the smallest one are as large as it is.
    let small = TextureDesc {
        mips: u32::MAX,
        ..TextureDesc::new(TextureFormat::R32Float, [4, 1])
    };
    assert_eq!(small.bytes(), 4 * (4 + 2 + (u64::from(u32::MAX) - 2)));
    let sound = TextureDesc { mips: 3, ..small };
    assert_eq!(sound.bytes(), 4 * (4 + 2 + 1));
    let mut plan = compiled(TEXT, &native()).unwrap();
    for memory in &mut plan.memory {
        memory.desc = ResourceDesc::Buffer { size: u64::MAX };
    }
    plan.passes[0].bytes_read = u64::MAX;
    assert_eq!(
        (plan.bytes_resident(), plan.bytes_moved()),
        (u64::MAX, u64::MAX)
    );
}

#[test]
fn nodes_are_not_asked_about_textures_that_no_device_has() {
    // A pass for each mip level or plane.
    for (claim, says) in [
        ("\"mips\": 4294967295", "4294967295 mip levels"),
        ("\"planes\": 4294967295", "4294967295 layers"),
    ] {
        let text = format!(
            r#"{{"version": 2, "imports": [{{"name": "map", "texture": {{"format": "rgba16float", "size": [64, 64], {claim},
                "encoding": {{"storage": "float16"}}}}}}], "nodes": [{{"name": "down", "type": "downsample"}}],
                "edges": [{{"from": "map", "to": "down.map"}}], "outputs": [{{"name": "o", "from": "down.map"}}]}}"#
        );
        assert_error(&refused(&text), Size, "down", "map", "2:66", says);
    }
}

#[test]
fn a_view_has_no_block_without_end() {
    let text = edited("\"samples\": 4", "\"layers\": 200");
    let mut device = native();
    device.uniform_alignment = 1 << 21;
    let error = compiled(&text, &device).unwrap_err();
    let says = "a view's parameters take 419430400 bytes with those of this node; at most 268435456 are possible";
    assert_error(&error, Size, "resolve", "", "", says);
}

#[test]
fn a_node_draws_to_what_can_be_drawn_to() {
    let target = |name: &str| {
        made(
            name,
            Direction::Out,
            Access::RENDER_TARGET,
            TextureFormat::R8Unorm,
            1,
        )
    };
    let drawn = |count: usize| {
        let names: Vec<String> = (1..count).map(|number| format!("to_{number}")).collect();
        let names: Vec<&str> = ["to"]
            .into_iter()
            .chain(names.iter().map(String::as_str))
            .collect();
        let slots = names.iter().map(|name| target(name));
        empty(Stage::AfterShadowMaps)
            .slots([input("from")].into_iter().chain(slots))
            .pass(Pass::host("draw", &names, None))
    };
    compile(drawn(8)).unwrap();
    let error = compile(drawn(9)).unwrap_err();
    let says = "pass 'draw' draws to 9 targets at once; at most 8 are possible";
    assert_error(&error, Size, "host", "", "", says);

    let mut slot = target("to");
    if let SlotResource::Texture(rule) = &mut slot.resource {
        rule.samples = moment_shadows_graph::Rule::Exact(4);
        rule.format = moment_shadows_graph::Rule::Exact(TextureFormat::Depth32Float);
    }
    let covers = Pass::fullscreen("cover", "to").shader("", "main");
    let node = empty(Stage::AfterShadowMaps)
        .slots([input("from"), slot])
        .pass(covers);
    let says = "pass 'cover' covers a texture of 4 samples";
    assert_error(
        &compile(node).unwrap_err(),
        Declaration,
        "host",
        "",
        "",
        says,
    );
}

#[test]
fn a_pass_has_parameters_for_each_of_its_layers() {
    let wgsl = COPY.replace(
        "textureLoad(source, id.xy, 0)",
        "textureLoad(source, id.xy, 0) * p.a",
    );
    let wgsl = format!("struct P {{ a: vec4f }}\n@group(0) @binding(2) var<uniform> p: P;\n{wgsl}");
    let node = |layers: u32| {
        let variables = from_and_to().into_iter().chain([("p", bind::parameters())]);
        let pass = compute(&wgsl, "to", true, variables);
        NodeDesc {
            parameters: Some(ParameterBlock {
                name: "P".to_owned(),
                elements: 1,
                size: 16,
                each_layer_of: Some("few".to_owned()),
                initial: Vec::new(),
            }),
            ..empty(Stage::AfterShadowMaps)
                .slots([input("from"), output("to", 3), few(layers)])
                .pass(pass)
        }
    };
    fn few(layers: u32) -> Slot {
        let mut slot = output("few", layers);
        slot.direction = Direction::Internal;
        slot
    }
    let three = |node: NodeDesc| {
        let graph = graph(
            &[("map", rgba32(3))],
            vec![("host", node)],
            &[("map", "host.from")],
            &[("out", "host.to")],
        );
        graph.compile(&native(), &[])
    };
    let plan = three(node(3)).unwrap();
    plan.check().unwrap();
    let error = three(node(2)).unwrap_err();
    let says = "pass 'main' is recorded for 3 layers, but 'P' has 2";
    assert_error(&error, Size, "host", "", "", says);
}
