//! The constant of the receiver bias, from below and from above: what 16-bit depth asks for, and what it has to leave.

use moment_shadows::{ReceiverBias, Technique, TextureFormat};

use crate::depth_map;
use crate::depth_tests::{picture, view};
use crate::setup::gpu;

#[test]
fn a_caster_two_steps_of_16_bit_depth_in_front_still_shadows() {
    let gpu = gpu();
    let size = [8, 8];
    let format = wgpu::TextureFormat::Depth16Unorm;
    // Where the map has a texel for each pixel: a texel of 1/4 of the depth range.
    let view = view(false, ReceiverBias::for_kernel(0.0, 0.25));
    for level in [1000_u32, 20_000, 65_000] {
        // The receiver's depth between its own step and the next, at most half a step from it.
        for offset in [-0.49, 0.0, 0.49] {
            let depth = ((f64::from(level) + offset) / 65535.0) as f32;
            let camera = depth_map::of(&gpu, size, |_, _| depth);
            // How many steps the caster's stored depth is in front of the receiver's own. Half a step and rounding are what
            // the bias is for, and from one and a half on a caster is one: a step in between is either.
            for (steps, expected) in [(0, 0.0), (2, 1.0), (3, 1.0)] {
                let stored = (f64::from(level - steps) / 65535.0) as f32;
                let map = depth_map::texture(&gpu, format, size, 1, 1);
                depth_map::draw(&gpu, &map, 0, &depth_map::values(size, |_, _| stored));
                let map = (&map, TextureFormat::Depth16Unorm);
                let found = picture(&gpu, &Technique::Binary, map, &camera, &view);
                assert!(
                    found.iter().all(|&intensity| intensity == expected),
                    "{steps} steps before {level} + {offset}: {found:?}"
                );
            }
        }
    }
}
