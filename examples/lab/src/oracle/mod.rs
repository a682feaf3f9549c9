//! The truth about moments, by other routes than the shader's: exact rationals, roots with many digits, and known mixtures.
//!
//! The library evaluates the moment problem through orthogonal polynomials and Christoffel numbers in f32. Here the Hankel
//! system is solved exactly, roots are taken with hundreds of bits and weights come from the Vandermonde system, so that the
//! two have nothing in common but the theorem.
//!
//! - [`hamburger`] and [`hausdorff`]: exact bounds for any even number of power moments, on the real line and on an interval.
//! - [`ideal`]: what every filterable technique gives for known surfaces in f64, fast enough for all pixels of a picture.

mod exact;
mod hausdorff;
pub mod ideal;
mod mixture;
mod polynomial;
mod sensitivity;
#[cfg(test)]
mod tests;

pub use exact::{Extremal, OracleError, SupportPoint, hamburger, rational};
pub use hausdorff::hausdorff;
pub use mixture::{Atom, Mixture};
pub use polynomial::Real;
pub use sensitivity::{sensitivity, tolerance_unit};
