//! What a pass may do with the resources that it touches.

use super::touch::touched;
use super::{Described, declaration};
use crate::{
    Capabilities, Direction, GraphError, GraphErrorKind, PlannedPass, PlannedResource, PlannedWork,
    TextureDesc,
};

/// Checks the uses of a pass against each other and its targets against the device.
pub(super) fn check_pass(
    pass: &PlannedPass,
    resources: &[PlannedResource],
    capabilities: &Capabilities,
) -> Result<(), GraphError> {
    let touches = touched(pass);
    for (index, touch) in touches.iter().enumerate() {
        let mut again = touches[..index]
            .iter()
            .filter(|earlier| earlier.meets(touch));
        if again.any(|earlier| earlier.access.writes() || touch.access.writes()) {
            return Err(declaration(format!(
                "pass '{}' writes '{}' while it uses it in another way; a device allows one use at a time, so go through \
                 an internal slot",
                pass.label, resources[touch.resource].name
            )));
        }
    }
    let texture = |index: usize| resources.get(index)?.desc.texture();
    match &pass.work {
        PlannedWork::Compute { .. } => Ok(()),
        PlannedWork::Fullscreen { target, .. } => texture(*target).map_or(Ok(()), |target| {
            colour_target(pass, target, false, capabilities)
        }),
        PlannedWork::Host {
            targets,
            blend,
            depth,
        } => {
            let colours: Vec<&TextureDesc> = targets
                .iter()
                .filter_map(|&target| texture(target))
                .collect();
            for target in &colours {
                colour_target(pass, target, *blend, capabilities)?;
            }
            let depth = depth.and_then(texture);
            if let Some(depth) = depth.filter(|depth| !depth.format.is_depth()) {
                return Err(declaration(format!(
                    "pass '{}' has the depth target {}, which holds no depth",
                    pass.label, depth.format
                )));
            }
            let mut all = colours.into_iter().chain(depth);
            let Some(first) = all.next() else {
                return Err(declaration(format!(
                    "pass '{}' draws to nothing",
                    pass.label
                )));
            };
            match all.find(|other| other.size != first.size || other.samples != first.samples) {
                None => Ok(()),
                Some(other) => Err(GraphError::new(
                    GraphErrorKind::Size,
                    format!(
                        "pass '{}' draws to {first} and to {other} at once; all its targets have one size and number of samples",
                        pass.label
                    ),
                )),
            }
        }
    }
}

fn colour_target(
    pass: &PlannedPass,
    target: &TextureDesc,
    blend: bool,
    capabilities: &Capabilities,
) -> Result<(), GraphError> {
    if target.format.is_depth() {
        return Err(declaration(format!(
            "pass '{}' has the colour target {}, which holds depth",
            pass.label, target.format
        )));
    }
    if blend && !capabilities.support(target.format).blendable {
        return Err(GraphError::new(
            GraphErrorKind::Capability,
            format!(
                "pass '{}' blends into {}, which cannot be blended under the profile {}; use another format",
                pass.label, target.format, capabilities.profile
            ),
        ));
    }
    Ok(())
}

/// A node makes what it promises: some pass of it writes every output.
pub(super) fn check_outputs(
    described: &Described,
    passes: &[PlannedPass],
) -> Result<(), GraphError> {
    let written = |resource: usize| {
        passes
            .iter()
            .flat_map(touched)
            .any(|touch| touch.resource == resource && touch.access.writes())
    };
    for slot in &described.desc.slots {
        let resource = described.slots.get(&slot.name).copied();
        if slot.direction == Direction::Out && !resource.is_some_and(written) {
            return Err(declaration(
                "the node promises this output, but none of its passes writes it".to_owned(),
            )
            .at_slot(&slot.name));
        }
    }
    Ok(())
}
