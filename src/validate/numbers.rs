//! Numbers without a type (WGSL specification, section 6.2.1, "Abstract Numeric Types") that fit the type they get. naga wraps and rounds
//! them.

use naga::{Arena, Expression, Literal, Module};

use crate::link::tokens::{Kind, tokens};
use crate::{Linked, Rule, ShaderError};

/// Values that naga holds for others than those of the text.
pub(super) fn check(module: &Module, linked: &Linked) -> Vec<ShaderError> {
    let functions = module
        .functions
        .iter()
        .map(|(_, function)| &function.expressions);
    let entry_points = module
        .entry_points
        .iter()
        .map(|it| &it.function.expressions);
    let all = functions
        .chain(entry_points)
        .chain([&module.global_expressions]);
    all.flat_map(|expressions| of(expressions, linked))
        .collect()
}

fn of(expressions: &Arena<Expression>, linked: &Linked) -> Vec<ShaderError> {
    let mut found = Vec::new();
    for (handle, expression) in expressions.iter() {
        let Some(range) = expressions.get_span(handle).to_range() else {
            continue;
        };
        let Some(value) = linked.wgsl().get(range.clone()).and_then(value) else {
            continue;
        };
        let (fits, ty) = match (expression, value) {
            (Expression::Literal(Literal::I32(_)), Number::Int(value)) => {
                (i32::try_from(value).is_ok(), "i32")
            }
            (Expression::Literal(_), Number::Int(value))
                if bitcast_to(linked.wgsl().get(..range.start)).is_some() =>
            {
                match bitcast_to(linked.wgsl().get(..range.start)) {
                    Some("i32") => (i32::try_from(value).is_ok(), "i32"),
                    _ => (
                        u32::try_from(value).is_ok() || i32::try_from(value).is_ok(),
                        "u32",
                    ),
                }
            }
            // naga makes a u32 of an integer that is no i32, or an f32.
            (Expression::Literal(Literal::U32(_) | Literal::F32(_)), Number::Int(value))
                if is_untyped(linked.wgsl().get(..range.start)) =>
            {
                (i32::try_from(value).is_ok(), "i32")
            }
            (Expression::Literal(Literal::U32(_)), Number::Int(value)) => {
                (u32::try_from(value).is_ok(), "u32")
            }
            (Expression::Literal(Literal::F32(_)), value) => {
                (value.float().abs() <= f32::MAX.into(), "f32")
            }
            _ => continue,
        };
        if !fits {
            found.push(ShaderError {
                rule: Rule::Constant,
                message: format!("the value {value} is beyond those of `{ty}`"),
                places: linked.location(range).into_iter().collect(),
                notes: Vec::new(),
            });
        }
    }
    found
}

/// Whether a number after `before` gets the type that it has by itself: it is the value of `let`, `var`, `override` or `_` without a type,
/// or stands among such numbers in the constructor of a vector or array that is.
fn is_untyped(before: Option<&str>) -> bool {
    let tokens = before.and_then(|before| {
        let statement = before.rfind([';', '{', '}']).map_or(0, |end| end + 1);
        tokens(before.get(statement..)?).ok()
    });
    let mut rest = tokens.as_deref().unwrap_or_default();
    // The numbers before it, up to the constructor's bracket.
    let mut constructor = rest;
    while let [head @ .., last] = constructor
        && (last.kind == Kind::Number && value(last.text).is_some() || last.is_symbol(","))
    {
        constructor = head;
    }
    if let [head @ .., name, open] = constructor
        && open.is_symbol("(")
        && matches!(name.text, "vec2" | "vec3" | "vec4" | "array")
    {
        rest = head;
    }
    match rest {
        [.., keyword, _, equals] if equals.is_symbol("=") => {
            matches!(keyword.text, "let" | "var" | "override")
        }
        [name, equals] => name.text == "_" && equals.is_symbol("="),
        _ => false,
    }
}

/// The type that `bitcast<T>(` gives a number after `before`.
fn bitcast_to(before: Option<&str>) -> Option<&'static str> {
    let before = before?.trim_end().strip_suffix('(')?.trim_end();
    ["i32", "u32"]
        .into_iter()
        .find(|ty| before.ends_with(&format!("bitcast<{ty}>")))
}

/// A number without a type.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Number {
    Int(i64),
    Float(f64),
}

impl Number {
    fn float(self) -> f64 {
        match self {
            Number::Int(value) => value as f64,
            Number::Float(value) => value,
        }
    }
}

impl core::fmt::Display for Number {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Number::Int(value) => write!(f, "{value}"),
            Number::Float(value) => write!(f, "{value:e}"),
        }
    }
}

