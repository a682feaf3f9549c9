//! The modules through linkers of WESL, the language of our imports: what they make of each module and of the example of forward
//! shading is valid, and all constants and functions have the same bits on the adapter as through our linker. `./run check` runs the
//! crate `wesl` and npm's `wesl`, with the packages that are made for them.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod adapter;
mod commands;
mod judge;
mod package;
mod roots;
mod values;
