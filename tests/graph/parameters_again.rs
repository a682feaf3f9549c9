//! A view's block that is used again with less in it than in the frame before: nothing stays behind.

use moment_shadows::{DepthConversion, MapRegion, ViewParameters};
use moment_shadows_graph::ParameterLayout;

use crate::example::{TEXT, compiled, native};

/// The example with two layers of four regions, and three views.
fn layout() -> ParameterLayout {
    let text = TEXT
        .replace("\"samples\": 4", "\"layers\": 2, \"regions\": 4")
        .replace(
            "\"type\": \"shade_hard\"",
            "\"type\": \"shade_hard\", \"properties\": { \"views\": 3 }",
        );
    compiled(&text, &native()).unwrap().parameters
}

/// A block in which no byte is what it should be.
fn stale(layout: &ParameterLayout) -> Vec<u8> {
    layout.initial().iter().map(|byte| !byte).collect()
}

/// The bytes of `block` from `offset` on.
fn part(block: &[u8], offset: u32, size: u64) -> &[u8] {
    &block[offset as usize..offset as usize + size as usize]
}

#[test]
fn fewer_regions_leave_none_of_the_frame_before() {
    let layout = layout();
    let table = &layout.regions[0];
    let four = [[0, 0], [64, 0], [0, 64], [64, 64]].map(|origin| MapRegion::new(origin, [64, 64]));
    for layer in [0, 1] {
        let at = table.offset + layer * table.stride;
        let mut block = stale(&layout);
        let before = block.clone();
        for count in [4, 1, 0, 2] {
            let regions = &four[4 - count..];
            layout
                .write_regions(&mut block, "light_depth", layer, regions)
                .unwrap();
            // A region without texels is invalid.
            let mut expected = [MapRegion::NONE; 4];
            expected[..count].copy_from_slice(regions);
            assert_eq!(
                part(&block, at, table.size()),
                bytemuck::cast_slice::<_, u8>(&expected),
                "{count} regions of layer {layer}"
            );
        }
        let end = (at as u64 + table.size()) as usize;
        assert_eq!(block[..at as usize], before[..at as usize]);
        assert_eq!(block[end..], before[end..]);
    }
}

#[test]
fn fewer_views_leave_none_of_the_frame_before() {
    let layout = layout();
    let shade = layout.blocks.iter().find(|it| it.node == "shade").unwrap();
    assert_eq!(shade.elements, 3);
    let view = |byte: u8| -> ViewParameters {
        bytemuck::pod_read_unaligned(&[byte; size_of::<ViewParameters>()])
    };
    let views = [view(1), view(2), view(3)];
    let size = shade.size as usize;
    let mut block = stale(&layout);
    for count in [3, 1, 2, 0] {
        layout
            .write_all(&mut block, "shade", 0, &views[..count])
            .unwrap();
        let written = part(&block, shade.offset, shade.array_size());
        let given: &[u8] = bytemuck::cast_slice(&views[..count]);
        assert_eq!(&written[..count * size], given);
        // A view of zeros covers no region: it shades nothing.
        assert!(written[count * size..].iter().all(|&byte| byte == 0));
    }
    // One that is written alone is the first of them, and the only one.
    block.fill(255);
    layout.write(&mut block, "shade", 0, &views[1]).unwrap();
    let written = part(&block, shade.offset, shade.array_size());
    assert_eq!(written[..size], [2; size_of::<ViewParameters>()]);
    assert!(written[size..].iter().all(|&byte| byte == 0));
}

#[test]
fn conversions_of_regions_that_are_gone_are_the_nodes_own_again() {
    let layout = layout();
    let resolve = layout
        .blocks
        .iter()
        .find(|it| it.node == "resolve")
        .unwrap();
    assert_eq!((resolve.elements, resolve.count), (4, 2));
    let reversed = DepthConversion::orthographic().reversed();
    let plain = DepthConversion::orthographic();
    for layer in [0, 1] {
        let mut block = stale(&layout);
        let at = resolve.offset + layer * resolve.stride;
        for count in [4, 1, 3] {
            let given = &[reversed; 4][..count];
            layout
                .write_all(&mut block, "resolve", layer, given)
                .unwrap();
            let mut expected = [plain; 4];
            expected[..count].fill(reversed);
            assert_eq!(
                part(&block, at, resolve.array_size()),
                bytemuck::cast_slice::<_, u8>(&expected),
                "{count} conversions of layer {layer}"
            );
        }
    }
}
