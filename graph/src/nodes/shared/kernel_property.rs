//! A filter kernel as a node's property.

use moment_shadows::{Kernel, ValueError};
use serde::{Deserialize, Serialize};

use crate::{GraphError, GraphErrorKind};

/// A Gaussian (`radius` and `sigma`) or given weights (`weights`).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KernelProperty {
    /// Texels on either side of the centre, 1 to 64.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<u32>,
    /// The Gaussian's standard deviation in texels; 0.6 of the radius where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sigma: Option<f32>,
    /// Weights of an odd number of texels, not negative; they are normalised.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weights: Option<Vec<f32>>,
}

/// 9 x 9 texels with sigma 2.4, as in the moment shadow mapping papers (Peters & Klein, i3D 2015, section 4).
const SIGMA_PER_RADIUS: f32 = 0.6;

impl KernelProperty {
    /// A Gaussian.
    #[must_use]
    pub fn gaussian(radius: u32, sigma: f32) -> Self {
        Self {
            radius: Some(radius),
            sigma: Some(sigma),
            weights: None,
        }
    }

    /// The kernel that the property stands for.
    pub fn kernel(&self) -> Result<Kernel, GraphError> {
        let built = match (&self.weights, self.radius) {
            (Some(weights), None) if self.sigma.is_none() => Kernel::from_weights(weights),
            (None, Some(radius)) => Kernel::gaussian(
                radius,
                self.sigma.unwrap_or(radius as f32 * SIGMA_PER_RADIUS),
            ),
            _ => {
                return Err(property(
                    "a kernel is either a 'radius' (with a 'sigma') or 'weights'; give one of them",
                ));
            }
        };
        built.map_err(|error: ValueError| property(error.to_string()))
    }
}

fn property(message: impl Into<String>) -> GraphError {
    GraphError::new(GraphErrorKind::Property, message)
}
