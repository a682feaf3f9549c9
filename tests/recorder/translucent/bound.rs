//! The bound is never above 1 - transmittance but for the bias, however many casters are blended.

use moment_shadows::{MapEncoding, Opacity, Storage, Technique};
use moment_shadows_lab::translucent::{
    Caster, Surfaces, Texture, TranslucentStage, plumes, stack, stacks,
};

/// What the arithmetic of the bound in f32 adds.
const ARITHMETIC: f64 = 2e-4;

/// Two moments have no bias but a smallest variance v: an error e of the mean moves a bound by up to 0.65 e / sqrt(v), and e is
/// the error of one channel, twice, for each rounding.
fn of_two_moments(storage: Storage, casters: u32) -> f64 {
    let (error, variance): (f64, f64) = match storage {
        Storage::Unorm16 => (2_f64.powi(-17), 6e-5),
        Storage::Float16 => (2_f64.powi(-13), 1e-3),
        _ => (2_f64.powi(-25), 5e-7),
    };
    0.65 * 2.0 * error * f64::from(casters + 1) / variance.sqrt()
}

#[test]
fn bounds_are_below_the_truth_but_for_the_bias() {
    let stage = TranslucentStage::new(64).unwrap();
    let rows = stacks(&stage, &[1, 4, 16]).unwrap();
    // 13 maps, uniform and textured, apart and as a cloud.
    assert_eq!(rows.len(), 3 * 4 * 13);
    for row in &rows {
        println!("{row:?}");
    }
    for row in &rows {
        let allowed = if row.bias.is_nan() {
            let mut storages = Storage::ALL.into_iter();
            let storage = storages.find(|it| row.map.ends_with(it.name()));
            of_two_moments(storage.unwrap(), row.casters)
        } else {
            row.bias
        };
        assert!(row.above <= allowed + ARITHMETIC, "{row:?}");
    }
    // More moments tell more casters apart.
    let below = |map: &str| {
        let of = rows.iter().find(|row| row.map == map && row.casters == 4);
        of.unwrap().below
    };
    assert!(below("hamburger6 as unorm16") < 0.8 * below("hamburger4 as unorm16"));
    assert!(below("hamburger4 as unorm16") < 0.8 * below("vsm as unorm16"));
}

#[test]
fn every_source_of_opacity_makes_the_same_map() {
    let stage = TranslucentStage::new(32).unwrap();
    let surfaces = Surfaces {
        opaque: &|_| 1.0,
        receiver: &|[x, y]| (x as f32 + 0.5 + y as f32 / 64.0) / 32.0,
        blurred: false,
    };
    let casters: Vec<Caster> = stack(5, false, Texture::Even);
    let map = MapEncoding::new(Technique::Hamburger4, Storage::Float32).unwrap();
    let map = map.with_blends(10).unwrap();
    let by = |opacity| stage.found(&map, opacity, &casters, &surfaces).unwrap();
    let constant = by(Opacity::Constant);
    assert!(constant.iter().any(|&it| it > 0.6));
    // A device has a second source or not; two draws are everywhere.
    let all = [Opacity::TwoDraws, Opacity::SecondSource];
    for opacity in &all[..1 + usize::from(stage.has_second_source())] {
        let opacity = *opacity;
        let largest = constant.iter().zip(by(opacity));
        let largest = largest.map(|(one, other)| (one - other).abs());
        let largest = largest.fold(0.0, f32::max);
        println!("{opacity:?}: {largest:e}");
        assert!(largest < 2e-3, "{opacity:?}: {largest}");
    }
}

#[test]
fn two_casters_before_the_far_end_are_reproduced_if_drawn_far_to_near() {
    let stage = TranslucentStage::new(32).unwrap();
    let surfaces = Surfaces {
        opaque: &|_| 1.0,
        // One or two of 32 lie so close behind a caster that the bias leaks.
        receiver: &|[x, _]| (x as f32 + 0.65) / 32.0,
        blurred: false,
    };
    // Three surfaces, which six moments reproduce.
    let map = MapEncoding::new(Technique::Hamburger6, Storage::Float32).unwrap();
    let map = map.with_blends(2).unwrap();
    let mut casters = stack(2, false, Texture::Hashed);
    let truth = stage.truth(&casters, &surfaces).unwrap();
    let mut error = |reversed: bool| {
        if reversed {
            casters.reverse();
        }
        let found = stage.found(&map, Opacity::Alpha, &casters, &surfaces);
        let found = found.unwrap();
        let pairs = found.iter().zip(&truth);
        let sum: f64 = pairs
            .map(|(found, truth)| (f64::from(*found) - truth).abs())
            .sum();
        sum / truth.len() as f64
    };
    let (in_order, reversed) = (error(false), error(true));
    println!("mean error {in_order:.5}, reversed {reversed:.5}");
    assert!(in_order < 5e-3 && reversed > 2e-2, "{in_order} {reversed}");
}

