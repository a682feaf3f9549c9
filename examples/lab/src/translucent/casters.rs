//! Translucent casters that lie parallel to a light's map, far to near.

/// How the opacity of a caster differs from texel to texel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Texture {
    /// Not at all, as a pane's.
    Even,
    /// From an eighth to all of it.
    Hashed,
    /// It fades out from a centre on, in texels; along an axis without a radius it does not.
    Soft {
        /// The centre.
        centre: [f32; 2],
        /// Where it ends along each axis.
        radius: [Option<f32>; 2],
    },
}

/// A translucent caster.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Caster {
    /// The depth that a map stores, from 0 to 1.
    pub depth: f32,
    /// The greatest opacity.
    pub opacity: f32,
    /// How it differs.
    pub texture: Texture,
}

impl Caster {
    /// Centre and inverse radii, as the shader has them.
    pub(super) fn shape(&self) -> ([f32; 2], [f32; 2]) {
        match self.texture {
            Texture::Even | Texture::Hashed => ([0.0; 2], [0.0; 2]),
            Texture::Soft { centre, radius } => {
                (centre, radius.map(|radius| radius.map_or(0.0, f32::recip)))
            }
        }
    }

    /// The opacity at a texel.
    #[must_use]
    pub fn opacity_at(&self, [x, y]: [u32; 2]) -> f64 {
        let hashed = match self.texture {
            Texture::Hashed => f64::from((5 * x + 3 * y) % 8 + 1) / 8.0,
            Texture::Even | Texture::Soft { .. } => 1.0,
        };
        let (centre, inverse) = self.shape();
        let place = [x, y].map(|texel| f64::from(texel) + 0.5);
        let square = |axis: usize| {
            ((place[axis] - f64::from(centre[axis])) * f64::from(inverse[axis])).powi(2)
        };
        let inside = (1.0 - square(0) - square(1)).clamp(0.0, 1.0);
        f64::from(self.opacity) * hashed * inside * inside
    }
}

/// So many casters that all together keep 70 % of the light where their opacity is greatest: from 0.2 to 0.8 of the depth, or as a cloud
/// in a hundredth of it.
#[must_use]
pub fn stack(count: u32, cloud: bool, texture: Texture) -> Vec<Caster> {
    let extent = if cloud { 0.01 } else { 0.6 };
    let caster = |index: u32| Caster {
        depth: 0.2 + extent * ((count - index) as f32 - 0.5) / count as f32,
        opacity: 1.0 - 0.3_f32.powf(1.0 / count as f32),
        texture,
    };
    (0..count).map(caster).collect()
}

/// A plume of smoke of 24 slices in a map of so many texels per side: it winds, widens and thins from the light's far end on. Rows of the
/// map are alike where it is `flat`, so that a picture whose rows are depths is a section through it.
#[must_use]
pub fn plume(side: u32, flat: bool) -> Vec<Caster> {
    const SLICES: u32 = 24;
    let slice = |index: u32| {
        let height = index as f32 / (SLICES - 1) as f32;
        let side = side as f32;
        let (sine, cosine) = (7.0 * height).sin_cos();
        let radius = (0.09 + 0.2 * height) * side;
        Caster {
            depth: 0.82 - 0.66 * height,
            opacity: 0.3 - 0.15 * height,
            texture: Texture::Soft {
                centre: [
                    (0.5 + 0.14 * height * sine) * side,
                    (0.5 + 0.14 * height * cosine) * side,
                ],
                radius: [Some(radius), (!flat).then_some(radius)],
            },
        }
    };
    (0..SLICES).map(slice).collect()
}
