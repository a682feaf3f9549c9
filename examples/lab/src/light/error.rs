//! What can be wrong with a light.

/// Why no light could be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LightError {
    /// The direction is zero or not finite.
    #[error(
        "the light's direction {direction:?} cannot be normalised; give a finite, non-zero direction"
    )]
    Direction {
        /// The direction that was given.
        direction: [f64; 3],
    },
    /// The position of a spot light is not finite.
    #[error("the light's position {position:?} is not finite")]
    Position {
        /// The position that was given.
        position: [f64; 3],
    },
    /// There is nothing to fit a directional light to.
    #[error("a directional light cannot be fitted: there are no casters; give at least one point")]
    NoCasters,
    /// A caster cannot be placed in the light's view.
    #[error(
        "a directional light cannot be fitted: caster point {index} is {point:?}, which is not finite"
    )]
    Caster {
        /// Which of the points it is.
        index: usize,
        /// The point.
        point: [f64; 3],
    },
    /// The map is too small for its margin.
    #[error(
        "a map of {}x{} texels has no room for a margin of {margin} texels on each side; choose a larger map or a smaller margin",
        map[0], map[1]
    )]
    Margin {
        /// The map's size in texels.
        map: [u32; 2],
        /// The margin in texels.
        margin: f64,
    },
    /// The opening angle of a spot light cannot be projected.
    #[error(
        "the spot light's full angle of {angle} radians must lie between 0 and pi, both excluded"
    )]
    Angle {
        /// The angle that was given, in radians.
        angle: f64,
    },
    /// Near and far, or the range of moment depth, are not in order.
    #[error(
        "the light's {what} reaches from {near} to {far}; it must be finite, start above zero and end beyond its start"
    )]
    Interval {
        /// `depth planes` or `moment range`.
        what: &'static str,
        /// Its start, a distance along the axis.
        near: f64,
        /// Its end, a distance along the axis.
        far: f64,
    },
    /// An area light has no such size.
    #[error("the light's {what} is {value}, but must be {range}; 0 gives hard shadows")]
    Size {
        /// `angular diameter`, `diameter`, `width` or `height`.
        what: &'static str,
        /// What was given, in radians or scene units.
        value: f64,
        /// The range that it may be in.
        range: &'static str,
    },
    /// A directional light has directions, and a spot light has places.
    #[error(
        "{light} cannot have the shape '{shape}'; a directional light has an angular diameter, a spot light is a disk or a rectangle"
    )]
    Shape {
        /// The shape's name.
        shape: &'static str,
        /// The light that the shape was given to.
        light: &'static str,
    },
}
