//! Which passes have to follow which: for frame graphs that order passes on their own.

use serde::{Deserialize, Serialize};

use super::access::{Part, Touch};
use super::{Home, Plan, PlannedPass};

/// A part of a resource that a pass reads or writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlannedUse {
    /// Index into [`Plan::resources`].
    pub resource: usize,
    /// The mip level, of the layer that the pass is recorded for; all levels and layers of a texture, or a whole buffer, where
    /// there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub level: Option<u32>,
    /// The plane of that layer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plane: Option<u32>,
}

impl PlannedUse {
    pub(crate) fn of(touch: &Touch) -> Self {
        let (level, plane) = match touch.part {
            Part::Level { level, plane } => (Some(level), Some(plane)),
            Part::Layers | Part::Buffer => (None, None),
        };
        Self {
            resource: touch.resource,
            level,
            plane,
        }
    }

    /// Whether both have texels in common, of some layer.
    pub(crate) fn meets(&self, other: &Self) -> bool {
        let apart = |one: Option<u32>, other: Option<u32>| {
            one.zip(other).is_some_and(|(one, other)| one != other)
        };
        self.resource == other.resource
            && !apart(self.level, other.level)
            && !apart(self.plane, other.plane)
    }
}

impl PlannedPass {
    /// What it reads: also of a target that keeps its contents, or that a host blends into.
    pub(crate) fn reading(&self) -> Vec<PlannedUse> {
        let touches = self.touches();
        let read = touches
            .iter()
            .filter(|touch| touch.access.read || self.keeps(touch));
        read.map(PlannedUse::of).collect()
    }

    /// What it writes.
    pub(crate) fn writing(&self) -> Vec<PlannedUse> {
        let touches = self.touches();
        let written = touches.iter().filter(|touch| touch.access.writes());
        written.map(PlannedUse::of).collect()
    }
}

impl Plan {
    /// Fills in what each pass reads and writes, and which it follows: for a host that changes what passes bind, or where resources
    /// live.
    pub fn update_hazards(&mut self) {
        for pass in &mut self.passes {
            (pass.reads, pass.writes) = (pass.reading(), pass.writing());
        }
        let after: Vec<_> = (0..self.passes.len())
            .map(|pass| (self.followed(pass, false), self.followed(pass, true)))
            .collect();
        for (pass, (by_resource, by_memory)) in self.passes.iter_mut().zip(after) {
            (pass.after, pass.after_in_memory) = (by_resource, by_memory);
        }
    }

    /// The earlier passes that a pass has to follow: those of which either writes what the other touches.
    pub(crate) fn followed(&self, pass: usize, in_memory: bool) -> Vec<usize> {
        let Some((later, earlier)) = self.passes.get(..=pass).and_then(<[_]>::split_last) else {
            return Vec::new();
        };
        let shared = |one: &PlannedUse, other: &PlannedUse| {
            one.meets(other)
                || in_memory && one.resource != other.resource && self.share_memory(one, other)
        };
        let meet = |one: &[PlannedUse], other: &[PlannedUse]| {
            one.iter()
                .any(|one| other.iter().any(|other| shared(one, other)))
        };
        let conflicts = |earlier: &PlannedPass| {
            meet(&earlier.writes, &later.writes)
                || meet(&earlier.writes, &later.reads)
                || meet(&earlier.reads, &later.writes)
        };
        let earlier = earlier.iter().enumerate();
        let followed = earlier.filter(|(_, earlier)| conflicts(earlier));
        followed.map(|(index, _)| index).collect()
    }

    /// Whether two uses have memory in common.
    pub(crate) fn shared(&self, one: &Touch, other: &Touch) -> bool {
        let [one, other] = [one, other].map(PlannedUse::of);
        one.meets(&other) || one.resource != other.resource && self.share_memory(&one, &other)
    }

    fn share_memory(&self, one: &PlannedUse, other: &PlannedUse) -> bool {
        let home = |of: &PlannedUse| match self.resources.get(of.resource)?.home {
            Home::Memory(memory) => Some(memory),
            Home::Import(_) => None,
        };
        home(one).is_some_and(|memory| home(other) == Some(memory))
    }
}
