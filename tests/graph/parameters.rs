//! Parameters of a plan: where they lie, and what they begin as.

use crate::example::{TEXT, compiled, edited, native};
use crate::plan::example;
use moment_shadows_graph::GraphErrorKind::{Parameters, UnknownName};
use moment_shadows_graph::{Capabilities, GraphError, ParameterLayout};

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
            ("shade", 2304, 256, 1)
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
fn a_node_that_shades_has_one_view_unless_it_says_more() {
    for text in [TEXT, include_str!("../../examples/soft_shadows.json")] {
        let layout = compiled(text, &native()).unwrap().parameters;
        let mut blocks = layout.blocks.iter();
        let shade = blocks.find(|block| block.node == "shade").unwrap();
        assert_eq!((shade.name.as_str(), shade.elements), ("ViewParameters", 1));
    }
}

#[test]
fn parameters_are_written_where_they_belong_or_not_at_all() {
    let text = TEXT.replace("\"samples\": 4", "\"samples\": 4, \"layers\": 2");
    let layout = compiled(&text, &native()).unwrap().parameters;
    let mut bytes = layout.initial();
    let conversion = moment_shadows::DepthConversion::orthographic().reversed();
    layout.write(&mut bytes, "resolve", 1, &conversion).unwrap();
    assert_eq!(bytes[256..288], *bytemuck::bytes_of(&conversion));
    assert_eq!(
        bytes[..32],
        layout.initial()[..32],
        "the other layer's stay"
    );
    let fails = |result: Result<(), GraphError>, kind, says: &str| {
        let error = result.unwrap_err();
        assert_eq!((error.kind, error.to_string().as_str()), (kind, says));
    };
    fails(
        layout.write(&mut bytes, "resolv", 0, &conversion),
        UnknownName,
        "there is no node with parameters 'resolv'; the nearest are `resolve`, `shade` (in this plan)",
    );
    fails(
        ParameterLayout::default().write(&mut bytes, "resolve", 0, &conversion),
        UnknownName,
        "there is no node with parameters 'resolve'; there is none (in this plan)",
    );
    fails(
        layout.write(&mut bytes, "resolve", 0, &[0_u32; 4]),
        Parameters,
        "node 'resolve': its parameters (DepthConversion) have 32 bytes, 16 were given",
    );
    fails(
        layout.write_all(&mut bytes, "resolve", 0, &[conversion; 2]),
        Parameters,
        "node 'resolve': its parameters (DepthConversion) are at most 1 structs, 2 were given",
    );
    fails(
        layout.write(&mut bytes, "resolve", 2, &conversion),
        Parameters,
        "node 'resolve': it has parameters for 2 layers; layer 2 is none of them",
    );
    fails(
        layout.write(&mut bytes[..100], "resolve", 1, &conversion),
        Parameters,
        "a view's block has 1280 bytes, 100 were given",
    );
}
