//! The turned Poisson disk.

use moment_shadows::DepthConversion;

use crate::device::{self, Query, Shader};
use crate::slopes::{BODY, IMPORTS};

const ROTATIONS: u32 = 256;

/// The share of a disk that lies beyond a straight edge at `distance` radii from its centre.
pub(crate) fn segment(distance: f64) -> f64 {
    let d = distance.clamp(-1.0, 1.0);
    (d.acos() - d * (1.0 - d * d).sqrt()) / std::f64::consts::PI
}

#[test]
fn the_mean_over_rotations_is_that_of_the_disk() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let size = [64, 64];
    // An occluder left of column 32.
    let stored: Vec<f32> = (0..64 * 64)
        .map(|texel| if texel % 64 < 32 { 0.25 } else { 1.0 })
        .collect();
    let map = device::map(&gpu, wgpu::TextureFormat::Depth32Float, size, &[stored]);
    let radius = 12.0;
    for column in 18..=46 {
        let queries: Vec<Query> = (0..ROTATIONS)
            .map(|rotation| Query {
                taps: 3,
                radius: radius as f32,
                angle: std::f32::consts::TAU * rotation as f32 / ROTATIONS as f32,
                ..Query::new([column as f32 / 64.0, 0.5], 0.5, size)
            })
            .collect();
        let light = [0_u8; 32];
        let answers = shader.run(
            &map,
            wgpu::CompareFunction::Greater,
            DepthConversion::orthographic(),
            &light,
            &queries,
        );
        let mean = answers.iter().copied().map(f64::from).sum::<f64>() / f64::from(ROTATIONS);
        let expected = segment((f64::from(column) - 32.0) / radius);
        // Turned, the samples average over 16 circles, which are the midpoint rule in the area. What they average
        // changes monotonically with the radius by at most one half, so that the rule is off by half a step of 1/16 of that; each
        // circle has a point at 256 places, so that its two crossings are off by 1/256 each.
        let tolerance = 0.5 / 32.0 + 2.0 / 256.0;
        assert!(
            (mean - expected).abs() < tolerance,
            "column {column}: {mean}, not {expected}"
        );
    }
}
