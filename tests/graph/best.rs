//! A technique that is left to the library.

use moment_shadows::{Profile, Storage, Technique};
use moment_shadows_graph::Capabilities;
use moment_shadows_graph::GraphErrorKind::Property;
use moment_shadows_graph::nodes::Resolve;

use crate::example::{assert_error, compiled, edited, refused};

fn with(properties: &str) -> String {
    edited("\"storage\": \"unorm16\"", properties)
}

#[test]
fn the_best_is_what_the_record_has_for_the_profile_and_the_bits() {
    let mut seen = Vec::new();
    for profile in Profile::ALL {
        let capabilities = Capabilities::of_profile(profile);
        for bits in [None, Some(32), Some(64), Some(256)] {
            let given = bits.map_or(String::new(), |bits| format!(", \"bits\": {bits}"));
            let found = compiled(
                &with(&format!("\"technique\": \"best\"{given}")),
                &capabilities,
            );
            // A blur that resolves makes the others.
            let mut all = Technique::by_error(profile, bits.unwrap_or(64));
            let best = all.find(|it| !it.storage().is_written_once()).unwrap();
            let [technique, storage] = [best.technique().name(), best.storage().name()];
            let named = format!("\"technique\": \"{technique}\", \"storage\": \"{storage}\"");
            let named = compiled(&with(&named), &capabilities);
            assert_eq!(found.unwrap(), named.unwrap(), "{profile}, {bits:?}");
            seen.push((technique.to_owned(), storage.to_owned()));
        }
    }
    // Those that the table has for 64 and 256 bits, and for 32 on core WebGPU and elsewhere.
    seen.sort();
    seen.dedup();
    assert_eq!(seen.len(), 4, "{seen:?}");
}

/// Packed texels have the least error, but no mip levels, and no node for soft shadows reads them.
#[test]
fn the_best_is_one_of_the_storages_that_are_given_and_suits_mip_levels() {
    let bits = 64;
    let capabilities = Capabilities::of_profile(Profile::WebgpuCore);
    let encoding = |storage: &[Storage], mip_levels| {
        let resolve = Resolve {
            technique: None,
            bits: Some(bits),
            storage: storage.to_vec(),
            blends: 0,
            mip_levels,
        };
        let encoding = resolve.encoding(&capabilities).unwrap();
        (encoding.technique().name().to_owned(), encoding.storage())
    };
    let named = |technique: &str, storage| (technique.to_owned(), storage);
    let (packed, sampled) = (
        named("hamburger4", Storage::Packed64),
        named("evsm4", Storage::Float16),
    );
    assert_eq!(encoding(&[], Some(1)), packed);
    assert_eq!(encoding(&[], None), sampled);
    assert_eq!(encoding(&[], Some(2)), sampled);
    assert_eq!(encoding(&[Storage::Float16], Some(1)), sampled);
    let both = [Storage::Float16, Storage::Packed64];
    assert_eq!(encoding(&both, Some(1)), packed);
    assert_eq!(
        encoding(&[Storage::Float32], Some(1)),
        named("vsm", Storage::Float32)
    );
}

#[test]
fn what_the_best_cannot_be_is_refused() {
    let cases = [
        ("\"technique\": \"best\", \"bits\": 8", "8; no technique"),
        (
            "\"technique\": \"best\", \"bits\": 32, \"storage\": \"packed64\"",
            "32; no technique has a map of so few per texel, stored as 'packed64', under",
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
