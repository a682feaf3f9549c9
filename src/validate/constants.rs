//! Constants among the arguments of builtin functions, where WGSL has no result for some (WGSL specification, section 17). naga looks at
//! those of constant expressions only.

use naga::{
    ArraySize, Expression, Function, Handle, ImageClass, ImageDimension, Literal, MathFunction,
    Module, SampleLevel, ScalarKind, TypeInner,
};

use naga::valid::{FunctionInfo, ModuleInfo};

use super::{bitcast, lets};
use crate::{Linked, Rule, ShaderError};

/// Calls with constants for which there is no result.
pub(super) fn check(module: &Module, info: &ModuleInfo, linked: &Linked) -> Vec<ShaderError> {
    let functions = module.functions.iter();
    let functions = functions.map(|(handle, function)| (function, &info[handle]));
    let entry_points = module.entry_points.iter().enumerate();
    let entry_points = entry_points.map(|(index, it)| (&it.function, info.get_entry_point(index)));
    let mut found = Vec::new();
    for (function, info) in functions.chain(entry_points) {
        let call = Call {
            module,
            function,
            info,
            linked,
        };
        for (handle, expression) in function.expressions.iter() {
            let objection = call.objection(handle, expression);
            let objection =
                objection.or_else(|| bitcast::objection(module, function, info, linked, handle));
            if let Some(message) = objection {
                let range = function.expressions.get_span(handle).to_range();
                found.push(ShaderError {
                    rule: Rule::Constant,
                    message,
                    places: range
                        .and_then(|range| linked.location(range))
                        .into_iter()
                        .collect(),
                    notes: Vec::new(),
                });
            }
        }
    }
    found
}

/// The largest 16-bit float.
const HALF_MAX: f64 = 65_504.0;

struct Call<'a> {
    module: &'a Module,
    function: &'a Function,
    info: &'a FunctionInfo,
    linked: &'a Linked,
}

