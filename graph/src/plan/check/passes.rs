//! What a pass says of itself, against what it touches.

use super::super::access::{MOST_TARGETS, Part, Touch};
use super::super::{Plan, PlannedBinding, PlannedBindingResource, PlannedPass, PlannedWork, Usage};
use super::within;
use crate::error::ensure;
use crate::{GraphError, GraphErrorKind, TextureDesc};

impl Plan {
    pub(super) fn check_pass(&self, index: usize, pass: &PlannedPass) -> Result<(), GraphError> {
        let what = format!("pass '{}'", pass.name());
        if let Some(shader) = pass.shader {
            within(&what, "shader", shader, self.shaders.len())?;
        }
        for binding in &pass.bindings {
            self.check_binding(binding, pass, &what)?;
        }
        let touches = pass.touches();
        for touch in &touches {
            self.check_touch(touch, pass, &what)?;
        }
        self.check_work(pass, &what)?;
        // No device lets a pass do both at once.
        let again = |(number, touch): (usize, &Touch)| {
            let mut earlier = touches.iter().take(number);
            earlier.any(|earlier| {
                (earlier.access.writes() || touch.access.writes()) && self.shared(earlier, touch)
            })
        };
        let conflicts = touches.iter().enumerate().any(again);
        ensure(!conflicts, GraphErrorKind::Plan, || {
            format!("{what} writes what it uses in another way as well; compile the graph again")
        })?;
        let of_bindings = (pass.reading(), pass.writing());
        let numbers = pass.bindings.iter().map(|binding| binding.binding);
        let agrees = numbers.is_sorted_by(|one, next| one < next)
            && (&pass.reads, &pass.writes) == (&of_bindings.0, &of_bindings.1)
            && pass.dynamic_offsets == self.parameters.offsets(&pass.bindings)
            && pass.after == self.followed(index, false)
            && pass.after_in_memory == self.followed(index, true);
        ensure(agrees, GraphErrorKind::Plan, || {
            format!(
                "{what} says something else of its bindings than they do; compile the graph again"
            )
        })
    }

    fn check_binding(
        &self,
        binding: &PlannedBinding,
        pass: &PlannedPass,
        what: &str,
    ) -> Result<(), GraphError> {
        ensure(binding.fits(), GraphErrorKind::Plan, || {
            format!(
                "{what} binds '{}' as something else than what it holds; compile the graph again",
                binding.name
            )
        })?;
        let (bytes, layers) = match binding.resource {
            PlannedBindingResource::Parameters { block } => {
                let blocks = self.parameters.blocks.len();
                within(what, "parameter block", block, blocks)?;
                let block = &self.parameters.blocks[block];
                let every_layer = block.count == 1;
                let layers = if every_layer { u32::MAX } else { block.count };
                (block.array_size(), layers)
            }
            PlannedBindingResource::Regions { table } => {
                let tables = self.parameters.regions.len();
                within(what, "region table", table, tables)?;
                let table = &self.parameters.regions[table];
                (table.size(), table.layers)
            }
            PlannedBindingResource::Buffer { resource } => {
                within(what, "resource", resource, self.resources.len())?;
                (self.resources[resource].desc.bytes(), u32::MAX)
            }
            PlannedBindingResource::Texture { .. }
            | PlannedBindingResource::StorageTexture { .. }
            | PlannedBindingResource::Sampler(_) => return Ok(()),
        };
        let least = u64::from(binding.least_bytes());
        let fits = match binding.uniform_size() {
            Some(_) => least == bytes && pass.layers <= layers,
            // What is left open a device compares only when it is recorded, and tells nobody.
            None => least <= bytes && (least > 0 || matches!(pass.work, PlannedWork::Host { .. })),
        };
        ensure(fits, GraphErrorKind::Plan, || {
            format!(
                "{what} binds more or less as '{}' than there is; compile the graph again",
                binding.name
            )
        })
    }

    fn check_touch(&self, touch: &Touch, pass: &PlannedPass, what: &str) -> Result<(), GraphError> {
        within(what, "resource", touch.resource, self.resources.len())?;
        let resource = &self.resources[touch.resource];
        let (name, texture) = (&resource.name, resource.desc.texture());
        let is_buffer = touch.part == Part::Buffer;
        ensure(is_buffer == texture.is_none(), GraphErrorKind::Plan, || {
            let desc = &resource.desc;
            format!("{what} refers to resource '{name}', which is {desc}; compile the graph again")
        })?;
        if let (Some(texture), Part::Level { level, plane }) = (texture, touch.part) {
            let what = format!("{what} on '{name}'");
            within(&what, "mip level", level as usize, texture.mips as usize)?;
            within(&what, "plane", plane as usize, texture.planes as usize)?;
            let last = pass.layers.saturating_sub(1);
            within(&what, "layer", last as usize, texture.layers as usize)?;
        }
        let needed = Usage::needed(&resource.desc, touch.access);
        let allowed = needed.iter().all(|usage| resource.usage.contains(usage));
        ensure(allowed, GraphErrorKind::Plan, || {
            format!(
                "{what} uses resource '{name}' in a way that it does not allow; compile the graph again"
            )
        })
    }

    /// Whether the pass covers or draws to what can be, as often as there are layers. What it draws to is there.
    fn check_work(&self, pass: &PlannedPass, what: &str) -> Result<(), GraphError> {
        let texture = |resource: usize| self.resources.get(resource)?.desc.texture();
        let (followed, possible) = match &pass.work {
            &PlannedWork::Compute { covers, level, .. } => {
                within(what, "resource", covers, self.resources.len())?;
                let covered = texture(covers).is_some_and(|texture| level < texture.mips);
                (Some(covers), covered)
            }
            &PlannedWork::Fullscreen { target, .. } => {
                let one_sample = texture(target).is_some_and(|texture| texture.samples == 1);
                (Some(target), one_sample)
            }
            PlannedWork::Host {
                targets,
                planes,
                depth,
                ..
            } => {
                let count = targets.len().saturating_mul(*planes as usize);
                let first = targets.first().or(depth.as_ref());
                (first.copied(), count <= MOST_TARGETS)
            }
        };
        let layers = followed.and_then(texture).map(|texture: &TextureDesc| {
            let of_texture = if pass.each_layer { texture.layers } else { 1 };
            of_texture == pass.layers
        });
        let fits = possible && layers == Some(true);
        ensure(fits, GraphErrorKind::Plan, || {
            format!("{what} does not fit what it covers or draws to; compile the graph again")
        })
    }
}
