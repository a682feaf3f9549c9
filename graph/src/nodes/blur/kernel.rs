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