impl Call<'_> {
    fn objection(&self, handle: Handle<Expression>, expression: &Expression) -> Option<String> {
        match expression {
            Expression::Math {
                fun,
                arg,
                arg1,
                arg2,
                arg3,
            } => self.of_math(*fun, *arg, [*arg1, *arg2, *arg3]),
            Expression::ImageSample {
                image,
                offset,
                gather,
                level,
                ..
            } => {
                let by_gradient = matches!(level, SampleLevel::Gradient { .. });
                self.of_sample(handle, *image, *offset, gather.is_some(), by_gradient)
            }
            Expression::As {
                expr,
                kind: ScalarKind::Float,
                convert: None,
            } => {
                let from = self.info[*expr].ty.inner_with(&self.module.types);
                let kind = from.scalar_kind()?;
                if !matches!(kind, ScalarKind::Uint | ScalarKind::Sint) {
                    return None;
                }
                let bits = self.constant(*expr)?;
                let is_finite = |bits: &f64| f32::from_bits(*bits as i64 as u32).is_finite();
                let message =
                    "the bits are no finite number, and constants are finite; make it at run time";
                (!bits.iter().all(is_finite)).then(|| message.to_owned())
            }
            _ => None,
        }
    }

    fn of_math(
        &self,
        function: MathFunction,
        first: Handle<Expression>,
        others: [Option<Handle<Expression>>; 3],
    ) -> Option<String> {
        let [second, third, fourth] = others.map(|it| self.constant(it?));
        let bits = |offset: Vec<f64>, count: Vec<f64>| {
            let (offset, count) = (offset.first()?, count.first()?);
            (offset + count > 32.0).then(|| {
                format!("{count} bits from bit {offset} on are more than the 32 that a number has")
            })
        };
        match function {
            MathFunction::ExtractBits => bits(second?, third?),
            MathFunction::InsertBits => bits(third?, fourth?),
            MathFunction::Clamp => {
                let (low, high) = (second?, third?);
                let exchanged = low.iter().zip(&high).find(|(low, high)| low > high);
                exchanged.map(|(low, high)| {
                    format!("`clamp` has the low end {low} above the high end {high}")
                })
            }
            MathFunction::SmoothStep => {
                let (low, high) = (self.constant(first)?, second?);
                let equal = low.iter().zip(&high).find(|(low, high)| low == high);
                equal.map(|(edge, _)| format!("both edges of `smoothstep` are {edge}"))
            }
            MathFunction::QuantizeToF16 | MathFunction::Pack2x16float => {
                let values = self.constant(first)?;
                let large = values.iter().find(|value| value.abs() > HALF_MAX)?;
                Some(format!(
                    "{large} is no 16-bit float, of which {HALF_MAX} is the largest"
                ))
            }
            MathFunction::Unpack2x16float => {
                let bits = *self.constant(first)?.first()? as u32;
                let is_finite = |half: u32| half & 0x7c00 != 0x7c00;
                let message = "the bits hold a 16-bit float that is no finite number";
                (!is_finite(bits) || !is_finite(bits >> 16)).then(|| message.to_owned())
            }
            MathFunction::Ldexp => {
                let exponents = second?;
                let large = exponents.iter().find(|exponent| **exponent > 128.0);
                large.map(|exponent| {
                    format!("`ldexp` has the exponent {exponent}, and 128 is the largest")
                })
            }
            _ => None,
        }
    }

    fn of_sample(
        &self,
        handle: Handle<Expression>,
        image: Handle<Expression>,
        offset: Option<Handle<Expression>>,
        gathers: bool,
        by_gradient: bool,
    ) -> Option<String> {
        let (name, ty) = match self.function.expressions[image] {
            Expression::GlobalVariable(variable) => {
                let variable = &self.module.global_variables[variable];
                (variable.name.as_deref(), variable.ty)
            }
            Expression::FunctionArgument(index) => {
                let argument = self.function.arguments.get(index as usize)?;
                (argument.name.as_deref(), argument.ty)
            }
            _ => return None,
        };
        let TypeInner::Image { dim, class, .. } = self.module.types[ty].inner else {
            return None;
        };
        if dim == ImageDimension::Cube && offset.is_some() {
            return Some("samples of cube textures have no offset".to_owned());
        }
        if dim == ImageDimension::D1 && (offset.is_some() || by_gradient) {
            return Some(
                "samples of textures of one dimension have neither offset nor gradients".to_owned(),
            );
        }
        if by_gradient && matches!(class, ImageClass::Depth { .. }) {
            return Some("`textureSampleGrad` does not take depth textures".to_owned());
        }
        if gathers
            && matches!(class, ImageClass::Depth { .. })
            && name != self.first_argument(handle)
        {
            return Some("`textureGather` of a depth texture takes no component; its first argument is the texture".to_owned());
        }
        let outside = self
            .constant(offset?)?
            .into_iter()
            .find(|it| !(-8.0..=7.0).contains(it));
        outside.map(|it| format!("the offset {it} is not from -8 to 7"))
    }

    /// The first argument of a call as it stands in the text.
    fn first_argument(&self, call: Handle<Expression>) -> Option<&str> {
        let range = self.function.expressions.get_span(call).to_range()?;
        let (_, arguments) = self.linked.wgsl().get(range.start..)?.split_once('(')?;
        Some(arguments.split(',').next()?.trim())
    }

    /// The components of an expression that is a constant. 32 bits of any kind are exact. A `let` is none, whatever its value is, and naga
    /// makes no difference.
    fn constant(&self, handle: Handle<Expression>) -> Option<Vec<f64>> {
        let text = self.linked.wgsl();
        let range = self.function.expressions.get_span(handle).to_range();
        let named = lets::named(self.function, handle, text);
        if named
            .or_else(|| lets::within(self.function, range, text))
            .is_some()
        {
            return None;
        }
        self.value(&self.function.expressions, handle)
    }

    fn value(
        &self,
        expressions: &naga::Arena<Expression>,
        handle: Handle<Expression>,
    ) -> Option<Vec<f64>> {
        match &expressions[handle] {
            Expression::Literal(literal) => number(*literal).map(|number| vec![number]),
            Expression::Constant(constant) => {
                let init = self.module.constants[*constant].init;
                self.value(&self.module.global_expressions, init)
            }
            Expression::ZeroValue(ty) => match self.module.types[*ty].inner {
                TypeInner::Scalar(_) => Some(vec![0.0]),
                TypeInner::Vector { size, .. } => Some(vec![0.0; size as usize]),
                _ => None,
            },
            Expression::Splat { size, value } => {
                let one = *self.value(expressions, *value)?.first()?;
                Some(vec![one; *size as usize])
            }
            Expression::Compose { ty, components } => {
                let is_vector = matches!(self.module.types[*ty].inner, TypeInner::Vector { .. });
                let all = components.iter().map(|it| self.value(expressions, *it));
                let all: Option<Vec<Vec<f64>>> = all.collect();
                all.filter(|_| is_vector).map(|all| all.concat())
            }
            _ => None,
        }
    }
}

fn number(literal: Literal) -> Option<f64> {
    match literal {
        Literal::F32(value) => Some(value.into()),
        Literal::U32(value) => Some(value.into()),
        Literal::I32(value) => Some(value.into()),
        Literal::AbstractInt(value) => Some(value as f64),
        Literal::AbstractFloat(value) | Literal::F64(value) => Some(value),
        Literal::F16(value) => Some(value.into()),
        _ => None,
    }
}

/// The number of an array's elements, if it is known.
pub(super) fn array_length(size: ArraySize) -> Option<u32> {
    match size {
        ArraySize::Constant(count) => Some(count.get()),
        ArraySize::Pending(_) | ArraySize::Dynamic => None,
    }
}
