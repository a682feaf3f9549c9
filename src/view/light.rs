//! A view of a light, and how its map stores depth.

use core::ops::RangeInclusive;

use glam::{DMat4, DVec3, DVec4};
use serde::{Deserialize, Serialize};

use super::Border;
use super::border::WIDEST;
use crate::value_error::check;
use crate::{AreaLight, DepthConversion, DepthRange, LightSize, MapRegion, ValueError};

/// A view of a light: what one region of its map was drawn with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightView {
    /// From scene to clip space, by columns, as the map was drawn with.
    pub clip_from_world: [[f64; 4]; 4],
    /// How the map stores depth.
    pub depth: LightDepth,
    /// The layer of the map of moments.
    pub layer: u32,
    /// The region of that layer that the matrix's clip space covers; [`MapRegion::WHOLE`] where it has the layer to itself.
    pub region: MapRegion,
    /// Texels along the region's edges that are drawn and filtered, but where nodes that shade look up no place: such pixels
    /// belong to other views. 0 where the region goes on nowhere else. [`crate::Tile::guard`] follows from a filter.
    pub guard: u32,
    /// What becomes of shadows along the border of what the view shows.
    pub border: Border,
    /// The light's channel in the node's outputs, 0 to 15: four in each.
    pub channel: u32,
    /// How large the light is; for soft shadows.
    pub size: LightSize,
}

impl LightView {
    /// A view of a sun or another light with parallel rays, which has the first layer of its map to itself and stores 0 at
    /// the near plane.
    #[must_use]
    pub fn orthographic(clip_from_world: [[f64; 4]; 4]) -> Self {
        Self {
            clip_from_world,
            depth: LightDepth::Orthographic { reversed: false },
            layer: 0,
            region: MapRegion::WHOLE,
            guard: 0,
            border: Border::Sharp,
            channel: 0,
            size: LightSize::Point,
        }
    }

    /// A view of a spot or a face of a point light, which has the first layer of its map to itself. Depth is stored as by a
    /// projection with planes at `near` and `far` (which may be infinite), 0 at the near plane; moment depth covers `range`.
    #[must_use]
    pub fn perspective(
        clip_from_world: [[f64; 4]; 4],
        near: f64,
        far: f64,
        range: DepthRange,
    ) -> Self {
        Self {
            depth: LightDepth::Perspective {
                near,
                far,
                reversed: false,
                range,
            },
            ..Self::orthographic(clip_from_world)
        }
    }

    /// Width and height of a texel in scene units, where the region has `extent` texels: with a perspective map, at distance 1
    /// along the light's axis.
    #[must_use]
    pub fn texel_size(&self, extent: [u32; 2]) -> [f64; 2] {
        let clip = DMat4::from_cols_array_2d(&self.clip_from_world);
        let length = |row: usize| clip.row(row).truncate().length();
        let divisor = match self.depth {
            LightDepth::Orthographic { .. } => clip.row(3).w.abs(),
            LightDepth::Perspective { .. } | LightDepth::Linear { .. } => length(3),
        };
        [0, 1].map(|axis| 2.0 * divisor / (length(axis) * f64::from(extent[axis])))
    }

    /// Distances along the light's axis of the moment depths -1 and 1; for a light with parallel rays from its near plane on.
    #[must_use]
    pub fn range(&self) -> DepthRange {
        match self.depth {
            LightDepth::Perspective { range, .. } | LightDepth::Linear { range } => range,
            LightDepth::Orthographic { .. } => {
                let clip = DMat4::from_cols_array_2d(&self.clip_from_world);
                let per_unit = self.depth.row(clip).truncate().length() / clip.row(3).w.abs();
                DepthRange {
                    near: 0.0,
                    far: 2.0 / per_unit,
                }
            }
        }
    }

    /// The moment depth that a texel's width corresponds to along the light's axis, as [`crate::ReceiverBias::for_kernel`]
    /// takes it, where the region has `extent` texels: with a perspective map at the far end of the range.
    #[must_use]
    pub fn depth_per_texel(&self, extent: [u32; 2]) -> f64 {
        let [width, height] = self.texel_size(extent);
        let DepthRange { near, far } = self.range();
        let spread = match self.depth {
            LightDepth::Orthographic { .. } => 1.0,
            LightDepth::Perspective { .. } | LightDepth::Linear { .. } => far,
        };
        2.0 * width.max(height) * spread / (far - near)
    }

