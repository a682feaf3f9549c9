//! The shaders of the table: references, and every pass of the catalogue's variants that have a row.

use std::collections::BTreeMap;

use moment_shadows::{Source, Storage, TextureFormat, link};
use moment_shadows_graph::{
    Binding, BindingResource, Direction, NodeDesc, Pass, ResourceDesc, Rule, SlotResource,
    TextureRule, Work,
};

use crate::catalogue::{self, Row, SIZE, Variant};
use crate::error::LabError;
use crate::summed_area::naive;

/// A shader that is compiled.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The name in the table.
    pub name: String,
    /// Linked WGSL. A fragment shader also has a vertex entry point named `fullscreen`.
    pub wgsl: String,
    /// The compute or fragment entry point.
    pub entry_point: String,
    /// Values of `override` constants.
    pub constants: BTreeMap<String, f64>,
    /// The format of the target that a fragment shader draws a pixel of; none for texels of a storage texture.
    pub target: Option<TextureFormat>,
    /// How many such targets it draws to at once.
    pub targets: usize,
    /// Texels that a workgroup makes.
    pub texels_per_workgroup: u32,
    /// Bytes of the widest texel that the shader reads or writes.
    pub texel_bytes: u32,
    /// How often each loop of the code runs, in the order in which they begin.
    pub trips: Vec<u32>,
}

/// Filtering with a table.
const FILTER: &str = include_str!("reference/summed_area.wgsl");

/// Every shader of the table: the references first.
pub fn subjects() -> Result<Vec<Subject>, LabError> {
    let mut subjects = Vec::new();
    let fullscreen = Source {
        name: "fullscreen",
        text: include_str!("reference/fullscreen.wgsl"),
    };
    let reference = |name: &str, wgsl, texel_bytes| Subject {
        name: format!("reference: {name}"),
        wgsl,
        entry_point: "shade".to_owned(),
        constants: BTreeMap::new(),
        target: Some(TextureFormat::Rgba16Float),
        targets: 1,
        texels_per_workgroup: 1,
        texel_bytes,
        trips: Vec::new(),
    };
    // Shaders that stand alone, with a target of 16 bits per channel: name, text, bytes of the widest texel.
    let plain = FILTER.replace(
        "summed_area_table_mean_interpolated",
        "summed_area_table_mean_plain",
    );
    for (name, text, texel_bytes) in [
        (
            "one bilinear fetch",
            include_str!("reference/bilinear.wgsl"),
            8,
        ),
        (
            "Hamburger 4 (fetch, decoding, bias, leak reduction)",
            include_str!("reference/hamburger.wgsl"),
            8,
        ),
        ("summed-area table, nine rectangles", FILTER, 16),
        ("summed-area table, whole texels", &plain, 16),
    ] {
        let linked = link(Source { name, text }, &[fullscreen])?;
        subjects.push(reference(name, linked.into_wgsl(), texel_bytes));
    }
    // What fragments of translucent casters take, which a host draws.
    let casters = include_str!("reference/translucent_casters.wgsl");
    for storage in [Storage::Unorm16, Storage::Float16] {
        let constant = format!("const STORAGE = {}u;", storage.wgsl_index());
        let constant = Source {
            name: "storage",
            text: &constant,
        };
        let name = "translucent casters";
        let source = Source {
            name,
            text: casters,
        };
        let linked = link(source, &[fullscreen, constant])?.into_wgsl();
        for (moments, entry_point, targets) in [
            ("two", "two_moments", 1),
            ("four", "four_moments", 1),
            ("six", "six_moments", 2),
        ] {
            subjects.push(Subject {
                entry_point: entry_point.to_owned(),
                targets,
                target: Some(match storage {
                    Storage::Unorm16 => TextureFormat::Rgba16Unorm,
                    _ => TextureFormat::Rgba16Float,
                }),
                ..reference(
                    &format!("{name}, {moments} moments, {storage}"),
                    linked.clone(),
                    8,
                )
            });
        }
    }
    for (name, text, entry_point) in naive::SHADERS {
        let wgsl = naive::linked(name, text)?;
        subjects.push(Subject {
            entry_point: entry_point.to_owned(),
            target: None,
            texels_per_workgroup: naive::LINES * SIZE[0],
            trips: vec![SIZE[0]],
            ..reference(&format!("summed-area table, {name}"), wgsl, 16)
        });
    }
    for variant in catalogue::variants()? {
        if let Some(row) = &variant.row {
            subjects.extend(of_variant(&variant, row)?);
        }
    }
    Ok(subjects)
}

