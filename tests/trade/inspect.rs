//! One pixel, step by step.

use moment_shadows::Profile;
use moment_shadows_lab::command::render::RenderOptions;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::scene;
use moment_shadows_lab::trade::Trade;
use moment_shadows_lab::trade::inspect::{Inspection, inspect};

use crate::some;

/// Looks at a pixel of the fence with four techniques.
fn look(pixel: [u32; 2]) -> Result<Inspection, String> {
    let options = RenderOptions {
        map: Some(256),
        size: Some([160, 90]),
        ..RenderOptions::default()
    };
    let file = Trade::graph().unwrap();
    let drawn = options.drawn(&file).unwrap();
    let gpu = Gpu::open(Profile::Native).unwrap();
    let scene = scene::load("fence-and-foliage").unwrap();
    let candidates = some(&["vsm", "evsm4", "hamburger4", "hausdorff4", "pcf"]);
    inspect(&gpu, &scene, (&options, &drawn), &file, &candidates, pixel)
        .map_err(|error| error.to_string())
}

/// What the shader makes of a map is what the technique makes of the depths under its filter, but for the rounding of the storage; and a
/// bias takes from a bound, as leak reduction adds to it.
#[test]
fn every_step_is_what_it_says() {
    let mut mixed = 0;
    for pixel in [[80, 62], [60, 70], [100, 75], [40, 80]] {
        let found = look(pixel).unwrap();
        let shares: f64 = found.depths.iter().map(|[_, share]| share).sum();
        assert!((shares - 1.0).abs() < 1e-9, "{shares}");
        assert!(found.depths.is_sorted_by(|one, other| one[0] < other[0]));
        // Four samples and sixty-four of a texel agree but where something is finer than a texel.
        assert!((found.truth - found.sampled).abs() < 0.1, "{found}");
        mixed += usize::from(found.depths.len() > 1 && found.truth > 0.05 && found.truth < 0.95);
        let names: Vec<&str> = found.techniques.iter().map(|it| it.name.as_str()).collect();
        assert!(
            names.contains(&"vsm") && names.contains(&"hausdorff4"),
            "{names:?}"
        );
        assert!(!names.contains(&"pcf"), "it has no steps");
        for steps in &found.techniques {
            assert!((steps.stored - steps.biased).abs() < 0.03, "{found}");
            assert!(steps.biased <= steps.bound + 1e-3, "{found}");
            assert!(steps.shown >= steps.stored - 1e-6, "{found}");
            assert!(found.to_string().contains(&steps.name));
        }
        let svg = found.svg();
        assert_eq!(svg.matches("<circle").count(), found.techniques.len());
    }
    assert!(mixed > 0, "no pixel is in a penumbra");
}

#[test]
fn pixels_without_a_surface_are_refused() {
    let refused = look([160, 0]).unwrap_err();
    assert_eq!(refused, "pixel 160,0 is outside of the picture of 160x90");
    assert!(
        look([0, 0])
            .unwrap_err()
            .contains("shows nothing that the light's map holds")
    );
}
