//! The truth about moments, by other routes than the shader's: exact rationals, roots with many digits, and known mixtures.
//!
//! The library evaluates the moment problem through orthogonal polynomials and Christoffel numbers in f32. Here the Hankel
//! system is solved exactly, roots are taken with hundreds of bits and weights come from the Vandermonde system, so that the
//! two have nothing in common but the theorem.

mod exact;
mod mixture;
mod no_fma;
mod polynomial;
mod sensitivity;
#[cfg(test)]
mod tests;

pub use exact::{Extremal, OracleError, SupportPoint, hamburger, rational};
pub use mixture::{Atom, Mixture};
pub use no_fma::bounds_without_fma;
pub use polynomial::Real;
pub use sensitivity::{sensitivity, tolerance_unit};
