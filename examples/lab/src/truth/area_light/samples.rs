//! Places that are spread evenly over a light.

use glam::DVec2;

use crate::light::LightShape;

/// The golden angle: a full turn times (3 - sqrt(5)) / 2.
const GOLDEN_ANGLE: f64 = std::f64::consts::PI * 0.763_932_022_500_210_3;

/// `count` places on a light, in units of half its width and height: within the unit disk, or within [-1, 1] along both
/// axes. A single one is the centre.
pub(super) fn places(shape: LightShape, count: u32) -> Vec<DVec2> {
    if count == 1 || shape.is_point() {
        return vec![DVec2::ZERO];
    }
    (0..count)
        .map(|index| {
            let part = (f64::from(index) + 0.5) / f64::from(count);
            if shape.is_round() {
                // A sunflower's seeds (Vogel, Mathematical Biosciences 44, 1979).
                DVec2::from_angle(f64::from(index) * GOLDEN_ANGLE) * part.sqrt()
            } else {
                // Hammersley's points.
                let reversed = f64::from(index.reverse_bits()) / (1u64 << 32) as f64;
                2.0 * DVec2::new(part, reversed + 0.5 / f64::from(count)) - 1.0
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_cover_disks_and_rectangles_evenly() {
        let disk = LightShape::Disk { diameter: 1.0 };
        let rectangle = LightShape::Rectangle { size: [2.0, 1.0] };
        for (shape, variance) in [(disk, 0.25), (rectangle, 1.0 / 3.0)] {
            let all = places(shape, 256);
            assert_eq!(all.len(), 256);
            let mean = all.iter().sum::<DVec2>() / 256.0;
            let spread = all.iter().map(|place| place * place).sum::<DVec2>() / 256.0;
            // Sums over 256 evenly spread places have an error of some 1/256.
            assert!(mean.length() < 0.01, "{shape:?}: {mean}");
            assert!(
                (spread - variance).abs().max_element() < 0.01,
                "{shape:?}: {spread}"
            );
            assert!(all.iter().all(|place| place.abs().max_element() < 1.0));
            // Every half-plane through a fifth of the circle's directions has its share.
            for direction in 0..5 {
                let normal = DVec2::from_angle(f64::from(direction));
                let front = all.iter().filter(|place| place.dot(normal) > 0.0).count();
                assert!(front.abs_diff(128) <= 5, "{shape:?} {direction}: {front}");
            }
        }
        let point = LightShape::Disk { diameter: 0.0 };
        assert_eq!(places(point, 256), [DVec2::ZERO]);
    }
}
