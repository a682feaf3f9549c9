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

/// How large a light is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LightSize {
    /// Without size: all shadows are as hard as the filter allows.
    #[default]
    Point,
    /// A light with parallel rays that appears as a disk of this many radians, at least 0 and below pi; the sun's is 0.0093.
    AngularDiameter(f64),
    /// A disk of this diameter in scene units, at least 0, facing along the axis of a light with a perspective map.
    Disk(f64),
    /// A rectangle of this width and height in scene units, each at least 0, along x and y of a perspective map.
    Rectangle([f64; 2]),
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

    /// The light of some size over a map. `texel` is a texel's width and height in scene units: for rays from a point at
    /// distance 1 along the light's axis, which is 2 tan(full angle / 2) over the texels. `range` is that of the map's moment
    /// depth; for rays from a point it begins in front of the light.
    ///
    /// Search and filter keep to `radii`, half widths in texels. The smallest is at least 0; 0.5 and more softens the edges of
    /// texels near contacts, and those of a light whose size is 0. The largest is above 0, at most 4096: n taps on a disk are
    /// 1.8 times as much over sqrt(n) apart; for a summed-area table it is half of the largest kernel's side.
    ///
    /// # Errors
    /// [`ValueError`], which names the number that is out of range.
    pub fn new(
        size: LightSize,
        texel: [f64; 2],
        range: DepthRange,
        radii: RangeInclusive<f64>,
    ) -> Result<Self, ValueError> {
        let width = match size {
            LightSize::Point => return Ok(Self::NONE),
            LightSize::AngularDiameter(angle) => {
                let valid = (0.0..std::f64::consts::PI).contains(&angle);
                let legal = "at least 0 and below pi radians";
                check(valid, OF, "the angular diameter", angle, legal)?;
                [2.0 * (0.5 * angle).tan(); 2]
            }
            LightSize::Disk(diameter) => {
                check_length("the diameter", diameter)?;
                [diameter; 2]
            }
            LightSize::Rectangle([width, height]) => {
                check_length("the width", width)?;
                check_length("the height", height)?;
                [width, height]
            }
        };
        let parallel = matches!(size, LightSize::AngularDiameter(_));
        let valid = parallel || range.near > 0.0;
        let name = "the distance of the range's near end";
        let legal = "above 0, in front of the light";
        check(valid, OF, name, range.near, legal)?;
        range.check()?;
        let (smallest, largest) = radii.into_inner();
        let valid = smallest >= 0.0 && smallest <= largest;
        let legal = "at least 0 and at most the largest";
        check(valid, OF, "the smallest radius", smallest, legal)?;
        let valid = largest > 0.0 && largest <= f64::from(AREA_LIGHT_LARGEST_RADIUS);
        let legal = "above 0 and at most 4096 texels";
        check(valid, OF, "the largest radius", largest, legal)?;
        let texels = [width[0] / texel[0], width[1] / texel[1]];
        // Sizes beyond single precision come from units that do not fit together.
        let single = "within single precision; choose another unit of length";
        let above_zero = "above 0 and finite";
        let length = |value: f64| (value > 0.0 && value.is_finite(), value, above_zero);
        let size_in_texels =
            |value: f64| ((value as f32).is_normal() || value == 0.0, value, single);
        let end = |value: f64| ((value as f32).is_finite(), value, single);
        for (name, (valid, value, legal)) in [
            ("a texel's width", length(texel[0])),
            ("a texel's height", length(texel[1])),
            ("the light's size in texels", size_in_texels(texels[0])),
            ("the light's size in texels", size_in_texels(texels[1])),
            ("the range's near end", end(range.near)),
            ("the range's far end", end(range.far)),
        ] {
            check(valid, OF, name, value, legal)?;
        }
        Ok(Self {
            size: texels.map(|value| value as f32),
            near: range.near as f32,
            far: range.far as f32,
            perspective: u32::from(!parallel),
            smallest_radius: smallest as f32,
            largest_radius: largest as f32,
            rectangular: u32::from(matches!(size, LightSize::Rectangle(_))),
        })
    }
}

fn check_length(name: &'static str, length: f64) -> Result<(), ValueError> {
    let valid = length >= 0.0 && length.is_finite();
    check(valid, OF, name, length, "at least 0 and finite")
}
