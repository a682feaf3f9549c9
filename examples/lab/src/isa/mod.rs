//! What shaders cost on chips that need not be there: a real compiler's code for them, counted.
//!
//! Every shader that a node emits is compiled by Mesa's RADV for one RDNA and one GCN chip. The figures are compared with a
//! table that is kept with the sources, so that a change which makes a shader slower is seen, whatever machine it is made on.

pub mod child;
pub mod chip;
pub mod class;
pub mod compare;
mod compiler;
pub mod cycles;
pub mod driver;
pub mod figures;
pub mod loops;
mod report;
mod spirv;
pub mod subjects;
pub mod table;
pub mod text;
mod vulkan;
