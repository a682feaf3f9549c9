//! The host side of the WGSL module `area_light`.

use bytemuck::{Pod, Zeroable};

use crate::{DepthError, DepthRange};

/// The largest radius in texels.
const LARGEST_SOFT_RADIUS: f64 = 4096.0;

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

/// The half widths in texels that search and filter keep to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoftRadii {
    /// At least 0; 0.5 and more softens the edges of texels near contacts.
    pub smallest: f64,
    /// At least `smallest`, above 0, at most 4096. n taps on a disk are 1.8 times the radius over sqrt(n) apart; for a
    /// summed-area table the radius is half of the largest kernel's side.
    pub largest: f64,
}

/// An area light whose parameters are out of range.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AreaLightError {
    /// A number is out of range.
    #[error("a light's soft shadows: {name} is {value}, but must be {range}")]
    Value {
        /// The number's name.
        name: &'static str,
        /// The value that was given.
        value: f64,
        /// The range that it has to be in.
        range: &'static str,
    },
    /// The range of moment depth is empty.
    #[error(transparent)]
    Range(#[from] DepthError),
    /// A size of another kind of light.
    #[error(
        "a light with parallel rays has an angular diameter as its size, one with a perspective map is a disk or a rectangle"
    )]
    Shape,
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
    /// 0.0093. `texel` is a texel's width and height in scene units, `range` that of the map's moment depth. A light without
    /// size has shadows as hard as `radii` allow.
    ///
    /// # Errors
    /// [`AreaLightError`], which names the number that is out of range.
    pub fn directional(
        angular_diameter: f64,
        texel: [f64; 2],
        range: DepthRange,
        radii: SoftRadii,
    ) -> Result<Self, AreaLightError> {
        check(
            "the angular diameter",
            angular_diameter,
            (0.0..std::f64::consts::PI).contains(&angular_diameter),
            "at least 0 and below pi radians",
        )?;
        let size = 2.0 * (0.5 * angular_diameter).tan();
        Self::new([size; 2], texel, range, radii)
    }

    /// A light with rays from a point: a disk of the given diameter in scene units, at least 0, facing along the light's
    /// axis. `texel` is a texel's width and height at distance 1 along it: 2 tan(full angle / 2) over the texels. `range` is
    /// that of the map's moment depth; it begins in front of the light.
    ///
    /// # Errors
    /// [`AreaLightError`], which names the number that is out of range.
    pub fn spot(
        diameter: f64,
        texel: [f64; 2],
        range: DepthRange,
        radii: SoftRadii,
    ) -> Result<Self, AreaLightError> {
        check_length("the diameter", diameter)?;
        check_near(range)?;
        Ok(Self {
            perspective: 1,
            ..Self::new([diameter; 2], texel, range, radii)?
        })
    }

    /// A light with rays from a point: a rectangle of the given width and height in scene units, each at least 0, along the
    /// map's x and y. `texel` and `range` are as in [`AreaLight::spot`].
    ///
    /// # Errors
    /// [`AreaLightError`], which names the number that is out of range.
    pub fn rectangle(
        size: [f64; 2],
        texel: [f64; 2],
        range: DepthRange,
        radii: SoftRadii,
    ) -> Result<Self, AreaLightError> {
        check_length("the width", size[0])?;
        check_length("the height", size[1])?;
        check_near(range)?;
        Ok(Self {
            perspective: 1,
            rectangular: 1,
            ..Self::new(size, texel, range, radii)?
        })
    }

    fn new(
        size: [f64; 2],
        texel: [f64; 2],
        range: DepthRange,
        radii: SoftRadii,
    ) -> Result<Self, AreaLightError> {
        range.check()?;
        for (name, length) in [
            ("a texel's width", texel[0]),
            ("a texel's height", texel[1]),
        ] {
            let valid = length > 0.0 && length.is_finite();
            check(name, length, valid, "above 0 and finite")?;
        }
        let SoftRadii { smallest, largest } = radii;
        check(
            "the smallest radius",
            smallest,
            smallest >= 0.0 && smallest <= largest,
            "at least 0 and at most the largest",
        )?;
        check(
            "the largest radius",
            largest,
            largest > 0.0 && largest <= LARGEST_SOFT_RADIUS,
            "above 0 and at most 4096 texels",
        )?;
        let texels = [size[0] / texel[0], size[1] / texel[1]];
        // Sizes beyond single precision come from units that do not fit together.
        for value in texels {
            let single = value as f32;
            check(
                "the light's size in texels",
                value,
                single.is_normal() || value == 0.0,
                "within single precision; choose another unit of length",
            )?;
        }
        for (name, value) in [
            ("the range's near end", range.near),
            ("the range's far end", range.far),
        ] {
            let single = value as f32;
            check(
                name,
                value,
                single.is_finite(),
                "within single precision; choose another unit of length",
            )?;
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

fn check(
    name: &'static str,
    value: f64,
    valid: bool,
    range: &'static str,
) -> Result<(), AreaLightError> {
    if valid {
        Ok(())
    } else {
        Err(AreaLightError::Value { name, value, range })
    }
}

fn check_length(name: &'static str, length: f64) -> Result<(), AreaLightError> {
    let valid = length >= 0.0 && length.is_finite();
    check(name, length, valid, "at least 0 and finite")
}

fn check_near(range: DepthRange) -> Result<(), AreaLightError> {
    check(
        "the distance of the range's near end",
        range.near,
        range.near > 0.0,
        "above 0, in front of the light",
    )
}
