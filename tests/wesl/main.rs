//! The modules through linkers of WESL, the language of our imports: what they make of each module is valid, and gives the
//! same bits on the adapter as what our linker makes of it.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod judge;
mod package;
mod roots;
mod rust;
mod values;
