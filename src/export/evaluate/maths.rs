//! Built-in functions, with the accuracy that WGSL asks for.

use naga::MathFunction as Function;

use super::{Rounding, Value};

pub(super) fn apply(
    function: Function,
    arguments: &[Value],
    rounding: &mut Rounding,
) -> Option<Value> {
    match (function, arguments) {
        (Function::Dot, [Value::Many(a), Value::Many(b)]) => {
            let mut sum = None;
            for pair in a.iter().zip(b) {
                let (Value::F(a), Value::F(b)) = pair else {
                    return None;
                };
                let product = rounding.multiply(*a, *b);
                sum = Some(sum.map_or(product, |sum| rounding.add(sum, product)));
            }
            sum.map(Value::F)
        }
        _ => Value::zip(arguments, &mut |it| of_scalars(function, it, rounding)),
    }
}

fn of_scalars(function: Function, arguments: &[&Value], rounding: &mut Rounding) -> Option<Value> {
    match arguments {
        [Value::F(x)] => of_one(function, *x, rounding).map(Value::F),
        [Value::F(x), Value::F(y)] => Some(Value::F(match function {
            Function::Min => x.min(*y),
            Function::Max => x.max(*y),
            Function::Pow => {
                let logarithm = logarithm(f64::from(*x), f64::from(*x).log2(), rounding);
                let power = rounding.multiply(*y, logarithm);
                exponential(f64::from(power), f64::from(power).exp2(), rounding)
            }
            _ => return None,
        })),
        [Value::F(x), Value::F(y), Value::F(z)] => Some(Value::F(match function {
            Function::Clamp => x.max(*y).min(*z),
            Function::Fma => rounding.fma(*x, *y, *z),
            Function::Mix => {
                let rest = rounding.add(1.0, -*z);
                let [first, second] = [rounding.multiply(*x, rest), rounding.multiply(*y, *z)];
                rounding.add(first, second)
            }
            _ => return None,
        })),
        [Value::U(x), Value::U(y)] => Some(Value::U(match function {
            Function::Min => *x.min(y),
            Function::Max => *x.max(y),
            _ => return None,
        })),
        [Value::U(x), Value::U(y), Value::U(z)] if function == Function::Clamp => {
            Some(Value::U((*x).max(*y).min(*z)))
        }
        _ => None,
    }
}

fn of_one(function: Function, x: f32, rounding: &mut Rounding) -> Option<f32> {
    let exact = f64::from(x);
    Some(match function {
        Function::Abs => x.abs(),
        Function::Saturate => x.clamp(0.0, 1.0),
        Function::Floor => x.floor(),
        Function::Ceil => x.ceil(),
        Function::Round => x.round_ties_even(),
        // One over the inverse square root.
        Function::Sqrt => rounding.within(exact.sqrt(), 4.5),
        Function::InverseSqrt => rounding.within(1.0 / exact.sqrt(), 2.0),
        Function::Exp => exponential(exact, exact.exp(), rounding),
        Function::Log => logarithm(exact, exact.ln(), rounding),
        Function::Sin => rounding.near(exact.sin(), SINE),
        Function::Cos => rounding.near(exact.cos(), SINE),
        _ => return None,
    })
}

/// How far sines may be off, within one turn.
const SINE: f64 = 1.0 / 2048.0;

fn exponential(x: f64, exact: f64, rounding: &mut Rounding) -> f32 {
    rounding.within(exact, 3.0 + 2.0 * x.abs())
}

fn logarithm(x: f64, exact: f64, rounding: &mut Rounding) -> f32 {
    if (0.5..=2.0).contains(&x) {
        rounding.near(exact, 2_f64.powi(-21))
    } else {
        rounding.within(exact, 3.0)
    }
}
