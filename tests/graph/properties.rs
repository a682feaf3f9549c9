//! Properties of nodes in a file that are refused.

use crate::example::{TEXT, assert_error, edited, refused};
use moment_shadows_graph::GraphErrorKind::{Property, UnknownNodeType};
use moment_shadows_graph::{Graph, NodeRegistry};

#[test]
fn kernels_say_what_is_wrong_with_them() {
    let cases = [
        ("{ \"radius\": 0 }", "radius is 1 to 64 texels, not 0"),
        ("{ \"radius\": 65 }", "radius is 1 to 64 texels, not 65"),
        (
            "{ \"radius\": 4, \"sigma\": 0 }",
            "sigma is a positive number of texels, not 0",
        ),
        ("{ \"radius\": 4, \"sigma\": -1.5 }", "not -1.5"),
        (
            "{ \"weights\": [1, 1] }",
            "odd number of weights, 3 to 129, not 2",
        ),
        ("{ \"weights\": [1, -1, 1] }", "weight 1 is -1"),
        ("{ \"weights\": [0, 0, 0] }", "all weights are 0"),
        (
            "{ \"weights\": [1, 2, 1], \"radius\": 1 }",
            "either a 'radius' (with a 'sigma' or a 'width') or 'weights'",
        ),
        (
            "{ \"weights\": [1, 2, 1], \"sigma\": 1 }",
            "give one of them",
        ),
        ("{}", "give one of them"),
        (
            "{ \"radius\": 4, \"sigma\": 2, \"width\": 0.1 }",
            "give one of them",
        ),
        ("{ \"radius\": 4, \"width\": 0 }", "positive length"),
        ("{ \"radius\": 65, \"width\": 0.1 }", "1 to 64 texels"),
    ];
    for (kernel, says) in cases {
        let text = edited("{ \"radius\": 4, \"sigma\": 2.4 }", kernel);
        assert_error(&refused(&text), Property, "blur", "", "9:5", says);
    }
}

#[test]
fn what_a_blur_cannot_resolve_is_refused_with_what_to_do() {
    let cases = [
        (r#""resolve": { "blends": 2 }"#, "4", "has 'blends'"),
        (r#""resolve": { "mip_levels": 2 }"#, "4", "has 'mip_levels'"),
        (
            r#""resolve": {}, "per_frame": true"#,
            "4",
            "at most radius 12",
        ),
        (r#""resolve": {}"#, "13", "at most radius 12"),
        (r#""resolve": {}"#, "4, \"width\": 0.1", "at most radius 12"),
        (
            r#""resolve": { "technique": "hamburger6", "storage": "unorm10" }"#,
            "4",
            "as 'unorm10', which is drawn",
        ),
        (
            r#""resolve": { "bits": 64 }"#,
            "4",
            "64 beside the technique",
        ),
    ];
    for (properties, radius, says) in cases {
        let text = edited(
            "\"kernel\": { \"radius\": 4, \"sigma\": 2.4 }",
            &format!("{properties}, \"kernel\": {{ \"radius\": {radius} }}"),
        )
        .replace("\"to\": \"resolve.depth\"", "\"to\": \"blur.depth\"")
        .replace(
            "    { \"from\": \"resolve.map\", \"to\": \"blur.map\" },\n",
            "",
        )
        .replace(
            "    { \"name\": \"resolve\", \"type\": \"resolve\", \"properties\": { \"storage\": \"unorm16\" } },\n",
            "",
        );
        let error = refused(&text);
        assert_eq!(error.kind, Property, "{error}");
        assert!(error.message.contains(says), "{error}");
    }
}

#[test]
fn moment_scale_is_refused_with_the_reason() {
    let text = edited(
        "\"type\": \"shade_hard\"",
        "\"type\": \"shade_hard\", \"properties\": { \"moment_scale\": 0.98 }",
    );
    assert_error(
        &refused(&text),
        Property,
        "shade",
        "",
        "10:5",
        "the moments of no distribution, so that the result bounds nothing",
    );
}

#[test]
fn media_that_are_not_homogeneous_are_refused_with_the_reason() {
    let text = edited(
        "\"type\": \"shade_hard\"",
        "\"type\": \"integrate_scattering\", \"properties\": { \"medium\": \"inhomogeneous\" }",
    );
    assert_error(
        &refused(&text),
        Property,
        "shade",
        "",
        "10:5",
        "'medium' is refused: all view rays of a row share its sums",
    );
}

#[test]
fn shadow_intensity_has_a_channel_per_light() {
    let text = edited(
        "\"type\": \"shade_hard\"",
        "\"type\": \"shade_hard\", \"properties\": { \"format\": \"rgba16unorm\" }",
    );
    assert_error(
        &refused(&text),
        Property,
        "shade",
        "",
        "10:5",
        "r8unorm, r16float, r32float or rgba8unorm, rgba16float, rgba32float, not rgba16unorm",
    );
}

#[test]
fn names_of_version_1_are_read_with_a_note_each() {
    let current = TEXT.to_owned();
    let old = [
        ("\"version\": 2", "\"version\": 1"),
        ("\"type\": \"resolve\"", "\"type\": \"resolve_moments\""),
        ("\"type\": \"blur\"", "\"type\": \"blur_moments\""),
        (".map\"", ".moments\""),
    ]
    .iter()
    .fold(current.clone(), |text, (now, old)| text.replace(now, old));
    let graph = |text: &str| Graph::parse(text, &NodeRegistry::new()).unwrap();
    let (read, expected) = (graph(&old), graph(&current));
    let ends = |graph: &Graph| -> Vec<_> {
        let edges = graph.edges.iter();
        let edges = edges.flat_map(|edge| [edge.from.clone(), edge.to.clone()]);
        edges
            .chain(graph.outputs.iter().map(|output| output.value.clone()))
            .collect()
    };
    assert_eq!(ends(&read), ends(&expected));
    assert_eq!(
        format!(
            "{:?}",
            read.nodes
                .iter()
                .map(|node| &node.value)
                .collect::<Vec<_>>()
        ),
        format!(
            "{:?}",
            expected
                .nodes
                .iter()
                .map(|node| &node.value)
                .collect::<Vec<_>>()
        )
    );
    assert_eq!(read.notes.len(), 5, "{:?}", read.notes);
    assert!(read.notes[0].contains("'resolve_moments' is called 'resolve'"));
    assert!(expected.notes.is_empty());
    // In a file of the current version the old names are unknown.
    let mixed = current.replace("\"type\": \"blur\"", "\"type\": \"blur_moments\"");
    let error = Graph::parse(&mixed, &NodeRegistry::new()).unwrap_err();
    assert_eq!(error.kind, UnknownNodeType);
    // Tools that change files rewrite them first.
    let mut value = serde_json::from_str(&old).unwrap();
    assert_eq!(Graph::upgrade(&mut value), read.notes);
    assert_eq!(
        value,
        serde_json::from_str::<serde_json::Value>(&current).unwrap()
    );
}
