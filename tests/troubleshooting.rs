//! Each mistake shows its symptom, as the page of symptoms says it; the picture beside it does not.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use moment_shadows::Profile;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::troubleshooting::{NAMES, symptom};

const WIDTH: usize = 160;
const HEIGHT: usize = 90;

/// Shadow intensity per pixel, with a mistake and without it.
struct Pair {
    wrong: Vec<f32>,
    right: Vec<f32>,
}

impl Pair {
    fn of(name: &'static str) -> Self {
        let gpu = Gpu::open(Profile::Native).unwrap();
        let found = symptom(&gpu, name, [WIDTH as u32, HEIGHT as u32]).unwrap();
        Self {
            wrong: found.wrong.shadow,
            right: found.right.shadow,
        }
    }

    /// The share of all pixels for which this holds of both intensities.
    fn share(&self, holds: impl Fn(f32, f32) -> bool) -> f64 {
        let pairs = self.wrong.iter().zip(&self.right);
        let count = pairs
            .filter(|&(&wrong, &right)| holds(wrong, right))
            .count();
        count as f64 / self.wrong.len() as f64
    }
}

#[test]
fn acne_shadows_what_is_lit_in_stripes() {
    let pair = Pair::of("acne");
    let shadowed = pair.share(|wrong, right| right < 0.01 && wrong > 0.2);
    assert!(shadowed > 0.15, "{shadowed}");
    // Stripes: what is lit and what is not are neighbours in most places.
    let is_striped = |x: usize, y: usize| {
        let of = |x: usize| pair.wrong[y * WIDTH + x];
        let lit = pair.right[y * WIDTH + x] < 0.01 && pair.right[y * WIDTH + x + 2] < 0.01;
        lit && (of(x) - of(x + 2)).abs() > 0.1
    };
    let edges = (0..HEIGHT).flat_map(|y| (0..WIDTH - 2).map(move |x| (x, y)));
    let edges = edges.filter(|&(x, y)| is_striped(x, y)).count();
    assert!(edges > 1000, "{edges}");
    assert!(pair.share(|wrong, right| wrong < right - 0.1) < 0.01);
}

#[test]
fn peter_panning_loses_shadows_where_things_stand() {
    let pair = Pair::of("peter-panning");
    let lost = pair.share(|wrong, right| right > 0.9 && wrong < 0.1);
    let added = pair.share(|wrong, right| wrong > right + 0.01);
    assert!(lost > 0.05 && added == 0.0, "{lost} {added}");
}

#[test]
fn leaking_lightens_what_is_in_full_shadow() {
    let pair = Pair::of("leaking");
    let leaks = pair.share(|wrong, right| right > 0.99 && wrong < 0.9);
    let added = pair.share(|wrong, right| wrong > right + 0.02);
    assert!(leaks > 0.02 && added < 0.01, "{leaks} {added}");
}

#[test]
fn seams_lie_along_the_edge_of_regions() {
    let pair = Pair::of("seams");
    let differs = pair.share(|wrong, right| (wrong - right).abs() > 0.05);
    let equal = pair.share(|wrong, right| (wrong - right).abs() < 0.01);
    assert!(differs > 0.002 && equal > 0.9, "{differs} {equal}");
}

#[test]
fn a_light_that_moves_by_whole_texels_does_not_flicker() {
    let pair = Pair::of("flicker");
    let mean = |all: &[f32]| all.iter().map(|&it| f64::from(it)).sum::<f64>() / all.len() as f64;
    let [wrong, right] = [mean(&pair.wrong), mean(&pair.right)];
    println!("{wrong:.6} {right:.6}");
    assert!(wrong > 1e-3 && right < wrong / 20.0, "{wrong} {right}");
}

#[test]
fn a_map_of_the_other_direction_is_black() {
    let pair = Pair::of("black");
    let black = pair.share(|wrong, right| right < 0.01 && wrong > 0.9);
    assert!(black > 0.3, "{black}");
}

#[test]
fn beside_the_map_all_is_lit() {
    let pair = Pair::of("lit");
    let lit = pair.share(|wrong, right| right > 0.9 && wrong == 0.0);
    assert!(lit > 0.08, "{lit}");
}

#[test]
fn flipped_shadows_are_elsewhere() {
    let pair = Pair::of("misplaced");
    let elsewhere = pair.share(|wrong, right| (wrong - right).abs() > 0.9);
    assert!(elsewhere > 0.2, "{elsewhere}");
}

#[test]
fn the_page_shows_every_symptom() {
    let page = include_str!("../docs/troubleshooting.md");
    for name in NAMES {
        assert!(
            page.contains(&format!("](troubleshooting/{name}.png)")),
            "{name}"
        );
    }
}
