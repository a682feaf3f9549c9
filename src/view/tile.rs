//! The square region of a map that a view of a light gets.

use crate::value_error::check;
use crate::{MapRegion, ValueError};

/// What places in f32 are at most off by, in texels: a shader looks up that much of the guard band, so that no pixel falls
/// between two faces.
pub(super) const PLACE_ERROR: f64 = 1.0 / 16.0;

/// The square region of a map that a view of a light gets, and the filter that reads it.
///
/// Along its edges lies a guard band as wide as the filter: it is drawn and filtered, and no place is looked up in it. Then a
/// filter never meets the region's edge, and where a neighbouring region goes on with the same scene there is no seam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tile {
    /// Texels along each side, the guard band included.
    pub texels: u32,
    /// How many texels filters reach to each side, one after the other: the radius of a blur, and the largest one of a lookup
    /// that filters by itself. With mip levels, texels of the coarsest one that is looked up count.
    pub filter_radius: f64,
}

impl Tile {
    /// The width of the guard band in whole texels: the filter's radius, and half a texel for a bilinear lookup.
    ///
    /// # Errors
    /// [`ValueError`]: `texels` of which there are none, a `filter_radius` that is none, a `guard` band wider than the region.
    pub fn guard(&self) -> Result<u32, ValueError> {
        let Self {
            texels,
            filter_radius,
        } = *self;
        check(texels > 0, "a region", "texels", texels, "above 0")?;
        let valid = filter_radius.is_finite() && filter_radius >= 0.0;
        let range = "at least 0 and finite";
        check(valid, "a region", "filter_radius", filter_radius, range)?;
        let guard = (filter_radius + 0.5 + PLACE_ERROR).ceil();
        if 2.0 * guard < f64::from(texels) {
            return Ok(guard as u32);
        }
        let message = format!(
            "a region of {texels} texels has no room between guard bands of {guard} texels, which a filter of radius \
             {filter_radius} needs; give it more than {} texels",
            2.0 * guard
        );
        Err(ValueError::new("guard", message))
    }

    /// The region before it has a place.
    pub(super) fn region(&self) -> MapRegion {
        MapRegion::new([0; 2], [self.texels; 2])
    }
}
