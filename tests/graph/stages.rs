//! Fullscreen stages, filtering, and what a profile allows.

use crate::example::{assert_error, native};
use crate::host_node::{compute, from_and_to};
use crate::shaders::{Bound, SAMPLE, base, changed, compiled, fullscreen};
use moment_shadows::Profile;
use moment_shadows::TextureFormat::R8Unorm;
use moment_shadows_graph::GraphErrorKind::{Capability, Shader};
use moment_shadows_graph::{Capabilities, NodeDesc, bind};

fn sampled(filtering: bool) -> [Bound; 2] {
    [
        ("source", bind::layer("from")),
        ("linear", bind::sampler(filtering)),
    ]
}

#[test]
fn filtering_what_the_device_cannot_filter() {
    let error = compiled(fullscreen(SAMPLE, R8Unorm, sampled(true)), &native()).unwrap_err();
    assert_error(
        &error,
        Capability,
        "host",
        "",
        "",
        "samples 'map', rgba32float 16x16, which this device cannot filter",
    );
    compiled(fullscreen(SAMPLE, R8Unorm, sampled(false)), &native()).unwrap();
    let filterable = Capabilities {
        float32_filterable: true,
        ..native()
    };
    compiled(fullscreen(SAMPLE, R8Unorm, sampled(true)), &filterable).unwrap();
}

#[test]
fn fullscreen_passes_have_a_vertex_entry_point_of_their_own() {
    let without = SAMPLE.replace("fn fullscreen", "fn triangle");
    let error = compiled(fullscreen(&without, R8Unorm, sampled(false)), &native()).unwrap_err();
    assert_error(
        &error,
        Shader,
        "host",
        "",
        "",
        "no Vertex entry point 'fullscreen'",
    );
    let binds = SAMPLE.replace(
        "- 1.0, 0.0, 1.0",
        "- 1.0, textureLoad(source, vec2i(0), 0).x, 1.0",
    );
    let error = compiled(fullscreen(&binds, R8Unorm, sampled(false)), &native()).unwrap_err();
    assert_error(
        &error,
        Shader,
        "host",
        "",
        "",
        "the vertex entry point 'fullscreen' uses 'source'",
    );
}

#[test]
fn core_webgpu_is_allowed_and_no_more() {
    let core = Capabilities::of_profile(Profile::WebgpuCore);
    let packs = changed(
        "textureLoad(source, id.xy, 0)",
        "vec4f(unpack2x16float(pack2x16float(textureLoad(source, id.xy, 0).xy)), 0.0, 1.0)",
    );
    compiled(
        NodeDesc {
            passes: vec![compute(&packs, "to", true, from_and_to())],
            ..base()
        },
        &core,
    )
    .unwrap();
    let double = changed("textureLoad(source, id.xy, 0)", "vec4f(f32(f64(1.0)))");
    let error = compiled(
        NodeDesc {
            passes: vec![compute(&double, "to", true, from_and_to())],
            ..base()
        },
        &core,
    )
    .unwrap_err();
    assert_error(&error, Shader, "host", "", "", "the shader");
}
