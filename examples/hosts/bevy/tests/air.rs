//! Fog: the graph's output `scattering` beside Bevy's own volumetric fog, which marches.

mod common;

use common::{Picture, SIZE, difference, drawn, filtered, radiance};
use moment_shadows_bevy::demo::{Fog, Look};

/// Bevy's fog with so many steps that more change nothing that can be seen is the truth of both: it has the same medium.
const MANY_STEPS: u32 = 256;

/// Fog over the whole view, which is closed: where Bevy's shadow map ends, its fog is dark.
fn foggy(look: Look) -> Look {
    Look {
        reach: 80.0,
        map: 2048,
        bias: [0.35, 0.0],
        ..look
    }
}

/// Bevy's march ends where the ray has come as far as the surface lies along the camera's axis, which is before the surface:
/// elsewhere than near the axis its fog is too thin, whatever the number of steps (`findings/bevy_fog_length.sh`).
fn near_axis(picture: &Picture) -> Picture {
    let [width, height] = SIZE.map(|size| size as usize);
    // Eight degrees, of 22.5 to the upper edge: one per cent.
    let most = 0.5 * height as f64 * 8f64.to_radians().tan() / 22.5f64.to_radians().tan();
    let near = |pixel: usize| {
        let [x, y] = [pixel % width, pixel / width];
        let [x, y] = [
            x as f64 - 0.5 * width as f64,
            y as f64 - 0.5 * height as f64,
        ];
        x.hypot(y) < most
    };
    let pixels = picture.chunks(3).enumerate();
    pixels
        .filter(|(pixel, _)| near(*pixel))
        .flat_map(|(_, colour)| colour.to_vec())
        .collect()
}

#[test]
fn the_air_beside_bevys_own_fog() {
    // Black surfaces show the air alone.
    let bevys = |steps| Look {
        fog: Fog::Bevys(steps),
        black: true,
        ..foggy(Look::default())
    };
    let (truth, _) = drawn("air_truth", &bevys(MANY_STEPS));
    let (half, _) = drawn("air_half", &bevys(MANY_STEPS / 2));
    let (marched, marched_time) = drawn("air_bevys", &bevys(64));
    let ours = Look {
        fog: Fog::Filtered,
        black: true,
        ..foggy(filtered("air"))
    };
    let (ours, time) = drawn("air", &ours);
    let all = [truth, half, marched, ours].map(|it| radiance(&it));
    for (place, only_axis, most) in [
        ("near the axis", true, 0.06),
        ("everywhere", false, f64::INFINITY),
    ] {
        let [truth, half, marched, ours] = all
            .each_ref()
            .map(|it| if only_axis { near_axis(it) } else { it.clone() });
        let mean = truth.iter().sum::<f64>() / truth.len() as f64;
        let missed = |picture| difference(picture, &truth) / mean;
        let (missed, marched, half) = (missed(&ours), missed(&marched), missed(&half));
        println!(
            "fog {place}: missed {missed:.4} of its mean radiance, Bevy's 64 steps {marched:.4}, {} steps {half:.4}, against {MANY_STEPS} steps; \
             frame time {:.2} of that with 64 steps",
            MANY_STEPS / 2,
            time / marched_time
        );
        assert!(half < 0.004, "{half}");
        assert!(missed < most, "{missed}");
    }
}

/// The same with surfaces, to be looked at.
#[test]
fn the_air_before_surfaces() {
    let (ours, _) = drawn(
        "air_surfaces",
        &Look {
            fog: Fog::Filtered,
            ..foggy(filtered("air"))
        },
    );
    let (bevys, _) = drawn(
        "air_surfaces_bevys",
        &Look {
            fog: Fog::Bevys(64),
            ..foggy(Look::default())
        },
    );
    let (clear, _) = drawn("air_surfaces_clear", &foggy(filtered("hamburger4")));
    let (apart, none) = (difference(&ours, &bevys), difference(&clear, &bevys));
    println!("fog before surfaces: {apart:.3} from Bevy's, without fog {none:.3} of 255");
    assert!(none > 10.0, "{none}");
    assert!(apart < 3.0, "{apart}");
}
