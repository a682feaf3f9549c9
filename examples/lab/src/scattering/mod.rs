//! Single scattering, judged: the library's nodes and what renderers do instead, against marched rays.

mod air;
mod candidate;
mod chain;
mod convolution;
mod draw;
mod flicker;
mod look;
mod march;
mod marched;
mod report;
mod stage;
mod ten_bits;
mod truth;

pub use air::Air;
pub use candidate::{PROFILE, ScatteringCandidate, candidates};
pub use flicker::{
    Change, FRAMES, Flicker, FlickerDesc, GOAL, Path, Place, RectifyNearest, STILL, WINDOW, chains,
    flicker, static_region,
};
pub use look::{Look, LookDesc};
pub use marched::{
    Lamp, MarchCandidate, MarchErrors, MarchStage, MarchStageDesc, WayRow, WaysRecord,
    march_candidates, ways_record,
};
pub use report::{ScatteringError, ScatteringErrors};
pub use stage::{ScatteringStage, ScatteringStageDesc};
pub use truth::{MarchedRays, Rays, marched, marched_filtered};
