//! Plans in a frame graph that orders, allocates and leaves out by itself: what the plan says is enough, and needed.

mod drawn;
mod kept;
mod memory;
mod off;
mod order;
mod refused;
mod resized;

use std::sync::{Mutex, MutexGuard};

use moment_shadows_frame_graph::device::Pipelines;
use moment_shadows_frame_graph::frame::{Drawn, Frame, Options};
use moment_shadows_frame_graph::gpu::Gpu;
use moment_shadows_frame_graph::graphs::{self, Sizes};
use moment_shadows_frame_graph::world::World;
use moment_shadows_graph::Plan;

pub(crate) const SIZES: Sizes = Sizes {
    map: [128, 128],
    picture: [96, 54],
};

pub(crate) fn text(name: &str) -> &'static str {
    let mut all = graphs::ALL.iter();
    all.find(|graph| graph.0 == name).unwrap().1
}

pub(crate) fn plan(name: &str) -> Plan {
    graphs::compile(text(name), SIZES).unwrap()
}

/// Opens a device; one at a time, as a software driver uses all cores.
pub(crate) fn gpu() -> (Gpu, MutexGuard<'static, ()>) {
    static ONE: Mutex<()> = Mutex::new(());
    let one = ONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    (Gpu::open().unwrap(), one)
}

pub(crate) fn frame(gpu: &Gpu, plan: &Plan, sizes: Sizes) -> Frame {
    let pipelines = Pipelines::of_plan(&gpu.device, plan).unwrap();
    Frame::new(gpu, plan, &pipelines, sizes, &Options::default()).unwrap()
}

/// The first frame of a plan.
pub(crate) fn drawn(gpu: &Gpu, plan: &Plan, world: &World) -> Drawn {
    frame(gpu, plan, SIZES).draw_world(gpu, world).unwrap()
}

/// A share of the texels of a picture of 8 bits that are dark enough to be in shadow, and that are lit.
pub(crate) fn shares(texels: &[u8]) -> [f64; 2] {
    let count = |is: fn(&&u8) -> bool| texels.iter().filter(is).count() as f64;
    [count(|&&it| it > 200), count(|&&it| it < 10)].map(|it| it / texels.len() as f64)
}
