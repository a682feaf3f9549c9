//! Graph files, compilation and plans: what is accepted, what is refused and where, and what comes out.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod arbitrary;
mod best;
mod declarations;
mod drawn;
mod example;
mod file;
mod hazards;
#[allow(dead_code, reason = "shared with the tests of the recorder")]
#[path = "../support/host_node.rs"]
mod host_node;
mod memory;
mod memory_of_maps;
mod parameters;
mod parameters_again;
mod plan;
mod plan_file;
mod plan_from_elsewhere;
mod properties;
mod ranges;
mod rectified;
mod regions;
mod resized;
mod resources;
mod settings;
mod shaders;
mod sizes;
mod stages;
mod targets;
mod techniques;
mod wiring;
mod written_once;