#[test]
fn a_plume_shadows_itself_and_the_floor() {
    let stage = TranslucentStage::new(96).unwrap();
    let rows = plumes(&stage).unwrap();
    for row in &rows {
        println!("{row:?}");
    }
    let of = |map: &str| rows.iter().find(|row| row.map == map).unwrap();
    let (four, six) = (of("hamburger4 as unorm16"), of("hamburger6 as unorm16"));
    // Behind all of it the bound is nearly exact; within it, a fraction of full shadow is missing.
    assert!(six.floor < 0.01 && four.floor < 0.02, "{four:?} {six:?}");
    assert!(
        six.itself < four.itself && four.itself < 0.1,
        "{four:?} {six:?}"
    );
}

#[test]
fn a_bias_that_is_too_small_is_seen() {
    const COUNT: u32 = 32;
    // The bias of unorm16 for twice as many.
    const ALLOWED: f64 = 1.2e-3;
    let stage = TranslucentStage::new(64).unwrap();
    let draws = 2 - u32::from(stage.has_second_source());
    for (technique, opacity, draws) in [
        (Technique::Hamburger6, Opacity::Alpha, 1),
        (Technique::Hamburger4, textured(&stage), draws),
        (Technique::Hausdorff4, textured(&stage), draws),
    ] {
        // How far the bound is above the truth with the bias for one caster, and with that for all.
        let above = |first: f32, extent: f32| {
            let caster = |index: u32| Caster {
                depth: first + extent * (COUNT - index) as f32 / COUNT as f32,
                opacity: 1.0 - 0.3_f32.powf(1.0 / COUNT as f32),
                texture: Texture::Hashed,
            };
            let casters: Vec<Caster> = (0..COUNT).map(caster).collect();
            let surfaces = Surfaces {
                opaque: &|_| 1.0,
                receiver: &|[x, y]| first - 0.03 + 0.06 * ((x + 64 * y) as f32 + 0.5) / 4096.0,
                blurred: false,
            };
            let truth = stage.truth(&casters, &surfaces).unwrap();
            let above = [1, draws * COUNT].map(|blends| {
                let map = MapEncoding::new(technique.clone(), Storage::Unorm16).unwrap();
                let map = map.with_blends(blends).unwrap();
                let found = stage.found(&map, opacity, &casters, &surfaces).unwrap();
                let errors = found.iter().zip(&truth);
                let errors = errors.map(|(found, truth)| f64::from(*found) - truth);
                errors.fold(f64::NEG_INFINITY, f64::max)
            });
            let [of_one, of_all] = above;
            println!(
                "{technique:?}, {COUNT} casters from {first} over {extent}: {of_one:.1e} {of_all:.1e}"
            );
            above
        };
        let clouds = [(0.02, 1e-3), (0.5, 1e-4), (0.5, 1e-3), (0.5, 0.01)];
        let all = clouds.map(|(first, extent)| above(first, extent));
        // How a driver rounds decides how much it takes: six moments are off by 0.8 on llvmpipe, and by nothing on SwiftShader.
        let seen = all.iter().any(|[of_one, _]| *of_one > 0.02);
        assert!(seen || technique == Technique::Hamburger6, "{all:?}");
        assert!(all.iter().all(|[_, of_all]| *of_all < ALLOWED), "{all:?}");
        // In one plane at the near end, all of whose roundings are alike, more is asked for than the bias of four moments on an interval
        // covers: printed, for the document.
        above(0.02, 0.0);
    }
}

/// How casters whose opacity differs from texel to texel are blended into four moments.
fn textured(stage: &TranslucentStage) -> Opacity {
    if stage.has_second_source() {
        Opacity::SecondSource
    } else {
        Opacity::TwoDraws
    }
}