    /// Checks that a region of `extent` texels has some within its guard band, and room for its border.
    ///
    /// # Errors
    /// [`ValueError`] about the `guard` band or the `border`.
    pub fn check_border(&self, extent: [u32; 2]) -> Result<(), ValueError> {
        let [width, height] = extent;
        let room = f64::from(width.min(height)) - 2.0 * f64::from(self.guard);
        if room > 0.0 || self.guard == 0 {
            let wide = self.border.width();
            let range = "from 0 texels to half of those between the guard bands, and at most 4095";
            let valid = (0.0..=WIDEST.min(0.5 * room)).contains(&wide);
            return check(valid, "a view", "border", wide, range);
        }
        let message = format!(
            "a region of {width}x{height} texels has no room between guard bands of {} texels; give it more texels, or a filter \
             that reaches less far",
            self.guard
        );
        Err(ValueError::new("guard", message))
    }

    /// Checks that the kind of size suits the kind of rays.
    pub(super) fn check_size(&self) -> Result<(), ValueError> {
        let parallel = matches!(self.depth, LightDepth::Orthographic { .. });
        let suits = match self.size {
            LightSize::Point => true,
            LightSize::AngularDiameter(_) => parallel,
            LightSize::Disk(_) | LightSize::Rectangle(_) => !parallel,
        };
        if !suits {
            let message = "a light with parallel rays has an angular diameter as its size, one with a perspective map is a disk or \
                           a rectangle";
            return Err(ValueError::new("size", message));
        }
        Ok(())
    }

    /// The light with its size over a map whose region has `extent` texels, as `shade_soft` and percentage-closer soft
    /// shadows take it.
    ///
    /// # Errors
    /// [`ValueError`], where the size does not suit the map, or a number is out of range.
    pub fn area_light(
        &self,
        extent: [u32; 2],
        radii: RangeInclusive<f64>,
    ) -> Result<AreaLight, ValueError> {
        self.check_size()?;
        AreaLight::new(self.size, self.texel_size(extent), self.range(), radii)
    }
}

/// How a light's depth map stores depth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LightDepth {
    /// Linear from the near plane (moment depth -1) to the far plane (moment depth 1).
    Orthographic {
        /// Whether 1 is stored at the near plane.
        reversed: bool,
    },
    /// Hyperbolic; clip space w is the distance along the light's axis.
    Perspective {
        /// Distance of the near plane, above 0.
        near: f64,
        /// Distance of the far plane; may be infinite.
        far: f64,
        /// Whether 1 is stored at the near plane.
        reversed: bool,
        /// The distances that map to the moment depths -1 and 1.
        range: DepthRange,
    },
    /// The distance along the light's axis in scene units, clip space w, as an r32float map of a perspective light holds it.
    Linear {
        /// The distances that map to the moment depths -1 and 1.
        range: DepthRange,
    },
}

impl LightDepth {
    /// The conversion that `resolve` applies to the map.
    pub fn conversion(&self) -> Result<DepthConversion, ValueError> {
        let (forward, reversed) = match *self {
            LightDepth::Orthographic { reversed } => (DepthConversion::orthographic(), reversed),
            LightDepth::Perspective {
                near,
                far,
                reversed,
                range,
            } => (DepthConversion::perspective(near, far, range)?, reversed),
            LightDepth::Linear { range } => (DepthConversion::linear(range)?, false),
        };
        Ok(if reversed {
            forward.reversed()
        } else {
            forward
        })
    }

    /// Checks that depth is stored as maps with such a matrix store it.
    pub(super) fn check_matrix(&self, clip_from_world: DMat4) -> Result<(), ValueError> {
        let stored_parallel = matches!(self, LightDepth::Orthographic { .. });
        let parallel = clip_from_world.row(3).truncate() == DVec3::ZERO;
        if parallel == stored_parallel {
            return Ok(());
        }
        let message = "the light's matrix and its depth do not agree: a matrix with parallel rays goes with orthographic depth, one \
                       with perspective with the other kinds";
        Err(ValueError::new("depth", message))
    }

    /// The linear function of a scene position (x, y, z, 1) that gives its moment depth, for the map's matrix.
    ///
    /// Moment depth is linear in the scene whatever the map stores, so a fragment's needs no stored depth.
    #[must_use]
    pub fn moment_depth_row(&self, clip_from_world: &[[f64; 4]; 4]) -> [f32; 4] {
        self.row(DMat4::from_cols_array_2d(clip_from_world))
            .as_vec4()
            .to_array()
    }

    /// [`moment_depth_row`](Self::moment_depth_row) in f64.
    pub(super) fn row(&self, clip_from_world: DMat4) -> DVec4 {
        let (axis, factor, summand) = match *self {
            LightDepth::Orthographic { reversed } => {
                let sign = if reversed { -1.0 } else { 1.0 };
                (clip_from_world.row(2), 2.0 * sign, -sign)
            }
            LightDepth::Perspective { range, .. } | LightDepth::Linear { range } => {
                let extent = range.far - range.near;
                (
                    clip_from_world.row(3),
                    2.0 / extent,
                    -(range.near + range.far) / extent,
                )
            }
        };
        axis * factor + summand * DVec4::W
    }
}
