//! Plans: culling, order, sizes, text and JSON.

use moment_shadows::{Profile, TextureFormat};
use moment_shadows_graph::GraphErrorKind::{Plan as Broken, Version};
use moment_shadows_graph::nodes::{Blur, Resolve, ShadeHard};
use moment_shadows_graph::{
    BindingLayout, Capabilities, Connected, GraphError, GraphErrorKind, Node, Plan,
    PlannedBindingResource, PlannedDevice, PlannedExtent, ResourceDesc, SamplerKind, TextureDesc,
};

use crate::example::{TEXT, compiled, edited, native, parse};
use crate::host_node::{copy, graph, rgba32};
use moment_shadows_graph::Stage;

pub(crate) fn example() -> Plan {
    compiled(TEXT, &native()).unwrap()
}

#[test]
fn nodes_that_nobody_reads_are_left_out() {
    let unread = "{ \"name\": \"unread\", \"type\": \"blur\", \"properties\": { \"kernel\": { \"radius\": 20 } } }";
    let text = edited(
        "{ \"name\": \"shade\",",
        &format!("{unread},\n    {{ \"name\": \"shade\","),
    );
    let text = text.replace(
        "{ \"from\": \"camera_depth\", \"to\"",
        "{ \"from\": \"resolve.map\", \"to\": \"unread.map\" },\n    { \"from\": \"camera_depth\", \"to\"",
    );
    let plan = compiled(&text, &native()).unwrap();
    assert_eq!(plan, example(), "nothing of the unread node is left");
    let nothing = edited(
        "{ \"name\": \"shadow_intensity\", \"from\": \"shade.shadow_intensity\" }",
        "",
    );
    let plan = compiled(&nothing, &native()).unwrap();
    assert!(plan.passes.is_empty() && plan.memory.is_empty() && plan.imports.is_empty());
    assert_eq!(
        (
            plan.bytes_resident(),
            plan.bytes_moved(),
            plan.parameters.size
        ),
        (0, 0, 0)
    );
}

#[test]
fn imports_that_no_pass_touches_are_not_asked_for() {
    let text = edited(
        "\"from\": \"shade.shadow_intensity\"",
        "\"from\": \"blur.blurred\"",
    );
    let plan = compiled(&text, &native()).unwrap();
    let imports: Vec<&str> = plan
        .imports
        .iter()
        .map(|import| import.name.as_str())
        .collect();
    assert_eq!(imports, ["light_depth"]);
}

#[test]
fn an_import_can_be_handed_through() {
    let text = edited(
        "\"from\": \"shade.shadow_intensity\"",
        "\"from\": \"camera_depth\"",
    );
    let plan = compiled(&text, &native()).unwrap();
    assert!(plan.passes.is_empty());
    assert_eq!(
        plan.output_texture("shadow_intensity").unwrap().to_string(),
        "depth32float 1280x720"
    );
    plan.check().unwrap();
}

#[test]
fn compiling_and_describing_are_repeatable() {
    assert_eq!(example(), example());
    let map = |format| {
        ResourceDesc::Texture(TextureDesc {
            layers: 2,
            ..TextureDesc::new(format, [256, 64])
        })
    };
    let inputs = [
        ("depth".to_owned(), map(TextureFormat::Depth32Float)),
        ("map".to_owned(), map(TextureFormat::Rgba16Float)),
        ("camera_depth".to_owned(), map(TextureFormat::Depth32Float)),
    ]
    .into();
    let capabilities = native();
    let connected = Connected::new(&inputs, &capabilities);
    let nodes: [Box<dyn Node>; 4] = [
        Box::new(Resolve {
            technique: Some(moment_shadows::Technique::Hamburger4),
            blends: 0,
            bits: None,
            storage: vec![moment_shadows::Storage::Float16],
            mip_levels: Some(1),
        }),
        Box::new(Blur {
            kernel: moment_shadows::Kernel::gaussian(3, 1.5).map(Into::into),
            per_frame: false,
            resolve: None,
            rounded_inwards: false,
            mip_levels: Some(1),
        }),
        Box::new(Blur {
            kernel: moment_shadows::Kernel::gaussian(30, 12.0).map(Into::into),
            per_frame: true,
            resolve: None,
            rounded_inwards: false,
            mip_levels: Some(1),
        }),
        Box::new(ShadeHard::default()),
    ];
    for node in nodes {
        let first = node.describe(&connected).unwrap();
        assert_eq!(first, node.describe(&connected).unwrap());
        let json = serde_json::to_string(&first).unwrap();
        assert_eq!(
            first,
            serde_json::from_str(&json).unwrap(),
            "a description is data"
        );
    }
}

