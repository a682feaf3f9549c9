//! A technique that is left to the library.

use moment_shadows::{Profile, Technique};
use moment_shadows_graph::Capabilities;
use moment_shadows_graph::GraphErrorKind::Property;

use crate::example::{assert_error, compiled, edited, refused};

fn with(properties: &str) -> String {
    edited("\"storage\": \"unorm16\"", properties)
}

#[test]
fn the_best_is_what_the_record_has_for_the_profile_and_the_bits() {
    let mut seen = Vec::new();
    for profile in Profile::ALL {
        let capabilities = Capabilities::of_profile(profile);
        for bits in [None, Some(64), Some(128)] {
            let given = bits.map_or(String::new(), |bits| format!(", \"bits\": {bits}"));
            let found = compiled(
                &with(&format!("\"technique\": \"best\"{given}")),
                &capabilities,
            );
            let best = Technique::best(profile, bits.unwrap_or(64)).unwrap();
            let [technique, storage] = [best.technique().name(), best.storage().name()];
            let named = format!("\"technique\": \"{technique}\", \"storage\": \"{storage}\"");
            let named = compiled(&with(&named), &capabilities);
            assert_eq!(found.unwrap(), named.unwrap(), "{profile}, {bits:?}");
            seen.push((technique.to_owned(), storage.to_owned()));
        }
    }
    // The three that the table has for 64 and 128 bits.
    seen.sort();
    seen.dedup();
    assert_eq!(seen.len(), 3, "{seen:?}");
}

#[test]
fn what_the_best_cannot_be_is_refused() {
    let cases = [
        ("\"technique\": \"best\", \"bits\": 8", "8; no technique"),
        (
            "\"technique\": \"best\", \"storage\": \"unorm16\"",
            "brings its own",
        ),
        ("\"bits\": 64", "beside the technique 'hamburger4'"),
    ];
    for (properties, says) in cases {
        assert_error(
            &refused(&with(properties)),
            Property,
            "resolve",
            "",
            "8:5",
            says,
        );
    }
}
