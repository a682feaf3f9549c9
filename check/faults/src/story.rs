//! What a host does with a session, once, with a call that fails on the way.

use moment_shadows_graph::record::PipelineOptions;
use moment_shadows_graph::{Graph, GraphError, GraphErrorKind, NodeRegistry, Session, Stage};
use pollster::block_on;

use crate::host::Host;
use crate::steer::Steer;

/// Calls of the library, in this order.
pub(crate) const STEPS: [&str; 7] = [
    "Session::new",
    "Session::add_view",
    "Session::view",
    "Session::record",
    "Session::replace",
    "Session::view, again",
    "Session::record, again",
];

/// A graph and the outputs that are looked at.
pub(crate) struct Chapter {
    pub(crate) name: &'static str,
    graph: &'static str,
    outputs: &'static [&'static str],
}

/// The graphs.
pub(crate) const CHAPTERS: [Chapter; 2] = [
    Chapter {
        name: "hard_shadows",
        graph: include_str!("../../../examples/hard_shadows.json"),
        outputs: &["shadow_intensity"],
    },
    Chapter {
        name: "volumetric_scattering",
        graph: include_str!("../../../examples/volumetric_scattering.json"),
        outputs: &["shadow_intensity", "scattering"],
    },
];

/// What became of it.
#[derive(Debug, Default)]
pub(crate) struct Outcome {
    /// The errors, with the number of the step that gave them.
    pub(crate) errors: Vec<(usize, GraphError)>,
    /// Whether every step was done in the end.
    pub(crate) finished: bool,
    /// What is against the promise.
    pub(crate) faults: Vec<String>,
    /// The frames of both cameras before and after `replace`, where they were drawn.
    pub(crate) shown: [Option<Vec<u8>>; 2],
    /// Whether the device said that it is lost.
    pub(crate) lost: bool,
}

struct Teller<'a> {
    host: &'a Host,
    steer: &'a Steer,
    chapter: &'a Chapter,
    /// What is shown without a fault.
    expected: Option<&'a [Option<Vec<u8>>; 2]>,
    outcome: Outcome,
}

/// Tells the story. `expected` is what is shown without a fault.
pub(crate) fn tell(
    host: &Host,
    steer: &Steer,
    chapter: &Chapter,
    expected: Option<&[Option<Vec<u8>>; 2]>,
) -> Outcome {
    let mut teller = Teller {
        host,
        steer,
        chapter,
        expected,
        outcome: Outcome::default(),
    };
    teller.outcome.finished = teller.all().is_some();
    teller.outcome.lost = host.lost();
    teller.outcome
}

impl Teller<'_> {
    fn fault(&mut self, step: usize, what: String) {
        self.outcome.faults.push(format!("{}: {what}", STEPS[step]));
    }

    /// Takes a step whose calls can fail. What it makes, or nothing where it gave an error.
    fn attempt<T>(
        &mut self,
        step: usize,
        act: impl FnOnce() -> Result<T, GraphError>,
    ) -> Option<T> {
        const KINDS: [GraphErrorKind; 3] = [
            GraphErrorKind::OutOfMemory,
            GraphErrorKind::Lost,
            GraphErrorKind::Device,
        ];
        // What the host was told of its own calls, on a device that is lost.
        while self.host.gpu.check().is_err() {}
        self.steer.count(true);
        let made = act();
        self.steer.count(false);
        if let Err(error) = self.host.gpu.check() {
            self.fault(step, format!("the host's handler was told: {error}"));
        }
        match made {
            Ok(made) => Some(made),
            Err(error) => {
                if !KINDS.contains(&error.kind) {
                    let what = format!("an error of another kind, {:?}: {error}", error.kind);
                    self.fault(step, what);
                }
                self.outcome.errors.push((step, error));
                None
            }
        }
    }

    /// Takes a step, and once more where it gave an error and the device still works.
    fn step<T>(
        &mut self,
        step: usize,
        mut act: impl FnMut() -> Result<T, GraphError>,
    ) -> Option<T> {
        let first = self.attempt(step, &mut act);
        if first.is_some() || self.host.lost() {
            return first;
        }
        self.attempt(step, act)
    }

    fn all(&mut self) -> Option<()> {
        let host = self.host;
        let text = self.chapter.graph;
        let (adapter, device) = (&host.gpu.adapter, &host.gpu.device);
        let small = host.small.imports();
        let mut session = self.step(0, || {
            let graph = Graph::parse(text, &NodeRegistry::new())?;
            let options = PipelineOptions::default();
            block_on(Session::new(adapter, device, graph, &small, options))
        })?;
        self.step(1, || block_on(session.add_view(&[])))?;
        self.frame(&mut session, [2, 3], 0)?;
        let large = host.large.imports();
        let replaced = self.attempt(4, || block_on(session.replace(0, &large)));
        if replaced.is_none() {
            if host.lost() {
                return None;
            }
            self.as_before(&session);
            self.attempt(4, || block_on(session.replace(0, &large)))?;
        }
        self.frame(&mut session, [5, 6], 1)
    }

    /// A session that refused other textures shows what it showed.
    fn as_before(&mut self, session: &Session) {
        let mut encoder = self.encoder();
        if let Err(error) = recorded(session, &mut encoder) {
            self.fault(4, format!("the session is not as before: {error}"));
        }
        let shown = self.shown(session, encoder);
        if self.expected.is_some_and(|expected| expected[0] != shown) {
            self.fault(4, "the session shows something else than before".to_owned());
        }
    }

    /// Places both cameras, records everything and reads the outputs.
    fn frame(
        &mut self,
        session: &mut Session,
        [view, record]: [usize; 2],
        frame: usize,
    ) -> Option<()> {
        let host = self.host;
        for camera in 0..2 {
            self.step(view, || {
                session.view(&host.gpu.queue, camera, &host.camera, &[host.light])
            })?;
        }
        let mut encoder = self.encoder();
        self.step(record, || recorded(session, &mut encoder))?;
        self.outcome.shown[frame] = self.shown(session, encoder);
        Some(())
    }

    fn encoder(&self) -> wgpu::CommandEncoder {
        let desc = wgpu::CommandEncoderDescriptor::default();
        self.host.gpu.device.create_command_encoder(&desc)
    }

    /// What is shown; nothing where the device is lost.
    fn shown(&self, session: &Session, encoder: wgpu::CommandEncoder) -> Option<Vec<u8>> {
        let outputs = (0..2).flat_map(|camera| {
            let names = self.chapter.outputs.iter();
            names.filter_map(move |name| session.output(camera, name))
        });
        let outputs: Vec<_> = outputs.collect();
        self.host.shown(encoder, &outputs).ok()
    }
}

fn recorded(session: &Session, encoder: &mut wgpu::CommandEncoder) -> Result<(), GraphError> {
    let mut stages = Stage::ALL.into_iter();
    stages.try_for_each(|stage| session.record(stage, encoder))
}