#[test]
fn bytes_are_those_counted_by_hand() {
    let plan = example();
    let map = 1024 * 1024 * 8;
    let picture = 1280 * 720;
    // Moments and blurred moments share; the half-blurred map; the picture of one byte per pixel.
    assert_eq!(plan.bytes_resident(), 2 * map + picture);
    let moved: Vec<(u64, u64)> = plan
        .passes
        .iter()
        .map(|pass| (pass.bytes_read, pass.bytes_written))
        .collect();
    // Four samples of four bytes, a conversion of 32 and a region of 16; two blurs; the camera's depth, the map and a view
    // of 256 bytes.
    let expected = [
        (1024 * 1024 * 16 + 32 + 16, map),
        (map + 16, map),
        (map + 16, map),
        (picture * 4 + map + 256, picture),
    ];
    assert_eq!(moved, expected);
    assert_eq!(
        plan.bytes_moved(),
        expected
            .iter()
            .map(|(read, written)| read + written)
            .sum::<u64>()
    );
}

#[test]
fn a_plan_survives_json() {
    for text in [
        TEXT.to_owned(),
        edited("\"sigma\": 2.4 }", "\"sigma\": 2.4 }, \"per_frame\": true"),
    ] {
        let plan = compiled(&text, &native()).unwrap();
        let json = serde_json::to_string(&plan).unwrap();
        assert_eq!(plan, serde_json::from_str::<Plan>(&json).unwrap());
    }
    let json = serde_json::to_string(&example()).unwrap();
    let unknown = json.replacen("{\"version\"", "{\"colour\":1,\"version\"", 1);
    assert!(
        serde_json::from_str::<Plan>(&unknown)
            .unwrap_err()
            .to_string()
            .contains("unknown field `colour`")
    );
}

#[test]
fn a_plan_that_does_not_hold_together_is_told() {
    example().check().unwrap();
    let broken = |change: fn(&mut Plan)| -> GraphError {
        let mut plan = example();
        change(&mut plan);
        // Neither printing nor reading parameters may panic on it.
        let _ = (
            plan.to_string(),
            plan.parameters.initial(),
            plan.output_texture("shadow_intensity"),
        );
        plan.check().unwrap_err()
    };
    type Change = fn(&mut Plan);
    let cases: [(Change, GraphErrorKind, &str); 15] = [
        (|plan| plan.version = 2, Version, "the plan has version 2"),
        (
            |plan| plan.shaders.clear(),
            Broken,
            "pass 'resolve/resolve' refers to shader 0, but there are 0",
        ),
        (
            |plan| {
                plan.passes[0].bindings[1].layout = BindingLayout::Sampler {
                    ty: SamplerKind::Filtering,
                };
            },
            Broken,
            "pass 'resolve/resolve' binds 'depth_map' as something else than what it holds",
        ),
        (
            |plan| plan.passes[1].after.clear(),
            Broken,
            "pass 'blur/blur along x' says something else of its bindings than they do",
        ),
        (
            |plan| plan.passes[2].reads.clear(),
            Broken,
            "pass 'blur/blur along y' says something else of its bindings than they do",
        ),
        (
            |plan| plan.passes[0].dynamic_offsets.reverse(),
            Broken,
            "pass 'resolve/resolve' says something else of its bindings than they do",
        ),
        (
            |plan| {
                plan.resources[0].extent = Some(PlannedExtent {
                    import: 2,
                    per: [1; 2],
                })
            },
            Broken,
            "resource 'light_depth' refers to import 2, but there are 2",
        ),
        (
            |plan| plan.outputs[0].value = 99,
            Broken,
            "output 'shadow_intensity' refers to resource 99",
        ),
        (
            |plan| plan.imports[0].value = 99,
            Broken,
            "import 'light_depth' refers to resource 99",
        ),
        (
            |plan| plan.memory.clear(),
            Broken,
            "resource 'resolve.map' refers to memory 0, but there are 0",
        ),
        (
            |plan| plan.imports.clear(),
            Broken,
            "resource 'light_depth' refers to import 0, but there are 0",
        ),
        (
            |plan| plan.parameters.blocks.clear(),
            Broken,
            "pass 'resolve/resolve' refers to parameter block 0, but there are 0",
        ),
        (
            |plan| plan.parameters.blocks[1].offset = u32::MAX,
            Broken,
            "the parameters of node 'shade' do not lie within a view's block",
        ),
        (
            |plan| plan.parameters.blocks[0].initial = vec![0; 999],
            Broken,
            "the parameters of node 'resolve' do not lie within a view's block",
        ),
        (
            |plan| {
                let first = plan.passes[0].bindings[1].resource.clone();
                if let PlannedBindingResource::Texture { resource, .. } = first {
                    plan.resources[resource].desc = ResourceDesc::Buffer { size: 4 };
                }
            },
            Broken,
            "pass 'resolve/resolve' refers to resource 'light_depth', which is buffer of 4 bytes",
        ),
    ];
    for (change, kind, says) in cases {
        let error = broken(change);
        assert_eq!(error.kind, kind, "{error}");
        assert!(error.message.starts_with(says), "{error}");
    }
}

