//! Kinds of depth maps: sample counts and formats.

use moment_shadows::{Profile, Storage};
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::scene;
use moment_shadows_lab::view::View;

use crate::stage::{Stage, StageDesc, camera_for, mean_difference};

fn picture(samples: u32, format: wgpu::TextureFormat) -> Vec<f32> {
    let scene = scene::load("fence-and-foliage").unwrap();
    let view = View::numbered(&scene, 0);
    let stage = Stage::new(StageDesc {
        picture: [192, 108],
        map: 256,
        samples,
        format,
        ..StageDesc::new(Storage::Unorm16)
    });
    let light = view.sun(&scene, [256, 256], 6.0, false).unwrap();
    let model = stage.upload(&scene);
    stage.shadow(&model, &light, &camera_for(&view, &stage.desc))
}

/// Sample counts of a format on this device.
fn sample_counts(format: wgpu::TextureFormat) -> Vec<u32> {
    let Ok(gpu) = Gpu::open(Profile::NativeAdapter) else {
        return vec![1, 4];
    };
    let flags = gpu.adapter.get_texture_format_features(format).flags;
    [1, 2, 4, 8]
        .into_iter()
        .filter(|&count| flags.sample_count_supported(count))
        .collect()
}

#[test]
fn sample_counts_agree() {
    let format = wgpu::TextureFormat::Depth32Float;
    let four = picture(4, format);
    for samples in sample_counts(format) {
        let found = picture(samples, format);
        assert!(found.iter().all(|value| (0.0..=1.0).contains(value)));
        let difference = mean_difference(&found, &four);
        println!("{samples} samples: mean difference to 4 {difference:.6}");
        // Bars of the fence are thinner than the texels of this small map: whether one sample of four or none hits one
        // changes its shadow, and about a tenth of the picture is such shadow.
        assert!(difference < 0.02, "{samples} samples: {difference}");
        assert_eq!(difference == 0.0, samples == 4, "{samples} samples");
    }
}

#[test]
fn sixteen_bits_of_depth_suffice_for_sixteen_bit_moments() {
    let fine = picture(4, wgpu::TextureFormat::Depth32Float);
    let coarse = picture(4, wgpu::TextureFormat::Depth16Unorm);
    let difference = mean_difference(&fine, &coarse);
    println!("16-bit depth: mean difference {difference:.6}");
    // A step of 16-bit depth is 3e-5 of the range, far less than the sqrt(6e-5) = 8e-3 over which the moment bias of
    // unorm16 blurs anyway.
    assert!(difference > 0.0 && difference < 1.0 / 255.0, "{difference}");
}
