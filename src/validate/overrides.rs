//! Overrides: values for those that have no default, as whoever makes a pipeline gives them.

use std::borrow::Cow;

use naga::back::PipelineConstants;
use naga::back::pipeline_constants::{PipelineConstantError, process_overrides};
use naga::valid::ModuleInfo;
use naga::{Handle, Module, Override};

use super::compiler::Compiled;
use crate::{Linked, Rule, ShaderError};

/// Values for the overrides without a default, all alike: 1 is a legal workgroup size, array length and factor, and where it makes a
/// divisor zero another does not. Where none will do they get different ones.
const ALIKE: [f64; 5] = [1.0, 2.0, 3.0, 16.0, 0.0];

/// Ways to give each of so many overrides a value, by its index.
const DIFFERENT: [fn(usize, usize) -> f64; 2] = [
    |index, _| index as f64 + 1.0,
    |index, count| (count - index) as f64,
];

/// The module with values in place of overrides, the first with which it is valid.
pub(super) fn given<'a>(
    compiled: &'a Compiled,
    linked: &Linked,
) -> Result<(Cow<'a, Module>, Cow<'a, ModuleInfo>), ShaderError> {
    let module = &compiled.module;
    let missing: Vec<(Handle<Override>, &Override)> = module
        .overrides
        .iter()
        .filter(|(_, of)| of.init.is_none())
        .collect();
    let process = |value: &dyn Fn(usize) -> f64| {
        let constants = missing.iter().enumerate();
        let constants: PipelineConstants = constants
            .filter_map(|(index, (_, of))| Some((key(of)?, value(index))))
            .collect();
        process_overrides(module, &compiled.info, None, &constants).map_err(Box::new)
    };
    let first = match process(&|_| ALIKE[0]) {
        Ok(processed) => return Ok(processed),
        Err(error) => error,
    };
    if missing.is_empty() {
        return Err(refused(linked, module, &missing, &first));
    }
    let alike = ALIKE.into_iter().skip(1).map(|value| process(&|_| value));
    let count = missing.len();
    let different = DIFFERENT
        .iter()
        .map(|of| process(&|index| of(index, count)));
    let mut tried = alike.chain(different);
    tried
        .find_map(Result::ok)
        .ok_or_else(|| refused(linked, module, &missing, &first))
}

/// By what a pipeline names an override.
fn key(of: &Override) -> Option<String> {
    match of.id {
        Some(id) => Some(id.to_string()),
        None => of.name.clone(),
    }
}

fn refused(
    linked: &Linked,
    module: &Module,
    missing: &[(Handle<Override>, &Override)],
    error: &PipelineConstantError,
) -> ShaderError {
    let place = |handle: Handle<Override>| {
        let range = module.overrides.get_span(handle).to_range()?;
        linked.location(range)
    };
    let names: Vec<_> = missing
        .iter()
        .map(|(_, of)| format!("`{}`", of.name.as_deref().unwrap_or_default()))
        .collect();
    if names.is_empty() {
        let all = module.overrides.iter();
        // naga evaluates a side of `&&` and `||` that is left out.
        let is_left_out = |handle: Handle<Override>| {
            let range = module.overrides.get_span(handle).to_range();
            let text = range.and_then(|range| linked.wgsl().get(range.start..));
            let declaration = text.and_then(|text| text.split(';').next());
            declaration.is_some_and(|it| it.contains("&&") || it.contains("||"))
        };
        let mut declared = module.overrides.iter();
        let not_yet = error.to_string().starts_with("Not implemented")
            || declared.any(|(handle, _)| is_left_out(handle));
        return ShaderError {
            rule: if not_yet {
                Rule::Unsupported
            } else {
                Rule::Override
            },
            message: format!("an override's default leaves the shader without a value: {error}"),
            places: all.filter_map(|(handle, _)| place(handle)).collect(),
            notes: Vec::new(),
        };
    }
    ShaderError {
        rule: Rule::Override,
        message: format!(
            "no value was found with which the shader is valid for the overrides without a default, {}; give them one",
            names.join(", ")
        ),
        places: missing
            .iter()
            .filter_map(|(handle, _)| place(*handle))
            .collect(),
        notes: vec![format!(
            "{ALIKE:?} were tried, and different ones; the first gives: {error}"
        )],
    }
}
