//! Tap patterns.

use moment_shadows::Kernel;
use moment_shadows_lab::truth::kernel::{AxisTaps, TapPattern, sample_positions};

use crate::setup::gaussian;

#[test]
fn taps_are_the_blur_convolved_with_the_lookup() {
    let taps = TapPattern::of_kernel(&Kernel::from_weights(&[1.0, 2.0, 1.0]).unwrap());
    let mut axis = AxisTaps::default();
    // At the centre of texel 3 the lookup reads one texel; half-way to texel 4 it reads two alike.
    taps.along_axis(3.5 / 8.0, 8, &mut axis);
    assert_eq!(
        (axis.first, axis.weights.as_slice()),
        (2, &[0.25, 0.5, 0.25, 0.0][..])
    );
    taps.along_axis(4.0 / 8.0, 8, &mut axis);
    assert_eq!(
        (axis.first, axis.weights.as_slice()),
        (2, &[0.125, 0.375, 0.375, 0.125][..])
    );
    // At the border both the lookup and the blur repeat the last texel.
    taps.along_axis(0.0, 8, &mut axis);
    assert_eq!(
        (axis.first, axis.weights.as_slice()),
        (0, &[0.75, 0.25][..])
    );
    taps.along_axis(1.0, 8, &mut axis);
    assert_eq!(
        (axis.first, axis.weights.as_slice()),
        (6, &[0.25, 0.75][..])
    );
    // A kernel wider than the map puts all its weight on what there is.
    gaussian().along_axis(0.5, 1, &mut axis);
    assert_eq!(axis.weights.len(), 1);
    assert!((axis.weights[0] - 1.0).abs() < 1e-15);
}

#[test]
fn sample_patterns_are_centred_on_their_texel() {
    for samples in [1, 2, 4, 8] {
        let positions = sample_positions(samples).unwrap();
        assert_eq!(positions.len(), samples as usize);
        for axis in 0..2 {
            let mean: f64 = positions.iter().map(|p| p[axis]).sum::<f64>() / f64::from(samples);
            assert_eq!(mean, 0.5, "{samples} samples, axis {axis}");
        }
    }
    assert_eq!(sample_positions(3), None);
}
