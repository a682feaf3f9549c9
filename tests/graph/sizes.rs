//! Sizes of resources, and the limits of a device.

use crate::example::{TEXT, assert_error, compiled, native, refused};
use crate::host_node::{compute, empty, graph, made, output};
use crate::resources::with_light;
use moment_shadows::TextureFormat;
use moment_shadows_graph::GraphErrorKind::{Format, Size};
use moment_shadows_graph::{Access, Capabilities, Direction, NodeDesc, ResourceDesc, Slot, Stage};

#[test]
fn empty_textures_are_refused_with_the_sizes_that_are_not() {
    for size in ["[0, 1024]", "[1024, 0]", "[0, 0]"] {
        let text = with_light(&format!(
            "{{ \"format\": \"depth32float\", \"size\": {size} }}"
        ));
        assert_error(
            &refused(&text),
            Size,
            "resolve",
            "depth",
            "8:5",
            "sides from 1 to 8192",
        );
    }
    for count in ["\"layers\": 0", "\"mips\": 0"] {
        let text = with_light(&format!(
            "{{ \"format\": \"depth32float\", \"size\": [8, 8], {count} }}"
        ));
        assert_error(
            &refused(&text),
            Size,
            "resolve",
            "depth",
            "8:5",
            "the texture is empty",
        );
    }
    let text = with_light("{ \"format\": \"depth32float\", \"size\": [8, 8], \"samples\": 0 }");
    assert_error(
        &refused(&text),
        Format,
        "resolve",
        "depth",
        "8:5",
        "0 samples",
    );
}

#[test]
fn sizes_end_at_the_devices_limits() {
    let wide = with_light("{ \"format\": \"depth32float\", \"size\": [8193, 16] }");
    assert_error(
        &refused(&wide),
        Size,
        "resolve",
        "depth",
        "8:5",
        "8193x16 texels; the device allows 8192",
    );
    let layers =
        with_light("{ \"format\": \"depth32float\", \"size\": [16, 16], \"layers\": 257 }");
    assert_error(
        &refused(&layers),
        Size,
        "resolve",
        "depth",
        "8:5",
        "257 layers; the device allows 256",
    );
    let mips = with_light("{ \"format\": \"depth32float\", \"size\": [16, 8], \"mips\": 6 }");
    assert_error(
        &refused(&mips),
        Size,
        "resolve",
        "depth",
        "8:5",
        "6 mip levels; 16x8 texels have at most 5",
    );
    let both = with_light(
        "{ \"format\": \"depth32float\", \"size\": [16, 8], \"mips\": 2, \"samples\": 4 }",
    );
    assert_error(
        &refused(&both),
        Format,
        "resolve",
        "depth",
        "8:5",
        "no device has both",
    );
    let huge = with_light(
        "{ \"format\": \"depth32float\", \"size\": [4294967295, 4294967295], \"layers\": 4294967295 }",
    );
    assert_error(
        &refused(&huge),
        Size,
        "resolve",
        "depth",
        "8:5",
        "the device allows 8192",
    );
}

#[test]
fn more_workgroups_than_the_device_dispatches_are_refused_with_the_largest_map() {
    let device = Capabilities {
        max_workgroups: 100,
        ..native()
    };
    let error = compiled(TEXT, &device).unwrap_err();
    assert_error(
        &error,
        Size,
        "resolve",
        "map",
        "8:5",
        "takes 128x128 workgroups; the device allows 100, so at most 800x800 texels",
    );
    let exactly = Capabilities {
        max_workgroups: 128,
        ..native()
    };
    assert_eq!(compiled(TEXT, &exactly).unwrap().passes.len(), 4);
}

#[test]
fn a_kernel_that_is_wider_than_the_map_is_refused_with_the_largest_radius() {
    let small = with_light("{ \"format\": \"depth32float\", \"size\": [64, 8] }");
    assert_error(
        &refused(&small),
        Size,
        "blur",
        "map",
        "9:5",
        "64x8 texels; the largest radius for it is 3",
    );
    let largest = small.replace("\"radius\": 4", "\"radius\": 3");
    assert_eq!(compiled(&largest, &native()).unwrap().passes.len(), 4);
}

#[test]
fn an_input_of_an_exact_size_takes_no_other() {
    let exact = |name: &str| Slot {
        direction: Direction::In,
        ..made(
            name,
            Direction::In,
            Access::READ,
            TextureFormat::Rgba32Float,
            1,
        )
    };
    let node = NodeDesc {
        slots: vec![exact("from"), output("to", 1)],
        passes: vec![compute(
            crate::host_node::COPY,
            "to",
            true,
            crate::host_node::from_and_to(),
        )],
        ..empty(Stage::AfterShadowMaps)
    };
    let other = ResourceDesc::Texture(moment_shadows_graph::TextureDesc::new(
        TextureFormat::Rgba32Float,
        [8, 16],
    ));
    let graph = graph(
        &[("map", other)],
        vec![("host", node)],
        &[("map", "host.from")],
        &[("out", "host.to")],
    );
    let error = graph.compile(&native(), &[]).unwrap_err();
    assert_error(
        &error,
        Size,
        "host",
        "from",
        "",
        "8x16 texels; it has to have 16x16",
    );
}
