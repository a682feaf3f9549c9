//! Whatever stands in a graph file, reading and compiling it ends with a graph or an error.

use moment_shadows_graph::Graph;
use proptest::prelude::*;
use serde_json::Value;

use crate::example::{TEXT, compiled, native, parse};

/// Reads and compiles; what comes out does not matter, that something does is the test.
fn try_out(text: &str) {
    match compiled(text, &native()) {
        Ok(plan) => {
            plan.check().unwrap();
            assert!(!plan.to_string().is_empty());
        }
        Err(error) => assert!(!error.message.is_empty() && !error.to_string().is_empty()),
    }
}

/// Values that appear where others stood.
fn value() -> impl Strategy<Value = Value> {
    prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::from),
        any::<i64>().prop_map(Value::from),
        any::<f64>().prop_map(Value::from),
        prop_oneof![
            Just(0),
            Just(1),
            Just(2),
            Just(64),
            Just(65),
            Just(65536),
            Just(u32::MAX)
        ]
        .prop_map(Value::from),
        prop_oneof![
            Just("resolve.map"),
            Just("blur.blurred"),
            Just("blur.map"),
            Just("camera_depth"),
            Just("shade"),
            Just("."),
            Just(""),
            Just("a.b.c"),
            Just("float16"),
            Just("rgba32float"),
            Just("resolve"),
            Just("\u{0}")
        ]
        .prop_map(Value::from),
        Just(serde_json::json!([])),
        Just(serde_json::json!({})),
        Just(serde_json::json!([[1, 2], {"name": "x"}])),
        Just(serde_json::json!({"format": "depth32float", "size": [16, 16], "samples": 4})),
        Just(serde_json::json!({"radius": 64, "sigma": 1e-30})),
        Just(serde_json::json!({"weights": [1e38, 1e38, 1e-45]})),
    ]
}

/// The places of a document, depth first.
fn places(value: &Value, here: &str, all: &mut Vec<String>) {
    all.push(here.to_owned());
    match value {
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                places(item, &format!("{here}/{index}"), all);
            }
        }
        Value::Object(fields) => {
            for (name, field) in fields {
                places(field, &format!("{here}/{name}"), all);
            }
        }
        _ => {}
    }
}

/// What is done to a place: its value replaced, removed, or repeated in its array.
#[derive(Clone, Debug)]
enum Change {
    Replace(Value),
    Remove,
    Repeat,
}

fn change() -> impl Strategy<Value = Change> {
    prop_oneof![
        3 => value().prop_map(Change::Replace),
        1 => Just(Change::Remove),
        1 => Just(Change::Repeat),
    ]
}

fn apply(document: &mut Value, place: usize, change: Change) {
    let mut all = Vec::new();
    places(document, "", &mut all);
    let path = all[place % all.len()].clone();
    let Some((parent, last)) = path.rsplit_once('/') else {
        if let Change::Replace(value) = change {
            *document = value;
        }
        return;
    };
    let parent = document.pointer_mut(parent).unwrap();
    match (parent, change) {
        (Value::Array(items), Change::Remove) => {
            items.remove(last.parse::<usize>().unwrap());
        }
        (Value::Array(items), Change::Repeat) => {
            let item = items[last.parse::<usize>().unwrap()].clone();
            items.push(item);
        }
        (Value::Array(items), Change::Replace(value)) => {
            items[last.parse::<usize>().unwrap()] = value
        }
        (Value::Object(fields), Change::Remove) => {
            fields.remove(last);
        }
        (Value::Object(fields), Change::Replace(value)) => {
            fields.insert(last.to_owned(), value);
        }
        _ => {}
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn any_text_is_read_or_refused(text in any::<String>()) {
        let _: Result<Graph, _> = parse(&text);
    }

    #[test]
    fn any_text_within_the_example_is_read_or_refused(at in 0..TEXT.len(), length in 0_usize..40, insert in "[ -~\\n\u{e4}\u{1f312}]{0,12}") {
        let mut text = TEXT.to_owned();
        let end = (at + length).min(TEXT.len());
        text.replace_range(at..end, &insert);
        try_out(&text);
    }

    #[test]
    fn any_change_of_the_examples_structure_is_compiled_or_refused(
        changes in proptest::collection::vec((any::<usize>(), change()), 1..4),
    ) {
        let mut document: Value = serde_json::from_str(TEXT).unwrap();
        for (place, change) in changes {
            apply(&mut document, place, change);
        }
        try_out(&document.to_string());
    }
}