/// The shaders of every pass that the node itself records.
fn of_variant(variant: &Variant, row: &Row) -> Result<Vec<Subject>, LabError> {
    let desc = variant.describe()?;
    let formats = Formats {
        desc: &desc,
        inputs: variant.inputs(),
    };
    let mut subjects = Vec::new();
    for pass in &desc.passes {
        let name = format!("{}, {}: {}", desc.name, row.settings, pass.label);
        let (target, texels) = match &pass.work {
            Work::Compute {
                texels_per_workgroup: texels,
                ..
            } => (None, *texels),
            Work::Fullscreen { target, .. } => {
                let format = formats.of(target).ok_or_else(|| {
                    let reason = format!("its target '{target}' has no format");
                    LabError::unsuitable(format!("shader '{name}'"), reason)
                })?;
                (Some(format), [1; 2])
            }
            Work::Host { .. } => continue,
        };
        // A workgroup for whole lines covers no more than there is.
        let texels = texels.into_iter().zip(SIZE);
        let texels_per_workgroup = texels.map(|(texels, side)| texels.min(side)).product();
        subjects.push(Subject {
            name,
            wgsl: pass.wgsl.clone(),
            entry_point: pass.entry_point.clone(),
            constants: pass.constants.clone(),
            target,
            targets: 1,
            texels_per_workgroup,
            texel_bytes: formats.widest(pass),
            trips: row.trips(&pass.label).to_vec(),
        });
    }
    Ok(subjects)
}

/// The formats of a node's slots.
struct Formats<'a> {
    desc: &'a NodeDesc,
    inputs: BTreeMap<String, ResourceDesc>,
}

impl Formats<'_> {
    /// The format of what is connected to the slot, or of what the node makes for it.
    fn of(&self, slot: &str) -> Option<TextureFormat> {
        let connected = |slot: &str| Some(self.inputs.get(slot)?.texture()?.format);
        let slot = self.desc.slots.iter().find(|other| other.name == slot)?;
        if matches!(slot.direction, Direction::In | Direction::InOut) {
            return connected(&slot.name);
        }
        let SlotResource::Texture(TextureRule { format, .. }) = &slot.resource else {
            return None;
        };
        match format {
            Rule::Exact(format) => Some(*format),
            Rule::SameAs(input) => connected(input),
            Rule::OneOf(formats) => formats.first().copied(),
            Rule::Any => None,
        }
    }

    /// Bytes of the widest texel that a pass touches through a binding.
    fn widest(&self, pass: &Pass) -> u32 {
        let slot = |binding: &Binding| match &binding.resource {
            BindingResource::Layers(slot) => self.of(slot),
            BindingResource::Level { slot, .. } | BindingResource::StorageLevel { slot, .. } => {
                self.of(slot)
            }
            _ => None,
        };
        let formats = pass.bindings.iter().filter_map(slot);
        let bytes = formats.map(TextureFormat::bytes_per_texel);
        bytes.max().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_name_is_there_once() -> Result<(), LabError> {
        let subjects = subjects()?;
        let names: BTreeSet<&str> = subjects.iter().map(|subject| &*subject.name).collect();
        assert_eq!(names.len(), subjects.len());
        Ok(())
    }

    #[test]
    fn a_subject_knows_its_outputs_its_texels_and_its_loops() -> Result<(), LabError> {
        let subjects = subjects()?;
        let find = |name: &str| subjects.iter().find(|subject| subject.name == name);
        let blur = find("blur, float32, radius 64: blur along x");
        let blur = blur.map(|blur| (blur.texels_per_workgroup, blur.texel_bytes, &blur.trips));
        // 64 invocations of 16 texels; 128 + 16 taps in blocks of 16.
        assert_eq!(blur, Some((1024, 16, &vec![9])));
        let shade = find("shade_hard, unorm16, sampled: shade");
        let shade = shade.map(|shade| (shade.target, shade.texel_bytes));
        assert_eq!(shade, Some((Some(TextureFormat::R8Unorm), 8)));
        Ok(())
    }
}
