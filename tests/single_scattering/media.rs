//! Media: none at all, a thick one, one without extinction.

use crate::pictures::{
    FAR, Sun, camera, camera_view, directions, error, graph, medium, picture, picture_of, seen,
    truth,
};
use crate::stage::gpu;
use glam::DVec3;
use moment_shadows::{ScatteringParameters, SingleScattering};

#[test]
fn no_density_is_no_fog_to_the_bit() {
    let gpu = gpu();
    let sun = Sun::new(DVec3::new(0.5, -1.0, 0.3));
    let moments = sun.moments();
    let all = graph("\"hamburger6\"", "float16");
    for (_, forward) in directions(&sun) {
        for graph in [&all, &seen(&all)] {
            let found = picture(&gpu, &camera(forward), &sun, medium(0.0), &moments, graph);
            for pixel in found {
                assert_eq!(
                    pixel.map(f32::to_bits),
                    [0.0_f32, 0.0, 0.0, 1.0].map(f32::to_bits)
                );
            }
        }
    }
}

#[test]
fn in_a_thick_medium_sums_are_weighted_with_its_transmittance() {
    let gpu = gpu();
    let sun = Sun::new(DVec3::new(0.5, -1.0, 0.3));
    let moments = sun.moments();
    let medium = medium(4.0);
    let all = graph("\"hamburger6\"", "float32");
    let own = seen(&all);
    let mean = |errors: [f64; 3]| errors.iter().sum::<f64>() / 3.0;
    // Weighted for the view rays that end in each column, for all of a row, and not at all.
    let mut means = [0.0; 3];
    for (name, forward) in directions(&sun) {
        let pair = camera(forward);
        let truth = truth(&pair, &sun, &medium);
        let picture = |graph: &str, extinction: Option<f32>| {
            let mut parameters =
                ScatteringParameters::new(&camera_view(&pair), FAR, &sun.view(), medium).unwrap();
            if let Some(extinction) = extinction {
                parameters.integrate.extinction = extinction;
            }
            picture_of(&gpu, &parameters, &moments, graph)
        };
        let cases = [(&own, None), (&all, None), (&all, Some(0.0))];
        let errors =
            cases.map(|(graph, extinction)| mean(error(&picture(graph, extinction), &truth)));
        println!("{name}: {errors:?}");
        for (mean, error) in means.iter_mut().zip(errors) {
            *mean += error / 5.0;
        }
    }
    let [own, weighted, unweighted] = means;
    println!("mean over all directions: {means:?}");
    assert!(
        weighted < 0.7 * unweighted && own < 0.95 * weighted,
        "{means:?}"
    );
}

#[test]
fn without_extinction_light_is_scattered_without_loss() {
    let gpu = gpu();
    let sun = Sun::new(DVec3::new(0.5, -1.0, 0.3));
    let moments = sun.moments();
    let scattering = [0.07, 0.09, 0.1];
    let medium = SingleScattering::new([0.0; 3], scattering, 0.3, [3.0; 3]).unwrap();
    for (name, forward) in directions(&sun) {
        let pair = camera(forward);
        let graph = graph("\"hamburger6\"", "float32");
        let found = picture(&gpu, &pair, &sun, medium, &moments, &graph);
        assert!(found.iter().all(|pixel| pixel[3] == 1.0), "{name}");
        let errors = error(&found, &truth(&pair, &sun, &medium));
        println!("{name}: {errors:?}");
        // As with extinction: what six moments leave open.
        assert!(
            errors.iter().all(|&error| error <= 0.08),
            "{name}: {errors:?}"
        );
    }
}
