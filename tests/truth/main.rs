//! The instrument is judged first: ground truths and error figures on cases that can be worked out by hand.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod exact_bound;
mod metric;
mod pcf;
mod setup;
mod taps;
