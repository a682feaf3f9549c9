//! A plan that was read from a file: where the parameters of later layers lie.

use moment_shadows::{DepthConversion, MapRegion};
use moment_shadows_graph::Plan;
use serde_json::{Value, json};

use crate::example::{TEXT, compiled, native};

/// The example with three layers, as the text of a plan.
fn file() -> Value {
    let text = TEXT.replace("\"samples\": 4", "\"layers\": 3");
    serde_json::to_value(compiled(&text, &native()).unwrap()).unwrap()
}

fn read(file: &Value) -> Plan {
    serde_json::from_str(&file.to_string()).unwrap()
}

/// A number of the file, as a recorder in another language reads it.
fn number(value: &Value) -> usize {
    value.as_u64().unwrap().try_into().unwrap()
}

#[test]
fn parameters_of_a_later_layer_lie_where_the_file_says() {
    let file = file();
    let plan = read(&file);
    plan.check().unwrap();
    let conversion = DepthConversion::orthographic().reversed();
    let region = MapRegion::new([16, 32], [64, 128]);
    for layer in 0..3 {
        let mut expected = plan.parameters.initial();
        let mut block = expected.clone();
        let mut put = |place: &Value, bytes: &[u8]| {
            let at = number(&place["offset"]) + layer * number(&place["stride"]);
            expected[at..at + bytes.len()].copy_from_slice(bytes);
        };
        put(
            &file["parameters"]["blocks"][0],
            bytemuck::bytes_of(&conversion),
        );
        put(
            &file["parameters"]["regions"][0],
            bytemuck::bytes_of(&region),
        );
        let number = layer as u32;
        let layout = &plan.parameters;
        layout
            .write(&mut block, "resolve", number, &conversion)
            .unwrap();
        layout
            .write_regions(&mut block, "light_depth", number, &[region])
            .unwrap();
        // Thousands of bytes, which nobody reads.
        assert!(block == expected, "layer {layer}");
    }
}

#[test]
fn later_layers_beyond_the_block_are_refused() {
    let whole = file();
    let size = number(&whole["parameters"]["size"]);
    let ends = |kind: &str| -> (usize, usize) {
        let place = &whole["parameters"][kind][0];
        (number(&place["offset"]), number(&place["stride"]))
    };
    // With this stride the third layer, and no other, begins where the block ends.
    let beyond = |kind: &str| (size - ends(kind).0).div_ceil(2);
    let with = |kind: &str, name: &str, value: usize| {
        let mut file = file();
        file["parameters"][kind][0][name] = json!(value);
        let plan = read(&file);
        // Values that do not fit are left out, without a panic.
        let _ = plan.parameters.initial();
        plan.check()
    };
    for kind in ["blocks", "regions"] {
        let count = if kind == "blocks" { "count" } else { "layers" };
        assert_eq!(with(kind, "stride", ends(kind).1), Ok(()));
        let more = (size - ends(kind).0) / ends(kind).1 + 1;
        for (name, value) in [("stride", beyond(kind)), (count, more)] {
            let error = with(kind, name, value).unwrap_err();
            let what = match kind {
                "blocks" => "parameters of node 'resolve'",
                _ => "regions of map 'light_depth'",
            };
            let says = format!("the {what} do not lie within a view's block");
            assert!(
                error.message.starts_with(&says),
                "{name} = {value} of {kind}: {error}"
            );
        }
    }
}
