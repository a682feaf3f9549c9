//! Nodes of a host's own that contradict themselves.

use moment_shadows::TextureFormat::{R8Unorm, Rgba32Float};
use moment_shadows_graph::GraphErrorKind::{Declaration, DuplicateName, Size};
use moment_shadows_graph::{
    Access, BindingResource, Direction, GraphError, NodeDesc, ParameterBlock, Rule, Slot,
    SlotResource, Stage, TextureRule, Work, bind,
};

use crate::example::{assert_error, native};
use crate::host_node::{COPY, compute, copy, from_and_to, graph, input, made, output, rgba32};

/// The error of a node `host` with the input `from` and the output `to`.
#[track_caller]
fn refused(node: NodeDesc) -> GraphError {
    let graph = graph(
        &[("map", rgba32(1))],
        vec![("host", node)],
        &[("map", "host.from")],
        &[("out", "host.to")],
    );
    graph.compile(&native(), &[]).unwrap_err()
}

fn base() -> NodeDesc {
    copy(Stage::AfterShadowMaps, 1)
}

#[test]
fn the_node_without_a_fault_compiles() {
    let graph = graph(
        &[("map", rgba32(1))],
        vec![("host", base())],
        &[("map", "host.from")],
        &[("out", "host.to")],
    );
    graph.compile(&native(), &[]).unwrap();
}

#[test]
fn two_slots_of_a_name() {
    let node = NodeDesc {
        slots: vec![input("from"), output("to", 1), output("to", 1)],
        ..base()
    };
    assert_error(
        &refused(node),
        DuplicateName,
        "host",
        "to",
        "",
        "two slots of this name",
    );
}

type Change = fn(&mut SlotResource);

#[test]
fn outputs_that_leave_something_open() {
    let open = |change: fn(&mut SlotResource)| {
        let mut to = output("to", 1);
        change(&mut to.resource);
        refused(NodeDesc {
            slots: vec![input("from"), to],
            ..base()
        })
    };
    let cases: [(Change, &str); 5] = [
        (
            |resource| {
                if let SlotResource::Texture(TextureRule { format, .. }) = resource {
                    *format = Rule::OneOf(vec![Rgba32Float])
                }
            },
            "leaves its format open",
        ),
        (
            |resource| {
                if let SlotResource::Texture(TextureRule { extent, .. }) = resource {
                    *extent = Rule::Any
                }
            },
            "leaves its extent open",
        ),
        (
            |resource| {
                if let SlotResource::Texture(TextureRule { layers, .. }) = resource {
                    *layers = Rule::Any
                }
            },
            "leaves its number of layers open",
        ),
        (
            |resource| {
                if let SlotResource::Texture(TextureRule { samples, .. }) = resource {
                    *samples = Rule::OneOf(vec![1])
                }
            },
            "leaves its number of samples open",
        ),
        (
            |resource| {
                if let SlotResource::Texture(TextureRule { extent, .. }) = resource {
                    *extent = Rule::SameAs("form".to_owned())
                }
            },
            "refers to 'form', which is no connected texture",
        ),
    ];
    for (change, says) in cases {
        assert_error(&open(change), Declaration, "host", "to", "", says);
    }
}

#[test]
fn outputs_that_no_pass_writes() {
    let node = NodeDesc {
        passes: Vec::new(),
        ..base()
    };
    assert_error(
        &refused(node),
        Declaration,
        "host",
        "to",
        "",
        "none of its passes writes it",
    );
}

#[test]
fn inputs_that_are_written() {
    let from = made("from", Direction::In, Access::STORAGE_WRITE, Rgba32Float, 1);
    let node = NodeDesc {
        slots: vec![from, output("to", 1)],
        ..base()
    };
    assert_error(
        &refused(node),
        Declaration,
        "host",
        "from",
        "",
        "changed in place",
    );
}

