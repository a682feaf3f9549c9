//! The story of a graph, with each of its calls failing once.

use core::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};

use moment_shadows_graph::GraphErrorKind;
use moment_shadows_lab::error::LabError;

use crate::host::Host;
use crate::panicked;
use crate::steer::{Fault, Steer};
use crate::story::{Chapter, Outcome, tell};
use crate::watch;

/// What wgpu 30.0.1 never destroys, where it was refused something in between: when the function fails, objects of these.
const LEFT_BY_WGPU: [(&str, &[&str]); 5] = [
    ("vkCreateShaderModule", &["vkCreateShaderModule"]),
    ("vkCreateRenderPass", &["vkCreateShaderModule"]),
    ("vkCreateComputePipelines", &["vkCreateShaderModule"]),
    ("vkCreateGraphicsPipelines", &["vkCreateShaderModule"]),
    ("vkCreateImageView", &["vkCreateImage", "vkCreateImageView"]),
];

/// Functions whose failure wgpu 30.0.1 takes for impossible where it begins to record what `Queue::write_buffer` writes: it
/// panics there, in a host's own writes as well.
const PANICS_OF_WGPU: [&str; 2] = ["vkAllocateCommandBuffers", "vkBeginCommandBuffer"];

/// What became of all of them.
pub(crate) struct Tried {
    chapter: &'static str,
    /// Calls of one story.
    calls: u64,
    /// By fault, how many stories had an error of a kind first, ended in a lost device without one, or showed what they show
    /// without a fault.
    counts: [Counts; Fault::ALL.len()],
    /// What is against the promise.
    found: Vec<String>,
}

#[derive(Default)]
struct Counts {
    tried: u64,
    out_of_memory: u64,
    lost: u64,
    refused: u64,
    silently_lost: u64,
    same: u64,
    worked_on: u64,
    left_by_wgpu: u64,
    panics_of_wgpu: u64,
}

impl Tried {
    /// Lets one in `every` calls fail, from call number `first` on.
    pub(crate) fn every(
        steer: &Steer,
        chapter: &Chapter,
        first: u64,
        every: u64,
    ) -> Result<Self, LabError> {
        let mut tried = Self {
            chapter: chapter.name,
            calls: 0,
            counts: Default::default(),
            found: Vec::new(),
        };
        // What the first device of a process makes once.
        drop(Host::new()?);
        steer.plan(u64::MAX, Fault::OutOfMemoryOnce);
        let whole = tell(&Host::new()?, steer, chapter, None);
        tried.calls = steer.calls();
        if !whole.finished || whole.shown.iter().any(Option::is_none) {
            tried
                .found
                .push("it does not work without a fault".to_owned());
            return Ok(tried);
        }
        for number in (first..tried.calls).step_by(every as usize) {
            for (fault, at) in Fault::ALL.into_iter().zip(0..) {
                let what = format!("{}, call {number}, {fault:?}", chapter.name);
                watch::begun();
                watch::over(what.clone());
                tried.one(steer, chapter, &whole, (number, fault, at), &what)?;
            }
        }
        Ok(tried)
    }

    fn one(
        &mut self,
        steer: &Steer,
        chapter: &Chapter,
        whole: &Outcome,
        (number, fault, at): (u64, Fault, usize),
        what: &str,
    ) -> Result<(), LabError> {
        self.counts[at].tried += 1;
        let before = steer.alive();
        let host = Host::new()?;
        steer.plan(number, fault);
        let told = catch_unwind(AssertUnwindSafe(|| {
            tell(&host, steer, chapter, Some(&whole.shown))
        }));
        steer.count(false);
        let failed = steer.failed();
        drop(host);
        let named = failed.join(", ");
        let mut found = |problem: String| self.found.push(format!("{what} ({named}): {problem}"));
        let mut left = steer.alive();
        left.retain(|name, count| *count != before[name]);
        let by_wgpu = left.extract_if(.., |name, _| {
            let leaks = |(call, objects): &(&str, &[&str])| {
                failed.iter().any(|failed| failed == call) && objects.contains(&name.as_str())
            };
            LEFT_BY_WGPU.iter().any(leaks)
        });
        self.counts[at].left_by_wgpu += u64::from(by_wgpu.count() > 0);
        if !left.is_empty() {
            found(format!("more objects are left than before: {left:?}"));
        }
        let Ok(outcome) = told else {
            let panicked = panicked::last();
            let within_wgpu = panicked.contains("wgpu-core");
            if within_wgpu
                && failed
                    .iter()
                    .any(|name| PANICS_OF_WGPU.contains(&name.as_str()))
            {
                self.counts[at].panics_of_wgpu += 1;
            } else {
                found(format!("it panicked: {panicked}"));
            }
            return Ok(());
        };
        outcome.faults.into_iter().for_each(&mut found);
        let counts = &mut self.counts[at];
        match outcome.errors.first().map(|(_, error)| error.kind) {
            Some(GraphErrorKind::OutOfMemory) => counts.out_of_memory += 1,
            Some(GraphErrorKind::Lost) => counts.lost += 1,
            Some(_) => counts.refused += 1,
            None if outcome.lost => counts.silently_lost += 1,
            None => counts.same += 1,
        }
        counts.worked_on += u64::from(outcome.finished && !outcome.errors.is_empty());
        if outcome.finished && !outcome.lost && outcome.shown != whole.shown {
            self.found
                .push(format!("{what} ({named}): another picture"));
        }
        if !outcome.finished && outcome.errors.is_empty() {
            self.found
                .push(format!("{what} ({named}): it ends without an error"));
        }
        Ok(())
    }

    /// Whether something was found.
    pub(crate) fn found(&self) -> bool {
        !self.found.is_empty()
    }
}

impl fmt::Display for Tried {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {} calls can fail", self.chapter, self.calls)?;
        for (fault, counts) in Fault::ALL.into_iter().zip(&self.counts) {
            let Counts {
                tried,
                out_of_memory,
                lost,
                refused,
                silently_lost,
                same,
                worked_on,
                left_by_wgpu,
                panics_of_wgpu,
            } = counts;
            writeln!(f, "  {fault:?}, {tried} tried")?;
            writeln!(
                f,
                "    errors: {out_of_memory} OutOfMemory, {lost} Lost, {refused} Device; after {worked_on} the same call works"
            )?;
            writeln!(
                f,
                "    no error: {silently_lost} where the device says that it is lost, {same} that show the same"
            )?;
            writeln!(
                f,
                "    {left_by_wgpu} after which wgpu leaves objects, {panics_of_wgpu} in which it panics itself"
            )?;
        }
        for found in &self.found {
            writeln!(f, "  FOUND {found}")?;
        }
        Ok(())
    }
}
