//! What a pass may do with the resources that it touches.

use super::{Described, declaration};
use crate::error::ensure;
use crate::{
    Capabilities, Direction, GraphError, GraphErrorKind, PlannedPass, PlannedResource, PlannedUse,
    PlannedWork, SlotResource, TextureDesc,
};
use moment_shadows::TextureFormat;

/// Checks the uses of a pass against each other and its targets against the device.
pub(super) fn check_pass(
    pass: &PlannedPass,
    resources: &[PlannedResource],
    capabilities: &Capabilities,
) -> Result<(), GraphError> {
    let label = &pass.label;
    let touches = pass.touches();
    for (index, touch) in touches.iter().enumerate() {
        let mut again = touches[..index]
            .iter()
            .filter(|earlier| PlannedUse::of(earlier).meets(&PlannedUse::of(touch)));
        if again.any(|earlier| earlier.access.writes() || touch.access.writes()) {
            return Err(declaration(format!(
                "pass '{label}' writes '{}' while it uses it in another way; a device allows one use at a time, so go \
                 through an internal slot",
                resources[touch.resource].name
            )));
        }
    }
    let texture = |index: usize| resources[index].desc.texture();
    let (colours, depth, blend): (Vec<&TextureDesc>, _, _) = match &pass.work {
        PlannedWork::Compute { .. } => return Ok(()),
        PlannedWork::Fullscreen { target, .. } => {
            let target = texture(*target);
            let samples = target.map_or(1, |target| target.samples);
            ensure(samples == 1, GraphErrorKind::Declaration, || {
                format!(
                    "pass '{label}' covers a texture of {samples} samples; the library draws to one"
                )
            })?;
            (target.into_iter().collect(), None, false)
        }
        PlannedWork::Host {
            targets,
            blend,
            depth,
            ..
        } => {
            let colours = targets.iter().filter_map(|&target| texture(target));
            (colours.collect(), depth.and_then(texture), *blend)
        }
    };
    for target in &colours {
        let format = target.format;
        ensure(!format.is_depth(), GraphErrorKind::Declaration, || {
            format!("pass '{label}' has the colour target {format}, which holds depth")
        })?;
        let blendable = !blend || capabilities.support(format).blendable;
        ensure(blendable, GraphErrorKind::Capability, || {
            format!(
                "pass '{label}' blends into {format}, which cannot be blended under the profile {}; {}",
                capabilities.profile,
                to_blend(format)
            )
        })?;
    }
    if let Some(TextureDesc { format, .. }) = depth {
        ensure(format.is_depth(), GraphErrorKind::Declaration, || {
            format!("pass '{label}' has the depth target {format}, which holds no depth")
        })?;
    }
    let mut all = colours.into_iter().chain(depth);
    // A pass that draws to nothing is no longer here.
    let Some(first) = all.next() else {
        return Ok(());
    };
    let differs = |other: &&TextureDesc| (other.size, other.samples) != (first.size, first.samples);
    all.find(differs).map_or(Ok(()), |other| {
        let message = format!(
            "pass '{label}' draws to {first} and to {other} at once; all its targets have one size and number of samples"
        );
        Err(GraphError::new(GraphErrorKind::Size, message))
    })
}

/// What to do about a format that cannot be blended.
fn to_blend(format: TextureFormat) -> String {
    match format.features_to_blend() {
        Some(features) => format!("request the device with {features}, or use another format"),
        None => "use another format".to_owned(),
    }
}

/// A node makes what it promises: some pass of it writes every output.
pub(super) fn check_outputs(described: &Described) -> Result<(), GraphError> {
    let desc = &described.desc;
    for slot in &desc.slots {
        let mut touched = desc.passes.iter().flat_map(|pass| pass.touched());
        // Passes bind a buffer; its slot says that they write it.
        let buffer =
            matches!(slot.resource, SlotResource::Buffer { access, .. } if access.writes());
        let written =
            touched.any(|(name, access)| name == slot.name && (buffer || access.writes()));
        if slot.direction == Direction::Out && !written {
            let message = "the node promises this output, but none of its passes writes it";
            return Err(declaration(message).at_slot(&slot.name));
        }
    }
    Ok(())
}
