//! Ranges that fit themselves: whoever makes a map and whoever reads it have to agree, and the compiler says where they do not.

use moment_shadows_graph::GraphError;
use moment_shadows_graph::GraphErrorKind::{
    self, Format, MissingInput, Property, Size, UnknownName,
};

use crate::example::{compiled, native};

const FITTED: &str = include_str!("../../examples/fitted_range.json");

/// The edge that leads to a slot, with the comma after it.
fn edge(from: &str, to: &str) -> String {
    format!(r#"    {{ "from": "{from}", "to": "{to}" }},"#) + "\n"
}

fn without(text: &str, from: &str, to: &str) -> String {
    let edge = edge(from, to);
    assert!(text.contains(&edge), "{edge}");
    text.replace(&edge, "")
}

#[track_caller]
fn assert_refused(text: &str, kind: GraphErrorKind, slot: &str, says: &str) {
    let error: GraphError = compiled(text, &native()).unwrap_err();
    assert_eq!(
        (error.kind, error.slot.as_deref()),
        (kind, Some(slot)),
        "{error}"
    );
    assert!(error.message.contains(says), "{error}");
}

#[test]
fn the_range_goes_with_the_map() {
    let plan = compiled(FITTED, &native()).unwrap();
    for resource in &plan.resources {
        let Some(texture) = resource.desc.texture() else {
            continue;
        };
        let of_map = texture.encoding.is_some() || resource.name == "fit.ranges";
        assert_eq!(
            texture.range.as_deref(),
            of_map.then_some("fit.ranges"),
            "{}",
            resource.name
        );
    }
    let soft = FITTED
        .replace(
            r#""type": "blur", "properties": { "kernel": { "radius": 4, "sigma": 2.4 } }"#,
            r#""type": "summed_area_table""#,
        )
        .replace("blur.blurred", "blur.table")
        .replace("shade.map", "shade.table")
        .replace("shade_hard", "shade_soft");
    compiled(&soft, &native()).unwrap();
    let open = without(&soft, "fit.ranges", "shade.ranges");
    assert_refused(&open, MissingInput, "ranges", "'fit.ranges'");
}

#[test]
fn a_map_and_its_reader_have_the_same_range() {
    let open = without(FITTED, "fit.ranges", "shade.ranges");
    assert_refused(&open, MissingInput, "ranges", "fitted to 'fit.ranges'");
    let unfitted = without(FITTED, "fit.ranges", "resolve.ranges");
    assert_refused(&unfitted, Format, "ranges", "are not fitted");
    let other = FITTED
        .replace(
            r#"{ "name": "fit", "#,
            r#"{ "name": "other", "type": "fit_range" }, { "name": "fit", "#,
        )
        .replace(
            &edge("light_depth", "fit.depth"),
            &(edge("light_depth", "fit.depth") + &edge("light_depth", "other.depth")),
        )
        .replace(
            &edge("fit.ranges", "shade.ranges"),
            &edge("other.ranges", "shade.ranges"),
        );
    assert_refused(&other, Format, "ranges", "'other.ranges'");
}

#[test]
fn what_cannot_be_fitted_says_so() {
    // Tests on the plain depth map have no such input.
    let plain = FITTED
        .replace(
            r#""type": "shade_hard""#,
            r#""type": "shade_hard", "properties": { "technique": "pcf" }"#,
        )
        .replace(r#""samples": 4"#, r#""samples": 1"#)
        .replace(
            &edge("blur.blurred", "shade.map"),
            &edge("light_depth", "shade.depth"),
        );
    assert_refused(&plain, UnknownName, "ranges", "ranges");
    // Layers are placed in the host's range.
    let placed = FITTED
        .replace(
            r#""storage": ["unorm16", "float16"]"#,
            r#""technique": { "lvsm": { "layers": 3, "splits": "lloyd" } }, "storage": "float16""#,
        )
        .replace(r#"{ "name": "fit", "#, r#"{ "name": "place", "type": "place_layers", "properties": { "layers": 3 } }, { "name": "fit", "#)
        .replace(
            &edge("light_depth", "fit.depth"),
            &(edge("light_depth", "fit.depth") + &edge("light_depth", "place.depth") + &edge("place.splits", "resolve.splits") + &edge("place.splits", "shade.splits")),
        );
    assert_refused(&placed, Property, "ranges", "placed in the host's range");
    // Light rays in the air are.
    let air = FITTED
        .replace(
            r#"{ "name": "shade", "type": "shade_hard" }"#,
            r#"{ "name": "shade", "type": "rectify_moments", "properties": { "storage": "float16" } }"#,
        )
        .replace(&edge("fit.ranges", "shade.ranges"), "")
        .replace(r#"},
    { "from": "camera_depth", "to": "shade.camera_depth" }"#, "}")
        .replace("shade.shadow_intensity", "shade.rectified");
    assert_refused(&air, Format, "map", "in the host's range");
    let crowded = FITTED.replace(
        r#""size": [1024, 1024], "samples": 4"#,
        r#""size": [64, 32], "regions": 3"#,
    );
    assert_refused(&crowded, Size, "depth", "fewer regions");
    // A texture that is none.
    let imported = FITTED
        .replace(r#""imports": ["#, r#""imports": [ { "name": "given", "texture": { "format": "rgba32float", "size": [1, 1] } },"#)
        .replace(&edge("fit.ranges", "resolve.ranges"), &edge("given", "resolve.ranges"));
    assert_refused(&imported, Format, "ranges", "holds no ranges");
    // Ranges of another depth map.
    let foreign = FITTED
        .replace(r#""imports": ["#, r#""imports": [ { "name": "second", "texture": { "format": "depth32float", "size": [512, 512], "layers": 2 } },"#)
        .replace(&edge("light_depth", "fit.depth"), &edge("second", "fit.depth"));
    assert_refused(&foreign, Format, "ranges", "in 2 layers");
}
