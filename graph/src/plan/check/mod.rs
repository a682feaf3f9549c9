//! Whether a plan that was read from elsewhere holds together.

mod parameters;
mod passes;

use super::{Plan, PlannedResource};
use crate::error::ensure;
use crate::{GraphError, GraphErrorKind, Home, Instead};

impl Plan {
    /// Whether everything that the plan refers to is there, and passes do with it what a device allows. The recorder asks this before it
    /// uses a plan. A plan that [`Graph::compile`](crate::Graph::compile) gave is never refused; one that was read from a file may be.
    pub fn check(&self) -> Result<(), GraphError> {
        let (version, read) = (self.version, Self::VERSION);
        ensure(version == read, GraphErrorKind::Version, || {
            format!(
                "the plan has version {version}, this library reads version {read}; compile the graph with this library"
            )
        })?;
        for resource in &self.resources {
            self.check_resource(resource)?;
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
            self.check_pass(index, pass)?;
        }
        Ok(())
    }

    /// Whether a resource lives somewhere that is what it says of itself.
    fn check_resource(&self, resource: &PlannedResource) -> Result<(), GraphError> {
        let what = format!("resource '{}'", resource.name);
        match resource.home {
            Home::Import(index) => within(&what, "import", index, self.imports.len())?,
            Home::Memory(index) => {
                within(&what, "memory", index, self.memory.len())?;
                let memory = &self.memory[index];
                let allowed = |usage| memory.usage.contains(usage);
                let same = memory.desc.on_device() == resource.desc.on_device();
                let fits = same && resource.usage.iter().all(allowed);
                ensure(fits, GraphErrorKind::Plan, || {
                    format!(
                        "{what} lives in memory {index}, which is something else; compile the graph again"
                    )
                })?;
            }
        }
        let extent = resource.extent.as_ref();
        extent.map_or(Ok(()), |extent| {
            within(&what, "import", extent.import, self.imports.len())
        })
    }
}

/// Whether something refers to what is there.
fn within(what: &str, of: &str, index: usize, count: usize) -> Result<(), GraphError> {
    ensure(index < count, GraphErrorKind::Plan, || {
        format!("{what} refers to {of} {index}, but there are {count}; compile the graph again")
    })
}
