//! Soft shadows from a summed-area table: the blocker search, the node, and what they give in pictures.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod blockers;
mod errors;
mod loads;
mod pictures;
