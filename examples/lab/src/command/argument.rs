//! Arguments that are values of the library, by their own names.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use moment_shadows::{Profile, Storage};

use crate::techniques::STORAGES;

/// A storage of a map.
pub(super) fn storage() -> impl TypedValueParser<Value = Storage> {
    named(STORAGES, Storage::name)
}

/// A profile.
pub(super) fn profile() -> impl TypedValueParser<Value = Profile> {
    named(Profile::ALL, Profile::name)
}

/// What a command takes where nothing is given.
pub(crate) fn defaults<A: clap::Args>() -> A {
    let command = A::augment_args(clap::Command::new("defaults"));
    let matches = command.get_matches_from(["defaults"]);
    A::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
}

fn named<T: Copy + Send + Sync + 'static, const COUNT: usize>(
    all: [T; COUNT],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(all.map(name)).try_map(move |text| {
        let found = all.into_iter().find(|&value| name(value) == text);
        found.ok_or("there is no such name")
    })
}
