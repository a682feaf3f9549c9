//! Mutations of JSON documents: of their structure, of their numbers and words, and of their text.

use serde_json::{Map, Number, Value, json};

use crate::Random;

/// Changes one place of a document. `words` are strings that mean something in the format.
pub(crate) fn mutate(document: &mut Value, words: &[String], random: &mut Random) {
    let places = places(document);
    let Some(place) = random.pick(&places) else {
        return;
    };
    let other = random
        .pick(&places)
        .and_then(|place| document.pointer(place))
        .cloned()
        .unwrap_or_default();
    let Some((parent, last)) = place.rsplit_once('/') else {
        if random.once_in(20) {
            *document = value(words, random);
        }
        return;
    };
    let last = last.replace("~1", "/").replace("~0", "~");
    let Some(parent) = document.pointer_mut(parent) else {
        return;
    };
    match parent {
        Value::Array(items) => {
            let at = last.parse().unwrap_or(0).min(items.len());
            mutate_item(items, at, other, words, random);
        }
        Value::Object(fields) => mutate_field(fields, &last, other, words, random),
        _ => {}
    }
}

fn mutate_item(
    items: &mut Vec<Value>,
    at: usize,
    other: Value,
    words: &[String],
    random: &mut Random,
) {
    if at >= items.len() {
        return;
    }
    match random.below(8) {
        0 => {
            items.remove(at);
        }
        1 => items.insert(at, items[at].clone()),
        2 => {
            let to = random.below(items.len());
            items.swap(at, to);
        }
        3 => items.insert(at, other),
        4 => {
            // Many of a kind; where they have names, each has its own.
            let item = items[at].clone();
            for number in 0..random.count(2000) {
                let mut copy = item.clone();
                if let Some(Value::String(name)) = copy.get_mut("name") {
                    *name += &number.to_string();
                }
                items.push(copy);
            }
        }
        _ => change(&mut items[at], other, words, random),
    }
}

fn mutate_field(
    fields: &mut Map<String, Value>,
    name: &str,
    other: Value,
    words: &[String],
    random: &mut Random,
) {
    match random.below(8) {
        0 => {
            fields.remove(name);
        }
        1 => {
            let key = random.pick(words).cloned().unwrap_or_default();
            fields.insert(key, other);
        }
        2 => {
            let key = random.pick(words).cloned().unwrap_or_default();
            if let Some(field) = fields.remove(name) {
                fields.insert(key, field);
            }
        }
        _ => {
            if let Some(field) = fields.get_mut(name) {
                change(field, other, words, random);
            }
        }
    }
}

/// Changes a value in place.
fn change(here: &mut Value, other: Value, words: &[String], random: &mut Random) {
    match here {
        Value::Number(number) if random.below(4) > 0 => *number = nearby(number, random),
        Value::String(text) if random.below(4) > 0 => {
            if random.once_in(3) {
                let span = random.span(text.len());
                if let (Some(before), Some(after)) = (text.get(..span.start), text.get(span.end..))
                {
                    let word = random.pick(words).cloned().unwrap_or_default();
                    *text = format!("{before}{word}{after}");
                }
            } else {
                *text = random.pick(words).cloned().unwrap_or_default();
            }
        }
        _ => {
            *here = match random.below(3) {
                0 => other,
                1 => nested(here, random),
                _ => value(words, random),
            }
        }
    }
}

/// The value within many brackets.
fn nested(value: &Value, random: &mut Random) -> Value {
    let in_object = random.once_in(2);
    (0..random.count(160)).fold(value.clone(), |inner, _| {
        if in_object {
            json!({ "x": inner })
        } else {
            json!([inner])
        }
    })
}

/// A number that a limit may lie next to, or one next to `number`.
fn nearby(number: &Number, random: &mut Random) -> Number {
    let whole = number.as_i64().unwrap_or(0);
    let changed = match random.below(7) {
        0 => whole.wrapping_add(1),
        1 => whole.wrapping_sub(1),
        2 => whole.wrapping_neg(),
        3 => whole.wrapping_mul(2),
        4 => whole ^ (1 << random.below(63)),
        _ => return special_number(random),
    };
    Number::from(changed)
}

