//! Functions whose expectations describe a depth distribution, and how the published ones are stored.
//!
//! Powers of depth are one choice of several: Peters and Klein compared thousands ("Moment Shadow Mapping", i3D 2015,
//! section 2.3). Bounds for any of them come from linear programming ([`crate::oracle::MomentProblem`]).

mod function;
mod plot;
mod published;
mod published_bias;
mod subsets;

pub use function::{Basis, Function};
pub use plot::save as save_plot;
pub use published::{Quantisation, published_quantisations};
pub use published_bias::{PublishedBias, published_biases};
pub use subsets::{CANDIDATES, Subset, SubsetError, Subsets};
