//! Contact: a board that stands on the ground. Its shadow begins at its foot, as closely as the receiver bias and the
//! moment bias allow, and there is no light behind that.

use glam::DVec3;
use moment_shadows::{ReceiverBias, Storage};
use moment_shadows_lab::light::{DirectionalFit, LightView};

use crate::stage::{Stage, StageDesc, camera_at, scene_of};

const MAP: u32 = 256;

/// How high the sun stands.
const ELEVATION: f64 = 35.0;

/// Half the board's length, along x, and its height.
const HALF: f64 = 1.2;
const HEIGHT: f64 = 1.0;

/// Behind a single occluder the bound reaches one half after 0.79 sqrt(alpha) of moment depth, and 0.9 after three times
/// that (a distribution of one depth, widened by the moment bias).
const HALF_SHADOW: f64 = 0.79;
const NINE_TENTHS: f64 = 3.0 * HALF_SHADOW;

/// A board of this thickness with its back at z = 0, on a ground.
fn board(thickness: f64) -> [[DVec3; 4]; 6] {
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let (h, t) = (HEIGHT, thickness);
    let side = |x: f64| [at(x, 0.0, 0.0), at(x, 0.0, t), at(x, h, t), at(x, h, 0.0)];
    let face = |z: f64| {
        [
            at(-HALF, 0.0, z),
            at(HALF, 0.0, z),
            at(HALF, h, z),
            at(-HALF, h, z),
        ]
    };
    let top = [
        at(-HALF, h, t),
        at(HALF, h, t),
        at(HALF, h, 0.0),
        at(-HALF, h, 0.0),
    ];
    let ground = [
        at(-9.0, 0.0, 9.0),
        at(9.0, 0.0, 9.0),
        at(9.0, 0.0, -9.0),
        at(-9.0, 0.0, -9.0),
    ];
    [face(t), face(0.0), side(-HALF), side(HALF), top, ground]
}

fn check(storage: Storage, thickness: f64) {
    let stage = Stage::new(StageDesc {
        picture: [320, 180],
        map: MAP,
        ..StageDesc::new(storage)
    });
    let quads = board(thickness);
    let casters: Vec<DVec3> = quads[..5].iter().flatten().copied().collect();
    let (sin, cos) = ELEVATION.to_radians().sin_cos();
    // From the front, z > 0, so that the shadow falls towards z < 0.
    let fit = DirectionalFit {
        map: [MAP; 2],
        margin: 6.0,
        reversed: false,
    };
    let light = LightView::directional_fitted(DVec3::new(0.0, -sin, -cos), &casters, fit).unwrap();
    let texel = light.texel_size([MAP; 2])[1];
    // From behind the board, above its shadow; a pixel is about a third of a texel.
    let camera = camera_at(DVec3::new(0.1, 0.6, -1.0), DVec3::new(0.0, 0.0, -0.1));
    let model = stage.upload(&scene_of("board", &quads));
    let shadow = stage.shadow(&model, &light, &camera);
    let pixels = stage.pixels();

    let half_range = 0.5 * (light.range[1] - light.range[0]);
    let kernel = moment_shadows::Kernel::gaussian(stage.desc.radius, stage.desc.sigma).unwrap();
    let bias = ReceiverBias::for_kernel(kernel.standard_deviation(), (texel / half_range) as f32);
    // The ground's depth changes by a texel's width times the cotangent of the elevation per texel.
    let receiver_bias =
        f64::from(bias.constant) * half_range + f64::from(bias.slope_scale) * texel * cos / sin;
    let moment_bias = f64::from(storage.moment_bias().alpha).sqrt() * half_range;
    // On the ground at z the board's front stands (thickness - z) / cos before the fragment, along the light.
    let begins = cos * (receiver_bias + HALF_SHADOW * moment_bias) - thickness;
    // The kernel and the lookup see the lit ground before the board up to 5 texels into the board's image.
    let lit = 5.0 * texel / sin - thickness;
    let full = lit.max(cos * (receiver_bias + NINE_TENTHS * moment_bias) - thickness);

    let mut first = f64::INFINITY;
    let mut lightest: (f64, f32) = (0.0, 1.0);
    let mut in_shadow = 0;
    for (position, &intensity) in pixels.position.iter().zip(&shadow) {
        let [x, y, z] = position.map(f64::from);
        assert!((0.0..=1.0).contains(&intensity), "{intensity}");
        // The ground behind the middle half of the board, up to half of its shadow's length.
        let behind = -z;
        if y.abs() > 1e-5
            || x.abs() > 0.5 * HALF
            || !(0.0..0.5 * HEIGHT * cos / sin).contains(&behind)
        {
            continue;
        }
        in_shadow += 1;
        if intensity >= 0.5 {
            first = first.min(behind);
        }
        // Half a texel for what a pixel covers.
        if behind > full + 0.5 * texel && intensity < lightest.1 {
            lightest = (behind, intensity);
        }
    }
    let texels = |length: f64| length * sin / texel;
    println!(
        "{storage}, {thickness}: half shadow at {:.2} texels (allowed {:.2}); behind {:.2} texels at least {:.3} (at {:.2})",
        texels(first),
        texels(begins),
        texels(full),
        lightest.1,
        texels(lightest.0),
    );
    assert!(in_shadow > 3000, "{in_shadow}");
    // The kernel straddles the board's foot: half of it sees the board where the ground begins.
    assert!(first <= begins.max(0.0) + texel, "{first} {begins}");
    assert!(lightest.1 >= 0.9, "{lightest:?}");
}

#[test]
fn shadows_begin_at_the_foot_of_a_thick_board() {
    for storage in Storage::OF_FOUR_MOMENTS {
        check(storage, 0.3);
    }
}

#[test]
fn shadows_begin_at_the_foot_of_a_thin_board() {
    for storage in Storage::OF_FOUR_MOMENTS {
        check(storage, 0.01);
    }
}
