//! Views that follow from a camera, a light and a filter, and their places.

use moment_shadows::{
    Atlas, Border, CascadeSplits, Cascades, LightView, PointLight, Tile, ValueError,
};
use moment_shadows_graph::Plan;
use serde_json::{Value, json};

use super::{Random, camera, case, depth, number, numbers};

/// Views as JavaScript has them; matrices in f32, since powers and tangents differ in the last bit.
fn written(views: &[LightView]) -> Value {
    let written = views.iter().map(|view| {
        let matrix = view.clip_from_world.as_flattened().iter();
        let matrix: Vec<f32> = matrix.map(|&entry| entry as f32).collect();
        json!([
            matrix,
            view.layer,
            view.region.origin,
            view.region.extent,
            view.guard,
            match view.border {
                Border::Sharp => json!("sharp"),
                Border::Blend(width) => json!({ "blend": width as f32 }),
                Border::Fade(width) => json!({ "fade": width as f32 }),
                Border::Cone(width) => json!({ "cone": width as f32 }),
            }
        ])
    });
    written.collect()
}

fn tile(random: &mut Random) -> (Tile, Value) {
    let radius = random.between(0.0, 20.0);
    let tile = Tile {
        texels: random.of(0, 10) * random.of(20, 200),
        filter_radius: random.spoilt(radius),
    };
    let written = json!({ "texels": tile.texels, "filterRadius": number(tile.filter_radius) });
    (tile, written)
}

/// A place, or a direction.
fn triple(random: &mut Random, size: f64) -> [f64; 3] {
    let triple = [0; 3].map(|_| random.between(-size, size));
    if random.one_in(30) {
        [0.0, 0.0, random.spoilt(0.0)]
    } else {
        triple
    }
}

/// Gives views places in a map that may have no room for them.
fn placed(
    random: &mut Random,
    views: Result<Vec<LightView>, ValueError>,
) -> (Result<Value, ValueError>, Value) {
    let (size, layers) = (
        [random.of(500, 4000), random.of(500, 4000)],
        random.of(1, 4),
    );
    let made = views.and_then(|mut views| {
        Atlas { size, layers }.place(&mut views)?;
        Ok(written(&views))
    });
    (made, json!({ "size": size, "layers": layers }))
}

pub(super) fn cascades(random: &mut Random, _: &Plan) -> Value {
    let is_parallel = random.one_in(5);
    let (camera, camera_written) = camera(random, is_parallel);
    let (tile, tile_written) = tile(random);
    let near = if random.one_in(8) {
        0.0
    } else {
        random.between(0.1, 2.0)
    };
    let (far, overlap) = (random.magnitude(0.5, 3.0), random.between(0.0, 1.0));
    let blend = if random.one_in(2) {
        0.0
    } else {
        random.between(0.0, 0.6)
    };
    let (splits, splits_written) = if random.one_in(3) {
        let given: Vec<f64> = (0..random.below(3))
            .map(|index| near + index as f64 + random.between(0.0, 1.2))
            .collect();
        let written = json!({ "given": numbers(&given) });
        (CascadeSplits::Given(given), written)
    } else {
        let (count, weight) = (random.of(0, 6), random.between(0.0, 1.0));
        let logarithmic = if random.one_in(4) {
            0.0
        } else {
            random.spoilt(weight)
        };
        let written = json!({ "blend": { "count": count, "logarithmic": number(logarithmic) } });
        (CascadeSplits::Blend { count, logarithmic }, written)
    };
    let casters = random.one_in(2).then(|| {
        let low = triple(random, 50.0);
        [low, low.map(|it| it + random.between(-0.5, 100.0))]
    });
    let cascades = Cascades {
        direction: triple(random, 1.0),
        splits,
        near: random.spoilt(near),
        far: random.spoilt(far),
        overlap: random.spoilt(overlap),
        blend: random.spoilt(blend),
        casters,
        pancaking: !random.one_in(4),
        reversed: random.one_in(2),
        tile,
    };
    let views = cascades.views(&camera);
    let slices = cascades.slices().map(|it| {
        it.as_flattened()
            .iter()
            .map(|&it| it as f32)
            .collect::<Vec<_>>()
    });
    let (made, atlas) = placed(random, views);
    let made = made.and_then(|views| Ok(json!({ "views": views, "slices": slices? })));
    let input = json!({
        "camera": camera_written, "atlas": atlas,
        "cascades": {
            "direction": numbers(&cascades.direction), "splits": splits_written, "near": number(cascades.near),
            "far": number(cascades.far), "overlap": number(cascades.overlap), "blend": number(cascades.blend), "casters": casters.map(|corners| corners.map(|it| numbers(&it))),
            "pancaking": cascades.pancaking, "reversed": cascades.reversed, "tile": tile_written,
        },
    });
    case("cascades", input, made)
}

pub(super) fn point_light(random: &mut Random, _: &Plan) -> Value {
    let kind = if random.one_in(30) {
        0
    } else {
        1 + random.below(2)
    };
    let (depth, depth_written) = depth(random, kind);
    let (tile, tile_written) = tile(random);
    let nearest = random.magnitude(-2.0, 2.0);
    let nearest_caster = random.one_in(2).then(|| random.spoilt(nearest));
    let light = PointLight {
        position: triple(random, 50.0),
        depth,
        tile,
        nearest_caster,
    };
    let (direction, angle) = (triple(random, 1.0), random.between(0.1, 3.2));
    let angle = random.spoilt(angle);
    let views = light.faces().and_then(|faces| {
        let mut views = faces.to_vec();
        views.push(light.spot(direction, angle)?);
        Ok(views)
    });
    let (made, atlas) = placed(random, views);
    let input = json!({
        "atlas": atlas, "direction": numbers(&direction), "angle": number(angle),
        "light": {
            "position": numbers(&light.position), "depth": depth_written, "tile": tile_written,
            "nearestCaster": nearest_caster.map(number),
        },
    });
    case(
        "pointLight",
        input,
        made.map(|views| json!({ "views": views })),
    )
}
