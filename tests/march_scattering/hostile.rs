//! Rays with numbers that are none, lights where the camera is, and no density at all.

use moment_shadows::SingleScattering;

use crate::rays::{Ray, haze, plain, run};

/// What every number is replaced by.
const NUMBERS: [f32; 10] = [
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    0.0,
    -0.0,
    -1.0,
    1e38,
    -1e38,
    1e-40,
    1e18,
];

fn lamp() -> Ray {
    Ray {
        gradient: [0.0, 0.2, 0.0],
        place: [0.5, -0.5, 6.0],
        radius: 0.02,
        cone_axis: [0.0, 8.0, 0.0],
        cone_offset: -6.0,
        ..plain()
    }
}

/// Radiance and transmittance are numbers in their ranges.
#[track_caller]
fn assert_possible(pixel: [f32; 4], what: &str) {
    let [.., transmittance] = pixel;
    let radiance = &pixel[..3];
    assert!(
        radiance.iter().all(|it| (0.0..=65504.0).contains(it)),
        "{what}: {pixel:?}"
    );
    assert!((0.0..=1.0).contains(&transmittance), "{what}: {pixel:?}");
}

#[test]
fn no_number_gives_a_pixel_that_is_none() {
    let words = size_of::<Ray>() / 4 - 4;
    let (mut rays, mut whats) = (Vec::new(), Vec::new());
    for (kind, ray) in [("directional", plain()), ("spot", lamp())] {
        for place in 0..words {
            for number in NUMBERS {
                let mut words: [f32; size_of::<Ray>() / 4] = bytemuck::cast(ray);
                words[place] = number;
                rays.push(bytemuck::cast(words));
                whats.push(format!("{kind}, {number} at {place}"));
            }
        }
    }
    for (pixel, what) in run(&rays).into_iter().zip(&whats) {
        assert_possible(pixel, what);
    }
}

#[test]
fn a_light_where_the_camera_is_or_in_the_ray_is_finite_and_seen() {
    let at = [
        [0.0; 3],
        [0.0, 0.0, 6.0],
        [0.0, 0.0, 20.0],
        [0.0, 0.0, 1e-30],
        [1e-30, 0.0, 5.0],
    ];
    let rays = at.map(|place| Ray {
        place,
        cone_axis: [0.0; 3],
        cone_offset: 1.0,
        ..lamp()
    });
    for (pixel, place) in run(&rays).into_iter().zip(at) {
        assert_possible(pixel, &format!("{place:?}"));
        assert!(pixel[0] > 0.0, "{place:?}: {pixel:?}");
    }
    // In a spot that the camera is in, and in one that looks at it.
    for axis in [8.0, -8.0] {
        let ray = Ray {
            place: [0.0; 3],
            cone_axis: [0.0, 0.0, axis],
            ..lamp()
        };
        let pixel = run(&[ray])[0];
        assert_possible(pixel, "a spot at the camera");
        assert_eq!(pixel[0] > 0.0, axis > 0.0, "{pixel:?}");
    }
}

#[test]
fn no_density_is_no_fog_to_the_bit() {
    let none = |ray: Ray| Ray {
        medium: haze(0.0),
        ..ray
    };
    let mut rays: Vec<Ray> = [plain(), lamp()].map(none).to_vec();
    // A host's density that is 0, negative or no number.
    rays.extend([0.0, -0.0, -2.0, f32::NAN].map(|density| Ray {
        density,
        has_density: 1,
        ..plain()
    }));
    // Light that is scattered without loss has its transmittance to the bit.
    let lossless = SingleScattering::new([0.0; 3], [0.1; 3], 0.0, [1.0; 3]).unwrap();
    rays.push(Ray {
        medium: lossless,
        ..plain()
    });
    let found = run(&rays);
    let (last, without) = found.split_last().unwrap();
    for (pixel, ray) in without.iter().zip(&rays) {
        assert_eq!(
            pixel.map(f32::to_bits),
            [0.0_f32, 0.0, 0.0, 1.0].map(f32::to_bits),
            "{ray:?}"
        );
    }
    assert!(last[3] == 1.0 && last[0] > 0.0, "{last:?}");
}
