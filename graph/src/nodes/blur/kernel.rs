//! A filter kernel as a node's property.

use moment_shadows::{Finite, Kernel, ValueError};
use serde::{Deserialize, Deserializer};

/// 9 x 9 texels with sigma 2.4, as in the moment shadow mapping papers (Peters & Klein, i3D 2015, section 4).
const SIGMA_PER_RADIUS: f32 = 0.6;

/// What a map is filtered by.
#[derive(Clone, Debug, PartialEq)]
pub enum BlurKernel {
    /// A kernel in texels, the same for all regions.
    Texels(Kernel),
    /// A width in scene units: each region has a kernel of its own, as wide in the scene as those of the others whatever the size
    /// of its texels ([`Kernel::of_width`]), along either axis.
    Scene {
        /// The standard deviation in scene units; with a perspective map at distance 1 along the light's axis, so that it grows with
        /// distance.
        width: Finite,
        /// The largest radius of a kernel, in texels.
        radius: u32,
    },
}

impl From<Kernel> for BlurKernel {
    fn from(kernel: Kernel) -> Self {
        BlurKernel::Texels(kernel)
    }
}

/// A Gaussian (`radius` and `sigma`), a `width` in scene units with the largest `radius`, or given `weights`. What makes no kernel is
/// for the node to refuse.
pub(super) fn read<'de, D: Deserializer<'de>>(
    file: D,
) -> Result<Result<BlurKernel, ValueError>, D::Error> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Written {
        radius: Option<u32>,
        sigma: Option<f32>,
        width: Option<f32>,
        weights: Option<Vec<f32>>,
    }
    let written = Written::deserialize(file)?;
    let Written {
        radius,
        sigma,
        width,
        weights,
    } = written;
    Ok(match (radius, sigma, width, weights) {
        (Some(radius), sigma, None, None) => {
            Kernel::gaussian(radius, sigma.unwrap_or(radius as f32 * SIGMA_PER_RADIUS))
                .map(BlurKernel::Texels)
        }
        (Some(radius), None, Some(width), None) => {
            Finite::new(width).map(|width| BlurKernel::Scene { width, radius })
        }
        (None, None, None, Some(weights)) => Kernel::from_weights(&weights).map(BlurKernel::Texels),
        _ => Err(ValueError::new(
            "kernel",
            "a kernel is either a 'radius' (with a 'sigma' or a 'width') or 'weights'; give one of them",
        )),
    })
}

#[cfg(feature = "schema")]
pub(super) fn schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let largest = Kernel::LARGEST_RADIUS;
    schemars::json_schema!({
        "type": "object",
        "properties": {
            "radius": {
                "description": "Texels on either side of the centre.",
                "type": "integer", "minimum": 1, "maximum": largest,
            },
            "sigma": {
                "description": "The standard deviation of the Gaussian in texels; 0.6 of the radius where it is left out.",
                "type": "number", "exclusiveMinimum": 0,
            },
            "width": {
                "description": "The standard deviation in scene units, in place of 'sigma'; with a perspective map at distance 1. Each \
                                region then has a kernel of its own, of at most that radius, which whoever records the plan writes.",
                "type": "number", "exclusiveMinimum": 0,
            },
            "weights": {
                "description": "Weights of any symmetric or other kernel, from end to end, in place of a Gaussian.",
                "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 2 * largest + 1,
            },
        },
        "oneOf": [
            { "required": ["radius"], "not": { "required": ["sigma", "width"] } },
            { "required": ["weights"], "not": { "anyOf": [{ "required": ["sigma"] }, { "required": ["width"] }] } },
        ],
        "additionalProperties": false,
    })
}
