//! Why a technique, or its combination with a storage, is refused.

use super::Finite;
use crate::Storage;

/// A technique, or its combination with a storage, that is invalid.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TechniqueError {
    /// A storage that the technique cannot use.
    #[error("'{technique}' cannot be stored as {storage}; it can as {}", names(.legal))]
    Storage {
        /// The technique's name.
        technique: &'static str,
        /// The storage.
        storage: Storage,
        /// The storages that it can use.
        legal: &'static [Storage],
    },
    /// A technique whose map has no summed-area table.
    #[error(
        "no summed-area table is made of a map for '{technique}'; one is of maps for hamburger4, hausdorff4 or vsm"
    )]
    NoTable {
        /// The technique's name.
        technique: &'static str,
    },
    /// A summed-area table with the storage of another map.
    #[error(
        "a summed-area table is stored as fixed32, not as {storage}; leave out 'table' for a map that is not a table"
    )]
    NotATable {
        /// The storage.
        storage: Storage,
    },
    /// A technique without a filterable map.
    #[error(
        "'{technique}' reads the plain depth map, which needs no storage; connect the map to 'depth' of the node that shades"
    )]
    ReadsDepth {
        /// The technique's name.
        technique: &'static str,
    },
    /// An exponent out of range.
    #[error(
        "'{technique}' has the exponent {exponent}; stored as {storage} it is from 1 to {largest}"
    )]
    Exponent {
        /// The technique's name.
        technique: &'static str,
        /// The storage.
        storage: Storage,
        /// The exponent that was given.
        exponent: Finite,
        /// The largest exponent that the storage's range and precision allow.
        largest: f32,
    },
    /// A number out of range.
    #[error("'{technique}' has {count} {what}; it can have {smallest} to {largest}")]
    Count {
        /// The technique's name.
        technique: &'static str,
        /// What is counted.
        what: &'static str,
        /// The count that was given.
        count: u32,
        /// The fewest.
        smallest: u32,
        /// The most.
        largest: u32,
    },
    /// Splits that do not fit the layers.
    #[error(
        "the splits of {layers} layers are {} ascending moment depths between -1 and 1, all but the overlap apart; \
         these {given} are not", layers - 1
    )]
    Splits {
        /// The number of layers.
        layers: u32,
        /// The number of splits that were given.
        given: usize,
    },
    /// A setting out of range.
    #[error("'{technique}' has {value} as its {what}; it is {range}")]
    Setting {
        /// The technique's name.
        technique: &'static str,
        /// The setting's name.
        what: &'static str,
        /// The value that was given.
        value: Finite,
        /// The range that it has to be in.
        range: String,
    },
    /// Weights that make no filter.
    #[error(
        "{count} weights are no filter: an odd number from 1 to 129 is, none of them negative and not all of them zero"
    )]
    Weights {
        /// The number of weights that were given.
        count: usize,
    },
}

fn names(storages: &[Storage]) -> String {
    let names: Vec<&str> = storages.iter().map(|storage| storage.name()).collect();
    names.join(" or ")
}
