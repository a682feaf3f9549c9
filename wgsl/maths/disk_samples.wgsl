// Samples that are spread over the unit disk, and the rotation by which each pixel turns them.
//
// With few samples a filter makes bands. Turned by a different angle in each pixel, it makes noise instead, which the eye and
// temporal filters forgive.

// The number of samples of the Poisson disk.
const DISK_SAMPLES_POISSON_COUNT: u32 = 16u;

// A Poisson disk: no two samples are closer than 0.455. Sample i lies at radius sqrt((i + 0.5) / 16), in the middle of one of
// 16 rings of equal area, so that the samples cover the disk evenly when they are turned by every angle. Their angles were
// found by best candidates and random relaxation of the smallest distance.
const DISK_SAMPLES_POISSON: array<vec2f, 16> = array<vec2f, 16>(
    vec2f(0.027483, -0.174627),
    vec2f(0.059710, 0.300308),
    vec2f(-0.383554, 0.095584),
    vec2f(0.465980, 0.040162),
    vec2f(-0.389073, -0.360378),
    vec2f(0.415935, -0.413217),
    vec2f(-0.321242, 0.550503),
    vec2f(0.471743, 0.496194),
    vec2f(0.000066, -0.728869),
    vec2f(0.083704, 0.765992),
    vec2f(-0.806214, -0.079181),
    vec2f(-0.750352, 0.394616),
    vec2f(0.858217, -0.211455),
    vec2f(0.876628, 0.274358),
    vec2f(-0.520274, -0.797223),
    vec2f(0.435590, -0.882616),
);

// A full turn in radians.
const DISK_SAMPLES_TURN: f32 = 6.2831853;

// The angle between two neighbours of a sunflower's seeds: a full turn times (3 - sqrt(5)) / 2.
const DISK_SAMPLES_GOLDEN_ANGLE: f32 = 2.3999632;

// The angle in radians, from 0 to a full turn, by which a pixel turns its samples: interleaved gradient noise of its
// coordinates (Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014). `pixel` from
// 0 to 65536.
fn disk_samples_angle(pixel: vec2f) -> f32 {
    return DISK_SAMPLES_TURN * fract(52.9829189 * fract(dot(pixel, vec2f(0.06711056, 0.00583715))));
}

// Cosine and sine of an angle in radians, as `disk_samples_rotate` takes them.
fn disk_samples_rotation(angle: f32) -> vec2f {
    // WGSL promises accurate sines within one turn only.
    let turned = DISK_SAMPLES_TURN * fract(angle / DISK_SAMPLES_TURN);
    return vec2f(cos(turned), sin(turned));
}

// A sample turned by a rotation.
fn disk_samples_rotate(sample: vec2f, rotation: vec2f) -> vec2f {
    return vec2f(dot(sample, vec2f(rotation.x, -rotation.y)), dot(sample, rotation.yx));
}

// Sample `index` (0 to 15) of the Poisson disk, turned.
fn disk_samples_poisson(index: u32, rotation: vec2f) -> vec2f {
    return disk_samples_rotate(DISK_SAMPLES_POISSON[min(index, DISK_SAMPLES_POISSON_COUNT - 1u)], rotation);
}

// Sample `index` of `count` samples that cover the disk evenly (Vogel, "A better way to construct the sunflower head",
// Mathematical Biosciences 44, 1979), turned. `count` is at least 1.
fn disk_samples_vogel(index: u32, count: u32, rotation: vec2f) -> vec2f {
    let radius = sqrt((f32(index) + 0.5) / f32(max(count, 1u)));
    return disk_samples_rotate(vec2f(radius, 0.0), disk_samples_rotate(disk_samples_rotation(f32(index) * DISK_SAMPLES_GOLDEN_ANGLE), rotation));
}