#[test]
fn the_bind_group_is_the_hosts_choice() {
    let device = Capabilities {
        bind_group: 2,
        ..native()
    };
    let plan = compiled(TEXT, &device).unwrap();
    assert_eq!(plan.bind_group, 2);
    for pass in &plan.passes {
        let wgsl = plan.wgsl(pass);
        assert!(wgsl.contains("const GROUP = 2;"), "{}", pass.label);
        assert!(wgsl.contains("@group(GROUP)") && !wgsl.contains("@group(0)"));
    }
}

#[test]
fn a_plan_prints_as_text() {
    let expected = "\
imports
  light_depth                  depth32float 1024x1024, 4 samples
  camera_depth                 depth32float 1280x720
stage AfterShadowMaps
  resolve/resolve              compute 128x128 workgroups x 1 layers, 16.00 MiB read, 8.00 MiB written
  blur/blur along x            compute 16x128 workgroups x 1 layers, 8.00 MiB read, 8.00 MiB written
  blur/blur along y            compute 16x128 workgroups x 1 layers, 8.00 MiB read, 8.00 MiB written
stage AfterMainPass
  shade/shade                  fullscreen to shade.shadow_intensity, 11.52 MiB read, 0.88 MiB written
memory (16.88 MiB resident)
  resolve.map | blur.blurred   rgba16unorm 1024x1024, 8.00 MiB
  blur.half_blurred            rgba16unorm 1024x1024, 8.00 MiB
  shade.shadow_intensity       r8unorm 1280x720, 0.88 MiB
parameters (768 bytes per view)
  resolve                      DepthConversion at 0, 32 bytes x 1
  shade                        ViewParameters at 512, 256 bytes x 1
  light_depth                  MapRegion at 256, up to 1 regions x 1 layers
outputs
  shadow_intensity             shade.shadow_intensity
";
    assert_eq!(example().to_string(), expected);
}

#[test]
fn a_plan_is_for_any_profile_that_offers_its_storage() {
    let text = edited("\"unorm16\"", "\"float16\"");
    for profile in Profile::ALL {
        let plan = parse(&text)
            .unwrap()
            .compile(&Capabilities::of_profile(profile), &[])
            .unwrap();
        assert_eq!(plan.passes.len(), 4);
        // Every device of WebGPU stores and filters halves.
        let PlannedDevice {
            features,
            wgpu_features,
            ..
        } = plan.device;
        assert!(
            features.is_empty() && wgpu_features.is_empty(),
            "{profile}: {features:?} {wgpu_features:?}"
        );
    }
    let copies = graph(
        &[("map", rgba32(1))],
        vec![("a", copy(Stage::AfterShadowMaps, 1))],
        &[("map", "a.from")],
        &[("out", "a.to")],
    );
    copies
        .compile(&Capabilities::of_profile(Profile::WebgpuCore), &[])
        .unwrap();
}
