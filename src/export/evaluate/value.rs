//! What functions take and give.

use naga::{ArraySize, Handle, Literal, Module, ScalarKind, Type, TypeInner};

/// A value of a type in WGSL: vectors, matrices by columns, arrays and structs are values of several.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::export) enum Value {
    F(f32),
    U(u32),
    I(i32),
    B(bool),
    Many(Vec<Value>),
    /// A variable by its number, and the parts of parts that are meant.
    Pointer(usize, Vec<usize>),
}

impl Value {
    pub(super) fn of_literal(literal: Literal) -> Option<Self> {
        Some(match literal {
            Literal::F32(it) => Value::F(it),
            Literal::U32(it) => Value::U(it),
            Literal::I32(it) => Value::I(it),
            Literal::Bool(it) => Value::B(it),
            _ => return None,
        })
    }

    pub(super) fn of_bits(bits: u32, kind: ScalarKind) -> Self {
        match kind {
            ScalarKind::Float => Value::F(f32::from_bits(bits)),
            ScalarKind::Sint => Value::I(bits.cast_signed()),
            ScalarKind::Bool => Value::B(bits != 0),
            _ => Value::U(bits),
        }
    }

    /// The bits of a scalar.
    pub(super) fn bits(&self) -> Option<u32> {
        Some(match self {
            Value::F(it) => it.to_bits(),
            Value::U(it) => *it,
            Value::I(it) => it.cast_unsigned(),
            Value::B(it) => u32::from(*it),
            Value::Many(_) | Value::Pointer(..) => return None,
        })
    }

    pub(super) fn bool(&self) -> Option<bool> {
        match self {
            Value::B(it) => Some(*it),
            _ => None,
        }
    }

    pub(super) fn zero(module: &Module, ty: Handle<Type>) -> Option<Self> {
        let mut none = std::iter::repeat(0);
        Self::read(module, ty, &mut none)
    }

    /// The value of a type whose scalars have the next of `bits`, in order.
    pub(in crate::export) fn read(
        module: &Module,
        ty: Handle<Type>,
        bits: &mut impl Iterator<Item = u32>,
    ) -> Option<Self> {
        let mut several = |types: &mut dyn Iterator<Item = Handle<Type>>| {
            let parts = types.map(|ty| Self::read(module, ty, bits));
            Some(Value::Many(parts.collect::<Option<_>>()?))
        };
        match &module.types[ty].inner {
            TypeInner::Scalar(scalar) => Some(Self::of_bits(bits.next()?, scalar.kind)),
            TypeInner::Vector { size, scalar } => {
                let parts =
                    (0..*size as usize).map(|_| Some(Self::of_bits(bits.next()?, scalar.kind)));
                Some(Value::Many(parts.collect::<Option<_>>()?))
            }
            TypeInner::Array {
                base,
                size: ArraySize::Constant(count),
                ..
            } => several(&mut std::iter::repeat_n(*base, count.get() as usize)),
            TypeInner::Struct { members, .. } => several(&mut members.iter().map(|it| it.ty)),
            _ => None,
        }
    }

    /// Adds the bits of all scalars.
    pub(in crate::export) fn write(&self, bits: &mut Vec<u32>) {
        match self {
            Value::Many(parts) => parts.iter().for_each(|part| part.write(bits)),
            scalar => bits.extend(scalar.bits()),
        }
    }

    /// A part of a value; of a pointer, the pointer to that part.
    pub(super) fn part(&self, index: usize) -> Option<Self> {
        match self {
            Value::Many(parts) => parts.get(index).cloned(),
            Value::Pointer(variable, path) => {
                let path = path.iter().copied().chain([index]);
                Some(Value::Pointer(*variable, path.collect()))
            }
            _ => None,
        }
    }

    /// What a pointer points to.
    pub(super) fn place<'a>(&self, variables: &'a mut [Value]) -> Option<&'a mut Value> {
        let Value::Pointer(variable, path) = self else {
            return None;
        };
        let mut place = variables.get_mut(*variable)?;
        for index in path {
            let Value::Many(parts) = place else {
                return None;
            };
            place = parts.get_mut(*index)?;
        }
        Some(place)
    }

    /// A function of each scalar.
    pub(super) fn map(&self, of: &mut dyn FnMut(&Value) -> Option<Value>) -> Option<Value> {
        match self {
            Value::Many(parts) => {
                let parts = parts.iter().map(|part| part.map(of));
                Some(Value::Many(parts.collect::<Option<_>>()?))
            }
            scalar => of(scalar),
        }
    }

    /// A function of the scalars at the same place of all `values`; a scalar beside a vector counts for each of its components.
    pub(super) fn zip(
        values: &[Value],
        of: &mut dyn FnMut(&[&Value]) -> Option<Value>,
    ) -> Option<Value> {
        let count = values.iter().find_map(|value| match value {
            Value::Many(parts) => Some(parts.len()),
            _ => None,
        });
        let at = |value: &'_ Value, index: usize| match value {
            Value::Many(parts) => parts.get(index).cloned(),
            scalar => Some(scalar.clone()),
        };
        let Some(count) = count else {
            let scalars: Vec<&Value> = values.iter().collect();
            return of(&scalars);
        };
        let parts = (0..count).map(|index| {
            let parts = values.iter().map(|value| at(value, index));
            let parts: Vec<Value> = parts.collect::<Option<_>>()?;
            Value::zip(&parts, of)
        });
        Some(Value::Many(parts.collect::<Option<_>>()?))
    }
}
