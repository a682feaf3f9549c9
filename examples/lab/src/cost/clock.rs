//! The clock that suits an adapter.
//!
//! A software adapter's timestamps do not cover all the work that it does on threads of this process; its processor time
//! does, and hardly depends on what else the machine is doing. A graphics processor has timestamps of its own.

use std::time::Instant;

use cpu_time::ProcessTime;
use serde::Serialize;

use crate::error::LabError;
use crate::gpu::Gpu;

/// The features that timestamps between passes need; the clock falls back to the wall without them.
pub const FEATURES: wgpu::Features =
    wgpu::Features::TIMESTAMP_QUERY.union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS);

/// What is read before and after the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ClockKind {
    /// Processor time of all threads of this process.
    ProcessTime,
    /// Timestamps that the device writes.
    Timestamps,
    /// The wall, from submission to completion.
    Wall,
}

/// One measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Seconds by the clock.
    pub seconds: f64,
    /// Seconds by the wall, as a cross-check.
    pub wall: f64,
}

/// A clock.
pub struct Clock<'gpu> {
    gpu: &'gpu Gpu,
    kind: ClockKind,
    stamps: Option<Stamps>,
}

/// Two timestamp queries and where they go.
struct Stamps {
    queries: wgpu::QuerySet,
    buffer: wgpu::Buffer,
}

impl ClockKind {
    /// The clock that suits a device.
    #[must_use]
    pub fn for_device(gpu: &Gpu) -> Self {
        if gpu.adapter.get_info().device_type == wgpu::DeviceType::Cpu {
            ClockKind::ProcessTime
        } else if gpu.device.features().contains(FEATURES) {
            ClockKind::Timestamps
        } else {
            ClockKind::Wall
        }
    }
}

impl<'gpu> Clock<'gpu> {
    /// A clock of a kind. Timestamps need a device with [`FEATURES`].
    #[must_use]
    pub fn new(gpu: &'gpu Gpu, kind: ClockKind) -> Self {
        let stamps = (kind == ClockKind::Timestamps).then(|| Stamps {
            queries: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("cost/timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            buffer: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("cost/timestamps"),
                size: 16,
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
        });
        Self { gpu, kind, stamps }
    }

    /// The device.
    #[must_use]
    pub fn gpu(&self) -> &'gpu Gpu {
        self.gpu
    }

    /// The kind.
    #[must_use]
    pub fn kind(&self) -> ClockKind {
        self.kind
    }

    /// Records some work, submits it, waits for its end, and says how long it took.
    pub fn time(
        &self,
        what: &str,
        record: impl FnOnce(&mut wgpu::CommandEncoder) -> Result<(), LabError>,
    ) -> Result<Reading, LabError> {
        let gpu = self.gpu;
        let mut encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some(what) });
        if let Some(stamps) = &self.stamps {
            encoder.write_timestamp(&stamps.queries, 0);
        }
        record(&mut encoder)?;
        if let Some(stamps) = &self.stamps {
            encoder.write_timestamp(&stamps.queries, 1);
            encoder.resolve_query_set(&stamps.queries, 0..2, &stamps.buffer, 0);
        }
        let commands = encoder.finish();
        let (wall, process) = (Instant::now(), ProcessTime::now());
        gpu.queue.submit([commands]);
        gpu.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| LabError::unsuitable(what, error))?;
        let (process, wall) = (
            process.elapsed().as_secs_f64(),
            wall.elapsed().as_secs_f64(),
        );
        gpu.check()?;
        let seconds = match (&self.stamps, self.kind) {
            (Some(stamps), _) => self.between(stamps)?,
            (None, ClockKind::ProcessTime) => process,
            (None, _) => wall,
        };
        Ok(Reading { seconds, wall })
    }

    fn between(&self, stamps: &Stamps) -> Result<f64, LabError> {
        let bytes = self.gpu.read_buffer(&stamps.buffer, "cost/timestamps")?;
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
        let passed = match ticks.as_slice() {
            [begin, end] => end.saturating_sub(*begin),
            _ => 0,
        };
        Ok(passed as f64 * f64::from(self.gpu.queue.get_timestamp_period()) * 1e-9)
    }
}
