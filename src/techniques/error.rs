//! Why a technique, or its combination with a storage, is refused.

use super::Finite;
use crate::Storage;

/// A technique, or its combination with a storage, that makes no sense.
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
        /// Those that it can use.
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
    /// A table that is said to be stored like another map.
    #[error(
        "a summed-area table is stored as fixed32, not as {storage}; leave out 'table' for a map that is none"
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
        /// What was given.
        exponent: Finite,
        /// The largest that the storage's range and precision allow.
        largest: f32,
    },
    /// A number out of range.
    #[error("'{technique}' has {count} {what}; it can have {smallest} to {largest}")]
    Count {
        /// The technique's name.
        technique: &'static str,
        /// What is counted.
        what: &'static str,
        /// What was given.
        count: u32,
        /// The fewest.
        smallest: u32,
        /// The most.
        largest: u32,
    },
    /// Splits that are no splits of so many layers.
    #[error(
        "the splits of {layers} layers are {} ascending moment depths between -1 and 1, all but the overlap apart; \
         these {given} are not", layers - 1
    )]
    Splits {
        /// Layers.
        layers: u32,
        /// Splits that were given.
        given: usize,
    },
    /// A setting out of range.
    #[error("'{technique}' has {value} as its {what}; it is {range}")]
    Setting {
        /// The technique's name.
        technique: &'static str,
        /// The setting.
        what: &'static str,
        /// What was given.
        value: Finite,
        /// What it can be.
        range: String,
    },
    /// Weights that are no filter.
    #[error(
        "{count} weights are no filter: an odd number from 1 to 129 is, none of them negative and not all of them zero"
    )]
    Weights {
        /// How many were given.
        count: usize,
    },
}

fn names(storages: &[Storage]) -> String {
    let names: Vec<&str> = storages.iter().map(|storage| storage.name()).collect();
    names.join(" or ")
}
