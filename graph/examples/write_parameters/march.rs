//! Parameters of marched scattering.

use bytemuck::bytes_of;
use moment_shadows::{
    HeightFog, LeakReduction, LightDepth, MarchScatteringParameters, MarchedAir, SingleScattering,
    SpotCone, UpsampleScatteringParameters,
};
use moment_shadows_graph::Plan;
use serde_json::{Value, json};

use super::{Random, camera, case, hexadecimal, light, number};

/// A camera, a light of any kind and fog.
pub(crate) fn march(random: &mut Random, _: &Plan) -> Value {
    let is_parallel = random.one_in(20);
    let (camera, camera_written) = camera(random, is_parallel);
    let (light, light_written) = light(random);
    let far = random.magnitude(0.0, 4.0);
    let far = random.spoilt(far);
    let up = [0; 3].map(|_| random.between(-1.0, 1.0));
    let (height, falloff) = (random.between(-9.0, 9.0), random.magnitude(-3.0, 0.0));
    let fog = HeightFog {
        up,
        height: random.spoilt(height),
        falloff: random.spoilt(falloff),
    };
    let (inner, outer) = (random.between(0.0, 1.5), random.between(1.5, 3.0));
    let is_spot = !matches!(light.depth, LightDepth::Orthographic { .. }) != random.one_in(20);
    let cone = (is_spot && random.one_in(2)).then(|| SpotCone {
        inner: random.spoilt(inner),
        outer: random.spoilt(outer),
    });
    let air = MarchedAir {
        fog,
        cone,
        frame: random.of(0, 100_000),
        own: [1.0, 2.0, 3.0, random.of(0, 9) as f32],
    };
    let colour = [0.25, 0.5, 1.0];
    let made = || {
        let medium = SingleScattering::new(colour, colour, 0.5, colour)?;
        let leaks = LeakReduction::DEFAULT;
        let march = MarchScatteringParameters::new(&camera, far, &light, medium, &air, leaks)?;
        let upsample = UpsampleScatteringParameters::new(&camera, far)?;
        let upsample = hexadecimal(bytes_of(&upsample));
        Ok(json!({ "march": hexadecimal(bytes_of(&march)), "upsample": upsample }))
    };
    let cone = cone.map(|it| json!({ "inner": number(it.inner), "outer": number(it.outer) }));
    let written = json!({ "up": up, "height": number(fog.height), "falloff": number(fog.falloff) });
    let input = json!({
        "camera": camera_written, "light": light_written, "far": number(far), "colour": colour,
        "air": { "fog": written, "cone": cone, "frame": air.frame, "own": air.own },
    });
    case("march", input, made())
}
