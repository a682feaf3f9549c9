//! Operators and conversions of scalars.

use naga::{BinaryOperator as Operator, ScalarKind, UnaryOperator};

use super::{Rounding, Value};

pub(super) fn unary(op: UnaryOperator, value: &Value) -> Option<Value> {
    Some(match (op, value) {
        (UnaryOperator::Negate, Value::F(it)) => Value::F(-it),
        (UnaryOperator::Negate, Value::I(it)) => Value::I(it.wrapping_neg()),
        (UnaryOperator::LogicalNot, Value::B(it)) => Value::B(!it),
        (UnaryOperator::BitwiseNot, Value::U(it)) => Value::U(!it),
        _ => return None,
    })
}

pub(super) fn binary(
    op: Operator,
    left: &Value,
    right: &Value,
    rounding: &mut Rounding,
) -> Option<Value> {
    Some(match (left, right) {
        (Value::F(a), Value::F(b)) => match op {
            Operator::Add => Value::F(rounding.add(*a, *b)),
            Operator::Subtract => Value::F(rounding.add(*a, -*b)),
            Operator::Multiply => Value::F(rounding.multiply(*a, *b)),
            Operator::Divide => Value::F(rounding.divide(*a, *b)),
            _ => Value::B(compared(op, a, b)?),
        },
        (Value::U(a), Value::U(b)) => match op {
            Operator::Add => Value::U(a.wrapping_add(*b)),
            Operator::Subtract => Value::U(a.wrapping_sub(*b)),
            Operator::Multiply => Value::U(a.wrapping_mul(*b)),
            Operator::Divide => Value::U(a.checked_div(*b)?),
            Operator::Modulo => Value::U(a.checked_rem(*b)?),
            Operator::And => Value::U(a & b),
            Operator::InclusiveOr => Value::U(a | b),
            Operator::ExclusiveOr => Value::U(a ^ b),
            Operator::ShiftLeft => Value::U(a.wrapping_shl(*b)),
            Operator::ShiftRight => Value::U(a.wrapping_shr(*b)),
            _ => Value::B(compared(op, a, b)?),
        },
        (Value::I(a), Value::I(b)) => match op {
            Operator::Add => Value::I(a.wrapping_add(*b)),
            Operator::Subtract => Value::I(a.wrapping_sub(*b)),
            Operator::Multiply => Value::I(a.wrapping_mul(*b)),
            Operator::And => Value::I(a & b),
            Operator::InclusiveOr => Value::I(a | b),
            Operator::ExclusiveOr => Value::I(a ^ b),
            _ => Value::B(compared(op, a, b)?),
        },
        (Value::I(a), Value::U(b)) => match op {
            Operator::ShiftLeft => Value::I(a.wrapping_shl(*b)),
            Operator::ShiftRight => Value::I(a.wrapping_shr(*b)),
            _ => return None,
        },
        (Value::B(a), Value::B(b)) => Value::B(match op {
            Operator::LogicalAnd | Operator::And => *a && *b,
            Operator::LogicalOr | Operator::InclusiveOr => *a || *b,
            Operator::Equal => a == b,
            Operator::NotEqual | Operator::ExclusiveOr => a != b,
            _ => return None,
        }),
        _ => return None,
    })
}

fn compared<T: PartialOrd>(op: Operator, a: &T, b: &T) -> Option<bool> {
    Some(match op {
        Operator::Equal => a == b,
        Operator::NotEqual => a != b,
        Operator::Less => a < b,
        Operator::LessEqual => a <= b,
        Operator::Greater => a > b,
        Operator::GreaterEqual => a >= b,
        _ => return None,
    })
}

pub(super) fn converted(value: &Value, kind: ScalarKind) -> Option<Value> {
    let number = match value {
        Value::F(it) => f64::from(*it),
        Value::U(it) => f64::from(*it),
        Value::I(it) => f64::from(*it),
        Value::B(it) => f64::from(u8::from(*it)),
        _ => return None,
    };
    Some(match kind {
        ScalarKind::Float => Value::F(number as f32),
        ScalarKind::Uint => Value::U(number as u32),
        ScalarKind::Sint => Value::I(number as i32),
        ScalarKind::Bool => Value::B(number != 0.0),
        _ => return None,
    })
}