/// The value of a text of numbers without a type, operators, and brackets. `None` for any other.
fn value(text: &str) -> Option<Number> {
    // Anything longer is no sum of numbers that somebody wrote.
    const LONGEST: usize = 200;
    if text.len() > LONGEST {
        return None;
    }
    let mut reader = Reader { rest: text };
    let value = reader.bits()?;
    reader.rest.trim().is_empty().then_some(value)
}

struct Reader<'a> {
    rest: &'a str,
}

impl Reader<'_> {
    fn take(&mut self, symbols: &[char]) -> Option<char> {
        self.rest = self.rest.trim_start();
        let first = self.rest.chars().next().filter(|it| symbols.contains(it))?;
        self.rest = self.rest.get(first.len_utf8()..)?;
        Some(first)
    }

    /// Shifts and bitwise operators, which stand beside no others without brackets.
    fn bits(&mut self) -> Option<Number> {
        let mut value = self.sum()?;
        while let Some(symbol) = self.take(&['<', '>', '&', '|', '^']) {
            if matches!(symbol, '<' | '>') && self.take(&[symbol]).is_none() {
                return None;
            }
            let (Number::Int(a), Number::Int(b)) = (value, self.sum()?) else {
                return None;
            };
            value = Number::Int(match symbol {
                '<' => {
                    let by = u32::try_from(b).ok().filter(|by| *by < 64)?;
                    // Bits that are lost are an error of naga's.
                    i64::try_from(i128::from(a) << by).ok()?
                }
                '>' => a.checked_shr(u32::try_from(b).ok()?)?,
                '&' => a & b,
                '|' => a | b,
                _ => a ^ b,
            });
        }
        Some(value)
    }

    fn sum(&mut self) -> Option<Number> {
        let mut value = self.product()?;
        while let Some(symbol) = self.take(&['+', '-']) {
            let other = self.product()?;
            value = match (symbol, value, other) {
                ('+', Number::Int(a), Number::Int(b)) => Number::Int(a.checked_add(b)?),
                (_, Number::Int(a), Number::Int(b)) => Number::Int(a.checked_sub(b)?),
                ('+', a, b) => Number::Float(a.float() + b.float()),
                (_, a, b) => Number::Float(a.float() - b.float()),
            };
        }
        Some(value)
    }

    fn product(&mut self) -> Option<Number> {
        let mut value = self.sign()?;
        while let Some(symbol) = self.take(&['*', '/', '%']) {
            let other = self.sign()?;
            value = match (symbol, value, other) {
                ('*', Number::Int(a), Number::Int(b)) => Number::Int(a.checked_mul(b)?),
                ('/', Number::Int(a), Number::Int(b)) => Number::Int(a.checked_div(b)?),
                (_, Number::Int(a), Number::Int(b)) => Number::Int(a.checked_rem(b)?),
                ('*', a, b) => Number::Float(a.float() * b.float()),
                ('/', a, b) => Number::Float(a.float() / b.float()),
                (_, a, b) => Number::Float(a.float() % b.float()),
            };
        }
        Some(value)
    }

    fn sign(&mut self) -> Option<Number> {
        if self.take(&['-']).is_some() {
            return match self.sign()? {
                Number::Int(value) => Some(Number::Int(value.checked_neg()?)),
                Number::Float(value) => Some(Number::Float(-value)),
            };
        }
        if self.take(&['(']).is_some() {
            let value = self.bits()?;
            self.take(&[')'])?;
            return Some(value);
        }
        self.number()
    }

    /// A decimal number, or a hexadecimal integer. Any other form, and any suffix, is left to naga.
    fn number(&mut self) -> Option<Number> {
        self.rest = self.rest.trim_start();
        let mut end = 0;
        let mut before = ' ';
        for c in self.rest.chars() {
            let is_sign = matches!(c, '+' | '-') && matches!(before, 'e' | 'E');
            if !(c.is_ascii_alphanumeric() || c == '.' || is_sign) {
                break;
            }
            before = c;
            end += 1;
        }
        let text = self.rest.get(..end)?;
        self.rest = self.rest.get(end..)?;
        if !text.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            return None;
        }
        if let Some(digits) = text.strip_prefix("0x").or(text.strip_prefix("0X")) {
            return i64::from_str_radix(digits, 16).ok().map(Number::Int);
        }
        match text.parse::<i64>() {
            Ok(value) => Some(Number::Int(value)),
            Err(_) => text.parse::<f64>().ok().map(Number::Float),
        }
    }
}
