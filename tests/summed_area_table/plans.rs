//! What the passes move and how many invocations they have.

use moment_shadows::{Profile, Storage, Technique};
use moment_shadows_graph::{Capabilities, PlannedWork};
use moment_shadows_lab::summed_area::SummedMap;

use crate::setup::{encoding, map};

#[test]
fn the_tiles_of_graphics_cards_move_48_bytes_and_keep_8192_invocations_busy() {
    let size = [1024, 1024];
    for (technique, bytes) in [(Technique::Hamburger4, 48), (Technique::Vsm, 24)] {
        let desc = map(&encoding(technique, Storage::Unorm16), size, 1);
        let capabilities = Capabilities::of_profile(Profile::Native);
        let plan = SummedMap::plan(&capabilities, &desc, [65; 2]).unwrap();
        let texels = u64::from(size[0] * size[1]);
        assert!(
            plan.bytes_moved() <= bytes * texels,
            "{}",
            plan.bytes_moved()
        );
        // Workgroups of the passes over texels have 64 invocations.
        for pass in [plan.passes.first(), plan.passes.last()] {
            let PlannedWork::Compute { workgroups, .. } = pass.unwrap().work else {
                panic!("no dispatch");
            };
            let wgsl = plan.wgsl(pass.unwrap());
            for side in ["WORKGROUP_X = 8u;", "WORKGROUP_Y = 8u;"] {
                assert!(wgsl.contains(side), "{side}");
            }
            assert_eq!(64 * workgroups[0] * workgroups[1], 8192);
        }
    }
}

/// Where the processor runs the shaders, larger tiles leave less in between.
#[test]
fn the_tile_follows_the_device() {
    let desc = map(
        &encoding(Technique::Hamburger4, Storage::Unorm16),
        [1000, 700],
        2,
    );
    let bytes = [false, true].map(|software_adapter| {
        let capabilities = Capabilities {
            software_adapter,
            ..Capabilities::of_profile(Profile::Native)
        };
        let plan = SummedMap::plan(&capabilities, &desc, [65; 2]).unwrap();
        let table = plan.output_texture("table").unwrap();
        assert_eq!((table.size, table.layers), (desc.size, desc.layers));
        plan.bytes_moved()
    });
    assert!(bytes[1] < bytes[0], "{bytes:?}");
}
