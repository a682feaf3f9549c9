//! Shading of planes that pixels see from afar: mip levels add variance to a texel's depths, and the bias follows.

use moment_shadows::{
    CameraView, LeakReduction, LightView, ReceiverBias, TextureFormat, ViewParameters,
};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::ImportedResource;

use crate::depth_map;
use crate::setup::{IDENTITY, bind, capabilities, compiled, gpu};
use crate::shade_regions::graph;

const MAP: u32 = 128;

#[test]
fn a_sloping_plane_is_lit_however_many_texels_a_pixel_covers() {
    let gpu = gpu();
    // Stored depth from 0.1 to 0.9 along u, v or both.
    for [u, v] in [[0.8, 0.0], [0.0, -0.8], [0.4, 0.4_f32]] {
        let middle = |at: u32, side: u32| (at as f32 + 0.5) / side as f32 - 0.5;
        let plane =
            |x, y, [width, height]: [u32; 2]| 0.5 + u * middle(x, width) + v * middle(y, height);
        let map = depth_map::of(&gpu, [MAP; 2], |x, y| plane(x, y, [MAP; 2]));
        // Between mip levels, on one, and a different one along each axis.
        for picture in [[12, 12], [16, 16], [23, 9], [8, 30_u32]] {
            let camera = depth_map::of(&gpu, picture, |x, y| plane(x, y, picture));
            let shade = r#"{ "format": "r32float", "anisotropy": 4 }"#;
            let depth = |size| TextureDesc::new(TextureFormat::Depth32Float, size);
            let plan = compiled(
                &graph("float32", 5, shade),
                &capabilities(&gpu),
                &[
                    ("light_depth", depth([MAP; 2])),
                    ("camera_depth", depth(picture)),
                ],
            );
            // The map is not blurred. A texel is 2 / 128 in moment depth where the light's range is as deep as it is wide.
            let view = ViewParameters::new(
                &CameraView {
                    clip_from_world: IDENTITY,
                    far_depth: 1.0,
                },
                &LightView::orthographic(IDENTITY),
                ReceiverBias::for_kernel(0.0, 2.0 / MAP as f32),
                LeakReduction::NONE,
            )
            .unwrap();
            let mut bytes = plan.parameters.initial();
            plan.parameters
                .write(&mut bytes, "shade", 0, &view)
                .unwrap();
            let imports = [
                ("light_depth", ImportedResource::from(&map)),
                ("camera_depth", ImportedResource::from(&camera)),
            ];
            let bound = bind(&gpu, plan, &imports, &bytes);
            bound.run(&gpu);
            for (pixel, intensity) in bound
                .read_floats(&gpu, "shadow_intensity", 0)
                .into_iter()
                .enumerate()
            {
                // What the library promises for unoccluded planes. Without the levels' variance it is a fifth and more.
                assert!(
                    intensity <= 0.02,
                    "slope {u}, {v}, {picture:?}, pixel {pixel}: {intensity}"
                );
            }
        }
    }
}
