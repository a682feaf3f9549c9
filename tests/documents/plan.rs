//! The schema of plans and the plan that is kept as an example of them: what the code makes, and one takes the other.

use moment_shadows::Profile;
use moment_shadows_graph::{Capabilities, Graph, NodeRegistry, Plan};
use serde_json::{Value, json};

use crate::{kept, read};

/// The plan of a graph file on every device.
fn plan(file: &str) -> Plan {
    let graph = Graph::parse(&read(file), &NodeRegistry::new()).unwrap();
    let device = Capabilities::of_profile(Profile::WebgpuCore);
    graph.compile(&device, &[]).unwrap()
}

#[test]
fn the_schema_is_that_of_the_code() {
    let text = serde_json::to_string_pretty(&Plan::schema()).unwrap();
    kept("graph/plan.schema.json", &format!("{text}\n"));
}

#[test]
fn the_example_is_what_the_compiler_makes() {
    let mut plan = plan("examples/hard_shadows.json");
    plan.compact().unwrap();
    let text = serde_json::to_string_pretty(&plan).unwrap();
    kept("graph/plan.example.json", &format!("{text}\n"));
    let read: Plan = serde_json::from_str(&read("graph/plan.example.json")).unwrap();
    read.check().unwrap();
    assert_eq!(read, plan);
}

#[test]
fn the_schema_takes_plans_and_refuses_what_is_none() {
    let schema = jsonschema::validator_for(&Plan::schema()).unwrap();
    for file in [
        "hard_shadows",
        "soft_shadows",
        "volumetric_scattering",
        "forward_shading",
        "translucent",
    ] {
        let plan = serde_json::to_value(plan(&format!("examples/{file}.json"))).unwrap();
        let taken = schema.validate(&plan).map_err(|error| error.to_string());
        assert_eq!(taken, Ok(()), "{file}");
    }
    let plan = serde_json::to_value(plan("examples/hard_shadows.json")).unwrap();
    type Change = fn(&mut Value);
    let changes: [Change; 6] = [
        |plan| plan["version"] = json!(2),
        |plan| plan["colour"] = json!(1),
        |plan| plan["shaders"] = json!([1]),
        |plan| plan["passes"][0]["bindings"][0]["layout"] = json!({ "buffers": {} }),
        |plan| plan["passes"][0]["bindings"][1]["layout"]["texture"]["sampleType"] = json!("sint"),
        |plan| plan["memory"][0]["usage"] = json!(["COPY"]),
    ];
    for (number, change) in changes.iter().enumerate() {
        let mut wrong = plan.clone();
        change(&mut wrong);
        assert!(!schema.is_valid(&wrong), "change {number}");
        assert!(
            serde_json::from_value::<Plan>(wrong)
                .map(|plan| plan.check().is_err())
                .unwrap_or(true)
        );
    }
}
