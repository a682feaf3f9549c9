//! The storage that is rounded once alone: a blur that resolves writes it, and nothing filters it again.

use moment_shadows::{Profile, TextureFormat};
use moment_shadows_graph::GraphErrorKind::{Format, Property};
use moment_shadows_graph::{Capabilities, Plan};

use crate::example::{assert_error, compiled, edited, refused};

/// The example with a blur that resolves, with these properties besides.
fn resolved(properties: &str, radius: u32) -> String {
    edited(
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
    )
}

const ONCE: &str = r#""resolve": { "storage": "packed32" }"#;

#[test]
fn rows_are_packed_in_64_bits_and_the_map_in_32_on_every_device() {
    let core = Capabilities::of_profile(Profile::WebgpuCore);
    let plan: Plan = compiled(&resolved(ONCE, 4), &core).unwrap();
    let format = |name: &str| {
        let of_name = |it: &&moment_shadows_graph::PlannedResource| it.name == name;
        let resource = plan.resources.iter().find(of_name).unwrap();
        resource.desc.texture().unwrap().format
    };
    assert_eq!(format("blur.half_blurred"), TextureFormat::Rg32Uint);
    assert_eq!(format("blur.blurred"), TextureFormat::R32Uint);
}

#[test]
fn it_is_refused_where_it_would_be_rounded_again_with_what_to_write() {
    let resolve = edited("\"storage\": \"unorm16\"", "\"storage\": \"packed32\"");
    assert_error(
        &refused(&resolve),
        Property,
        "resolve",
        "",
        "8:5",
        "give a node 'blur' the property 'resolve' with it ({ \"storage\": \"packed32\" }) in place of this node",
    );
    for (properties, radius, says) in [
        (
            ONCE.to_owned(),
            13,
            "another storage than 'packed32', which is written once",
        ),
        (
            format!("{ONCE}, \"per_frame\": true"),
            4,
            "another storage than 'packed32'",
        ),
        (
            format!("{ONCE}, \"rounded_inwards\": true"),
            4,
            "as unorm16 or float16",
        ),
    ] {
        let error = refused(&resolved(&properties, radius));
        assert_eq!(error.kind, Property, "{error}");
        assert!(error.message.contains(says), "{error}");
    }
    let again = resolved(ONCE, 4)
        .replace(
            "{ \"from\": \"blur.blurred\", \"to\": \"shade.map\" }",
            "{ \"from\": \"blur.blurred\", \"to\": \"again.map\" },\n    { \"from\": \"again.blurred\", \"to\": \"shade.map\" }",
        )
        .replace(
            "    { \"name\": \"shade\"",
            "    { \"name\": \"again\", \"type\": \"blur\", \"properties\": { \"kernel\": { \"radius\": 1 } } },\n    { \"name\": \"shade\"",
        );
    let error = refused(&again);
    assert_eq!(
        (error.kind, error.slot.as_deref()),
        (Format, Some("map")),
        "{error}"
    );
    let says = "is rounded too coarsely to be filtered; give this node 'resolve' with that storage";
    assert!(error.message.contains(says), "{error}");
    assert_eq!(error.node.as_deref(), Some("again"));
}

#[test]
fn the_best_of_32_bits_is_written_once_where_it_can_be() {
    let core = Capabilities::of_profile(Profile::WebgpuCore);
    let best = r#""technique": "best", "bits": 32"#;
    let blurred = resolved(&format!("\"resolve\": {{ {best} }}"), 4);
    let apart = edited("\"storage\": \"unorm16\"", best);
    let format = |text: &str| {
        let plan = compiled(text, &core).unwrap();
        let map = plan.resources.iter().find(|it| it.name == "blur.blurred");
        map.unwrap().desc.texture().unwrap().format
    };
    assert_eq!(format(&blurred), TextureFormat::R32Uint);
    assert_eq!(format(&apart), TextureFormat::R32Float);
}
