//! Widths of penumbrae in pictures of straight edges: of the sampled light and of percentage closer soft shadows.

use moment_shadows_lab::compare::Stage;
use moment_shadows_lab::scene;
use moment_shadows_lab::soft::{LightSize, SoftLightChoice, SoftStage, StageDesc, candidates};

use crate::{LIGHTS, open};

fn stage(light: SoftLightChoice, size: [f64; 2]) -> StageDesc {
    StageDesc {
        light,
        size: Some(LightSize(size)),
        // The narrowest penumbra is ten texels wide: these edges run along texels, so that widths come in steps of one.
        map: 2048,
        width: 480,
        height: 270,
        ..StageDesc::default()
    }
}

#[test]
fn they_are_those_of_geometry_at_three_distances() {
    let gpu = open();
    let scene = scene::load("edge").unwrap();
    let candidates = candidates(&[]).unwrap();
    for (light, size) in LIGHTS {
        let stage = SoftStage::new(&gpu, &scene, &stage(light, size)).unwrap();
        let exact = stage.exact_widths().unwrap();
        let check = |name: &str, shadow: &[f32], tolerance: f64| {
            for (found, exact) in stage.widths(shadow).unwrap().iter().zip(exact) {
                let found = found.unwrap_or(0.0);
                println!("{light:?} {name}: {found:.4}, exactly {exact:.4}");
                assert!(
                    (found / exact - 1.0).abs() < tolerance,
                    "{light:?} {name}: {found} for {exact}"
                );
            }
        };
        check("truth", &stage.truth, 0.03);
        for candidate in candidates.iter().filter(|it| it.name.starts_with("pcss")) {
            let picture = stage.picture(&gpu, candidate).unwrap();
            // The blockers that the search finds lie at one depth; its filter has a texel more.
            check(&candidate.name, &picture.shadow, 0.15);
            let error = stage.judge(&picture.shadow).unwrap();
            assert!(error.penumbra.mean_absolute < 0.06, "{light:?}: {error}");
        }
        // The filter of hard shadows knows no distance: there the widths are wrong.
        let hard = stage.picture(&gpu, &candidates[0]).unwrap();
        let found = stage.widths(&hard.shadow).unwrap()[2].unwrap();
        assert!(
            found < 0.6 * exact[2],
            "{light:?}: {found} for {}",
            exact[2]
        );
    }
}

#[test]
fn percentage_closer_soft_shadows_of_no_size_are_the_binary_test() {
    let gpu = open();
    let scene = scene::load("chairs").unwrap();
    for light in [
        SoftLightChoice::Directional,
        SoftLightChoice::Spot,
        SoftLightChoice::Rectangle,
    ] {
        let stage = SoftStage::new(&gpu, &scene, &stage(light, [0.0; 2])).unwrap();
        let mut candidates = candidates(&[]).unwrap();
        let soft = stage.picture(&gpu, &candidates[3]).unwrap().shadow;
        let binary = moment_shadows::Technique::Binary;
        candidates[0].file = candidates[0].file.with_technique(&binary, None).unwrap();
        assert_eq!(soft, stage.picture(&gpu, &candidates[0]).unwrap().shadow);
        assert!(soft.contains(&1.0) && soft.iter().all(|&value| value == 0.0 || value == 1.0));
    }
}
