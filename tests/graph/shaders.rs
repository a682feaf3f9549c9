//! Shaders against declarations: everything that would fail on the device fails when the graph is compiled.

use moment_shadows::TextureFormat;
use moment_shadows_graph::GraphErrorKind::Shader;
use moment_shadows_graph::{
    Access, BindingResource, Capabilities, Direction, GraphError, NodeDesc, ParameterBlock, Pass,
    Plan, Slot, SlotResource, Stage, bind,
};

use crate::example::{assert_error, native};
use crate::host_node::{
    COPY, compute, copy, empty, from_and_to, graph, input, made, output, rgba32,
};

pub(crate) fn compiled(node: NodeDesc, capabilities: &Capabilities) -> Result<Plan, GraphError> {
    let graph = graph(
        &[("map", rgba32(1))],
        vec![("host", node)],
        &[("map", "host.from")],
        &[("out", "host.to")],
    );
    graph.compile(capabilities, &[])
}

pub(crate) fn base() -> NodeDesc {
    copy(Stage::AfterShadowMaps, 1)
}

/// A variable and what it holds.
pub(crate) type Bound = (&'static str, BindingResource);

/// The copying node with another shader or other bindings.
#[track_caller]
pub(crate) fn assert_refused(wgsl: &str, variables: impl IntoIterator<Item = Bound>, says: &str) {
    let node = NodeDesc {
        passes: vec![compute(wgsl, "to", true, variables)],
        ..base()
    };
    assert_error(
        &compiled(node, &native()).unwrap_err(),
        Shader,
        "host",
        "",
        "",
        says,
    );
}

pub(crate) fn changed(from: &str, to: &str) -> String {
    assert_eq!(COPY.matches(from).count(), 1);
    COPY.replace(from, to)
}

#[test]
fn text_that_does_not_parse_or_validate_shows_its_line() {
    assert_refused("fn main( {", from_and_to(), "the shader does not parse");
    assert_refused(
        &changed("textureLoad(source, id.xy, 0)", "vec3f(0.0)"),
        from_and_to(),
        "the shader",
    );
}

#[test]
fn entry_points_have_the_right_name_and_stage() {
    assert_refused(
        &changed("fn main(", "fn copy("),
        from_and_to(),
        "no Compute entry point 'main'",
    );
    assert_refused(
        "@fragment fn main() {}",
        [],
        "no Compute entry point 'main'",
    );
}

#[test]
fn bindings_that_are_missing_superfluous_or_doubled() {
    assert_refused(
        COPY,
        [("source", bind::layer("from"))],
        "the shader uses the variable 'copied', which the node does not describe",
    );
    let [source, copied] = from_and_to();
    let misspelt = [("sauce", source.1.clone()), copied.clone()];
    assert_refused(
        COPY,
        misspelt,
        "'source', which the node does not describe; what it describes and the shader does not use: `sauce`",
    );
    let extra = [source, copied, ("copies", bind::sampler(true))];
    assert_refused(
        COPY,
        extra,
        "the node describes the variable 'copies', which the entry point 'main' does not use; what it uses: `copied`, `source`",
    );
    let mut node = base();
    let again = node.passes[0].bindings[0].clone();
    node.passes[0].bindings.push(again);
    assert_error(
        &compiled(node, &native()).unwrap_err(),
        Shader,
        "host",
        "",
        "",
        "describes the variable 'source' twice",
    );
}

#[test]
fn bindings_of_another_group() {
    assert_refused(
        &changed("@group(0) @binding(1)", "@group(1) @binding(1)"),
        from_and_to(),
        "'copied' is in bind group 1, but the plan has group 0",
    );
    let host_group = Capabilities {
        bind_group: 1,
        ..native()
    };
    assert_error(
        &compiled(base(), &host_group).unwrap_err(),
        Shader,
        "host",
        "",
        "",
        "is in bind group 0, but the plan has group 1",
    );
}

#[test]
fn bindings_of_another_class() {
    assert_refused(
        &changed("texture_2d<f32>", "texture_2d_array<f32>").replace("id.xy, 0)", "id.xy, 0, 0)"),
        from_and_to(),
        "the variable 'source' is not a two-dimensional float texture",
    );
    assert_refused(
        COPY,
        [
            ("source", bind::layers("from")),
            ("copied", bind::store("to")),
        ],
        "the variable 'source' is not a two-dimensional array float texture",
    );
    assert_refused(
        &changed("texture_2d<f32>", "texture_depth_2d").replace(
            "textureLoad(source, id.xy, 0)",
            "vec4f(textureLoad(source, id.xy, 0))",
        ),
        from_and_to(),
        "the variable 'source' is not a two-dimensional float texture",
    );
    assert_refused(
        &changed("texture_2d<f32>", "texture_2d<u32>").replace(
            "textureLoad(source, id.xy, 0)",
            "vec4f(textureLoad(source, id.xy, 0))",
        ),
        from_and_to(),
        "the variable 'source' is not a two-dimensional float texture",
    );
    assert_refused(
        &changed("rgba32float", "rgba16float"),
        from_and_to(),
        "the variable 'copied' is not a two-dimensional storage texture of format rgba32float",
    );
    assert_refused(
        &changed("rgba32float, write", "rgba32float, read_write"),
        from_and_to(),
        "the variable 'copied' is not a two-dimensional storage texture of format rgba32float, written only",
    );
    assert_refused(
        COPY,
        [
            ("source", bind::sampler(false)),
            ("copied", bind::store("to")),
        ],
        "the variable 'source' is not a sampler",
    );
}

const SCALE: &str = "
struct Scale { factor: vec4f, }
@group(0) @binding(0) var source: texture_2d<f32>;
@group(0) @binding(1) var copied: texture_storage_2d<rgba32float, write>;
@group(0) @binding(2) var<uniform> scale: Scale;
@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    textureStore(copied, id.xy, scale.factor * textureLoad(source, id.xy, 0));
}
";

