//! Translucent casters, blended by a host into maps of every storage, against the exact transmittance.

mod bound;
mod draw;
mod layers;
