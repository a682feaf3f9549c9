//! What is exported to other languages: its functions, names and comments, and its vectors against the adapter and against other
//! algorithms. Other compilers run it in `./run check`.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod opengl;
mod oracles;
mod refused;
mod texts;
mod vectors;
