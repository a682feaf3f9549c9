//! Summed-area tables on their own: made of any map, and what they have to be.

mod map;
mod means;
pub mod naive;
pub mod reference;

pub use map::SummedMap;
pub(crate) use map::node;
pub use means::{Mean, Means, Query};
pub use naive::NaiveTable;
