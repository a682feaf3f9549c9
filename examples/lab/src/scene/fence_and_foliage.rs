//! Fine casters in several depth layers: a wrought fence above steps, a tree and a potted plant.

use glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::shapes::{Shape, ball};
use super::{Image, Material, Scene};

const STONE: usize = 0;
const IRON: usize = 1;
const BARK: usize = 2;
const LEAVES: usize = 3;
const CLAY: usize = 4;
const GRASS: usize = 5;

/// Height of the landing on which the fence stands.
const LANDING: f64 = 0.6;

/// A wrought iron fence (bars of 16 mm) on a landing above three steps, a tree of alpha-masked leaves behind it, and
/// plants of thin triangles in front. About 8 m wide, and not yet on a ground plane.
pub fn fence_and_foliage() -> Scene {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut meshes = vec![steps(), fence()];
    meshes.extend(tree(&mut rng));
    meshes.extend(plants(&mut rng));
    let leaves = Material {
        texture: Some(0),
        mask: Some(0.5),
        double_sided: true,
        ..Material::plain("leaves", [1.0, 1.0, 1.0])
    };
    let grass = Material {
        double_sided: true,
        ..Material::plain("grass", [0.16, 0.28, 0.06])
    };
    Scene {
        name: "fence-and-foliage".to_owned(),
        meshes,
        materials: vec![
            Material::plain("stone", [0.56, 0.53, 0.48]),
            Material::plain("iron", [0.06, 0.065, 0.07]),
            Material::plain("bark", [0.22, 0.15, 0.1]),
            leaves,
            Material::plain("clay", [0.5, 0.2, 0.11]),
            grass,
        ],
        images: vec![twig()],
        ..Scene::default()
    }
}

/// A landing and three steps that descend towards +z.
fn steps() -> super::Mesh {
    let mut shape = Shape::new(STONE);
    for step in 0..4 {
        let front = -0.5 + 0.38 * f64::from(step);
        let back = if step == 0 { -2.6 } else { front - 0.38 };
        let top = LANDING - 0.15 * f64::from(step);
        shape.cuboid([-3.0, 0.0, back], [3.0, top, front]);
    }
    // Two low walls beside the steps.
    for side in [-1.0, 1.0_f64] {
        let [a, b] = [side * 3.0, side * 3.25];
        shape.cuboid([a.min(b), 0.0, -2.6], [a.max(b), LANDING + 0.1, 0.66]);
    }
    shape.finish()
}

/// Posts with balls, rails, bars with spearheads, and a row of rings between the upper rails.
fn fence() -> super::Mesh {
    let mut shape = Shape::new(IRON);
    let z = -0.8;
    let posts = [-2.8, -0.95, 0.95, 2.8];
    let at = |x: f64, y: f64| DVec3::new(x, LANDING + y, z);
    for x in posts {
        shape.cuboid(
            [x - 0.035, LANDING, z - 0.035],
            [x + 0.035, LANDING + 1.35, z + 0.035],
        );
        shape.lathe(
            at(x, 1.35),
            DVec3::Y,
            &[[0.055, 0.0], [0.055, 0.02], [0.02, 0.04]],
            16,
        );
        shape.lathe(at(x, 1.38), DVec3::Y, &ball(0.06, 0.0), 16);
    }
    for gap in posts.windows(2) {
        // The middle is a gate that stands open.
        if gap[0] > -1.0 && gap[0] < 0.0 {
            continue;
        }
        for height in [0.12, 0.92, 1.1] {
            let y = LANDING + height;
            shape.cuboid(
                [gap[0], y - 0.012, z - 0.012],
                [gap[1], y + 0.012, z + 0.012],
            );
        }
        let bars = 15;
        for bar in 1..bars {
            let x = gap[0] + (gap[1] - gap[0]) * f64::from(bar) / f64::from(bars);
            let spear = [
                [0.008, 0.05],
                [0.008, 1.2],
                [0.02, 1.22],
                [0.008, 1.24],
                [0.024, 1.29],
                [0.0, 1.4],
            ];
            shape.lathe(at(x, 0.0), DVec3::Y, &spear, 8);
            let middle = x + 0.5 * (gap[1] - gap[0]) / f64::from(bars);
            if bar + 1 < bars {
                shape.ring(at(middle, 1.01), DVec3::Z, 0.052, 0.006);
            }
        }
    }
    // One wing of the gate, opened towards the steps.
    let hinge = DVec3::new(-0.9, LANDING, z);
    let along = DVec3::new(0.45, 0.0, 0.893);
    let wing = |s: f64, y: f64| hinge + s * along + y * DVec3::Y;
    for height in [0.12, 0.55, 1.1] {
        shape.rod(wing(0.0, height), wing(0.88, height), [0.012, 0.012], 8);
    }
    for bar in 0..=8 {
        let s = 0.88 * f64::from(bar) / 8.0;
        // Its upper edge is an arc.
        let top = 1.3 - 0.25 * (1.0 - (1.0 - s / 0.88).powi(2));
        shape.rod(wing(s, 0.06), wing(s, top), [0.008, 0.008], 8);
    }
    shape.finish()
}

