//! Plans that follow from a plan as data, without the compiler: of other sizes, and without some nodes.

mod resized;
mod without;

pub use resized::resized;
pub use without::{stand_in, without};
