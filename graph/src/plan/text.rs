//! Plans as text.

use core::fmt;

use super::{Plan, PlannedWork};
use crate::Stage;

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "imports")?;
        for import in &self.imports {
            writeln!(
                f,
                "  {:<28} {}",
                import.name,
                description(self, import.resource)
            )?;
        }
        for stage in Stage::ALL {
            writeln!(f, "stage {stage:?}")?;
            for pass in self.passes.iter().filter(|pass| pass.stage == stage) {
                let work = match &pass.work {
                    PlannedWork::Compute { workgroups } => {
                        format!("compute {}x{} workgroups", workgroups[0], workgroups[1])
                    }
                    PlannedWork::Fullscreen { target, .. } => {
                        format!("fullscreen to {}", name(self, *target))
                    }
                    PlannedWork::Host { .. } => "the host draws".to_owned(),
                };
                let layers = if pass.each_layer {
                    format!(" x {} layers", pass.layers)
                } else {
                    String::new()
                };
                writeln!(
                    f,
                    "  {:<28} {work}{layers}, {} read, {} written",
                    format!("{}/{}", pass.node, pass.label),
                    Bytes(pass.bytes_read),
                    Bytes(pass.bytes_written)
                )?;
            }
        }
        writeln!(f, "memory ({} resident)", Bytes(self.bytes_resident()))?;
        for memory in &self.memory {
            writeln!(
                f,
                "  {:<28} {}, {}",
                memory.label,
                memory.desc,
                Bytes(memory.desc.bytes())
            )?;
        }
        writeln!(f, "parameters ({} bytes per view)", self.parameters.size)?;
        for block in &self.parameters.blocks {
            let elements = match block.elements {
                1 => String::new(),
                elements => format!(" x {elements}"),
            };
            writeln!(
                f,
                "  {:<28} {} at {}, {} bytes{elements} x {}",
                block.node, block.name, block.offset, block.size, block.count
            )?;
        }
        for table in &self.parameters.regions {
            writeln!(
                f,
                "  {:<28} MapRegion at {}, up to {} regions x {} layers",
                table.map, table.offset, table.capacity, table.layers
            )?;
        }
        writeln!(f, "outputs")?;
        for output in &self.outputs {
            writeln!(f, "  {:<28} {}", output.name, name(self, output.resource))?;
        }
        Ok(())
    }
}

/// A resource's name; a question mark where a plan from elsewhere refers to nothing.
fn name(plan: &Plan, resource: usize) -> &str {
    plan.resources
        .get(resource)
        .map_or("?", |resource| &resource.name)
}

fn description(plan: &Plan, resource: usize) -> String {
    plan.resources
        .get(resource)
        .map_or("?".to_owned(), |resource| resource.desc.to_string())
}

/// A number of bytes, readable.
struct Bytes(u64);

impl fmt::Display for Bytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            bytes @ 0..=9999 => write!(f, "{bytes} B"),
            bytes => write!(f, "{:.2} MiB", bytes as f64 / f64::from(1 << 20)),
        }
    }
}
