//! Cameras and lights, random and degenerate.

use glam::{DMat3, DMat4, DVec3, DVec4};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// A camera and a light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub(crate) clip_from_world: [[f64; 4]; 4],
    /// In f64, of the matrix in f32.
    pub(crate) world_from_clip: DMat4,
    pub(crate) far: f64,
    pub(crate) light: [f64; 3],
}

/// A perspective projection with its lens.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lens {
    pub(crate) field_of_view: f64,
    pub(crate) aspect: f64,
    pub(crate) near: f64,
    /// The far plane; without it depth is reversed and infinite.
    pub(crate) far: Option<f64>,
}

impl Lens {
    fn projection(self) -> DMat4 {
        let y = 1.0 / (0.5 * self.field_of_view).tan();
        let (z, w) = match self.far {
            None => (0.0, self.near),
            Some(far) => (far / (self.near - far), self.near * far / (self.near - far)),
        };
        DMat4::from_cols(
            DVec4::new(y / self.aspect, 0.0, 0.0, 0.0),
            DVec4::new(0.0, y, 0.0, 0.0),
            DVec4::new(0.0, 0.0, z, -1.0),
            DVec4::new(0.0, 0.0, w, 0.0),
        )
    }
}

/// A camera at `eye` whose axes are the columns of `rotation`; it looks along -z.
pub(crate) fn pair(eye: DVec3, rotation: DMat3, lens: Lens, far: f64, light: DVec3) -> Pair {
    let view = DMat4::from_mat3(rotation.transpose()) * DMat4::from_translation(-eye);
    let clip_from_world = lens.projection() * view;
    Pair {
        clip_from_world: clip_from_world.to_cols_array_2d(),
        world_from_clip: clip_from_world.inverse(),
        far,
        light: light.to_array(),
    }
}

/// A rotation that looks along `forward`.
pub(crate) fn looking(forward: DVec3, roll: f64) -> DMat3 {
    let back = -forward.normalize();
    let side = back.any_orthonormal_vector();
    let up = back.cross(side);
    let (sine, cosine) = roll.sin_cos();
    DMat3::from_cols(side * cosine + up * sine, up * cosine - side * sine, back)
}

pub(crate) fn direction(random: &mut ChaCha8Rng) -> DVec3 {
    loop {
        let vector = DVec3::from_array([0; 3].map(|_| random.random_range(-1.0..1.0)));
        if (0.01..=1.0).contains(&vector.length()) {
            return vector.normalize();
        }
    }
}

/// A random camera with a random light, one in three of them degenerate: along the view, across it, through a corner or an
/// edge of the picture, or nearly so.
pub(crate) fn random_pair(random: &mut ChaCha8Rng) -> Pair {
    let lens = Lens {
        field_of_view: random.random_range(0.1..2.4),
        aspect: 2.0_f64.powf(random.random_range(-1.5..1.5)),
        near: 10.0_f64.powf(random.random_range(-2.0..0.0)),
        far: random
            .random::<bool>()
            .then(|| random.random_range(50.0..2000.0)),
    };
    let rotation = looking(direction(random), random.random_range(0.0..6.3));
    let eye = direction(random) * random.random_range(0.0..30.0);
    let far = random.random_range(5.0..500.0);
    let mut light = direction(random);
    if random.random_range(0..3) == 0 {
        let y = (0.5 * lens.field_of_view).tan();
        let mut place = || [-1.0, 0.0, 1.0][random.random_range(0..3)];
        let through = rotation * DVec3::new(place() * y * lens.aspect, place() * y, -1.0);
        let sign = place();
        light = if sign == 0.0 {
            through.any_orthonormal_vector()
        } else {
            through * sign
        };
        let size = 10.0_f64.powf(random.random_range(-9.0..-1.0));
        if random.random() {
            light = light.normalize() + direction(random) * size;
        }
    }
    pair(eye, rotation, lens, far, light)
}
