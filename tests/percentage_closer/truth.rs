//! The Gaussian kernel against the lab's ground truth.

use glam::{DMat4, DVec2, DVec3};
use moment_shadows::{DepthConversion, Kernel};
use moment_shadows_lab::host::DepthSamples;
use moment_shadows_lab::light::{LightView, StoredDepth};
use moment_shadows_lab::truth::kernel::TapPattern;
use moment_shadows_lab::truth::pcf::{Receiver, pcf_at};
use moment_shadows_lab::truth::surface::{DepthRounding, MomentDepths};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use crate::brute_force::{Convention, random_depths};
use crate::device::{self, PercentageCloserKernel, Query, Shader};

const SIZE: [u32; 2] = [32, 24];

/// The truth forgives samples in front of the plane by what a rasteriser snaps: 1/512 texel of a slope of at most
/// 0.04 per texel, 8e-5. By twice as much the same receivers are moved back.
const FORGIVEN: f64 = 1.6e-4;

#[test]
fn the_gaussian_kernel_equals_the_ground_truth() {
    let gpu = device::open();
    let imports = "import moment_shadows::techniques::percentage_closer::{PercentageCloserKernel, percentage_closer_gaussian, percentage_closer_kernel};\n";
    let body = "
alias Extra = PercentageCloserKernel;
fn answer(query: Query, plane: ReceiverPlane) -> f32 {
    if query.taps == 0u {
        return percentage_closer_gaussian(map, 0u, query.region, plane, conversion, 4, 2.4);
    }
    return percentage_closer_kernel(map, 0u, query.region, plane, conversion, extra);
}
";
    let shader = Shader::new(&gpu, imports, body);
    // Parallel rays along -z over x and y in [-1, 1]; moment depth is -z - 1.
    let depth = StoredDepth::Orthographic {
        near: 0.0,
        far: 2.0,
        reversed: false,
    };
    let light = LightView {
        view_from_world: DMat4::IDENTITY,
        clip_from_view: depth.clip_from_view(DVec2::ONE),
        depth,
        range: [0.0, 2.0],
    };
    let mut random = ChaCha8Rng::seed_from_u64(24);
    let values = random_depths(
        &mut random,
        SIZE,
        Convention::Orthographic { reversed: false },
    );
    let map = device::map(
        &gpu,
        wgpu::TextureFormat::Depth32Float,
        SIZE,
        std::slice::from_ref(&values),
    );
    let samples = DepthSamples {
        width: SIZE[0],
        height: SIZE[1],
        samples: 1,
        values,
    };
    let depths = MomentDepths::from_stored(&light, &samples, DepthRounding::Float32).unwrap();
    let kernel = Kernel::gaussian(4, 2.4).unwrap();
    let mut receivers = [(); 2].map(|()| Vec::new());
    let mut queries = Vec::new();
    for index in 0..400 {
        let uv = [(); 2].map(|()| random.random_range(0.0..1.0_f32));
        let z = random.random_range(-0.8..0.8_f32);
        let slope = [(); 2].map(|()| random.random_range(-0.6..0.6_f32));
        // The plane z = z0 + slope . (uv - uv0) in moment depth; world x is 2 u - 1, y is 1 - 2 v, and z is -1 - moment depth.
        let normal =
            DVec3::new(0.5 * f64::from(slope[0]), -0.5 * f64::from(slope[1]), 1.0).normalize();
        for (list, behind) in receivers.iter_mut().zip([0.0, FORGIVEN]) {
            let position = DVec3::new(
                2.0 * f64::from(uv[0]) - 1.0,
                1.0 - 2.0 * f64::from(uv[1]),
                -1.0 - f64::from(z) - behind,
            );
            list.push(Receiver { position, normal });
        }
        queries.push(Query {
            gradient: [slope[0] / SIZE[0] as f32, slope[1] / SIZE[1] as f32],
            taps: index % 2,
            ..Query::new(uv, z, SIZE)
        });
    }
    let bounds = receivers
        .map(|receivers| pcf_at(&light, &depths, &TapPattern::of_kernel(&kernel), &receivers));
    let mut uniform = PercentageCloserKernel {
        radius: kernel.radius(),
        padding: [0; 3],
        weights: [[0.0; 4]; 33],
    };
    let weights = kernel.weights();
    uniform.weights.as_flattened_mut()[..weights.len()].copy_from_slice(weights);
    let found = shader.run(
        &map,
        wgpu::CompareFunction::Greater,
        DepthConversion::orthographic(),
        bytemuck::bytes_of(&uniform),
        &queries,
    );
    let mut apart = 0.0;
    for (index, found) in found.into_iter().enumerate() {
        let [low, high] = [bounds[0][index], bounds[1][index]];
        // Sums of a hundred rounded weights.
        assert!(
            found > low - 1e-5 && found < high + 1e-5,
            "receiver {index}: {found}, not {low} to {high}"
        );
        apart += (high - low) / 400.0;
    }
    assert!(apart < 1e-3, "the truth leaves {apart} open");
}
