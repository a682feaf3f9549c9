//! What every WebGPU device has of things that an entry point uses (WebGPU specification, "Limits", the defaults), and what a stage
//! may do. naga knows neither.

use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{AddressSpace, Binding, BuiltIn, EntryPoint, Handle, ImageClass, Module, ShaderStage};
use naga::{GlobalVariable, Span, StorageAccess, Type, TypeInner};

use super::constants;
use super::diagnostic::find;
use crate::link::tokens::tokens;
use crate::{Linked, Rule, ShaderError};

const BIND_GROUPS: u32 = 4;
const BINDINGS_PER_GROUP: u32 = 1000;
const WORKGROUP_BYTES: u32 = 16_384;
const WORKGROUP_SIDES: [u32; 3] = [256, 256, 64];
const WORKGROUP_INVOCATIONS: u32 = 256;
/// Elements of an array that no buffer holds (WGSL specification, section 2.4, "Limits").
const ARRAY_ELEMENTS: u32 = 65_535;
const UNIFORM_BYTES: u32 = 65_536;
const VERTEX_ATTRIBUTES: u32 = 16;
const VARYINGS: u32 = 16;
const COLOUR_TARGETS: u32 = 8;

/// Kinds of resources, and how many of them a stage has.
const RESOURCES: [(&str, usize); 5] = [
    ("uniform buffers", 12),
    ("storage buffers", 8),
    ("sampled textures", 16),
    ("samplers", 16),
    ("storage textures", 4),
];

/// Entry points that use more than every device has, or what their stage cannot.
pub(super) fn check(module: &Module, info: &ModuleInfo, linked: &Linked) -> Vec<ShaderError> {
    let mut found = large_arrays(module, linked);
    for (index, entry_point) in module.entry_points.iter().enumerate() {
        let checked = Checked {
            module,
            linked,
            entry_point,
        };
        let resources = checked.resources(info.get_entry_point(index));
        found.extend(resources.err());
        found.extend(checked.workgroup().err());
        found.extend(checked.locations().err());
    }
    found
}

/// Variables outside of buffers whose arrays have too many elements.
fn large_arrays(module: &Module, linked: &Linked) -> Vec<ShaderError> {
    let globals = module
        .global_variables
        .iter()
        .filter(|(_, it)| matches!(it.space, AddressSpace::Private | AddressSpace::WorkGroup));
    let globals = globals.map(|(handle, it)| (it.ty, module.global_variables.get_span(handle)));
    let functions = module.functions.iter().map(|(_, function)| function);
    let entry_points = module.entry_points.iter().map(|it| &it.function);
    let locals = functions.chain(entry_points).flat_map(|function| {
        let locals = function.local_variables.iter();
        locals.map(|(handle, it)| (it.ty, function.local_variables.get_span(handle)))
    });
    let large = globals.chain(locals).filter_map(|(ty, span)| {
        let TypeInner::Array { size, .. } = module.types[ty].inner else {
            return None;
        };
        let count = constants::array_length(size).filter(|count| *count > ARRAY_ELEMENTS)?;
        Some(ShaderError {
            rule: Rule::Limit,
            message: format!(
                "an array has {count} elements; outside of buffers every device has {ARRAY_ELEMENTS}"
            ),
            places: span.to_range().and_then(|range| linked.location(range)).into_iter().collect(),
            notes: Vec::new(),
        })
    });
    large.collect()
}

/// What an external texture takes beside its place among sampled textures (WebGPU specification, "Binding slots"): three more of
/// those, a sampler, and a uniform buffer.
const EXTERNAL: [usize; 5] = [2, 2, 2, 3, 0];

fn is_external(inner: &TypeInner) -> bool {
    matches!(
        inner,
        TypeInner::Image {
            class: ImageClass::External,
            ..
        }
    )
}

struct Checked<'a> {
    module: &'a Module,
    linked: &'a Linked,
    entry_point: &'a EntryPoint,
}

