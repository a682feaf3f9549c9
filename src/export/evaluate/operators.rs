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

/// Functions whose results are known without running them, those of `maths` too.
#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that fails says where")]

    use crate::export::evaluate::{Machine, Rounding, Rule, Value};
    use crate::export::translate::parse;

    /// The words that the function of a text gives for words.
    fn run(text: &str, words: &[u32], rounding: Rounding) -> Vec<u32> {
        let module = parse(text).unwrap();
        let (handle, function) = module.functions.iter().next().unwrap();
        let mut words = words.iter().copied();
        let arguments = function.arguments.iter();
        let arguments = arguments.map(|it| Value::read(&module, it.ty, &mut words).unwrap());
        let arguments: Vec<Value> = arguments.collect();
        let value = Machine::new(&module, rounding).call(handle, &arguments);
        let mut given = Vec::new();
        value.unwrap().write(&mut given);
        given
    }

    fn exactly(text: &str, words: &[u32]) -> Vec<u32> {
        run(text, words, Rounding::new(Rule::Separate, 0))
    }

    #[test]
    fn integers_are_those_of_two_complements() {
        let (a, b) = (0b1100_u32, 0b1010_u32);
        for ty in ["u32", "i32"] {
            for (expression, expected) in [
                ("a | b", 0b1110),
                ("a & b", 0b1000),
                ("a ^ b", 0b0110),
                ("a + b", 22),
                ("b - a", u32::MAX - 1),
                ("a * b", 120),
                ("a << u32(b)", 12_288),
                ("a >> (u32(b) - 8u)", 3),
            ] {
                let text = format!("fn f(a: {ty}, b: {ty}) -> {ty} {{ return {expression}; }}");
                assert_eq!(exactly(&text, &[a, b]), [expected], "{ty}: {expression}");
            }
        }
        for (expression, expected) in [("a / b", 1), ("a % b", 2), ("~a", u32::MAX - 12)] {
            let text = format!("fn f(a: u32, b: u32) -> u32 {{ return {expression}; }}");
            assert_eq!(exactly(&text, &[a, b]), [expected], "{expression}");
        }
    }

    #[test]
    fn truth_values_have_the_tables_of_logic() {
        // For false and false, false and true, true and false, true and true.
        for (expression, table) in [
            ("a & b", [0, 0, 0, 1]),
            ("a && b", [0, 0, 0, 1]),
            ("a | b", [0, 1, 1, 1]),
            ("a || b", [0, 1, 1, 1]),
            ("a == b", [1, 0, 0, 1]),
            ("a != b", [0, 1, 1, 0]),
            ("!a", [1, 1, 0, 0]),
        ] {
            let text = format!("fn f(a: bool, b: bool) -> bool {{ return {expression}; }}");
            let found = [[0, 0], [0, 1], [1, 0], [1, 1]].map(|words| exactly(&text, &words)[0]);
            assert_eq!(found, table, "{expression}");
        }
        let text = "fn f(a: vec2<bool>, b: vec2<bool>) -> vec2<bool> { return a & b; }";
        assert_eq!(exactly(text, &[1, 1, 0, 1]), [0, 1]);
    }

    #[test]
    fn variables_are_zero_at_first() {
        let text = "fn f(a: u32) -> vec3u { var b: bool; var n: vec2u; return vec3u(select(a, 9u, b), n); }";
        assert_eq!(exactly(text, &[7]), [7, 0, 0]);
    }

    #[test]
    fn numbers_are_rounded_to_whole_ones_as_asked() {
        for (expression, x, expected) in [
            ("floor(x)", -1.25_f32, -2.0),
            ("ceil(x)", -1.25, -1.0),
            ("ceil(x)", 1.25, 2.0),
            ("round(x)", 2.5, 2.0),
            ("round(x)", 3.5, 4.0),
            ("abs(x)", -1.25, 1.25),
            ("saturate(x)", 1.5, 1.0),
            ("saturate(x)", -0.5, 0.0),
        ] {
            let text = format!("fn f(x: f32) -> f32 {{ return {expression}; }}");
            let found = f32::from_bits(exactly(&text, &[x.to_bits()])[0]);
            assert_eq!(found, expected, "{expression} of {x}");
        }
    }

    /// The WGSL specification, section 15.7.4, "Floating Point Accuracy": absolute errors, or units in the last place.
    #[test]
    fn results_are_as_far_off_as_is_allowed_and_no_farther() {
        let unit = |exact: f64| {
            let nearest = (exact as f32).abs();
            f64::from(nearest.next_up()) - f64::from(nearest)
        };
        let [log, exp, sqrt] = [10_f64.ln(), 1_f64.exp(), 2_f64.sqrt()];
        let inverse_sqrt = 1.0 / 3_f64.sqrt();
        for (expression, x, exact, allowed) in [
            ("log(x)", 1.5_f32, 1.5_f64.ln(), 2_f64.powi(-21)),
            ("log(x)", 10.0, log, 3.0 * unit(log)),
            ("exp(x)", 1.0, exp, 5.0 * unit(exp)),
            ("sin(x)", 1.0, 1_f64.sin(), 2_f64.powi(-11)),
            ("cos(x)", 1.0, 1_f64.cos(), 2_f64.powi(-11)),
            ("sqrt(x)", 2.0, sqrt, 4.5 * unit(sqrt)),
            (
                "inverseSqrt(x)",
                3.0,
                inverse_sqrt,
                2.0 * unit(inverse_sqrt),
            ),
            ("1.0 / x", 3.0, 1.0 / 3.0, 2.5 * unit(1.0 / 3.0)),
        ] {
            let text = format!("fn f(x: f32) -> f32 {{ return {expression}; }}");
            let errors = (1..=500).map(|seed| {
                let rounding = Rounding::new(Rule::Allowed, seed);
                let found = run(&text, &[x.to_bits()], rounding)[0];
                (f64::from(f32::from_bits(found)) - exact).abs()
            });
            let largest = errors.fold(0.0, f64::max);
            // The result is an f32.
            let most = allowed + 0.5 * unit(exact);
            assert!(
                (0.9 * allowed..=most).contains(&largest),
                "{expression}: {largest:e} of {allowed:e}"
            );
        }
    }
}
