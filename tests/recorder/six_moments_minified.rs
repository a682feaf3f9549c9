//! Six moments seen from afar.

use crate::depth_map;
use crate::setup::{IDENTITY, bind, capabilities, compiled};
use moment_shadows::{
    CameraView, LeakReduction, LightView, Profile, ReceiverBias, Storage, Technique, TextureFormat,
    ViewParameters,
};
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_graph::{Capabilities, TextureDesc};
use moment_shadows_lab::gpu::Gpu;

/// Shadow intensity of a picture half as large as the map, looked up in mip level 1 of both planes.
fn shade(gpu: &Gpu, capabilities: &Capabilities, storage: Storage) -> Vec<f32> {
    let text = format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "light_depth" }}, {{ "name": "camera_depth" }}],
  "nodes": [
    {{ "name": "resolve", "type": "resolve",
       "properties": {{ "technique": "hamburger6", "storage": "{storage}", "mip_levels": 2 }} }},
    {{ "name": "downsample", "type": "downsample" }},
    {{ "name": "shade", "type": "shade_hard", "properties": {{ "format": "r32float", "anisotropy": 1 }} }}
  ],
  "edges": [
    {{ "from": "light_depth", "to": "resolve.depth" }},
    {{ "from": "resolve.map", "to": "downsample.map" }},
    {{ "from": "downsample.map", "to": "shade.map" }},
    {{ "from": "camera_depth", "to": "shade.camera_depth" }}
  ],
  "outputs": [{{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }}]
}}"#
    );
    let size = [64, 48];
    let picture = [32, 24];
    // One, two or three of the four texels below a pixel show the caster, where it is not all or none of them.
    let light = depth_map::of(gpu, size, |x, y| match x {
        0..20 => 0.25,
        20..44 if (x + y) % 2 == 0 || (x > 32 && y % 2 == 0) => 0.25,
        _ => 1.0,
    });
    let camera = depth_map::of(gpu, picture, |_, _| 0.75);
    let desc = |size| TextureDesc::new(TextureFormat::Depth32Float, size);
    let imports = [("light_depth", desc(size)), ("camera_depth", desc(picture))];
    let plan = compiled(&text, capabilities, &imports);
    let parameters = ViewParameters::new(
        &CameraView {
            clip_from_world: IDENTITY,
            far_depth: 1.0,
        },
        &LightView::orthographic(IDENTITY),
        ReceiverBias::NONE,
        LeakReduction::NONE,
    )
    .unwrap();
    let mut bytes = plan.parameters.initial();
    plan.parameters
        .write(&mut bytes, "shade", 0, &parameters)
        .unwrap();
    let imports = [
        ("light_depth", ImportedResource::from(&light)),
        ("camera_depth", ImportedResource::from(&camera)),
    ];
    let bound = bind(gpu, plan, &imports, &bytes);
    bound.run(gpu);
    bound.read_floats(gpu, "shadow_intensity", 0)
}

#[test]
fn a_minified_lookup_averages_surfaces_whether_sampled_or_loaded() {
    let gpu = Gpu::open_with(Profile::Native, wgpu::Features::FLOAT32_FILTERABLE).unwrap();
    let device = capabilities(&gpu);
    let [sampled, loaded] = [true, false].map(|anisotropic_sampling| Capabilities {
        anisotropic_sampling,
        ..device.clone()
    });
    for &storage in Technique::Hamburger6.row().storages {
        let alpha = storage.six_moments_bias().unwrap().alpha;
        let pictures = [&sampled, &loaded].map(|capabilities| shade(&gpu, capabilities, storage));
        for index in 0..32 * 24 {
            let x = index % 32;
            // Two of four texels of a checkerboard show the caster, and three where rows are added.
            let truth = match x {
                0..=9 => 1.0,
                10..=15 => 0.5,
                17..=21 => 0.75,
                22.. => 0.0,
                _ => continue,
            };
            for picture in &pictures {
                // Two surfaces are reproduced but for the bias, which moves a share alpha over a distance of 1: what leaks is some times
                // alpha.
                let error = f64::from(picture[index]) - truth;
                assert!(
                    error <= f64::from(alpha) && error >= -8.0 * f64::from(alpha) - 1e-4,
                    "{storage}, {x}: {} for {truth}",
                    picture[index]
                );
            }
            // Samplers' weights have 8 bits.
            let difference = (pictures[0][index] - pictures[1][index]).abs();
            assert!(difference <= 1.0 / 128.0, "{storage}, {x}: {difference}");
        }
    }
}