/// A trunk that branches, and at the branches' ends cards with alpha-masked twigs.
fn tree(rng: &mut ChaCha8Rng) -> [super::Mesh; 2] {
    let mut bark = Shape::new(BARK);
    let mut leaves = Shape::new(LEAVES);
    let root = DVec3::new(1.9, LANDING, -1.75);
    let top = root + DVec3::new(-0.15, 1.25, 0.1);
    bark.rod(root - 0.05 * DVec3::Y, top, [0.11, 0.075], 12);
    branch(
        &mut bark,
        &mut leaves,
        rng,
        top,
        DVec3::new(-0.1, 1.0, 0.1),
        0.75,
        0,
    );
    [bark.finish(), leaves.finish()]
}

/// A vector within the unit cube about the origin.
fn jitter(rng: &mut ChaCha8Rng) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|_| rng.random_range(-1.0..1.0)))
}

fn branch(
    bark: &mut Shape,
    leaves: &mut Shape,
    rng: &mut ChaCha8Rng,
    from: DVec3,
    direction: DVec3,
    length: f64,
    level: u32,
) {
    for _ in 0..4 {
        let lean = (direction + 0.9 * jitter(rng) + 0.15 * DVec3::Y).normalize_or(DVec3::Y);
        let tip = from + lean * length * rng.random_range(0.8..1.15);
        let radius = 0.055 * 0.5_f64.powi(level as i32);
        bark.rod(from, tip, [radius, 0.5 * radius], 7);
        if level < 3 {
            branch(bark, leaves, rng, tip, lean, 0.68 * length, level + 1);
        }
        if level >= 2 {
            for _ in 0..5 {
                let middle = from.lerp(tip, rng.random_range(0.2..1.3)) + 0.1 * jitter(rng);
                let (u, v) = jitter(rng).normalize_or(DVec3::Y).any_orthonormal_pair();
                let [u, v] = [0.08 * u, 0.08 * v];
                leaves.quad([
                    middle - u - v,
                    middle + u - v,
                    middle + u + v,
                    middle - u + v,
                ]);
            }
        }
    }
}

