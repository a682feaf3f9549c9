//! Arguments that are values of the library, by their own names.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use moment_shadows::Profile;

/// A profile.
pub fn profile() -> impl TypedValueParser<Value = Profile> {
    named(Profile::ALL, Profile::name)
}

/// One of these values, by its name.
pub fn named<T: Copy + Send + Sync + 'static, const COUNT: usize>(
    all: [T; COUNT],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(all.map(name)).try_map(move |text| {
        let found = all.into_iter().find(|&value| name(value) == text);
        found.ok_or("there is no such name")
    })
}
