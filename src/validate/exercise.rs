//! Entry points for text without any, so that every backend translates every function as a shader would call it.

use core::fmt::Write;

use naga::common::wgsl::TypeContext;
use naga::valid::Capabilities;
use naga::{AddressSpace, Module, TypeInner};

use super::backend::Shader;
use super::compiler::{self, Compiled};

/// `text`, of which `compiled` was made, with an entry point per function that does nothing but call it: in a fragment shader, or
/// in a compute shader where a function is only valid there. If that cannot be, `compiled` as it was, with the reason.
pub(super) fn exercise(text: &str, compiled: Compiled, capabilities: Capabilities) -> Shader {
    let module = &compiled.module;
    let fragment = exercised(text, module, "@fragment", capabilities);
    fragment
        .or_else(|_| exercised(text, module, "@compute @workgroup_size(1)", capabilities))
        .unwrap_or_else(|reason| Shader {
            compiled,
            no_entry_point: Some(reason),
        })
}

fn exercised(
    text: &str,
    module: &Module,
    stage: &str,
    capabilities: Capabilities,
) -> Result<Shader, String> {
    let text = text.to_owned() + &entry_points(module, stage)?;
    let refused = |error| format!("no entry point can call every function: {error}");
    let module =
        compiler::parse(&text, capabilities).map_err(|error| refused(error.to_string()))?;
    let info =
        compiler::check(&module, capabilities).map_err(|error| refused(error.to_string()))?;
    Ok(Shader {
        compiled: Compiled { module, info },
        no_entry_point: None,
    })
}

/// HLSL keeps group indices in a byte; no device has as many groups.
const UNUSED_GROUP: u32 = 200;

/// An entry point per function, with the textures and samplers that they give it in a bind group that the text does not use.
fn entry_points(module: &Module, stage: &str) -> Result<String, String> {
    if module.functions.is_empty() {
        return Err("the text has neither functions nor entry points".to_owned());
    }
    let types = module.to_ctx();
    let mut text = String::new();
    let mut bindings = 0..;
    for (index, (_, function)) in module.functions.iter().enumerate() {
        let name = |name: &Option<String>| name.clone().unwrap_or_default();
        let callee = name(&function.name);
        let mut variables = String::new();
        let mut arguments = Vec::new();
        for argument in &function.arguments {
            let variable = format!("exercise_{index}_{}", arguments.len());
            let ty = types.type_to_string(argument.ty);
            let inner = &module.types[argument.ty].inner;
            // Writing to a string cannot fail.
            arguments.push(
                if matches!(inner, TypeInner::Image { .. } | TypeInner::Sampler { .. }) {
                    let binding = bindings.next().unwrap_or_default();
                    let place = format!("@group({UNUSED_GROUP}) @binding({binding})");
                    let _ = writeln!(text, "{place} var {variable}: {ty};");
                    variable
                } else if let TypeInner::Pointer { base, space } = *inner {
                    if space != AddressSpace::Function {
                        return Err(format!(
                            "no value can be made up for `{}` of function `{callee}`; validate a shader that calls it",
                            name(&argument.name),
                        ));
                    }
                    let base = types.type_to_string(base);
                    let _ = write!(variables, "var {variable}: {base}; ");
                    format!("&{variable}")
                } else {
                    format!("{ty}()")
                },
            );
        }
        let result = function.result.as_ref().map_or("", |_| "_ = ");
        let call = format!("{result}{callee}({})", arguments.join(", "));
        let _ = writeln!(
            text,
            "{stage} fn exercise_{index}() {{ {variables}{call}; }}"
        );
    }
    Ok(text)
}
