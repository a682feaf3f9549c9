//! Translucent casters, which a host blends into maps of every storage.

mod bound;
mod layers;
mod refused;
mod samples;
