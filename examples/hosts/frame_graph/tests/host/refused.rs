use std::collections::HashMap;

use moment_shadows_frame_graph::adapter::{Host, Inputs, add_plan};
use moment_shadows_frame_graph::device::Pipelines;
use moment_shadows_frame_graph::error::HostError;
use moment_shadows_frame_graph::gpu::Gpu;
use moment_shadows_frame_graph::variants::without;
use moment_shadows_graph::Plan;
use nightshade_renderer::rendergraph::{
    RenderGraph, render_graph_external_color, render_graph_new,
};

use crate::{gpu, plan};

/// What is wrong with adding a plan so many times, with so many textures for each import.
fn refused(
    gpu: &Gpu,
    plan: &Plan,
    pipelines: &Pipelines,
    textures: usize,
    times: u32,
) -> HostError {
    let mut graph: RenderGraph<Inputs> = render_graph_new();
    let parameters = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(plan.parameters.size),
        usage: wgpu::BufferUsages::UNIFORM,
        mapped_at_creation: false,
    });
    let mut imports = HashMap::new();
    for import in &plan.imports {
        let ids = (0..textures).map(|_| render_graph_external_color(&mut graph, &import.name));
        imports.insert(import.name.as_str(), ids.collect());
    }
    let host = Host {
        device: &gpu.device,
        queue: &gpu.queue,
        pipelines,
        parameters: &parameters,
        leaves_out_layers: true,
        imports: &imports,
        draw: |_, _| None,
    };
    let mut added = (0..times).map(|_| add_plan(&mut graph, plan, &host));
    added
        .find_map(|added| added.err())
        .expect("the plan was added")
}

#[test]
fn what_does_not_suit_is_refused_by_name() {
    let (gpu, _one) = gpu();
    let whole = plan("hard_shadows");
    let pipelines = Pipelines::of_plan(&gpu.device, &whole).unwrap();
    let taken = refused(&gpu, &whole, &pipelines, 1, 2);
    assert!(
        matches!(&taken, HostError::Taken(pass) if pass == "resolve/resolve"),
        "{taken}"
    );
    let import = refused(&gpu, &whole, &pipelines, 2, 1);
    assert!(
        matches!(&import, HostError::Import(name, 1) if name == "light_depth"),
        "{import}"
    );
    let other = plan("soft_shadows");
    let missing = refused(&gpu, &other, &pipelines, 1, 1);
    assert!(
        matches!(&missing, HostError::Pass(pass) if pass.starts_with("sum/")),
        "{missing}"
    );
    let unknown = without(&whole, &["blurr"]).unwrap_err();
    assert_eq!(
        unknown.to_string(),
        "the plan has no node 'blurr'; it has resolve, blur, shade"
    );
}