fn special_number(random: &mut Random) -> Number {
    const REAL: &str = "-0.0 0.5 -1.0 -2.0 1e-300 5e-324 1e-45 1e-30 3.0e38 3.5e38 1e300 -1e300 2147483648.5 4294967296.0";
    if random.once_in(2) {
        // Limits are powers of two, and 0; mistakes are next to them.
        let limit = 1_u64 << random.below(64);
        return Number::from(limit.wrapping_add([0, 1, u64::MAX][random.below(3)]));
    }
    let words: Vec<&str> = REAL.split(' ').collect();
    let real = random.word(&words).parse().unwrap_or(0.0);
    Number::from_f64(real).unwrap_or(Number::from(0))
}

/// A value of any kind.
fn value(words: &[String], random: &mut Random) -> Value {
    match random.below(9) {
        0 => Value::Null,
        1 => Value::Bool(random.once_in(2)),
        2 => json!([]),
        3 => json!({}),
        4 => (0..random.count(300))
            .map(|_| Value::Number(special_number(random)))
            .collect(),
        5 => json!("x".repeat(random.count(100_000))),
        6 | 7 => Value::Number(special_number(random)),
        _ => Value::String(random.pick(words).cloned().unwrap_or_default()),
    }
}

/// JSON pointers to all places of a document.
fn places(value: &Value) -> Vec<String> {
    // The mutations keep documents flatter than serde_json's own limit, but they stack.
    const MOST: usize = 4000;
    let mut all = vec![(String::new(), value)];
    let mut next = 0;
    while let Some((here, value)) = all.get(next).cloned() {
        match value {
            Value::Array(items) => all.extend(
                items
                    .iter()
                    .enumerate()
                    .map(|(index, item)| (format!("{here}/{index}"), item)),
            ),
            Value::Object(fields) => all.extend(fields.iter().map(|(name, field)| {
                let name = name.replace('~', "~0").replace('/', "~1");
                (format!("{here}/{name}"), field)
            })),
            _ => {}
        }
        next += 1;
        if all.len() > MOST {
            break;
        }
    }
    all.into_iter().map(|(place, _)| place).collect()
}

/// All strings of a document, keys among them.
pub(crate) fn strings(value: &Value, found: &mut Vec<String>) {
    match value {
        Value::String(text) => found.push(text.clone()),
        Value::Array(items) => items.iter().for_each(|item| strings(item, found)),
        Value::Object(fields) => {
            for (name, field) in fields {
                found.push(name.clone());
                strings(field, found);
            }
        }
        _ => {}
    }
}

/// Changes the text where no document could be: keys that occur twice, numbers that JSON does not know, brackets
/// without end, and so on.
pub(crate) fn mutate_text(text: &str, random: &mut Random) -> String {
    const WORDS: &str = r#"NaN Infinity - 1e999 -1e999 0x10 1_000 00 1. "\ud800" "\u0000""#;
    let mut breaks: Vec<usize> = text
        .match_indices([',', ':', '{', '[', '}', ']'])
        .map(|(at, _)| at)
        .collect();
    breaks.push(text.len());
    let at = *random.pick(&breaks).unwrap_or(&0);
    let until = *random.pick(&breaks).unwrap_or(&0);
    let (at, until) = (at.min(until), at.max(until));
    let insert = match random.below(8) {
        0 => ", \"name\": \"twice\"".to_owned(),
        1 => random.word(&WORDS.split(' ').collect::<Vec<_>>()),
        2 => "[".repeat(random.count(100_000)),
        3 => "{\"a\":".repeat(random.count(100_000)),
        4 => " ".repeat(random.count(100_000)),
        5 => "9".repeat(random.count(100_000)),
        6 => text.get(at..until).unwrap_or_default().to_owned(),
        _ => return format!("{}{}", &text[..at], &text[until..]),
    };
    format!("{}{insert}{}", &text[..at], &text[at..])
}
