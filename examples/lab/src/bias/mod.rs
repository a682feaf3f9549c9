//! The search for the smallest safe moment bias of a storage.
//!
//! Rounding can move moments out of the set of possible ones. A moment bias `b + alpha (b* - b)` moves them back. How large
//! alpha has to be is found here by filtering random patches of depth as a graph does, every stage rounded to the
//! storage, and solving for the alpha from which on the moments are possible again. Beside it stands the bound to first
//! order in the rounding error, by maximisation over the boundary of the moment space.

mod casters;
mod definite;
mod form;
mod inwards;
mod packed;
mod patch;
mod pipeline;
mod scaling;
mod search;
mod tables;

pub use definite::Condition;
pub use form::{Form, rounded};
pub use scaling::error_factor;
pub use search::{BiasRow, BiasTable, BiasTechnique, Quantiles, measure, search, steps};
pub use tables::{TableBiasRow, TableBiases, search_tables, table_steps};
