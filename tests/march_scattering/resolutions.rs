//! Half and a quarter of the resolution, and what upsampling makes of them along an edge of depth.

use crate::pictures::{March, WALL, error, march};
use crate::scene::{Lamp, PICTURE, Scene};
use crate::stage::gpu;

#[test]
fn what_is_upsampled_is_near_the_full_picture_along_edges_too() {
    let gpu = gpu();
    let columns = 20;
    for lamp in [Lamp::Sun, Lamp::Spot] {
        let scene = Scene::new(lamp);
        let truth = scene.truth(columns, WALL);
        let full = march(r#""steps": 64"#).picture(&gpu, &scene, columns);
        let of_full = error(&full, &truth);
        for (resolution, most) in [("half", 0.02), ("quarter", 0.05)] {
            let properties = format!(r#""steps": 64, "resolution": "{resolution}""#);
            let march = March {
                upsampled: true,
                ..march(&properties)
            };
            let found = march.picture(&gpu, &scene, columns);
            let whole = error(&found, &truth);
            // Two pixels on each side of the wall's edge.
            let at_edge =
                |index: &usize| (columns - 2..columns + 2).contains(&(*index as u32 % PICTURE[0]));
            let edge: Vec<usize> = (0..truth.len()).filter(at_edge).collect();
            let of_edge = |picture: &[[f32; 4]]| {
                let pixels: Vec<_> = edge.iter().map(|&index| picture[index]).collect();
                let truths: Vec<_> = edge.iter().map(|&index| truth[index]).collect();
                error(&pixels, &truths)
            };
            println!(
                "{lamp:?} {resolution}: {whole} beside {of_full}; along the edge {}",
                of_edge(&found)
            );
            assert!(
                whole < of_full + most,
                "{lamp:?} {resolution}: {whole} {of_full}"
            );
            // Transmittance along the edge is the wall's or the sky's, not a mixture of both.
            for &index in &edge {
                let difference = f64::from(found[index][3]) - truth[index].2;
                assert!(
                    difference.abs() < 0.02,
                    "{lamp:?} {resolution} {index}: {difference}"
                );
            }
        }
    }
}
