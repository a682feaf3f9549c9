//! Where alpha-masked materials have holes, and how opaque blended ones are, in f64: what the host's fragment shader discards or blends.
//! Images are read at their full size, as ever finer pixels would show them.

use glam::{DVec2, DVec3};
use wgpu::{AddressMode, FilterMode};

use crate::scene::{Image, Material, Mesh};

/// The holes of a masked material, or the opacity of a blended one.
pub(super) struct Opacity {
    /// Multiplied with the vertices' and the image's alpha.
    alpha: f64,
    /// Alpha below this is a hole; none in a blended material.
    mask: Option<f64>,
    image: Option<Alphas>,
}

/// Alpha of an image at its full size.
struct Alphas {
    size: [i64; 2],
    values: Vec<u8>,
    /// How it goes on beyond its edges.
    wrap: [AddressMode; 2],
    filter: FilterMode,
}

/// What alpha needs of the corners of a triangle: texture coordinates and alpha, each at all three.
pub(super) struct AlphaCorners([DVec3; 3]);

impl AlphaCorners {
    /// Those of a mesh's triangle.
    pub(super) fn of(mesh: &Mesh, corners: [u32; 3]) -> Self {
        let corners = corners.map(|corner| corner as usize);
        let along = |axis: usize| corners.map(|corner| f64::from(mesh.uvs[corner][axis]));
        let alphas = corners.map(|corner| mesh.alphas.get(corner).copied().unwrap_or(1.0).into());
        Self([along(0), along(1), alphas].map(DVec3::from_array))
    }
}

impl Opacity {
    /// The opacity of a material; `None` if it is opaque without holes.
    pub(super) fn of(material: &Material, images: &[Image]) -> Option<Self> {
        if material.mask.is_none() && !material.blend {
            return None;
        }
        let image = material.texture.and_then(|texture| images.get(texture));
        Some(Self {
            alpha: f64::from(material.base_colour[3]),
            mask: material.mask.map(f64::from),
            image: image.map(|image| Alphas {
                size: [image.width.into(), image.height.into()],
                values: image.rgba.iter().skip(3).step_by(4).copied().collect(),
                wrap: material.wrap,
                filter: material.filter,
            }),
        })
    }

    /// Whether there is a hole where a triangle's corners have these weights.
    pub(super) fn is_hole(&self, corners: &AlphaCorners, weights: DVec3) -> bool {
        self.mask
            .is_some_and(|mask| self.alpha_at(corners, weights) < mask)
    }

    /// How opaque a blended material is there; `None` for a masked one.
    pub(super) fn blended(&self, corners: &AlphaCorners, weights: DVec3) -> Option<f64> {
        let alpha = || self.alpha_at(corners, weights).clamp(0.0, 1.0);
        self.mask.is_none().then(alpha)
    }

    fn alpha_at(&self, corners: &AlphaCorners, weights: DVec3) -> f64 {
        let [u, v, alpha] = corners.0.map(|values| weights.dot(values));
        let image = self.image.as_ref();
        let of_image = image.map_or(1.0, |image| image.at(DVec2::new(u, v)));
        self.alpha * alpha * of_image
    }
}

impl Alphas {
    /// Alpha from 0 to 1 at `uv`.
    fn at(&self, uv: DVec2) -> f64 {
        let place = uv * DVec2::from_array(self.size.map(|side| side as f64));
        let texel = |at: DVec2| {
            let [x, y] =
                [0, 1].map(|axis| wrapped(at[axis] as i64, self.size[axis], self.wrap[axis]));
            let value = self.values.get((y * self.size[0] + x) as usize);
            f64::from(value.copied().unwrap_or(255)) / 255.0
        };
        if self.filter == FilterMode::Nearest {
            return texel(place.floor());
        }
        let base = (place - 0.5).floor();
        let weight = place - 0.5 - base;
        let row = |y: f64| {
            let [left, right] = [0.0, 1.0].map(|x| texel(base + DVec2::new(x, y)));
            left + weight.x * (right - left)
        };
        row(0.0) + weight.y * (row(1.0) - row(0.0))
    }
}

/// The texel of `size` ones in a row that stands for texel `at` beyond its ends.
fn wrapped(at: i64, size: i64, wrap: AddressMode) -> i64 {
    match wrap {
        AddressMode::Repeat => at.rem_euclid(size),
        AddressMode::MirrorRepeat => {
            let at = at.rem_euclid(2 * size);
            at.min(2 * size - 1 - at)
        }
        AddressMode::ClampToEdge | AddressMode::ClampToBorder => at.clamp(0, size - 1),
    }
}
