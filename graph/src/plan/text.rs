//! Plans as text.

use core::fmt;

use super::{Plan, PlannedWork};
use crate::Stage;

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // A plan from elsewhere may refer to nothing.
        let name = |resource: usize| {
            let resource = self.resources.get(resource);
            resource.map_or("?", |resource| &resource.name).to_owned()
        };
        let imports = self.imports.iter().map(|import| {
            let resource = self.resources.get(import.value);
            let desc = resource.map_or("?".to_owned(), |resource| resource.desc.to_string());
            (import.name.clone(), desc)
        });
        section(f, "imports", imports)?;
        for stage in Stage::ALL {
            let passes = self.passes.iter().filter(|pass| pass.stage == stage);
            let passes = passes.map(|pass| {
                let work = match &pass.work {
                    PlannedWork::Compute {
                        workgroups: [x, y], ..
                    } => {
                        format!("compute {x}x{y} workgroups")
                    }
                    PlannedWork::Fullscreen { target, .. } => {
                        format!("fullscreen to {}", name(*target))
                    }
                    PlannedWork::Host { .. } => "the host draws".to_owned(),
                };
                let layers = pass
                    .each_layer
                    .then(|| format!(" x {} layers", pass.layers));
                let layers = layers.unwrap_or_default();
                let [read, written] = [pass.bytes_read, pass.bytes_written].map(Bytes);
                let text = format!("{work}{layers}, {read} read, {written} written");
                (pass.name(), text)
            });
            section(f, &format!("stage {stage:?}"), passes)?;
        }
        let memory = self.memory.iter().map(|memory| {
            let text = format!("{}, {}", memory.desc, Bytes(memory.desc.bytes()));
            (memory.label.clone(), text)
        });
        let resident = Bytes(self.bytes_resident());
        section(f, &format!("memory ({resident} resident)"), memory)?;
        let blocks = self.parameters.blocks.iter().map(|block| {
            let elements = match block.elements {
                1 => String::new(),
                elements => format!(" x {elements}"),
            };
            let text = format!(
                "{} at {}, {} bytes{elements} x {}",
                block.name, block.offset, block.size, block.count
            );
            (block.node.clone(), text)
        });
        let tables = self.parameters.regions.iter().map(|table| {
            let text = format!(
                "MapRegion at {}, up to {} regions x {} layers",
                table.offset, table.capacity, table.layers
            );
            (table.map.clone(), text)
        });
        let title = format!("parameters ({} bytes per view)", self.parameters.size);
        section(f, &title, blocks.chain(tables))?;
        let outputs = self.outputs.iter();
        let outputs = outputs.map(|output| (output.name.clone(), name(output.value)));
        section(f, "outputs", outputs)
    }
}

fn section(
    f: &mut fmt::Formatter<'_>,
    title: &str,
    mut rows: impl Iterator<Item = (String, String)>,
) -> fmt::Result {
    writeln!(f, "{title}")?;
    rows.try_for_each(|(name, text)| writeln!(f, "  {name:<28} {text}"))
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
