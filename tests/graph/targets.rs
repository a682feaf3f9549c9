//! Passes that the host draws, and what they draw to.

use moment_shadows::TextureFormat::{Depth32Float, R8Unorm, R32Float};
use moment_shadows_graph::GraphErrorKind::{Capability, Declaration, Size};
use moment_shadows_graph::{
    Access, Direction, GraphError, NodeDesc, Pass, Plan, Rule, Slot, SlotResource, Stage,
    TextureRule,
};

use crate::example::{assert_error, native};
use crate::host_node::{empty, graph, input, made, rgba32};

/// Compiles a node `host` with the input `from` and the output `to`.
pub(crate) fn compiled(node: NodeDesc) -> Result<Plan, GraphError> {
    let graph = graph(
        &[("map", rgba32(1))],
        vec![("host", node)],
        &[("map", "host.from")],
        &[("out", "host.to")],
    );
    graph.compile(&native(), &[])
}

fn refused(node: NodeDesc) -> GraphError {
    compiled(node).unwrap_err()
}

/// A node whose pass the host draws.
fn drawn(slots: Vec<Slot>, targets: &[&str], blend: bool, depth: Option<&str>) -> NodeDesc {
    let mut all = vec![input("from")];
    all.extend(slots);
    let pass = Pass::host("draw", targets, depth);
    let pass = if blend { pass.blended() } else { pass };
    empty(Stage::AfterShadowMaps).slots(all).pass(pass)
}

#[test]
fn targets_that_a_host_cannot_draw_to() {
    let target = |name: &str, format| made(name, Direction::Out, Access::RENDER_TARGET, format, 1);
    let depth = drawn(vec![target("to", Depth32Float)], &["to"], false, None);
    assert_error(
        &refused(depth),
        Declaration,
        "host",
        "",
        "",
        "has the colour target depth32float",
    );
    let colour = drawn(vec![target("to", R8Unorm)], &[], false, Some("to"));
    assert_error(
        &refused(colour),
        Declaration,
        "host",
        "",
        "",
        "has the depth target r8unorm, which holds no depth",
    );
    let blend = drawn(vec![target("to", R32Float)], &["to"], true, None);
    assert_error(
        &refused(blend),
        Capability,
        "host",
        "",
        "",
        "blends into r32float",
    );
    let nothing = drawn(vec![target("to", R8Unorm)], &[], false, None);
    assert_error(
        &refused(nothing),
        Declaration,
        "host",
        "",
        "",
        "draws to nothing",
    );
    let mut small = target("small", Depth32Float);
    if let SlotResource::Texture(TextureRule { extent, .. }) = &mut small.resource {
        *extent = Rule::Exact([8, 8]);
    }
    let sizes = drawn(
        vec![target("to", R8Unorm), small],
        &["to"],
        false,
        Some("small"),
    );
    assert_error(
        &refused(sizes),
        Size,
        "host",
        "",
        "",
        "r8unorm 16x16 and to depth32float 8x8 at once",
    );
}

#[test]
fn a_host_pass_moves_the_bytes_of_its_targets() {
    let target = |name: &str, format| made(name, Direction::Out, Access::RENDER_TARGET, format, 1);
    let node = drawn(
        vec![target("to", R8Unorm), target("depth", Depth32Float)],
        &["to"],
        true,
        Some("depth"),
    );
    let graph = graph(
        &[("map", rgba32(1))],
        vec![("host", node)],
        &[("map", "host.from")],
        &[("out", "host.to")],
    );
    let plan = graph.compile(&native(), &[]).unwrap();
    assert_eq!(
        (plan.passes[0].bytes_read, plan.passes[0].bytes_written),
        (256, 256 + 1024)
    );
}
