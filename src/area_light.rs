//! The host side of the WGSL module `area_light`.

use core::ops::RangeInclusive;

use bytemuck::{Pod, Zeroable};

use crate::constants::AREA_LIGHT_LARGEST_RADIUS;
use crate::value_error::check;
use crate::{DepthRange, ValueError};

const OF: &str = "a light's soft shadows";

/// A light of some size over its map: the uniform struct of the WGSL module `area_light`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct AreaLight {
    /// Width and height of the light on the map in texels: for parallel rays per scene unit between blocker and receiver,
    /// for rays from a point per 1 / scene unit between their inverse distances.
    pub size: [f32; 2],
    /// Distance from the light of moment depth -1, in scene units.
    pub near: f32,
    /// Distance from the light of moment depth 1, in scene units.
    pub far: f32,
    /// 0 for parallel rays, 1 for rays from a point.
    pub perspective: u32,
    /// Smallest half width of search and filter in texels.
    pub smallest_radius: f32,
    /// Largest half width of search and filter in texels.
    pub largest_radius: f32,
    /// 0 for a light that is a disk, 1 for a rectangle along the map's axes.
    pub rectangular: u32,
}

impl AreaLight {
    /// A light without size: shadows without penumbrae.
    pub const NONE: AreaLight = AreaLight {
        size: [0.0; 2],
        near: 0.0,
        far: 1.0,
        perspective: 0,
        smallest_radius: 0.0,
        largest_radius: 0.0,
        rectangular: 0,
    };

    /// A light with parallel rays that appears as a disk of `angular_diameter` radians, at least 0 and below pi; the sun's is
    /// 0.0093. `texel` is a texel's width and height in scene units, `range` that of the map's moment depth.
    ///
    /// Search and filter keep to `radii`, half widths in texels. The smallest is at least 0; 0.5 and more softens the edges of
    /// texels near contacts, and those of a light without size. The largest is above 0, at most 4096: n taps on a disk are 1.8
    /// times as much over sqrt(n) apart; for a summed-area table it is half of the largest kernel's side.
    ///
    /// # Errors
    /// [`ValueError`], which names the number that is out of range.
    pub fn directional(
        angular_diameter: f64,
        texel: [f64; 2],
        range: DepthRange,
        radii: RangeInclusive<f64>,
    ) -> Result<Self, ValueError> {
        check(
            (0.0..std::f64::consts::PI).contains(&angular_diameter),
            OF,
            "the angular diameter",
            angular_diameter,
            "at least 0 and below pi radians",
        )?;
        let size = 2.0 * (0.5 * angular_diameter).tan();
        Self::new([size; 2], texel, range, radii)
    }

    /// A light with rays from a point: a disk of the given diameter in scene units, at least 0, facing along the light's
    /// axis. `texel` is a texel's width and height at distance 1 along it: 2 tan(full angle / 2) over the texels. `range` is
    /// that of the map's moment depth; it begins in front of the light. `radii` are as in [`AreaLight::directional`].
    ///
    /// # Errors
    /// [`ValueError`], which names the number that is out of range.
    pub fn spot(
        diameter: f64,
        texel: [f64; 2],
        range: DepthRange,
        radii: RangeInclusive<f64>,
    ) -> Result<Self, ValueError> {
        check_length("the diameter", diameter)?;
        Self::from_point([diameter; 2], texel, range, radii)
    }

    /// A light with rays from a point: a rectangle of the given width and height in scene units, each at least 0, along the
    /// map's x and y. `texel`, `range` and `radii` are as in [`AreaLight::spot`].
    ///
    /// # Errors
    /// [`ValueError`], which names the number that is out of range.
    pub fn rectangle(
        size: [f64; 2],
        texel: [f64; 2],
        range: DepthRange,
        radii: RangeInclusive<f64>,
    ) -> Result<Self, ValueError> {
        check_length("the width", size[0])?;
        check_length("the height", size[1])?;
        Ok(Self {
            rectangular: 1,
            ..Self::from_point(size, texel, range, radii)?
        })
    }

    fn from_point(
        size: [f64; 2],
        texel: [f64; 2],
        range: DepthRange,
        radii: RangeInclusive<f64>,
    ) -> Result<Self, ValueError> {
        let name = "the distance of the range's near end";
        let legal = "above 0, in front of the light";
        check(range.near > 0.0, OF, name, range.near, legal)?;
        Ok(Self {
            perspective: 1,
            ..Self::new(size, texel, range, radii)?
        })
    }

    fn new(
        size: [f64; 2],
        texel: [f64; 2],
        range: DepthRange,
        radii: RangeInclusive<f64>,
    ) -> Result<Self, ValueError> {
        range.check()?;
        let (smallest, largest) = radii.into_inner();
        let most = f64::from(AREA_LIGHT_LARGEST_RADIUS);
        let texels = [size[0] / texel[0], size[1] / texel[1]];
        let is_length = |length: f64| length > 0.0 && length.is_finite();
        let is_size = |value: f64| (value as f32).is_normal() || value == 0.0;
        let is_single = |value: f64| (value as f32).is_finite();
        let above_zero = "above 0 and finite";
        // Sizes beyond single precision come from units that do not fit together.
        let single = "within single precision; choose another unit of length";
        for (valid, name, value, legal) in [
            (is_length(texel[0]), "a texel's width", texel[0], above_zero),
            (
                is_length(texel[1]),
                "a texel's height",
                texel[1],
                above_zero,
            ),
            (
                smallest >= 0.0 && smallest <= largest,
                "the smallest radius",
                smallest,
                "at least 0 and at most the largest",
            ),
            (
                largest > 0.0 && largest <= most,
                "the largest radius",
                largest,
                "above 0 and at most 4096 texels",
            ),
            (
                is_size(texels[0]),
                "the light's size in texels",
                texels[0],
                single,
            ),
            (
                is_size(texels[1]),
                "the light's size in texels",
                texels[1],
                single,
            ),
            (
                is_single(range.near),
                "the range's near end",
                range.near,
                single,
            ),
            (
                is_single(range.far),
                "the range's far end",
                range.far,
                single,
            ),
        ] {
            check(valid, OF, name, value, legal)?;
        }
        Ok(Self {
            size: texels.map(|value| value as f32),
            near: range.near as f32,
            far: range.far as f32,
            perspective: 0,
            smallest_radius: smallest as f32,
            largest_radius: largest as f32,
            rectangular: 0,
        })
    }
}

fn check_length(name: &'static str, length: f64) -> Result<(), ValueError> {
    let valid = length >= 0.0 && length.is_finite();
    check(valid, OF, name, length, "at least 0 and finite")
}
