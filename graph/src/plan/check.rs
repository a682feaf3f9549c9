//! Whether a plan that was read from elsewhere holds together.

use super::access::Part;
use super::{Plan, PlannedBindingResource, PlannedWork};
use crate::error::ensure;
use crate::{GraphError, GraphErrorKind, Home, Instead};

impl Plan {
    /// Whether everything that the plan refers to is there. The recorder asks this before it uses a plan. A plan that
    /// [`Graph::compile`](crate::Graph::compile) gave is never refused; one that was read from a file may be.
    pub fn check(&self) -> Result<(), GraphError> {
        let (version, read) = (self.version, Self::VERSION);
        ensure(version == read, GraphErrorKind::Version, || {
            format!(
                "the plan has version {version}, this library reads version {read}; compile the graph with this library"
            )
        })?;
        for resource in &self.resources {
            let what = format!("resource '{}'", resource.name);
            match resource.home {
                Home::Import(index) => within(&what, "import", index, self.imports.len())?,
                Home::Memory(index) => within(&what, "memory", index, self.memory.len())?,
            }
            if let Some(extent) = &resource.extent {
                within(&what, "import", extent.import, self.imports.len())?;
            }
        }
        let named = self.imports.iter().map(|import| ("import", import));
        let named = named.chain(self.outputs.iter().map(|output| ("output", output)));
        for (kind, named) in named {
            let what = format!("{kind} '{}'", named.name);
            within(&what, "resource", named.value, self.resources.len())?;
        }
        for off in &self.off {
            let what = format!("what stands in for node '{}'", off.node);
            within(&what, "resource", off.output, self.resources.len())?;
            if let Instead::Bypass(input) = off.instead {
                within(&what, "resource", input, self.resources.len())?;
            }
        }
        self.check_parameters()?;
        for (index, pass) in self.passes.iter().enumerate() {
            let what = format!("pass '{}'", pass.name());
            if let Some(shader) = pass.shader {
                within(&what, "shader", shader, self.shaders.len())?;
            }
            if let PlannedWork::Compute { covers, .. } = pass.work {
                within(&what, "resource", covers, self.resources.len())?;
            }
            for binding in &pass.bindings {
                let fits = binding.fits();
                ensure(fits, GraphErrorKind::Plan, || {
                    format!(
                        "{what} binds '{}' as something else than what it holds; compile the graph again",
                        binding.name
                    )
                })?;
                if let PlannedBindingResource::Parameters { block } = binding.resource {
                    let blocks = self.parameters.blocks.len();
                    within(&what, "parameter block", block, blocks)?;
                }
                if let PlannedBindingResource::Regions { table } = binding.resource {
                    let tables = self.parameters.regions.len();
                    within(&what, "region table", table, tables)?;
                }
            }
            for touch in pass.touches() {
                let of = touch.resource;
                within(&what, "resource", of, self.resources.len())?;
                let resource = &self.resources[of];
                let texture = resource.desc.texture();
                let is_buffer = touch.part == Part::Buffer;
                ensure(is_buffer == texture.is_none(), GraphErrorKind::Plan, || {
                    let (name, desc) = (&resource.name, &resource.desc);
                    format!(
                        "{what} refers to resource '{name}', which is {desc}; compile the graph again"
                    )
                })?;
                if let (Some(texture), Part::Level { level, plane }) = (texture, touch.part) {
                    let what = format!("{what} on '{}'", resource.name);
                    within(&what, "mip level", level as usize, texture.mips as usize)?;
                    within(&what, "plane", plane as usize, texture.planes as usize)?;
                }
            }
            let of_bindings = (pass.reading(), pass.writing());
            let in_order = pass.bindings.is_sorted_by_key(|binding| binding.binding);
            let offsets = self.parameters.offsets(&pass.bindings);
            let agrees = in_order
                && (&pass.reads, &pass.writes) == (&of_bindings.0, &of_bindings.1)
                && pass.dynamic_offsets == offsets
                && pass.after == self.followed(index, false)
                && pass.after_in_memory == self.followed(index, true);
            ensure(agrees, GraphErrorKind::Plan, || {
                format!(
                    "{what} says something else of its bindings than they do; compile the graph again"
                )
            })?;
        }
        Ok(())
    }

    /// Whether all uniform data lies within a view's block.
    fn check_parameters(&self) -> Result<(), GraphError> {
        let inside = |offset: u32, count: u32, stride: u32, size: u64| {
            let last = u64::from(count.saturating_sub(1));
            u64::from(offset) + last * u64::from(stride) + size <= u64::from(self.parameters.size)
        };
        let blocks = self.parameters.blocks.iter().map(|block| {
            let fits = inside(block.offset, block.count, block.stride, block.array_size())
                && block.initial.len() <= block.size as usize;
            (fits, format!("parameters of node '{}'", block.node))
        });
        let tables = self.parameters.regions.iter().map(|table| {
            let fits = inside(table.offset, table.layers, table.stride, table.size())
                && table.capacity > 0;
            (fits, format!("regions of map '{}'", table.map))
        });
        for (fits, what) in blocks.chain(tables) {
            ensure(fits, GraphErrorKind::Plan, || {
                format!("the {what} do not lie within a view's block; compile the graph again")
            })?;
        }
        Ok(())
    }
}

fn within(what: &str, of: &str, index: usize, count: usize) -> Result<(), GraphError> {
    ensure(index < count, GraphErrorKind::Plan, || {
        format!("{what} refers to {of} {index}, but there are {count}; compile the graph again")
    })
}
