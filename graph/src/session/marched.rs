//! What nodes that march scattered light are told of a light.

use moment_shadows::MarchScatteringParameters;

use super::scratch::Told;
use super::unsuitable;
use crate::{GraphError, PlannedParameters};

/// The structs of a node: the views of the first light, which are those with its channel.
pub(super) fn write(
    structs: &mut Vec<MarchScatteringParameters>,
    told: &Told<'_>,
    block: &PlannedParameters,
) -> Result<(), GraphError> {
    structs.clear();
    let channel = told.lights.first().map(|light| light.channel);
    let what = || format!("node '{}'", block.node);
    let channel = channel.ok_or_else(|| unsuitable(what(), "there is no light; give one"))?;
    let (medium, far) = told.medium;
    let lights = told.lights.iter().enumerate();
    for (index, light) in lights.filter(|(_, light)| light.channel == channel) {
        let made = MarchScatteringParameters::new(
            told.camera,
            far,
            light,
            medium,
            &told.marched,
            told.leak_reduction,
        );
        let of_view = |error| unsuitable(format!("view {index} of a light, for {}", what()), error);
        structs.push(made.map_err(of_view)?);
    }
    if structs.len() > block.elements as usize {
        let reason = format!(
            "the light has {} views, but the node's 'views' is {}; give it as many",
            structs.len(),
            block.elements
        );
        return Err(unsuitable(what(), reason));
    }
    Ok(())
}
