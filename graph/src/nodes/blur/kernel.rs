//! A filter kernel as a node's property.

use moment_shadows::{Kernel, ValueError};
use serde::{Deserialize, Deserializer};

/// 9 x 9 texels with sigma 2.4, as in the moment shadow mapping papers (Peters & Klein, i3D 2015, section 4).
const SIGMA_PER_RADIUS: f32 = 0.6;

/// A Gaussian (`radius` and `sigma`) or given `weights`. What makes no kernel is for the node to refuse.
pub(super) fn read<'de, D: Deserializer<'de>>(
    file: D,
) -> Result<Result<Kernel, ValueError>, D::Error> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Written {
        radius: Option<u32>,
        sigma: Option<f32>,
        weights: Option<Vec<f32>>,
    }
    let written = Written::deserialize(file)?;
    Ok(match (written.radius, written.sigma, written.weights) {
        (Some(radius), sigma, None) => {
            Kernel::gaussian(radius, sigma.unwrap_or(radius as f32 * SIGMA_PER_RADIUS))
        }
        (None, None, Some(weights)) => Kernel::from_weights(&weights),
        _ => Err(ValueError::new(
            "kernel",
            "a kernel is either a 'radius' (with a 'sigma') or 'weights'; give one of them",
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
            "weights": {
                "description": "Weights of any symmetric or other kernel, from end to end, in place of a Gaussian.",
                "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 2 * largest + 1,
            },
        },
        "oneOf": [{ "required": ["radius"] }, { "required": ["weights"] }],
        "additionalProperties": false,
    })
}
