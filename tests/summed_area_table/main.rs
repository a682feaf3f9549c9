//! Summed-area tables: to the bit against sums on the processor, and their means against sums over rectangles.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod bias;
mod errors;
mod exact;
mod plans;
mod queries;
mod regions;
mod setup;
