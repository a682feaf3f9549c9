//! Entry points for text without any, so that every backend translates every function as a shader would call it.

use naga::valid::{Capabilities, ModuleInfo};
use naga::{
    AddressSpace, ArraySize, Block, EntryPoint, Expression, Function, GlobalVariable, Handle,
    LocalVariable, Module, ResourceBinding, ShaderStage, Span, Statement, Type, TypeInner,
};

use super::backend::Shader;

/// `module` with an entry point per function that does nothing but call it: in a fragment shader, or in a compute shader
/// where a function is only valid there. If no argument can be made for a function, `module` as it was, with the reason.
pub(super) fn exercise(module: &Module, info: ModuleInfo, capabilities: Capabilities) -> Shader {
    let mut failure = String::from("the text has neither functions nor entry points");
    if !module.functions.is_empty() {
        for stage in [ShaderStage::Fragment, ShaderStage::Compute] {
            let exercised = match with_entry_points(module, stage) {
                Ok(exercised) => exercised,
                Err(reason) => {
                    failure = reason;
                    break;
                }
            };
            match super::check(&exercised, capabilities) {
                Ok(info) => {
                    return Shader {
                        module: exercised,
                        info,
                        no_entry_point: None,
                    };
                }
                Err(error) => failure = format!("no entry point can call every function: {error}"),
            }
        }
    }
    Shader {
        module: module.clone(),
        info,
        no_entry_point: Some(failure),
    }
}

fn with_entry_points(module: &Module, stage: ShaderStage) -> Result<Module, String> {
    let mut exercised = module.clone();
    for (index, (callee, function)) in module.functions.iter().enumerate() {
        let caller = call(module, &mut exercised, callee, function)?;
        exercised.entry_points.push(EntryPoint {
            name: format!("exercise_{index}"),
            stage,
            early_depth_test: None,
            workgroup_size: if stage == ShaderStage::Compute {
                [1; 3]
            } else {
                [0; 3]
            },
            workgroup_size_overrides: None,
            function: caller,
            mesh_info: None,
            task_payload: None,
            incoming_ray_payload: None,
        });
    }
    Ok(exercised)
}

/// A function that calls `callee`, and the resources that it needs in `exercised`.
fn call(
    module: &Module,
    exercised: &mut Module,
    callee: Handle<Function>,
    function: &Function,
) -> Result<Function, String> {
    let mut caller = Function::default();
    let mut arguments = Vec::new();
    for argument in &function.arguments {
        let inner = &module.types[argument.ty].inner;
        let expression = if matches!(inner, TypeInner::Image { .. } | TypeInner::Sampler { .. }) {
            Expression::GlobalVariable(resource(exercised, argument.ty))
        } else if let TypeInner::Pointer {
            base,
            space: AddressSpace::Function,
        } = *inner
            && is_value(module, base)
        {
            let local = LocalVariable {
                name: None,
                ty: base,
                init: None,
            };
            Expression::LocalVariable(caller.local_variables.append(local, Span::UNDEFINED))
        } else if is_value(module, argument.ty) {
            Expression::ZeroValue(argument.ty)
        } else {
            let of = |name: &Option<String>| name.clone().unwrap_or_default();
            return Err(format!(
                "no value can be made up for `{}` of function `{}`; validate a shader that calls it",
                of(&argument.name),
                of(&function.name),
            ));
        };
        arguments.push(caller.expressions.append(expression, Span::UNDEFINED));
    }
    let result = function.result.is_some().then(|| {
        let result = Expression::CallResult(callee);
        caller.expressions.append(result, Span::UNDEFINED)
    });
    let call = Statement::Call {
        function: callee,
        arguments,
        result,
    };
    caller.body = Block::from_vec(vec![call, Statement::Return { value: None }]);
    Ok(caller)
}

/// A new texture or sampler, in a bind group that the text does not use.
fn resource(module: &mut Module, ty: Handle<Type>) -> Handle<GlobalVariable> {
    let binding = u32::try_from(module.global_variables.len()).unwrap_or(u32::MAX);
    let variable = GlobalVariable {
        name: Some(format!("exercise_resource_{binding}")),
        space: AddressSpace::Handle,
        binding: Some(ResourceBinding {
            group: UNUSED_GROUP,
            binding,
        }),
        ty,
        init: None,
        memory_decorations: naga::MemoryDecorations::empty(),
    };
    module.global_variables.append(variable, Span::UNDEFINED)
}

/// HLSL keeps group indices in a byte; no device has as many groups.
const UNUSED_GROUP: u32 = 200;

/// Whether a value of the type can be a zero.
fn is_value(module: &Module, ty: Handle<Type>) -> bool {
    let inner = &module.types[ty].inner;
    if let TypeInner::Array { base, size, .. } = inner {
        return matches!(size, ArraySize::Constant(_)) && is_value(module, *base);
    }
    if let TypeInner::Struct { members, .. } = inner {
        return members.iter().all(|member| is_value(module, member.ty));
    }
    matches!(
        inner,
        TypeInner::Scalar(_) | TypeInner::Vector { .. } | TypeInner::Matrix { .. }
    )
}
