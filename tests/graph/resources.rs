//! Formats, samples, sizes, layers and what a device offers.

use moment_shadows::{Profile, Storage};
use moment_shadows_graph::GraphErrorKind::{Capability, Format, Size};
use moment_shadows_graph::{
    Access, Capabilities, Direction, Graph, NodeDesc, NodeRegistry, ResourceDesc, Slot,
    SlotResource, Stage, TextureDesc,
};

use crate::example::{TEXT, assert_error, compiled, edited, native, refused};
use crate::host_node::{copy, empty, graph, input, made, output, rgba32};
use moment_shadows::TextureFormat;

pub(crate) const LIGHT: &str =
    "{ \"format\": \"depth32float\", \"size\": [1024, 1024], \"samples\": 4 }";

/// The example with another light map.
pub(crate) fn with_light(desc: &str) -> String {
    edited(LIGHT, desc)
}

#[test]
fn every_number_of_samples_and_depth_format_that_is_named_compiles() {
    for (samples, format) in [
        (1, "depth32float"),
        (4, "depth32float"),
        (1, "depth16unorm"),
        (4, "depth16unorm"),
    ] {
        let text = with_light(&format!(
            "{{ \"format\": \"{format}\", \"size\": [64, 32], \"samples\": {samples} }}"
        ));
        assert_eq!(compiled(&text, &native()).unwrap().passes.len(), 4);
    }
    let device = Capabilities {
        depth_samples: vec![1, 2, 4, 8],
        ..native()
    };
    for samples in [2, 8] {
        let text = with_light(&format!(
            "{{ \"format\": \"depth32float\", \"size\": [64, 32], \"samples\": {samples} }}"
        ));
        assert_eq!(compiled(&text, &device).unwrap().passes.len(), 4);
        let error = compiled(&text, &native()).unwrap_err();
        assert_error(
            &error,
            Capability,
            "resolve",
            "depth",
            "8:5",
            "the device allows 1 or 4",
        );
    }
}

#[test]
fn wrong_formats_and_samples_are_named_at_their_slot() {
    let colour = with_light("{ \"format\": \"rgba8unorm\", \"size\": [64, 64] }");
    assert_error(
        &refused(&colour),
        Format,
        "resolve",
        "depth",
        "8:5",
        "rgba8unorm; it has to be depth32float or depth24plus or depth16unorm or depth32float-stencil8",
    );
    let samples =
        with_light("{ \"format\": \"depth32float\", \"size\": [64, 64], \"samples\": 3 }");
    assert_error(
        &refused(&samples),
        Format,
        "resolve",
        "depth",
        "8:5",
        "3 samples per texel; it has to have 1 or 2 or 4 or 8",
    );
    let depth = edited("\"from\": \"blur.blurred\"", "\"from\": \"camera_depth\"");
    assert_error(
        &refused(&depth),
        Format,
        "shade",
        "map",
        "10:5",
        "depth32float holds no moments",
    );
    let camera = edited(
        "\"size\": [1280, 720] }",
        "\"size\": [1280, 720], \"samples\": 3 }",
    );
    assert_error(
        &refused(&camera),
        Format,
        "shade",
        "camera_depth",
        "10:5",
        "3 samples per texel; it has to have 1 or 2 or 4 or 8",
    );
    let layers = edited(
        "\"size\": [1280, 720] }",
        "\"size\": [1280, 720], \"layers\": 2 }",
    );
    assert_error(
        &refused(&layers),
        Size,
        "shade",
        "camera_depth",
        "10:5",
        "2 layers; it has to have 1",
    );
}

#[test]
fn buffers_and_textures_are_not_mixed_up() {
    let buffer = edited(&format!("\"texture\": {LIGHT}"), "\"buffer_size\": 1024");
    assert_error(
        &refused(&buffer),
        Format,
        "resolve",
        "depth",
        "8:5",
        "a buffer is connected, but this input takes a texture",
    );
    let node = NodeDesc {
        slots: vec![Slot::input(
            "data",
            "Numbers.",
            SlotResource::Buffer {
                access: Access::READ,
                size: 64,
            },
        )],
        ..empty(Stage::AfterShadowMaps)
    };
    let refuse = |desc: ResourceDesc| {
        let graph = graph(
            &[("data", desc)],
            vec![("host", node.clone())],
            &[("data", "host.data")],
            &[],
        );
        graph.compile(&native(), &[]).unwrap_err()
    };
    assert_error(
        &refuse(rgba32(1)),
        Format,
        "host",
        "data",
        "",
        "a texture is connected, but this input takes a buffer",
    );
    assert_error(
        &refuse(ResourceDesc::Buffer { size: 60 }),
        Size,
        "host",
        "data",
        "",
        "60 bytes; at least 64 are needed",
    );
    assert_error(
        &refuse(ResourceDesc::Buffer { size: 66 }),
        Size,
        "host",
        "data",
        "",
        "positive multiple of 4",
    );
}

