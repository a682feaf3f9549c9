//! Plans: culling, order, sizes, text and JSON.

use moment_shadows::{Profile, TextureFormat};
use moment_shadows_graph::nodes::{Blur, KernelProperty, Resolve, ShadeHard};
use moment_shadows_graph::{
    Capabilities, Connected, Imports, Node, ParameterError, Plan, PlanError,
    PlannedBindingResource, ResourceDesc, TextureDesc, compile,
};

use crate::example::{TEXT, compiled, edited, native, parse};
use crate::host_node::{copy, graph, rgba32};
use moment_shadows_graph::Stage;

fn example() -> Plan {
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
            technique: moment_shadows::Technique::Hamburger4,
            storage: moment_shadows::Storage::Float16,
            mip_levels: Default::default(),
        }),
        Box::new(Blur {
            kernel: KernelProperty::gaussian(3, 1.5),
            per_frame: false,
            mip_levels: Default::default(),
        }),
        Box::new(Blur {
            kernel: KernelProperty::gaussian(30, 12.0),
            per_frame: true,
            mip_levels: Default::default(),
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
fn parameters_are_aligned_to_the_device_and_do_not_overlap() {
    let per_frame = edited("\"sigma\": 2.4 }", "\"sigma\": 2.4 }, \"per_frame\": true");
    let text = per_frame.replace("\"samples\": 4", "\"samples\": 4, \"layers\": 3");
    for (alignment, spacing) in [(256, 256), (64, 64), (32, 32), (4, 16)] {
        let device = Capabilities {
            uniform_alignment: alignment,
            ..native()
        };
        let plan = compiled(&text, &device).unwrap();
        let blocks = plan.parameters.blocks.iter();
        let tables = plan.parameters.regions.iter();
        let mut places: Vec<(u32, u32, u64, u32)> = blocks
            .map(|block| (block.offset, block.stride, block.array_size(), block.count))
            .chain(tables.map(|table| (table.offset, table.stride, table.size(), table.layers)))
            .collect();
        places.sort_unstable();
        let mut end = 0;
        for (offset, stride, size, count) in places {
            assert_eq!(offset % spacing, 0);
            assert_eq!(stride % spacing, 0);
            assert!(offset >= end && u64::from(stride) >= size);
            end = offset + stride * count;
        }
        assert_eq!(plan.parameters.size, end);
        assert_eq!(
            plan.parameters.size % alignment,
            0,
            "the blocks of views follow each other"
        );
    }
    let plan = compiled(&text, &native()).unwrap();
    let blocks: Vec<(&str, u32, u32, u32)> = plan
        .parameters
        .blocks
        .iter()
        .map(|block| (block.node.as_str(), block.offset, block.size, block.count))
        .collect();
    // 32 bytes of a conversion for each of three layers, the regions of each, 656 of a kernel, 208 of a view.
    assert_eq!(
        blocks,
        [
            ("resolve", 0, 32, 3),
            ("blur", 1536, 656, 1),
            ("shade", 2304, 208, 1)
        ]
    );
}

#[test]
fn initial_values_are_those_of_the_nodes() {
    let plan = example();
    let bytes = plan.parameters.initial();
    assert_eq!(bytes.len(), 768);
    let conversion = moment_shadows::DepthConversion::orthographic();
    assert_eq!(bytes[..32], *bytemuck::bytes_of(&conversion));
    let region = moment_shadows::MapRegion::WHOLE;
    assert_eq!(bytes[256..272], *bytemuck::bytes_of(&region));
    let rest = bytes[32..256].iter().chain(&bytes[272..]);
    assert!(rest.into_iter().all(|&byte| byte == 0));
}

#[test]
fn parameters_are_written_where_they_belong_or_not_at_all() {
    let text = TEXT.replace("\"samples\": 4", "\"samples\": 4, \"layers\": 2");
    let layout = compiled(&text, &native()).unwrap().parameters;
    let mut bytes = layout.initial();
    let conversion = moment_shadows::DepthConversion::orthographic_reversed();
    layout.write(&mut bytes, "resolve", 1, &conversion).unwrap();
    assert_eq!(bytes[256..288], *bytemuck::bytes_of(&conversion));
    assert_eq!(
        bytes[..32],
        layout.initial()[..32],
        "the other layer's stay"
    );
    let known = "resolve, shade".to_owned();
    assert_eq!(
        layout.write(&mut bytes, "resolv", 0, &conversion),
        Err(ParameterError::UnknownNode {
            node: "resolv".to_owned(),
            known
        })
    );
    assert!(matches!(
        layout.write(&mut bytes, "resolve", 0, &[0_u32; 4]),
        Err(ParameterError::Size {
            expected: 32,
            given: 16,
            ..
        })
    ));
    assert!(matches!(
        layout.write(&mut bytes, "resolve", 2, &conversion),
        Err(ParameterError::Layer {
            count: 2,
            layer: 2,
            ..
        })
    ));
    assert!(matches!(
        layout.write(&mut bytes[..100], "resolve", 1, &conversion),
        Err(ParameterError::Block {
            expected: 1280,
            given: 100
        })
    ));
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
    // of 208 bytes.
    let expected = [
        (1024 * 1024 * 16 + 32 + 16, map),
        (map + 16, map),
        (map + 16, map),
        (picture * 4 + map + 208, picture),
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
    let broken = |change: fn(&mut Plan)| {
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
    assert_eq!(
        broken(|plan| plan.version = 3),
        PlanError::Version { version: 3 }
    );
    assert!(matches!(
        broken(|plan| plan.outputs[0].resource = 99),
        PlanError::Index {
            index: 99,
            of: "resource",
            ..
        }
    ));
    assert!(matches!(
        broken(|plan| plan.imports[0].resource = 99),
        PlanError::Index { index: 99, .. }
    ));
    assert!(matches!(
        broken(|plan| plan.memory.clear()),
        PlanError::Index {
            of: "memory",
            count: 0,
            ..
        }
    ));
    assert!(matches!(
        broken(|plan| plan.imports.clear()),
        PlanError::Index {
            of: "import",
            count: 0,
            ..
        }
    ));
    assert!(matches!(
        broken(|plan| plan.parameters.blocks.clear()),
        PlanError::Index {
            of: "parameter block",
            ..
        }
    ));
    assert!(matches!(
        broken(|plan| plan.parameters.blocks[1].offset = u32::MAX),
        PlanError::Parameters { .. }
    ));
    assert!(matches!(
        broken(|plan| plan.parameters.blocks[0].initial = vec![0; 999]),
        PlanError::Parameters { .. }
    ));
    let kind = broken(|plan| {
        let first = plan.passes[0].bindings[1].resource.clone();
        if let PlannedBindingResource::Texture { resource, .. } = first {
            plan.resources[resource].desc = ResourceDesc::Buffer { size: 4 };
        }
    });
    assert!(matches!(kind, PlanError::Kind { resource, .. } if resource == "light_depth"));
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
        assert!(pass.wgsl.contains("const GROUP = 2;"), "{}", pass.label);
        assert!(pass.wgsl.contains("@group(GROUP)") && !pass.wgsl.contains("@group(0)"));
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
  shade                        ViewParameters at 512, 208 bytes x 1
  light_depth                  MapRegion at 256, up to 1 regions x 1 layers
outputs
  shadow_intensity             shade.shadow_intensity
";
    assert_eq!(example().to_string(), expected);
}

#[test]
fn a_plan_is_for_any_profile_that_offers_its_storage() {
    let text = edited("\"unorm16\"", "\"float16\"");
    let imports = Imports::new();
    for profile in Profile::ALL {
        let plan = compile(
            &parse(&text).unwrap(),
            &Capabilities::of_profile(profile),
            &imports,
        )
        .unwrap();
        assert_eq!(plan.passes.len(), 4);
    }
    let copies = graph(
        &[("map", rgba32(1))],
        vec![("a", copy(Stage::AfterShadowMaps, 1))],
        &[("map", "a.from")],
        &[("out", "a.to")],
    );
    compile(
        &copies,
        &Capabilities::of_profile(Profile::WebgpuCore),
        &imports,
    )
    .unwrap();
}
