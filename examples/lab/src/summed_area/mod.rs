//! Summed-area tables on their own: made of any map, and what they have to be.

mod map;
pub mod reference;

pub use map::{SummedMap, TableError};
