//! Limits on what backends write. They write a value out, number by number, wherever a variable starts as zero or an array is
//! loaded as a whole; and GLSL has one text for each entry point.

use naga::proc::TypeResolution;
use naga::valid::ModuleInfo;
use naga::{AddressSpace, ArraySize, Handle, Module, Span, Type, TypeInner};

use super::ValidateError;
use crate::{Linked, Location};

/// The most numbers in one value, such as a variable of a function or of a workgroup: 64 KiB of them. What lies in
/// buffers may be larger, as long as it is not loaded as a whole.
pub const LARGEST_VALUE: u64 = 16_384;

/// The most numbers in all values of a shader that are not scalars, vectors or matrices.
pub const MOST_VALUES: u64 = 1 << 20;

/// The most expressions of a shader, counted once for each entry point: each that the text has, or, in a text without any,
/// one made for each function.
pub const MOST_EXPRESSIONS: u64 = 1 << 24;

/// The most numbers of a matrix. The number of values this small is not limited.
const SMALL: u64 = 16;

/// Refuses a valid module with a value that is too large, or with too many large ones.
pub(super) fn refuse_large(
    linked: &Linked,
    module: &Module,
    info: &ModuleInfo,
) -> Result<(), ValidateError> {
    let mut total = Total {
        linked,
        numbers: Vec::new(),
        sum: 0,
    };
    // Types come after those that they are made of.
    for (_, ty) in module.types.iter() {
        let numbers = total.of(&ty.inner);
        total.numbers.push(numbers);
    }
    for (handle, constant) in module.constants.iter() {
        total.add(constant.ty, module.constants.get_span(handle))?;
    }
    for (handle, variable) in module.global_variables.iter() {
        let is_value = matches!(
            variable.space,
            AddressSpace::Private | AddressSpace::WorkGroup
        );
        if is_value {
            total.add(variable.ty, module.global_variables.get_span(handle))?;
        }
    }
    let functions = module
        .functions
        .iter()
        .map(|(handle, function)| (function, &info[handle]));
    let entry_points = module
        .entry_points
        .iter()
        .enumerate()
        .map(|(index, entry_point)| (&entry_point.function, info.get_entry_point(index)));
    let entry_point_count = match module.entry_points.len() {
        0 => module.functions.len(),
        count => count,
    };
    let mut expressions = 0;
    for (function, info) in functions.chain(entry_points) {
        for (handle, variable) in function.local_variables.iter() {
            total.add(variable.ty, function.local_variables.get_span(handle))?;
        }
        for (handle, _) in function.expressions.iter() {
            let numbers = match &info[handle].ty {
                TypeResolution::Handle(ty) => total.of_type(*ty),
                TypeResolution::Value(inner) => total.of(inner),
            };
            let span = function.expressions.get_span(handle);
            total.count(numbers, span)?;
            expressions += entry_point_count as u64;
            if expressions > MOST_EXPRESSIONS {
                let what = "expressions, counted once for each entry point";
                return Err(total.refused(MOST_EXPRESSIONS, what, span));
            }
        }
    }
    Ok(())
}

struct Total<'a> {
    linked: &'a Linked,
    /// For each type, how many numbers a value of it has.
    numbers: Vec<u64>,
    sum: u64,
}

impl Total<'_> {
    fn of_type(&self, ty: Handle<Type>) -> u64 {
        self.numbers.get(ty.index()).copied().unwrap_or_default()
    }

    /// A pointer, a texture or an array without a fixed size is not a value.
    fn of(&self, inner: &TypeInner) -> u64 {
        match inner {
            TypeInner::Scalar(_) | TypeInner::Atomic(_) => 1,
            TypeInner::Vector { size, .. } => u64::from(*size as u8),
            TypeInner::Matrix { columns, rows, .. } => u64::from(*columns as u8 * *rows as u8),
            TypeInner::Array {
                base,
                size: ArraySize::Constant(size),
                ..
            } => self.of_type(*base).saturating_mul(u64::from(size.get())),
            TypeInner::Struct { members, .. } => members
                .iter()
                .map(|member| self.of_type(member.ty))
                .fold(0, u64::saturating_add),
            _ => 0,
        }
    }

    fn add(&mut self, ty: Handle<Type>, span: Span) -> Result<(), ValidateError> {
        self.count(self.of_type(ty), span)
    }

    fn count(&mut self, numbers: u64, span: Span) -> Result<(), ValidateError> {
        if numbers > LARGEST_VALUE {
            return Err(self.refused(LARGEST_VALUE, "numbers in one value", span));
        }
        if numbers > SMALL {
            self.sum += numbers;
        }
        if self.sum > MOST_VALUES {
            return Err(self.refused(MOST_VALUES, "numbers in all arrays and structs", span));
        }
        Ok(())
    }

    fn refused(&self, limit: u64, what: &'static str, span: Span) -> ValidateError {
        let range = span.to_range().unwrap_or_default();
        let at = self.linked.location(range.clone());
        let in_text = || Location::in_text("", self.linked.wgsl(), range);
        ValidateError::TooMany {
            limit: limit as usize,
            what,
            at: Box::new(at.unwrap_or_else(in_text)),
        }
    }
}
