//! Pictures of the tests on the plain depth map, and what they say of equal depth.

use moment_shadows::{
    Border, CameraView, LeakReduction, LightDepth, LightSize, LightView, MapRegion, PcfTaps,
    ReceiverBias, Technique, TextureFormat, ViewParameters,
};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_lab::gpu::Gpu;

use crate::depth_map;
use crate::setup::{IDENTITY, bind, capabilities, compiled, gpu};
use crate::techniques::reading_depth;

/// A view of a light and a camera that look along the same axis: each pixel shows its place in the map.
pub(crate) fn view(reversed: bool, bias: ReceiverBias) -> ViewParameters {
    ViewParameters::new(
        &CameraView {
            clip_from_world: IDENTITY,
            far_depth: 1.0,
        },
        &LightView {
            clip_from_world: IDENTITY,
            depth: LightDepth::Orthographic { reversed },
            layer: 0,
            region: MapRegion::WHOLE,
            guard: 0,
            border: Border::Sharp,
            channel: 0,
            size: LightSize::Point,
        },
        bias,
        LeakReduction::NONE,
    )
    .unwrap()
}

/// Shadow intensity of every pixel by a technique that reads the depth map.
pub(crate) fn picture(
    gpu: &Gpu,
    technique: &Technique,
    (map, format): (&wgpu::Texture, TextureFormat),
    camera: &wgpu::Texture,
    view: &ViewParameters,
) -> Vec<f32> {
    let desc = |texture: &wgpu::Texture, format| TextureDesc {
        samples: texture.sample_count(),
        ..TextureDesc::new(format, [texture.width(), texture.height()])
    };
    let imports = [
        ("light_depth", desc(map, format)),
        ("camera_depth", desc(camera, TextureFormat::Depth32Float)),
    ];
    let text = reading_depth(&serde_json::to_string(technique).unwrap());
    let plan = compiled(&text, &capabilities(gpu), &imports);
    let mut bytes = plan.parameters.initial();
    plan.parameters.write(&mut bytes, "shade", 0, view).unwrap();
    let imports = [
        ("light_depth", ImportedResource::from(map)),
        ("camera_depth", ImportedResource::from(camera)),
    ];
    let bound = bind(gpu, plan, &imports, &bytes);
    bound.run(gpu);
    bound.read_floats(gpu, "shadow_intensity", 0)
}

#[test]
fn a_comparison_sampler_leaves_equal_depth_lit_in_both_directions_of_depth() {
    let gpu = gpu();
    let size = [8, 8];
    let format = TextureFormat::Depth32Float;
    // Exact in f32, and so are their moment depth, 2 z - 1, and the way back.
    for depth in [0.25, 0.5, 0.75_f32] {
        for reversed in [false, true] {
            let technique = Technique::Pcf(PcfTaps::Hardware {
                radius: 1,
                reversed,
            });
            // The next number nearer to the light, none, and the next one behind.
            for (nearer, expected) in [(1_i32, 1.0), (0, 0.0), (-1, 0.0)] {
                let steps = if reversed { nearer } else { -nearer };
                let stored = f32::from_bits(depth.to_bits().checked_add_signed(steps).unwrap());
                let map = depth_map::of(&gpu, size, |_, _| stored);
                let camera = depth_map::of(&gpu, size, |_, _| depth);
                let view = view(reversed, ReceiverBias::NONE);
                let found = picture(&gpu, &technique, (&map, format), &camera, &view);
                assert!(
                    found.iter().all(|&intensity| intensity == expected),
                    "{stored} in the map before {depth}, reversed {reversed}: {found:?}"
                );
            }
        }
    }
}
