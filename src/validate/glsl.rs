//! GLSL that naga writes and that compilers of GLSL do not take.
//!
//! naga reports most of what a version of GLSL lacks. What it writes all the same is found here, in the module that it writes from.

use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{
    Binding, BuiltIn, EntryPoint, Expression, Function, Handle, ImageClass, ImageDimension,
    ImageQuery, MathFunction, Module, SampleLevel, ScalarKind, ShaderStage, Type, TypeInner,
};

use super::Backend;

/// Why a compiler refuses the text that naga writes of `entry_point` for `backend`, by what is to be changed in the shader. `None` for
/// backends that are no GLSL.
pub(super) fn objection(
    module: &Module,
    entry_point: &EntryPoint,
    info: &ModuleInfo,
    backend: Backend,
) -> Option<String> {
    let is_es = match backend {
        Backend::Glsl450 => false,
        Backend::GlslEs300 => true,
        _ => return None,
    };
    let is_it = |it: &EntryPoint| it.stage == entry_point.stage && it.name == entry_point.name;
    let index = module.entry_points.iter().position(is_it)?;
    // Its handles are those of this module, whatever module the caller's entry point is of.
    let entry_point = module.entry_points.get(index)?;
    let text = Text {
        module,
        info,
        entry_point,
        uses: info.get_entry_point(index),
        is_es,
    };
    text.of_interface()
        .or_else(|| text.of_variables())
        .or_else(|| text.of_functions())
        .or_else(|| text.of_extensions())
}

/// The text of an entry point.
struct Text<'a> {
    module: &'a Module,
    info: &'a ModuleInfo,
    entry_point: &'a EntryPoint,
    /// What the entry point uses, with all that it calls.
    uses: &'a FunctionInfo,
    /// Whether this is GLSL ES 3.00, or else GLSL 4.50.
    is_es: bool,
}

