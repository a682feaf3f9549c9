use moment_shadows_frame_graph::adapter::Inputs;
use moment_shadows_frame_graph::device::Pipelines;
use moment_shadows_frame_graph::error::HostError;
use moment_shadows_frame_graph::frame::{Frame, Options};
use moment_shadows_frame_graph::world::World;
use moment_shadows_graph::{Instead, Plan, PlannedPass, PlannedWork, Usage};
use nightshade_renderer::rendergraph::{self, PassExecutionContext, PassNode, SubGraphRunCommand};

use crate::{SIZES, gpu, plan};

/// A pass of the host that fills what it draws to with a map that casts no shadow.
struct Lit {
    name: String,
    slots: Vec<String>,
}

impl Lit {
    fn of(pass: &PlannedPass, slots: &[Vec<String>]) -> Option<Box<dyn PassNode<Inputs>>> {
        let written = pass.writes.iter().flat_map(|it| &slots[it.resource]);
        Some(Box::new(Self {
            name: pass.name(),
            slots: written.cloned().collect(),
        }))
    }
}

/// The texel of [`Lit`].
fn texel() -> [f64; 4] {
    let plan = plan("hard_shadows");
    let off = plan.off.iter().find(|off| off.node == "resolve");
    match &off.unwrap().instead {
        Instead::Fill(texels) => texels[0],
        Instead::Bypass(_) => panic!("a map is made of nothing"),
    }
}

impl PassNode<Inputs> for Lit {
    fn name(&self) -> &str {
        &self.name
    }

    fn reads(&self) -> Vec<&str> {
        Vec::new()
    }

    fn writes(&self) -> Vec<&str> {
        self.slots.iter().map(String::as_str).collect()
    }

    fn execute<'r, 'e>(
        &mut self,
        context: PassExecutionContext<'r, 'e, Inputs>,
    ) -> rendergraph::Result<Vec<SubGraphRunCommand<'r>>> {
        let [r, g, b, a] = texel();
        let (view, ..) = context.get_color_attachment(&self.slots[0])?;
        let load = wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a });
        let store = wgpu::StoreOp::Store;
        context
            .encoder
            .begin_render_pass(&wgpu::RenderPassDescriptor {
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load, store },
                })],
                ..Default::default()
            });
        let mut recorded = context.configs.recorded.lock().unwrap();
        recorded.push(self.name.clone());
        Ok(Vec::new())
    }
}

/// The plan with a pass of the host in place of the first one of the blur.
fn with_a_pass_of_the_host() -> Plan {
    let mut plan = plan("hard_shadows");
    let pass = &mut plan.passes[1];
    let drawn = pass.writes[0].resource;
    *pass = PlannedPass {
        shader: None,
        entry_point: String::new(),
        visibility: None,
        bindings: Vec::new(),
        dynamic_offsets: Vec::new(),
        work: PlannedWork::Host {
            targets: vec![drawn],
            blend: false,
            depth: None,
        },
        ..pass.clone()
    };
    plan.resources[drawn].usage.push(Usage::RenderAttachment);
    plan.update_hazards();
    plan
}

/// What it replaced was the only reader of the map: the host leaves that out by itself.
#[test]
fn the_host_draws_its_own_pass_and_leaves_out_what_nobody_reads() {
    let (gpu, _one) = gpu();
    let plan = with_a_pass_of_the_host();
    let pipelines = Pipelines::of_plan(&gpu.device, &plan).unwrap();
    let missing = Frame::new(&gpu, &plan, &pipelines, SIZES, &Options::default());
    match missing.err().unwrap() {
        HostError::Pass(pass) => assert_eq!(pass, plan.passes[1].name()),
        other => panic!("{other}"),
    }
    let options = Options {
        draw: Lit::of,
        ..Options::default()
    };
    let mut frame = Frame::new(&gpu, &plan, &pipelines, SIZES, &options).unwrap();
    let drawn = frame.draw_world(&gpu, &World::default()).unwrap();
    assert_eq!(
        drawn.order,
        ["blur/blur along x", "blur/blur along y", "shade/shade"]
    );
    assert!(drawn.pictures[0].1.iter().all(|&texel| texel <= 1));
}
