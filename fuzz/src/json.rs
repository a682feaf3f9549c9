//! Mutations of JSON documents: of their structure, of their numbers and words, and of their text.

use serde_json::{Map, Number, Value, json};

use crate::Random;
use crate::text::mutate_bytes;

/// Changes an input `times` times: mostly by `change` within the structure of its document.
pub(crate) fn mutate_input(
    data: &[u8],
    seeds: &[Vec<u8>],
    times: usize,
    random: &mut Random,
    change: impl Fn(&mut Value, &mut Random),
) -> Vec<u8> {
    let mut data = data.to_vec();
    let mut left = times;
    while left > 0 {
        let Ok(mut document) = serde_json::from_slice::<Value>(&data) else {
            data = mutate_bytes(&data, seeds, random);
            left -= 1;
            continue;
        };
        // Until a change leaves no document.
        let mut is_whole = true;
        while is_whole && left > 0 {
            left -= 1;
            match random.below(16) {
                0 => {
                    data = mutate_bytes(document.to_string().as_bytes(), seeds, random);
                    is_whole = false;
                }
                1 => {
                    data = mutate_text(&document.to_string(), random).into_bytes();
                    is_whole = false;
                }
                _ => change(&mut document, random),
            }
        }
        if is_whole {
            return document.to_string().into_bytes();
        }
    }
    data
}

/// Strings that may stand where another one stands: those that mean something in the format, and some of the document.
struct Words<'a> {
    known: &'a [String],
    drawn: Vec<String>,
}

impl Words<'_> {
    fn pick(&self, random: &mut Random) -> String {
        let from = match random.below(2) {
            0 => &self.drawn,
            _ => self.known,
        };
        random.pick(from).cloned().unwrap_or_default()
    }
}

/// Changes one place of a document, or all that have one name. `known` are strings that mean something in the format.
pub(crate) fn mutate(document: &mut Value, known: &[String], random: &mut Random) {
    let count = count(document);
    let mut found = Vec::new();
    strings(document, &mut found);
    let drawn = (0..4).filter_map(|_| random.pick(&found).map(|&word| word.to_owned()));
    let drawn = drawn.collect();
    let words = &Words { known, drawn };
    if count == 0 || random.once_in(200) {
        *document = value(words, random);
        return;
    }
    let path = path(document, random.below(count));
    let other = self::path(document, random.below(count));
    let other = other
        .iter()
        .try_fold(&*document, |at, &child| children(at).nth(child))
        .cloned()
        .unwrap_or_default();
    let Some((&last, above)) = path.split_last() else {
        return;
    };
    let mut name = None;
    let mut parent = &mut *document;
    for &child in above {
        let next = match parent {
            Value::Array(items) => items.get_mut(child),
            Value::Object(fields) => fields.values_mut().nth(child),
            _ => None,
        };
        let Some(next) = next else { return };
        parent = next;
    }
    match parent {
        Value::Array(items) => mutate_item(items, last, other, words, random),
        Value::Object(fields) => {
            let key = fields.keys().nth(last).cloned().unwrap_or_default();
            mutate_field(fields, &key, other, words, random);
            let after = fields.get(&key).cloned();
            name = after.map(|after| (key, after));
        }
        _ => {}
    }
    if let Some((key, after)) = name
        && random.once_in(8)
    {
        set_all(document, &key, &after);
    }
}

/// Gives all fields of a name one value.
fn set_all(document: &mut Value, key: &str, to: &Value) {
    match document {
        Value::Array(items) => items.iter_mut().for_each(|item| set_all(item, key, to)),
        Value::Object(fields) => {
            for (name, field) in fields {
                if name == key {
                    *field = to.clone();
                } else {
                    set_all(field, key, to);
                }
            }
        }
        _ => {}
    }
}

/// What lies right within a value.
fn children(value: &Value) -> impl Iterator<Item = &Value> {
    let (items, fields) = match value {
        Value::Array(items) => (Some(items), None),
        Value::Object(fields) => (None, Some(fields)),
        _ => (None, None),
    };
    let items = items.into_iter().flatten();
    items.chain(fields.into_iter().flat_map(|fields| fields.values()))
}

/// How many values lie within a value.
fn count(value: &Value) -> usize {
    children(value).map(|child| 1 + count(child)).sum()
}

/// The way to value number `number` within a value.
fn path(value: &Value, mut number: usize) -> Vec<usize> {
    let mut path = Vec::new();
    walk(value, &mut number, &mut path);
    path
}

/// Whether the way ends within `value`.
fn walk(value: &Value, number: &mut usize, path: &mut Vec<usize>) -> bool {
    for (index, child) in children(value).enumerate() {
        path.push(index);
        if *number == 0 {
            return true;
        }
        *number -= 1;
        if walk(child, number, path) {
            return true;
        }
        path.pop();
    }
    false
}

fn mutate_item(
    items: &mut Vec<Value>,
    at: usize,
    other: Value,
    words: &Words<'_>,
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
            // Many of a kind; where they have names, each has its own. Very many take as long as hundreds of other inputs.
            let item = items[at].clone();
            let most = if random.once_in(16) { 2000 } else { 16 };
            for number in 0..random.count(most) {
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
    words: &Words<'_>,
    random: &mut Random,
) {
    match random.below(8) {
        0 => {
            fields.remove(name);
        }
        1 => {
            let key = words.pick(random);
            fields.insert(key, other);
        }
        2 => {
            let key = words.pick(random);
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
fn change(here: &mut Value, other: Value, words: &Words<'_>, random: &mut Random) {
    match here {
        Value::Number(number) if random.below(4) > 0 => *number = nearby(number, random),
        Value::String(text) if random.below(4) > 0 => {
            if random.once_in(3) {
                let span = random.span(text.len());
                if let (Some(before), Some(after)) = (text.get(..span.start), text.get(span.end..))
                {
                    let word = words.pick(random);
                    *text = format!("{before}{word}{after}");
                }
            } else {
                *text = words.pick(random);
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
fn value(words: &Words<'_>, random: &mut Random) -> Value {
    match random.below(9) {
        0 => Value::Null,
        1 => Value::Bool(random.once_in(2)),
        2 => json!([]),
        3 => json!({}),
        4 => (0..random.count(300))
            .map(|_| Value::Number(special_number(random)))
            .collect(),
        5 => json!("x".repeat(random.count(10_000))),
        6 | 7 => Value::Number(special_number(random)),
        _ => Value::String(words.pick(random)),
    }
}

/// All strings of a document, keys among them.
fn strings<'a>(value: &'a Value, found: &mut Vec<&'a str>) {
    match value {
        Value::String(text) => found.push(text),
        Value::Array(items) => items.iter().for_each(|item| strings(item, found)),
        Value::Object(fields) => {
            for (name, field) in fields {
                found.push(name);
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
