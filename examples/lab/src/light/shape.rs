//! How large a light is around the point or direction that its map is drawn from.

use super::{LightKind, LightView};
use crate::error::LabError;

/// The angle under which a light is seen where nothing else is said, in radians: six times the sun's, so that penumbrae
/// are some texels wide.
pub const USUAL_LIGHT_ANGLE: f64 = 0.055;

/// The shape of an area light. It faces along the light's axis, its centre is where the light's map is drawn from, and all
/// of it shines alike. A size of 0 is the point or direction itself: hard shadows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightShape {
    /// A directional light. Its directions end on a disk across the light's axis, evenly; the disk is seen under
    /// `angular_diameter` radians, at least 0 and below pi.
    Directional {
        /// In radians.
        angular_diameter: f64,
    },
    /// A disk around the position of a spot light, across its axis.
    Disk {
        /// In scene units.
        diameter: f64,
    },
    /// A rectangle around the position of a spot light, across its axis.
    Rectangle {
        /// Along the x and y axes of the light's map, in scene units.
        size: [f64; 2],
    },
}

impl LightShape {
    /// The shape that a light has where nothing else is said: round, and seen under [`USUAL_LIGHT_ANGLE`], from the middle
    /// of its range if it has a position.
    #[must_use]
    pub fn usual(light: &LightView) -> Self {
        match light.kind() {
            LightKind::Directional => Self::Directional {
                angular_diameter: USUAL_LIGHT_ANGLE,
            },
            LightKind::Spot => Self::Disk {
                diameter: USUAL_LIGHT_ANGLE * 0.5 * (light.range[0] + light.range[1]),
            },
        }
    }

    /// No size: hard shadows.
    #[must_use]
    pub fn point(kind: LightKind) -> Self {
        match kind {
            LightKind::Directional => Self::Directional {
                angular_diameter: 0.0,
            },
            LightKind::Spot => Self::Disk { diameter: 0.0 },
        }
    }

    /// Refuses sizes that are negative or no numbers, and a shape that a light of this kind cannot have.
    pub fn check(self, kind: LightKind) -> Result<(), LabError> {
        let fits = (kind == LightKind::Directional) == matches!(self, Self::Directional { .. });
        if !fits {
            let light = match kind {
                LightKind::Directional => "a directional light",
                LightKind::Spot => "a spot light",
            };
            return Err(LabError::refused(format!(
                "{light} cannot have the shape '{}'; a directional light has an angular diameter, a spot light is a disk or a \
                 rectangle",
                self.name()
            )));
        }
        match self {
            Self::Directional { angular_diameter } => check_size(
                "angular diameter",
                angular_diameter,
                std::f64::consts::PI,
                "at least 0 and below pi radians",
            ),
            Self::Disk { diameter } => check_length("diameter", diameter),
            Self::Rectangle {
                size: [width, height],
            } => {
                check_length("width", width)?;
                check_length("height", height)
            }
        }
    }

    /// `directional`, `disk` or `rectangle`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Directional { .. } => "directional",
            Self::Disk { .. } => "disk",
            Self::Rectangle { .. } => "rectangle",
        }
    }

    /// Whether the light is a disk, and no rectangle.
    #[must_use]
    pub fn is_round(self) -> bool {
        !matches!(self, Self::Rectangle { .. })
    }

    /// Width and height along the axes of the light's map: in scene units, and at distance 1 for a directional light.
    #[must_use]
    pub fn extent(self) -> [f64; 2] {
        match self {
            Self::Directional { angular_diameter } => [2.0 * (0.5 * angular_diameter).tan(); 2],
            Self::Disk { diameter } => [diameter; 2],
            Self::Rectangle { size } => size,
        }
    }

    /// Whether it is a point or a direction: shadows are hard.
    #[must_use]
    pub fn is_point(self) -> bool {
        self.extent() == [0.0; 2]
    }
}

fn check_length(what: &'static str, value: f64) -> Result<(), LabError> {
    check_size(what, value, f64::INFINITY, "at least 0 and finite")
}

fn check_size(
    what: &'static str,
    value: f64,
    end: f64,
    range: &'static str,
) -> Result<(), LabError> {
    if value >= 0.0 && value < end {
        Ok(())
    } else {
        Err(wrong_size(what, value, range))
    }
}

/// The error of a size that no light has.
pub(crate) fn wrong_size(what: &str, value: f64, range: &str) -> LabError {
    LabError::refused(format!(
        "the light's {what} is {value}, but must be {range}; 0 gives hard shadows"
    ))
}