/// A fern in a pot on a step, and grass along the foot of the steps.
fn plants(rng: &mut ChaCha8Rng) -> [super::Mesh; 2] {
    let mut clay = Shape::new(CLAY);
    let mut grass = Shape::new(GRASS);
    for (x, step) in [(-2.1, 1), (1.55, 2)] {
        let base = DVec3::new(
            x,
            LANDING - 0.15 * f64::from(step),
            -0.68 + 0.38 * f64::from(step),
        );
        let pot = [
            [0.0, 0.0],
            [0.1, 0.0],
            [0.135, 0.2],
            [0.155, 0.2],
            [0.155, 0.25],
            [0.13, 0.25],
            [0.12, 0.2],
            [0.0, 0.2],
        ];
        clay.lathe(base, DVec3::Y, &pot, 24);
        for _ in 0..70 {
            let lean = DVec3::new(1.0, 0.0, 1.0) * jitter(rng);
            frond(
                &mut grass,
                base + 0.2 * DVec3::Y + 0.06 * lean,
                lean,
                0.5,
                rng,
            );
        }
    }
    for _ in 0..420 {
        let side = if rng.random_bool(0.5) { 1.0 } else { -1.0 };
        let base = DVec3::new(
            side * rng.random_range(3.27..3.9),
            0.0,
            rng.random_range(-2.4..1.0),
        );
        let lean = DVec3::new(0.5, 0.0, 0.5) * jitter(rng);
        frond(&mut grass, base, lean, 0.3, rng);
    }
    [clay.finish(), grass.finish()]
}

/// A blade that bends towards `lean`, with leaflets.
fn frond(grass: &mut Shape, base: DVec3, lean: DVec3, length: f64, rng: &mut ChaCha8Rng) {
    const STEPS: u32 = 6;
    let length = length * rng.random_range(0.6..1.0);
    let side = lean.cross(DVec3::Y).normalize_or(DVec3::X);
    let point =
        |t: f64| base + length * (t * DVec3::Y + 0.6 * t * t * lean - 0.35 * t.powi(3) * DVec3::Y);
    for step in 0..STEPS {
        let [t, next] = [step, step + 1].map(|step| f64::from(step) / f64::from(STEPS));
        let width = 0.018 * (1.0 - t);
        grass.triangle([
            point(t) - width * side,
            point(t) + width * side,
            point(next),
        ]);
        for sign in [-1.0, 1.0] {
            let out = point(next) + sign * (0.07 * (1.2 - t)) * side;
            grass.triangle([point(t), point(next), out]);
        }
    }
}

/// A twig with seven leaves, transparent elsewhere.
fn twig() -> Image {
    const SIZE: u32 = 128;
    let mut rgba = Vec::with_capacity((SIZE * SIZE * 4) as usize);
    for y in 0..SIZE {
        for x in 0..SIZE {
            let [u, v] = [x, y].map(|at| (f64::from(at) + 0.5) / f64::from(SIZE));
            // The twig grows upwards from the bottom middle.
            let [px, py] = [u - 0.5, 1.0 - v];
            let stem = px.abs() < 0.012 && py < 0.75;
            let mut vein = 1.0_f64;
            let mut leaf = false;
            for (number, angle) in [-1.15, 1.15, -0.95, 0.95, -0.75, 0.75, 0.0_f64]
                .into_iter()
                .enumerate()
            {
                let foot = 0.1 + 0.22 * (number / 2) as f64 - if number == 6 { 0.16 } else { 0.0 };
                let (sin, cos) = angle.sin_cos();
                let along = (px * sin + (py - foot) * cos) / 0.42;
                let across = (px * cos - (py - foot) * sin) / 0.42;
                if (0.0..1.0).contains(&along) {
                    let half = 0.24 * (std::f64::consts::PI * along.powf(0.75)).sin();
                    if across.abs() < half {
                        leaf = true;
                        vein = vein.min(0.75 + 0.25 * (across.abs() / 0.03).min(1.0));
                    }
                }
            }
            let shade = vein * (0.85 + 0.15 * py);
            let colour = if leaf {
                [86.0 * shade, 122.0 * shade, 48.0 * shade]
            } else {
                // The colour under the transparent part bleeds into the edges of smaller mips.
                [80.0, 96.0, 48.0]
            };
            rgba.extend(colour.map(|channel| channel as u8));
            rgba.push(if leaf || stem { 255 } else { 0 });
        }
    }
    Image {
        width: SIZE,
        height: SIZE,
        rgba,
    }
}