impl Text<'_> {
    /// What the entry point takes and returns.
    fn of_interface(&self) -> Option<String> {
        let function = &self.entry_point.function;
        let inputs = function.arguments.iter();
        let inputs = inputs.flat_map(|it| self.built_ins(it.binding.as_ref(), it.ty));
        let outputs = function.result.iter();
        let outputs = outputs.flat_map(|it| self.built_ins(it.binding.as_ref(), it.ty));
        let mut inputs = inputs.filter_map(|it| self.of_built_in(it, false));
        let mut outputs = outputs.filter_map(|it| self.of_built_in(it, true));
        inputs.next().or_else(|| outputs.next())
    }

    /// The built-in values among a value and its members.
    fn built_ins(&self, binding: Option<&Binding>, ty: Handle<Type>) -> Vec<BuiltIn> {
        let members = match &self.module.types[ty].inner {
            TypeInner::Struct { members, .. } => members.as_slice(),
            _ => &[],
        };
        let bindings = binding.into_iter();
        let bindings = bindings.chain(members.iter().filter_map(|it| it.binding.as_ref()));
        bindings
            .filter_map(|binding| match binding {
                Binding::BuiltIn(built_in) => Some(*built_in),
                Binding::Location { .. } => None,
            })
            .collect()
    }

    fn of_built_in(&self, built_in: BuiltIn, is_output: bool) -> Option<String> {
        let is_fragment = self.entry_point.stage == ShaderStage::Fragment;
        let (name, why) = match built_in {
            BuiltIn::SampleMask if self.is_es => {
                ("sample_mask", "GLSL ES 3.00 has only by an extension")
            }
            // It is an array in GLSL.
            BuiltIn::SampleMask => (
                "sample_mask",
                "naga writes as one number, and GLSL has an array",
            ),
            BuiltIn::SampleIndex if self.is_es => {
                ("sample_index", "GLSL ES 3.00 has only by an extension")
            }
            BuiltIn::PrimitiveIndex if self.is_es => {
                ("primitive_index", "GLSL ES 3.00 has only by an extension")
            }
            BuiltIn::ClipDistances if self.is_es => {
                ("clip_distances", "GLSL ES 3.00 has only by an extension")
            }
            BuiltIn::NumSubgroups => return self.of_subgroups("num_subgroups"),
            BuiltIn::SubgroupId => return self.of_subgroups("subgroup_id"),
            BuiltIn::SubgroupInvocationId => return self.of_subgroups("subgroup_invocation_id"),
            BuiltIn::SubgroupSize => return self.of_subgroups("subgroup_size"),
            // For ES 3.00, as WebGL has it, naga leaves the word out.
            BuiltIn::Position { invariant: true } if is_fragment && !is_output && !self.is_es => {
                let why = "which GLSL has for outputs only; leave it to the vertex shader";
                return Some(format!(
                    "the fragment shader's input is `@invariant`, {why}"
                ));
            }
            _ => return None,
        };
        Some(format!("it has `@builtin({name})`, which {why}"))
    }

    /// naga asks for the extension where an operation needs it.
    fn of_subgroups(&self, name: &str) -> Option<String> {
        let is_operation = |(_, expression): (_, &Expression)| {
            use Expression::{SubgroupBallotResult, SubgroupOperationResult};
            matches!(
                expression,
                SubgroupBallotResult | SubgroupOperationResult { .. }
            )
        };
        let mut all = self.all_functions();
        (!all.any(|(function, _)| function.expressions.iter().any(is_operation))).then(|| {
            format!("it has `@builtin({name})` without a subgroup operation, and naga leaves out the extension for it")
        })
    }

    /// Every function, written or not.
    fn all_functions(&self) -> impl Iterator<Item = (&Function, &FunctionInfo)> {
        let functions = self.module.functions.iter();
        functions
            .map(|(handle, function)| (function, &self.info[handle]))
            .chain([(&self.entry_point.function, self.uses)])
    }

    /// The textures that are used.
    fn of_variables(&self) -> Option<String> {
        let variables = self.module.global_variables.iter();
        let mut used = variables.filter(|(handle, _)| !self.uses[*handle].is_empty());
        used.find_map(|(_, variable)| self.of_multisampled(variable.ty))
    }

    fn of_multisampled(&self, ty: Handle<Type>) -> Option<String> {
        let class = match self.module.types[ty].inner {
            TypeInner::Image { class, .. } if self.is_es => class,
            _ => return None,
        };
        class
            .is_multisampled()
            .then(|| "a texture is multisampled, which GLSL ES 3.00 does not have".to_owned())
    }

    /// What naga writes beside the entry point: every function that uses no more resources, called or not.
    fn of_functions(&self) -> Option<String> {
        let functions = self.module.functions.iter();
        let mut written = functions.filter(|(handle, _)| {
            let info = &self.info[*handle];
            self.uses.dominates_global_use(info)
                && info.available_stages.contains(self.uses.available_stages)
        });
        self.of_function(&self.entry_point.function, self.uses)
            .or_else(|| {
                written.find_map(|(handle, function)| {
                    self.of_arguments(function)
                        .or_else(|| self.of_function(function, &self.info[handle]))
                })
            })
    }

    fn of_arguments(&self, function: &Function) -> Option<String> {
        let of_dimension = |ty: Handle<Type>| {
            let dim = match self.module.types[ty].inner {
                TypeInner::Image { dim, .. } => dim,
                _ => return None,
            };
            (self.is_es && dim == ImageDimension::D1).then(|| {
                "a function takes a 1D texture, which GLSL ES 3.00 does not have; let it use the variable"
                    .to_owned()
            })
        };
        let mut types = function.arguments.iter().map(|it| it.ty);
        types.find_map(|ty| self.of_multisampled(ty).or_else(|| of_dimension(ty)))
    }

    fn of_function(&self, function: &Function, info: &FunctionInfo) -> Option<String> {
        // What nothing uses and nothing names is not written.
        let mut written = function.expressions.iter().filter(|(handle, _)| {
            info[*handle].ref_count > 0 || function.named_expressions.contains_key(handle)
        });
        written.find_map(|(_, expression)| match *expression {
            Expression::Select { condition, accept, .. } => self.of_select(info, condition, accept),
            Expression::Math { fun, .. } => self.of_math(fun),
            Expression::ImageSample { image, gather, depth_ref, .. } => {
                let (dim, arrayed, class) = self.image(info, image)?;
                let is_depth = matches!(class, ImageClass::Depth { .. });
                self.of_sample(gather.is_some(), is_depth, depth_ref.is_some(), dim, arrayed)
            }
            Expression::ImageQuery { image, query: ImageQuery::NumLayers } => {
                let (_, _, class) = self.image(info, image)?;
                matches!(class, ImageClass::Storage { .. }).then(|| {
                    "it calls `textureNumLayers` of a storage texture, which naga writes with an argument too many".to_owned()
                })
            }
            _ => None,
        })
    }

    fn image(
        &self,
        info: &FunctionInfo,
        image: Handle<Expression>,
    ) -> Option<(ImageDimension, bool, ImageClass)> {
        match *info[image].ty.inner_with(&self.module.types) {
            TypeInner::Image {
                dim,
                arrayed,
                class,
            } => Some((dim, arrayed, class)),
            _ => None,
        }
    }

    fn of_select(
        &self,
        info: &FunctionInfo,
        condition: Handle<Expression>,
        accept: Handle<Expression>,
    ) -> Option<String> {
        let ty = |of: Handle<Expression>| info[of].ty.inner_with(&self.module.types);
        // By one condition it becomes `?:`.
        let by_component = matches!(ty(condition), TypeInner::Vector { .. });
        let is_float = ty(accept).scalar_kind() == Some(ScalarKind::Float);
        (self.is_es && by_component && !is_float).then(|| {
            "it has a `select` by component of integers or of truth values, which becomes `mix`, and GLSL ES 3.00 has that for floats \
             only; select each component"
                .to_owned()
        })
    }

    fn of_math(&self, function: MathFunction) -> Option<String> {
        let name = match function {
            MathFunction::CountOneBits => "countOneBits",
            MathFunction::CountTrailingZeros => "countTrailingZeros",
            MathFunction::Dot4I8Packed => "dot4I8Packed",
            MathFunction::Dot4U8Packed => "dot4U8Packed",
            MathFunction::ExtractBits => "extractBits",
            MathFunction::FirstLeadingBit => "firstLeadingBit",
            MathFunction::FirstTrailingBit => "firstTrailingBit",
            MathFunction::InsertBits => "insertBits",
            MathFunction::Ldexp => "ldexp",
            MathFunction::ReverseBits => "reverseBits",
            MathFunction::Unpack4xI8 => "unpack4xI8",
            MathFunction::Unpack4xU8 => "unpack4xU8",
            _ => return None,
        };
        self.is_es
            .then(|| format!("it calls `{name}`, for which GLSL ES 3.00 has no function"))
    }

    fn of_sample(
        &self,
        is_gather: bool,
        is_depth: bool,
        is_compared: bool,
        dim: ImageDimension,
        arrayed: bool,
    ) -> Option<String> {
        let is_cube = dim == ImageDimension::Cube;
        let is_layers = dim == ImageDimension::D2 && arrayed;
        let why = if is_gather && self.is_es {
            "it gathers texels, for which GLSL ES 3.00 has no function"
        } else if is_depth && !is_compared {
            "it samples a depth texture without comparing, which GLSL does not have; bind it as `texture_2d<f32>`"
        } else if is_gather && is_depth && (is_cube && !arrayed || is_layers) {
            "it calls `textureGatherCompare` of a cube or of layers, which naga writes with arguments too many"
        } else {
            return None;
        };
        Some(why.to_owned())
    }

    /// An extension that naga asks for by what any function does, written or not.
    fn of_extensions(&self) -> Option<String> {
        let mut all = self.all_functions();
        all.any(|(function, info)| {
            let mut expressions = function.expressions.iter();
            expressions.any(|(_, expression)| self.needs_shadow_lod(info, expression))
        })
        .then(|| {
            "it samples a depth texture of cubes or of layers at a level, or with a bias or an offset, for which GLSL has only an \
             extension (GL_EXT_texture_shadow_lod)"
                .to_owned()
        })
    }

    /// As naga decides it.
    fn needs_shadow_lod(&self, info: &FunctionInfo, expression: &Expression) -> bool {
        let Expression::ImageSample {
            image,
            level,
            offset,
            ..
        } = *expression
        else {
            return false;
        };
        let Some((dim, arrayed, ImageClass::Depth { .. })) = self.image(info, image) else {
            return false;
        };
        let is_cube = dim == ImageDimension::Cube;
        let is_layers = dim == ImageDimension::D2 && arrayed;
        let (is_bias, is_auto) = (
            matches!(level, SampleLevel::Bias(_)),
            level == SampleLevel::Auto,
        );
        let at_level = matches!(level, SampleLevel::Zero | SampleLevel::Exact(_));
        // Level zero is written with derivatives of zero.
        let by_derivatives = level == SampleLevel::Zero && (is_layers || is_cube && !arrayed);
        (is_layers || is_cube && arrayed) && is_bias
            || is_layers && offset.is_some() && (is_bias || self.is_es && is_auto)
            || (is_cube || is_layers) && at_level && !by_derivatives
    }
}
