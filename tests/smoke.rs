#[test]
fn smoke() {
    use moment_shadows_graph::*;
    let graph = Graph::parse(
        include_str!("../examples/hard_shadows.json"),
        &NodeRegistry::new(),
    )
    .unwrap();
    let plan = compile(
        &graph,
        &Capabilities::of_profile(moment_shadows::Profile::Native),
        &Imports::new(),
    )
    .map_err(|e| e.to_string())
    .unwrap();
    println!("{plan}");
    println!("{}", plan.passes[3].wgsl);
}