#[test]
fn passes_that_use_what_is_not_there() {
    let pass = |source: BindingResource| NodeDesc {
        passes: vec![compute(
            COPY,
            "to",
            true,
            [("source", source), ("copied", bind::store("to"))],
        )],
        ..base()
    };
    assert_error(
        &refused(pass(bind::layer("form"))),
        Declaration,
        "host",
        "",
        "",
        "uses slot 'form', which the node does not have",
    );
    assert_error(
        &refused(pass(bind::parameters())),
        Declaration,
        "host",
        "",
        "",
        "uses parameters, but the node has none",
    );
    let covers = NodeDesc {
        passes: vec![compute(COPY, "nothing", true, from_and_to())],
        ..base()
    };
    assert_error(
        &refused(covers),
        Declaration,
        "host",
        "",
        "",
        "uses slot 'nothing'",
    );
    let buffer = NodeDesc {
        slots: vec![
            input("from"),
            output("to", 1),
            Slot::internal(
                "data",
                "Numbers.",
                SlotResource::Buffer {
                    access: Access::READ,
                    size: 16,
                },
            ),
        ],
        passes: vec![compute(
            COPY,
            "to",
            true,
            [
                ("source", bind::layer("data")),
                ("copied", bind::store("to")),
            ],
        )],
        ..base()
    };
    assert_error(
        &refused(buffer),
        Declaration,
        "host",
        "",
        "",
        "uses the buffer 'data' as a texture",
    );
}

#[test]
fn passes_that_do_more_than_the_slot_says() {
    let to = made("to", Direction::Out, Access::RENDER_TARGET, Rgba32Float, 1);
    let node = NodeDesc {
        slots: vec![input("from"), to],
        ..base()
    };
    assert_error(
        &refused(node),
        Declaration,
        "host",
        "to",
        "",
        "more with this slot than its declared access allows",
    );
}

#[test]
fn passes_that_read_what_they_write() {
    let access = Access::READ.union(Access::STORAGE_WRITE);
    let node = NodeDesc {
        slots: vec![
            input("from"),
            made("to", Direction::Out, access, Rgba32Float, 1),
        ],
        passes: vec![compute(
            COPY,
            "to",
            true,
            [("source", bind::layer("to")), ("copied", bind::store("to"))],
        )],
        ..base()
    };
    assert_error(
        &refused(node),
        Declaration,
        "host",
        "",
        "",
        "writes 'host.to' while it uses it in another way",
    );
}

#[test]
fn workgroups_that_cover_nothing() {
    let mut node = base();
    node.passes[0].work = Work::Compute {
        covers: "to".to_owned(),
        level: 0,
        texels_per_workgroup: [8, 0],
        regions: false,
    };
    assert_error(
        &refused(node),
        Declaration,
        "host",
        "to",
        "",
        "covers no texel",
    );
}

#[test]
fn multisampled_arrays() {
    let mut to = made("to", Direction::Out, Access::RENDER_TARGET, R8Unorm, 2);
    if let SlotResource::Texture(TextureRule { samples, .. }) = &mut to.resource {
        *samples = Rule::Exact(4);
    }
    let node = NodeDesc {
        slots: vec![input("from"), to],
        ..base()
    };
    assert_error(
        &refused(node),
        Declaration,
        "host",
        "to",
        "",
        "multisampled texture with several layers",
    );
}

#[test]
fn buffers_of_no_size() {
    for size in [0, 6] {
        let data = Slot::internal(
            "data",
            "Numbers.",
            SlotResource::Buffer {
                access: Access::READ,
                size,
            },
        );
        let node = NodeDesc {
            slots: vec![input("from"), output("to", 1), data],
            ..base()
        };
        assert_error(
            &refused(node),
            Size,
            "host",
            "data",
            "",
            "positive multiple of 4",
        );
    }
}

fn with_parameters(size: u32, initial: Vec<u8>, each_layer_of: Option<&str>) -> NodeDesc {
    NodeDesc {
        parameters: Some(ParameterBlock {
            name: "P".to_owned(),
            elements: 1,
            size,
            each_layer_of: each_layer_of.map(str::to_owned),
            initial,
        }),
        ..base()
    }
}

#[test]
fn parameters_that_do_not_fit() {
    assert_error(
        &refused(with_parameters(0, Vec::new(), None)),
        Declaration,
        "host",
        "",
        "",
        "a uniform struct is not empty",
    );
    assert_error(
        &refused(with_parameters(4, vec![0; 8], None)),
        Declaration,
        "host",
        "",
        "",
        "4 bytes, but 8 bytes of initial values",
    );
    assert_error(
        &refused(with_parameters(16, Vec::new(), Some("form"))),
        Declaration,
        "host",
        "",
        "",
        "per layer of 'form', which is no slot",
    );
    assert_error(
        &refused(with_parameters(u32::MAX, Vec::new(), None)),
        Size,
        "host",
        "",
        "",
        "more than a uniform binding of this device holds (65536 bytes); at most 0 of them",
    );
}

#[test]
fn slots_without_a_description() {
    let mut node = base();
    node.slots[1].description = " ".to_owned();
    assert_error(
        &refused(node),
        Declaration,
        "host",
        "to",
        "",
        "the slot has no description; say in a sentence what it is for",
    );
}
