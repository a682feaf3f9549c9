//! The nodes of single scattering in front of the picture: resampling of a light's map, and both ways to sum it up.

pub mod reference;
mod view;

use moment_shadows::{MapEncoding, Storage, Technique};
use moment_shadows_graph::record::Recording;
use moment_shadows_graph::{Capabilities, TextureDesc};
use serde_json::json;

use self::reference::{Resampled, sums_error, thicknesses};
use self::view::{ScatteringView, two_surfaces};
use super::SubjectList;
use super::copies::CopyWork;
use super::harness::{Case, Difference, largest};
use super::table::{Facts, Gate};
use super::texels::{encode, noise};
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::node_on_map::{NodeOnMap, NodeText};

/// The nodes on maps of up to a size.
pub const NODES: SubjectList = SubjectList {
    title: "six moments in two planes of rgba16float, in copies of both planes",
    sizes: &[256, 512, 1024, 2048, 4096],
    cases,
};

/// What sums by a row per invocation may cost.
const SERIAL_GATE: f64 = 1.3;

/// What the time per texel may be of that at a smaller size.
const LARGEST_GROWTH: f64 = 1.3;

/// Error of float16 channels below 1/2, plus the error of thousands of sums in f32.
const SUMS_TOLERANCE: f64 = 1.23e-4 + 1e-5;

/// Error of float16 weights up to 1, plus the error that f32 and a sampler make in two depths.
const RECTIFIED_TOLERANCE: f64 = 2.45e-4 + 1e-4;

/// Resampling of a light's map of four moments, and sums of noise by a row per invocation and by a row per workgroup.
pub fn cases(gpu: &Gpu, size: u32) -> Result<Vec<Case>, LabError> {
    let view = ScatteringView::new()?;
    let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
    let software = capabilities.software_adapter;
    let (node, difference) = rectified(gpu, &capabilities, &view, size)?;
    let mut cases = vec![case("rectify", size, node, difference, true)];
    let encoding = MapEncoding::new(Technique::Hamburger6, Storage::Float16)?;
    let desc = TextureDesc::of_map(encoding, [size; 2]);
    let texels = desc.array_layers() as usize * size as usize * size as usize;
    let noise = encode(Storage::Float16, &noise(Storage::Float16, texels));
    for (method, software_adapter) in [("serial", true), ("parallel", false)] {
        let capabilities = Capabilities {
            software_adapter,
            ..capabilities.clone()
        };
        let text = NodeText {
            node: "integrate_scattering",
            properties: json!({}),
            slots: ["rectified", "integrated"],
        };
        let node = NodeOnMap::new(gpu, &capabilities, &text, &desc, &noise)?;
        node.fill(gpu, |layout, block| {
            Ok(layout.write(block, text.node, 0, &view.parameters.integrate)?)
        })?;
        let difference = Difference {
            error: sums_of_planes(&node.made(gpu)?, &noise, &view, size),
            tolerance: SUMS_TOLERANCE,
        };
        let chosen = software_adapter == software;
        cases.push(case(method, size, node, difference, chosen));
    }
    Ok(cases)
}

fn case(method: &str, size: u32, node: NodeOnMap, difference: Difference, chosen: bool) -> Case {
    Case {
        name: method.to_owned(),
        facts: Facts(vec![
            ("size", size.into()),
            ("method", method.into()),
            ("chosen", chosen.into()),
        ]),
        written: vec![TextureDesc {
            layers: 2,
            ..TextureDesc::new(Storage::Float16.format(), [size; 2])
        }],
        work: CopyWork::Compute,
        bytes: node.bytes(),
        difference: Some(difference),
        gate: Gate {
            gate: (chosen && method == "serial").then_some(SERIAL_GATE),
            goal: None,
            largest_growth: chosen.then_some(LARGEST_GROWTH),
        },
        record: Box::new(move |encoder| node.record(Recording::default(), encoder)),
    }
}

/// The node that resamples, and how far it is off.
fn rectified(
    gpu: &Gpu,
    capabilities: &Capabilities,
    view: &ScatteringView,
    size: u32,
) -> Result<(NodeOnMap, Difference), LabError> {
    let bytes = two_surfaces(size);
    let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float16)?;
    let desc = TextureDesc::of_map(encoding, [size; 2]);
    let text = NodeText {
        node: "rectify_moments",
        properties: json!({ "technique": "hamburger6", "storage": "float16", "extent": [size, size] }),
        slots: ["map", "rectified"],
    };
    let node = NodeOnMap::new(gpu, capabilities, &text, &desc, &bytes)?;
    node.fill(gpu, |layout, block| {
        Ok(layout.write(block, text.node, 0, &view.parameters.rectify)?)
    })?;
    let resampled = Resampled {
        map: &bytes,
        size,
        light: view.light,
        view: &view.rectified,
    };
    let difference = Difference {
        // At most a million texels, of all rows.
        error: resampled.error(&node.made(gpu)?, (size / 1024).pow(2).max(1)),
        tolerance: RECTIFIED_TOLERANCE,
    };
    Ok((node, difference))
}

/// How far the sums of both planes are off.
fn sums_of_planes(found: &[Vec<u8>], summed: &[u8], view: &ScatteringView, size: u32) -> f64 {
    let parameters = &view.parameters.integrate;
    let thicknesses = thicknesses(&parameters.frame, f64::from(parameters.extinction), size);
    let planes = summed.chunks(summed.len() / 2);
    if found.len() != planes.len() {
        return f64::NAN;
    }
    let errors = found.iter().zip(planes);
    errors
        .map(|(found, summed)| sums_error(found, summed, &thicknesses))
        .fold(0.0, largest)
}