impl Checked<'_> {
    /// Refuses something that is said of the entry point, and points at `spans`, or at the entry point itself.
    fn refused<T>(&self, what: &str, spans: &[Span]) -> Result<T, ShaderError> {
        self.refused_by(Rule::Limit, what, spans)
    }

    fn refused_by<T>(&self, rule: Rule, what: &str, spans: &[Span]) -> Result<T, ShaderError> {
        let name = &self.entry_point.name;
        let places = spans.iter().filter_map(|span| span.to_range());
        let mut places: Vec<_> = places.filter_map(|it| self.linked.location(it)).collect();
        if places.is_empty() {
            places.extend(find(self.linked, name));
        }
        Err(ShaderError {
            rule,
            message: format!("entry point `{name}` {what}"),
            places,
            notes: Vec::new(),
        })
    }

    /// Kinds and numbers of buffers, textures and samplers, their places, and what is written by vertex shaders.
    fn resources(&self, uses: &FunctionInfo) -> Result<(), ShaderError> {
        let mut spans: [Vec<Span>; RESOURCES.len()] = Default::default();
        let mut workgroup_bytes: u32 = 0;
        for (handle, variable) in self.module.global_variables.iter() {
            if uses[handle].is_empty() {
                continue;
            }
            let span = self.module.global_variables.get_span(handle);
            let bytes = self.module.types[variable.ty]
                .inner
                .size(self.module.to_ctx());
            if variable.space == AddressSpace::WorkGroup {
                let rounded = bytes.checked_next_multiple_of(16).unwrap_or(u32::MAX);
                workgroup_bytes = workgroup_bytes.saturating_add(rounded);
            }
            if variable.space == AddressSpace::Uniform && bytes > UNIFORM_BYTES {
                let what = format!(
                    "uses a uniform buffer of {bytes} bytes; every device has {UNIFORM_BYTES}"
                );
                return self.refused(&what, &[span]);
            }
            if let Some(place) = variable.binding {
                if place.group >= BIND_GROUPS {
                    let what = format!(
                        "uses bind group {}; every device has groups 0 to {}",
                        place.group,
                        BIND_GROUPS - 1
                    );
                    return self.refused(&what, &[span]);
                }
                if place.binding >= BINDINGS_PER_GROUP {
                    let what = format!(
                        "uses binding {}; every device has bindings 0 to {}",
                        place.binding,
                        BINDINGS_PER_GROUP - 1
                    );
                    return self.refused(&what, &[span]);
                }
            }
            if variable.space == AddressSpace::WorkGroup
                && self.entry_point.stage != ShaderStage::Compute
            {
                let what = "uses workgroup memory, which compute shaders alone have";
                return self.refused_by(Rule::Stage, what, &[span]);
            }
            let (kind, written) = self.kind(variable);
            if written && self.entry_point.stage == ShaderStage::Vertex {
                let what = "is a vertex shader and uses a storage buffer or texture that can be written; only fragment and compute \
                            shaders may: declare it `read`";
                return self.refused_by(Rule::Stage, what, &[span]);
            }
            if let Some(kind) = kind {
                spans[kind].push(span);
            }
            if is_external(&self.module.types[variable.ty].inner) {
                EXTERNAL.iter().for_each(|kind| spans[*kind].push(span));
            }
        }
        for ((what, most), spans) in RESOURCES.into_iter().zip(&spans) {
            if spans.len() > most {
                let what = format!(
                    "uses {} {what}; every device has {most} per stage",
                    spans.len()
                );
                return self.refused(&what, &spans[most..]);
            }
        }
        if workgroup_bytes > WORKGROUP_BYTES {
            let what = format!(
                "uses {workgroup_bytes} bytes of workgroup memory; every device has {WORKGROUP_BYTES}"
            );
            return self.refused(&what, &[]);
        }
        Ok(())
    }

    /// The place in [`RESOURCES`] of what a variable is, and whether it can be written.
    fn kind(&self, variable: &GlobalVariable) -> (Option<usize>, bool) {
        if variable.space == AddressSpace::Uniform {
            return (Some(0), false);
        }
        if let AddressSpace::Storage { access } = variable.space {
            return (Some(1), access.contains(StorageAccess::STORE));
        }
        let inner = &self.module.types[variable.ty].inner;
        if let TypeInner::Image { class, .. } = inner {
            if let ImageClass::Storage { access, .. } = class {
                return (Some(4), access.contains(StorageAccess::STORE));
            }
            return (Some(2), false);
        }
        let sampler = matches!(inner, TypeInner::Sampler { .. });
        (sampler.then_some(3), false)
    }

    /// The size of a compute shader's workgroup. One that overrides decide is theirs.
    fn workgroup(&self) -> Result<(), ShaderError> {
        let size = self.entry_point.workgroup_size;
        let overridden = self.entry_point.workgroup_size_overrides.is_some();
        if self.entry_point.stage != ShaderStage::Compute || overridden {
            return Ok(());
        }
        let [x, y, z] = size;
        let invocations = size.into_iter().fold(1_u32, u32::saturating_mul);
        let too_long = size
            .iter()
            .zip(WORKGROUP_SIDES)
            .any(|(side, most)| *side > most);
        if too_long || invocations > WORKGROUP_INVOCATIONS {
            let [most_x, most_y, most_z] = WORKGROUP_SIDES;
            let what = format!(
                "has a workgroup of {x} x {y} x {z}; every device has {most_x} x {most_y} x {most_z} at most, and \
                 {WORKGROUP_INVOCATIONS} invocations together"
            );
            return self.refused(&what, &self.attribute("workgroup_size"));
        }
        Ok(())
    }

    /// Where the entry point's attribute of that name stands.
    fn attribute(&self, name: &str) -> Vec<Span> {
        let tokens = tokens(self.linked.wgsl()).unwrap_or_default();
        let function = tokens.windows(2).position(|pair| {
            matches!(pair, [word, of] if word.is_word("fn") && of.is_word(&self.entry_point.name))
        });
        let before = tokens.iter().take(function.unwrap_or_default());
        let attribute = before.rev().find(|token| token.is_word(name));
        let span = attribute.and_then(|token| {
            let range = token.range();
            let start = u32::try_from(range.start).ok()?;
            Some(Span::new(start, u32::try_from(range.end).ok()?))
        });
        span.into_iter().collect()
    }

    /// Vertex attributes, what goes from one stage to the next, and colour targets.
    fn locations(&self) -> Result<(), ShaderError> {
        let function = &self.entry_point.function;
        let inputs = function
            .arguments
            .iter()
            .map(|it| (it.ty, it.binding.as_ref()));
        let inputs: Vec<_> = inputs.collect();
        let outputs = function
            .result
            .iter()
            .map(|it| (it.ty, it.binding.as_ref()));
        let outputs: Vec<_> = outputs.collect();
        if self.entry_point.stage == ShaderStage::Vertex {
            self.integers(&inputs)?;
            self.below(&inputs, VERTEX_ATTRIBUTES, 0, "vertex attributes")?;
            self.below(&outputs, VARYINGS, 0, "outputs to the next stage")?;
        }
        if self.entry_point.stage == ShaderStage::Fragment {
            let builtins = self.bound(&inputs);
            let builtins = builtins.iter().filter(|it| takes_a_place(it)).count();
            self.below(
                &inputs,
                VARYINGS,
                builtins as u32,
                "inputs from the stage before",
            )?;
            self.integers(&outputs)?;
            self.below(&outputs, COLOUR_TARGETS, 0, "colour targets")?;
        }
        Ok(())
    }

    /// Refuses integers that are said to be interpolated, where no rasteriser stands between and naga does not look.
    fn integers(&self, values: &[(Handle<Type>, Option<&Binding>)]) -> Result<(), ShaderError> {
        let members = values
            .iter()
            .flat_map(|(ty, binding)| match &self.module.types[*ty].inner {
                TypeInner::Struct { members, .. } => members
                    .iter()
                    .map(|it| (it.ty, it.binding.as_ref()))
                    .collect(),
                _ => vec![(*ty, *binding)],
            });
        for (ty, binding) in members {
            let scalar = self.module.types[ty].inner.scalar();
            let is_integer = scalar.is_some_and(|it| it.kind != naga::ScalarKind::Float);
            if let Some(Binding::Location {
                interpolation: Some(how),
                ..
            }) = binding
                && is_integer
                && *how != naga::Interpolation::Flat
            {
                let what =
                    "has an integer that is to be interpolated; integers are `@interpolate(flat)`";
                return self.refused_by(Rule::Stage, what, &[]);
            }
        }
        Ok(())
    }

    /// Refuses locations from `most` on, and more of them than `most` less what is taken otherwise.
    fn below(
        &self,
        values: &[(Handle<Type>, Option<&Binding>)],
        most: u32,
        taken: u32,
        what: &str,
    ) -> Result<(), ShaderError> {
        let bound = self.bound(values);
        let locations = bound.iter().filter_map(|binding| match binding {
            Binding::Location { location, .. } => Some(*location),
            Binding::BuiltIn(_) => None,
        });
        let locations: Vec<u32> = locations.collect();
        if let Some(location) = locations.iter().find(|location| **location >= most) {
            let what =
                format!("uses location {location}; every device has {most} {what}, counted from 0");
            return self.refused(&what, &[]);
        }
        let all = locations.len() as u32 + taken;
        if all > most {
            let what =
                format!("uses {all} {what}, builtins that count included; every device has {most}");
            return self.refused(&what, &[]);
        }
        Ok(())
    }

    /// The bindings of arguments or results, those of structs one by one.
    fn bound(&self, values: &[(Handle<Type>, Option<&Binding>)]) -> Vec<Binding> {
        let mut found = Vec::new();
        for (ty, binding) in values {
            if let Some(binding) = binding {
                found.push((*binding).clone());
            } else if let TypeInner::Struct { members, .. } = &self.module.types[*ty].inner {
                found.extend(members.iter().filter_map(|member| member.binding.clone()));
            }
        }
        found
    }
}

/// Whether a builtin takes a place among a fragment shader's inputs.
fn takes_a_place(binding: &Binding) -> bool {
    use BuiltIn::{FrontFacing, SampleIndex, SampleMask};
    matches!(
        binding,
        Binding::BuiltIn(FrontFacing | SampleIndex | SampleMask)
    )
}