#[test]
fn uniform_structs_of_another_size() {
    let with = |size: u32| {
        let node = NodeDesc {
            passes: vec![compute(
                SCALE,
                "to",
                true,
                from_and_to()
                    .into_iter()
                    .chain([("scale", bind::parameters())]),
            )],
            parameters: Some(ParameterBlock {
                name: "Scale".to_owned(),
                elements: 1,
                size,
                each_layer_of: None,
                initial: Vec::new(),
            }),
            ..base()
        };
        compiled(node, &native())
    };
    assert_eq!(with(16).unwrap().parameters.size, 256);
    assert_error(
        &with(32).unwrap_err(),
        Shader,
        "host",
        "",
        "",
        "the variable 'scale' is not a uniform struct of 32 bytes",
    );
}

#[test]
fn storage_buffers_of_another_access_or_size() {
    let shader = |declaration: &str| {
        format!(
            "@group(0) @binding(0) {declaration};\n@group(0) @binding(1) var copied: texture_storage_2d<rgba32float, write>;\n\
                 @compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3u) {{ textureStore(copied, id.xy, data[0]); }}"
        )
    };
    let with = |declaration: &str, access: Access| {
        let node = NodeDesc {
            slots: vec![
                input("from"),
                output("to", 1),
                Slot::internal(
                    "data",
                    "Numbers.",
                    SlotResource::Buffer { access, size: 64 },
                ),
            ],
            passes: vec![compute(
                &shader(declaration),
                "to",
                true,
                [
                    ("data", bind::buffer("data")),
                    ("copied", bind::store("to")),
                ],
            )],
            ..empty(Stage::AfterShadowMaps)
        };
        compiled(node, &native())
    };
    with("var<storage, read> data: array<vec4f>", Access::READ).unwrap();
    with("var<storage, read> data: array<vec4f, 4>", Access::READ).unwrap();
    let says = "the variable 'data' is not a read-only storage buffer of at most 64 bytes";
    for declaration in [
        "var<storage, read_write> data: array<vec4f>",
        "var<storage, read> data: array<vec4f, 5>",
    ] {
        assert_error(
            &with(declaration, Access::READ).unwrap_err(),
            Shader,
            "host",
            "",
            "",
            says,
        );
    }
    let writable = Access::READ.union(Access::STORAGE_WRITE);
    with("var<storage, read_write> data: array<vec4f>", writable).unwrap();
    let error = with("var<storage, read> data: array<vec4f>", writable).unwrap_err();
    assert_error(
        &error,
        Shader,
        "host",
        "",
        "",
        "is not a writable storage buffer",
    );
}

#[test]
fn constants_that_match_no_override() {
    let wgsl = format!(
        "override scale: f32;\noverride offset: f32 = 0.0;\n@id(7) override numbered: f32 = 1.0;\n{}",
        changed(
            "textureLoad(source, id.xy, 0)",
            "scale * numbered * textureLoad(source, id.xy, 0) + offset"
        )
    );
    let with = |constants: &[(&str, f64)]| {
        let mut node = NodeDesc {
            passes: vec![compute(&wgsl, "to", true, from_and_to())],
            ..base()
        };
        node.passes[0].constants = constants
            .iter()
            .map(|(name, value)| ((*name).to_owned(), *value))
            .collect();
        compiled(node, &native())
    };
    assert_eq!(
        with(&[("scale", 2.0), ("7", 1.0)]).unwrap().passes[0].constants["scale"],
        2.0
    );
    assert_error(
        &with(&[]).unwrap_err(),
        Shader,
        "host",
        "",
        "",
        "override 'scale' has no value",
    );
    assert_error(
        &with(&[("scale", 1.0), ("ofset", 1.0)]).unwrap_err(),
        Shader,
        "host",
        "",
        "",
        "constant 'ofset', which is no override",
    );
}

/// A fullscreen pass that samples `from`.
pub(crate) fn fullscreen(
    wgsl: &str,
    format: TextureFormat,
    variables: impl IntoIterator<Item = Bound>,
) -> NodeDesc {
    let pass = Pass::fullscreen("draw", "to").shader(wgsl, "main");
    empty(Stage::AfterMainPass)
        .slots([
            input("from"),
            made("to", Direction::Out, Access::RENDER_TARGET, format, 1),
        ])
        .pass(
            variables
                .into_iter()
                .fold(pass, |pass, (name, resource)| pass.bind(name, resource)),
        )
}

pub(crate) const SAMPLE: &str = "
@group(0) @binding(0) var source: texture_2d<f32>;
@group(0) @binding(1) var linear: sampler;
@vertex fn fullscreen(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0, 0.0, 1.0);
}
@fragment fn main(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return textureSampleLevel(source, linear, position.xy / 16.0, 0.0);
}
";
