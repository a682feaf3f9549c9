//! What `shade_soft` cannot be connected to, and properties that are wrong.

use moment_shadows::Profile;
use moment_shadows_graph::{Capabilities, Graph, GraphError, GraphErrorKind, NodeRegistry};

const TEXT: &str = include_str!("../../examples/soft_shadows.json");

fn error(text: &str) -> GraphError {
    let capabilities = Capabilities::of_profile(Profile::Native);
    Graph::parse(text, &NodeRegistry::new())
        .and_then(|graph| graph.compile(&capabilities, &[]))
        .unwrap_err()
}

#[test]
fn the_example_compiles_under_core_webgpu() {
    let graph = Graph::parse(TEXT, &NodeRegistry::new()).unwrap();
    let capabilities = Capabilities::of_profile(Profile::WebgpuCore);
    let plan = graph.compile(&capabilities, &[]).unwrap();
    assert!(plan.passes.iter().any(|pass| pass.node == "shade"));
}

#[test]
fn a_map_that_is_no_table_is_named() {
    let text = TEXT.replace(
        r#"{ "from": "sum.table", "to": "shade.table" }"#,
        r#"{ "from": "resolve.map", "to": "shade.table" }"#,
    );
    let error = error(&text);
    assert_eq!(error.kind, GraphErrorKind::Format);
    let message = error.to_string();
    assert!(
        message.contains("shade") && message.contains("summed_area_table"),
        "{message}"
    );
}

#[test]
fn a_table_is_no_filterable_map() {
    let text = TEXT
        .replace(r#""type": "shade_soft""#, r#""type": "shade_hard""#)
        .replace(r#""to": "shade.table""#, r#""to": "shade.map""#);
    let error = error(&text);
    assert_eq!(error.kind, GraphErrorKind::Format);
    assert!(error.to_string().contains("summed-area table"), "{error}");
}

#[test]
fn techniques_without_moments_of_depth_have_no_soft_shadows() {
    let text = TEXT.replace(
        r#""storage": "float32""#,
        r#""storage": "float32", "technique": { "esm": { "exponent": 40 } }"#,
    );
    let message = error(&text).to_string();
    assert!(message.contains("esm"), "{message}");
}

#[test]
fn kernels_beyond_the_range_of_sums_are_refused_with_the_largest() {
    for (kernel, named) in [("257", "256"), ("0", "at least 1"), ("[65538, 1]", "65537")] {
        let text = TEXT.replace(
            r#""largest_kernel": 129"#,
            &format!(r#""largest_kernel": {kernel}"#),
        );
        assert_ne!(text, TEXT);
        let message = error(&text).to_string();
        assert!(
            message.contains("sum") && message.contains(named),
            "{kernel}: {message}"
        );
    }
}

#[test]
fn lights_views_and_formats_are_those_of_hard_shadows() {
    for (properties, named) in [
        (r#"{ "lights": 17 }"#, "'lights' is 17"),
        (r#"{ "lights": 2, "views": 1 }"#, "'views' is 1"),
        (r#"{ "format": "rg16float" }"#, "r8unorm"),
        (r#"{ "interpolation": "some" }"#, "some"),
        (r#"{ "anisotropy": 4 }"#, "anisotropy"),
    ] {
        let text = TEXT.replace(
            r#""type": "shade_soft""#,
            &format!(r#""type": "shade_soft", "properties": {properties}"#),
        );
        let message = error(&text).to_string();
        assert!(message.contains(named), "{properties}: {message}");
    }
}

#[test]
fn a_technique_without_soft_shadows_is_refused_by_name() {
    let text = TEXT.replace(
        r#""properties": { "storage": "float32" }"#,
        r#""properties": { "technique": "hausdorff4", "storage": "float32" }"#,
    );
    let error = error(&text);
    assert_eq!(error.kind, GraphErrorKind::Format);
    assert_eq!(
        (error.node.as_deref(), error.slot.as_deref()),
        (Some("shade"), Some("table"))
    );
    let message = error.to_string();
    assert!(
        message.contains("no soft shadows by 'hausdorff4'"),
        "{message}"
    );
    // Hamburger's bound of the same map is evaluated, and so is that of two moments.
    for (technique, evaluates) in [
        ("hamburger4", "return moment_soft_shadows_intensity("),
        ("vsm", "return moment_soft_shadows_variance_intensity("),
    ] {
        let text = TEXT.replace(
            r#""properties": { "storage": "float32" }"#,
            &format!(r#""properties": {{ "technique": "{technique}", "storage": "float32" }}"#),
        );
        let graph = Graph::parse(&text, &NodeRegistry::new()).unwrap();
        let capabilities = Capabilities::of_profile(Profile::Native);
        let plan = graph.compile(&capabilities, &[]).unwrap();
        let shade = plan
            .passes
            .iter()
            .find(|pass| pass.node == "shade")
            .unwrap();
        assert!(plan.wgsl(shade).contains(evaluates), "{technique}");
    }
}
