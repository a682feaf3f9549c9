//! What compiling takes from an adapter.

use crate::setup::{capabilities, gpu};

/// Names of adapters that are programs: Mesa's, SwiftShader and Windows' own.
const PROGRAMS: [&str; 3] = ["llvmpipe", "SwiftShader", "Microsoft Basic Render Driver"];

#[test]
fn a_program_is_told_from_a_graphics_card() {
    let gpu = gpu();
    let name = gpu.adapter.get_info().name;
    let is_program = PROGRAMS.iter().any(|program| name.contains(program));
    let found = capabilities(&gpu);
    assert_eq!(found.software_adapter, is_program, "{name}");
    assert_eq!(found.anisotropic_sampling, !is_program, "{name}");
}
