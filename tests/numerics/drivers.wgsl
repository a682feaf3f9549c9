import moment_shadows::air::single_scattering::{single_scattering_shadow};
import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity_of_texel};
import moment_shadows::map::map_load::{map_load_between};
import moment_shadows::map::storage::{STORAGE_FLOAT32, storage_round_to_float16};
import moment_shadows::maths::angle::{angle_atan2, angle_sin_cos};
import moment_shadows::moments::four_moments::{four_moments_from_depth};
import moment_shadows::shade::contact_shadow::{ContactShadowRay, contact_shadow_intensity};

// One function of the modules, on input on which a built-in function that could stand in its place fails on some driver.

struct BatchInput {
    tried: u32,
    // The first of `given`, where a compiler does not see that both are equal.
    again: f32,
    given: vec2f,
}

alias BatchOutput = vec2f;

fn batch(input: BatchInput) -> BatchOutput {
    let given = input.given;
    switch input.tried {
        case 0u: {
            return vec2f(angle_atan2(given.y, given.x), 0.0);
        }
        case 1u: {
            return vec2f(map_load_between(vec4f(given.x), vec4f(input.again), given.y).x, single_scattering_shadow(vec2f(given.x, input.again), given.y, vec2f(1.0)));
        }
        case 2u: {
            let ray = ContactShadowRay(vec3f(0.0), vec3f(1.0), 8.0, given.x, given.y);
            return vec2f(contact_shadow_intensity(ray, 1.0), contact_shadow_intensity(ray, 0.0));
        }
        case 3u: {
            return storage_round_to_float16(vec4f(given, 0.0, 0.0)).xy;
        }
        case 4u: {
            let texel = four_moments_from_depth(given.x);
            return vec2f(hamburger4_shadow_intensity_of_texel(texel, given.y, STORAGE_FLOAT32), 0.0);
        }
        default: {
            return angle_sin_cos(given.x);
        }
    }
}
