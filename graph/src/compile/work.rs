//! The work of a node's pass, with its slots replaced by resources.

use super::passes::{Planner, plane};
use super::{declaration, workgroups};
use crate::{GraphError, Pass, PlannedResource, PlannedWork, Work};

/// A pass's work with its slots replaced.
pub(super) struct Resolved {
    pub(super) work: PlannedWork,
    /// The resource whose layers it is recorded for.
    pub(super) followed: usize,
    pub(super) layers: u32,
    pub(super) each_layer: bool,
}

impl Planner<'_> {
    pub(super) fn work(
        &self,
        pass: &Pass,
        resources: &[PlannedResource],
    ) -> Result<Resolved, GraphError> {
        match &pass.work {
            Work::Compute {
                covers,
                texels_per_workgroup,
                each_layer,
            } => {
                let (followed, covered) = self.texture(pass, covers, resources)?;
                let groups =
                    workgroups::grid(covered.size, *texels_per_workgroup, self.capabilities)
                        .map_err(|error| error.at_slot(covers))?;
                Ok(Resolved {
                    work: PlannedWork::Compute { workgroups: groups },
                    followed,
                    layers: covered.layers,
                    each_layer: *each_layer,
                })
            }
            Work::ComputeRegions {
                covers,
                level,
                texels_per_workgroup,
            } => {
                let (followed, covered) = self.level(pass, covers, *level, resources)?;
                let groups = workgroups::for_regions(
                    covered.size_at(*level),
                    covered.regions,
                    *texels_per_workgroup,
                    self.capabilities,
                )
                .map_err(|error| error.at_slot(covers))?;
                Ok(Resolved {
                    work: PlannedWork::Compute { workgroups: groups },
                    followed,
                    layers: covered.layers,
                    each_layer: true,
                })
            }
            Work::Fullscreen {
                target: slot,
                each_layer,
            } => {
                let (index, target) = self.texture(pass, slot, resources)?;
                Ok(Resolved {
                    work: PlannedWork::Fullscreen {
                        target: index,
                        level: 0,
                        plane: plane(pass, slot, target)?,
                        keeps: false,
                    },
                    followed: index,
                    layers: target.layers,
                    each_layer: *each_layer,
                })
            }
            Work::FullscreenRegions {
                target: slot,
                level,
            } => {
                let (index, target) = self.level(pass, slot, *level, resources)?;
                Ok(Resolved {
                    work: PlannedWork::Fullscreen {
                        target: index,
                        level: *level,
                        plane: plane(pass, slot, target)?,
                        keeps: true,
                    },
                    followed: index,
                    layers: target.layers,
                    each_layer: true,
                })
            }
            Work::Host {
                targets,
                blend,
                depth,
            } => {
                let targets = targets
                    .iter()
                    .map(|slot| Ok(self.texture(pass, slot, resources)?.0))
                    .collect::<Result<Vec<usize>, GraphError>>()?;
                let depth = depth
                    .as_ref()
                    .map(|slot| Ok::<_, GraphError>(self.texture(pass, slot, resources)?.0))
                    .transpose()?;
                let followed = targets.first().copied().or(depth).ok_or_else(|| {
                    declaration(format!("pass '{}' draws to nothing", pass.label))
                })?;
                Ok(Resolved {
                    work: PlannedWork::Host {
                        targets,
                        blend: *blend,
                        depth,
                    },
                    followed,
                    layers: 1,
                    each_layer: false,
                })
            }
        }
    }
}
