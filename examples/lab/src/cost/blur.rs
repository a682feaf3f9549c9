//! The blur alone, on a map of noise, in both directions together.

use moment_shadows::{Kernel, Profile, Storage};
use moment_shadows_graph::record::Recording;
use moment_shadows_graph::{Capabilities, TextureDesc};
use serde_json::json;

use super::copies::CopyWork;
use super::harness::{Case, Difference};
use super::table::{Facts, Gate};
use super::texels::{Channels, decode, encode, noise};
use super::{SubjectList, reference};
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::node_on_map::{NodeOnMap, NodeText};

/// Blurs of several radii of a map of one size.
pub const BLURS: SubjectList = SubjectList {
    title: "blur of rgba16unorm, both directions, in copies of the map",
    sizes: &[],
    cases,
};

/// Radii that are measured, in texels, with the most that they may cost and what is aimed at.
pub const BOUNDS: [(u32, Option<f64>, Option<f64>); 4] = [
    (4, Some(4.5), Some(3.4)),
    (12, Some(8.0), Some(5.5)),
    (32, None, None),
    (64, Some(24.0), Some(15.0)),
];

/// A device that can store the moments of every storage.
pub const PROFILE: Profile = Profile::Native;

/// A map of moments of any contents, and a blur of it.
pub struct BlurredMap {
    storage: Storage,
    kernel: Kernel,
    size: [u32; 2],
    node: NodeOnMap,
}

impl BlurredMap {
    /// Compiles a graph of one blur and binds it to a map with these channels, row by row. With `per_frame`, the weights
    /// are parameters whatever the radius.
    pub fn new(
        gpu: &Gpu,
        storage: Storage,
        size: [u32; 2],
        channels: &[[f64; 4]],
        kernel: Kernel,
        per_frame: bool,
    ) -> Result<Self, LabError> {
        let desc = TextureDesc::new(storage.format(), size);
        let text = NodeText {
            node: "blur",
            properties: json!({ "kernel": { "weights": kernel.weights() }, "per_frame": per_frame }),
            slots: ["map", "blurred"],
        };
        let bytes = encode(storage, channels);
        let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
        Ok(Self {
            storage,
            kernel,
            size,
            node: NodeOnMap::new(gpu, &capabilities, &text, &desc, &bytes)?,
        })
    }

    /// Records some of its passes: number 0 blurs along x, number 1 along y.
    pub fn record(
        &self,
        passes: Option<&[usize]>,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), LabError> {
        let recording = Recording {
            passes,
            ..Recording::default()
        };
        self.node.record(recording, encoder)
    }

    /// The blurred channels, row by row.
    pub fn run(&self, gpu: &Gpu) -> Result<Channels, LabError> {
        Ok(decode(self.storage, &self.node.made(gpu)?.concat()))
    }

    /// What the output holds now.
    pub fn read(&self, gpu: &Gpu) -> Result<Channels, LabError> {
        Ok(decode(self.storage, &self.node.read(gpu)?.concat()))
    }

    /// Runs the blur and compares it with the reference for the same stored channels.
    pub fn difference(&self, gpu: &Gpu, channels: &[[f64; 4]]) -> Result<Difference, LabError> {
        let stored = decode(self.storage, &encode(self.storage, channels));
        let reference = reference::blur(&stored, self.size.map(|side| side as usize), &self.kernel);
        let tolerance = reference::blur_tolerance(self.storage, &self.kernel);
        Ok(reference::difference(
            &self.run(gpu)?,
            &reference,
            tolerance,
        ))
    }
}

fn cases(gpu: &Gpu, size: u32) -> Result<Vec<Case>, LabError> {
    let storage = Storage::Unorm16;
    let channels = noise(storage, size as usize * size as usize);
    let case = |(radius, gate, goal)| {
        let kernel = Kernel::gaussian(radius, 0.6 * radius as f32)
            .map_err(|error| LabError::unsuitable("blur", error.to_string()))?;
        let map = BlurredMap::new(gpu, storage, [size; 2], &channels, kernel, false)?;
        Ok(Case {
            name: format!("a blur of radius {radius}"),
            facts: Facts(vec![("size", size.into()), ("radius", radius.into())]),
            written: vec![TextureDesc::new(storage.format(), [size; 2])],
            work: CopyWork::Compute,
            bytes: map.node.bytes(),
            difference: Some(map.difference(gpu, &channels)?),
            gate: Gate {
                gate,
                goal,
                largest_growth: None,
            },
            record: Box::new(move |encoder| map.record(None, encoder)),
        })
    };
    BOUNDS.into_iter().map(case).collect()
}