#[test]
fn a_storage_that_the_profile_lacks_names_one_that_works() {
    let core = Capabilities::of_profile(Profile::WebgpuCore);
    let error = compiled(TEXT, &core).unwrap_err();
    assert_error(
        &error,
        Capability,
        "resolve",
        "map",
        "8:5",
        "rgba16unorm cannot be written as a storage texture under the profile webgpu-core; request the device with the \
         feature TEXTURE_FORMAT_16BIT_NORM of wgpu ('texture-formats-tier1' in browsers), or use storage 'float16'",
    );
    let works = edited(
        "\"unorm16\"",
        &format!("\"{}\"", Storage::best_for(Profile::WebgpuCore)),
    );
    assert_eq!(compiled(&works, &core).unwrap().passes.len(), 4);
}

#[test]
fn a_format_that_cannot_be_drawn_to_is_refused() {
    let node = NodeDesc {
        slots: vec![made(
            "to",
            Direction::Out,
            Access::RENDER_TARGET,
            TextureFormat::Rgba16Unorm,
            1,
        )],
        ..empty(Stage::AfterMainPass)
    };
    let graph = graph(&[], vec![("host", node)], &[], &[("out", "host.to")]);
    let error = graph.compile(&native(), &[]).unwrap_err();
    assert_error(
        &error,
        Capability,
        "host",
        "to",
        "",
        "rgba16unorm cannot be drawn to under the profile native; request the device with TEXTURE_FORMAT_16BIT_NORM and \
         TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES of wgpu",
    );
}

#[test]
fn a_texel_takes_the_bytes_that_wgpu_says() {
    let size = wgpu::Extent3d {
        width: 7,
        height: 5,
        depth_or_array_layers: 1,
    };
    for format in TextureFormat::ALL {
        let desc = TextureDesc::new(format, [7, 5]);
        let expected = desc.wgpu_format().theoretical_memory_footprint(size);
        assert_eq!(desc.bytes(), expected, "{format}");
    }
}

#[test]
fn a_pass_by_layer_needs_the_layers_of_all_that_it_binds() {
    let node = NodeDesc {
        slots: vec![input("from"), output("to", 3)],
        ..copy(Stage::AfterShadowMaps, 3)
    };
    let with = |layers: u32| {
        let graph = graph(
            &[("map", rgba32(layers))],
            vec![("copy", node.clone())],
            &[("map", "copy.from")],
            &[("out", "copy.to")],
        );
        graph.compile(&native(), &[])
    };
    assert_error(
        &with(2).unwrap_err(),
        Size,
        "copy",
        "",
        "",
        "recorded for 3 layers, but 'map' has 2",
    );
    assert_eq!(with(3).unwrap().passes[0].layers, 3);
}

#[test]
fn layers_are_inherited_along_the_chain() {
    let text = with_light(
        "{ \"format\": \"depth32float\", \"size\": [64, 32], \"layers\": 3, \"samples\": 4 }",
    );
    let plan = compiled(&text, &native()).unwrap();
    let layers: Vec<u32> = plan.passes.iter().map(|pass| pass.layers).collect();
    assert_eq!(layers, [3, 3, 3, 1]);
    assert_eq!(plan.parameters.blocks[0].count, 3, "a conversion per layer");
}

#[test]
fn the_first_storage_that_the_device_can_write_is_taken() {
    let encoded = |storage: &str, profile| {
        let text = edited("\"unorm16\"", storage);
        let graph = Graph::parse(&text, &NodeRegistry::new()).unwrap();
        let plan = graph.compile(&Capabilities::of_profile(profile), &[]);
        let resources = plan.unwrap().resources;
        let map = resources.iter().find(|it| it.name == "resolve.map");
        map.unwrap().desc.texture().unwrap().format
    };
    let (core, native) = (Profile::WebgpuCore, Profile::Native);
    for best in ["\"best\"", "[]", "[\"unorm16\", \"float16\"]"] {
        assert_eq!(encoded(best, native), TextureFormat::Rgba16Unorm);
        assert_eq!(encoded(best, core), TextureFormat::Rgba16Float);
    }
    let wide = "[\"float32\", \"unorm16\"]";
    assert_eq!(encoded(wide, native), TextureFormat::Rgba32Float);
    let found = refused(&edited("\"unorm16\"", "[\"unorm16\", \"unorm8\"]"));
    assert!(found.message.contains("unorm8"), "{found}");
    let found = refused(&edited("\"unorm16\"", "7"));
    assert!(found.message.contains("\"best\""), "{found}");
}
