//! What the nodes of single scattering cost in front of the picture: resampling of a light's map, and both ways to sum it up.

mod node;
pub mod reference;
mod report;
mod view;

use half::f16;
use moment_shadows::{MapEncoding, Storage, Technique};
use moment_shadows_graph::{Capabilities, TextureDesc};
use rand::{RngExt, SeedableRng};
use serde_json::json;

use self::node::{NodeOnMap, NodeText, upload};
use self::reference::{Resampled, sums_error, thicknesses};
pub use self::report::{FROM, GATE, LARGEST_GROWTH, Method, SIZES, ScatteringCost, ScatteringRow};
use self::view::{ScatteringView, two_surfaces};
use super::CostError;
use super::baseline::{Copies, CopyWork};
use super::clock::Clock;
use super::protocol::{CopyNumbers, Rounds, Subject};
use crate::gpu::Gpu;

/// Of channels of float16 below 1/2, and what f32 makes of thousands of sums.
const SUMS_TOLERANCE: f64 = 1.23e-4 + 1e-5;

/// Of weights of float16 up to 1, and what f32 and a sampler make of two depths.
const RECTIFIED_TOLERANCE: f64 = 2.45e-4 + 1e-4;

/// Runs and checks the nodes on maps of six moments in float16, then times them in turn with copies of both planes of such a map.
pub fn rows(
    gpu: &Gpu,
    clock: &Clock<'_>,
    size: u32,
    rounds: u32,
) -> Result<Vec<ScatteringRow>, CostError> {
    let view = ScatteringView::new()?;
    let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
    let (rectify, error) = rectified(gpu, &capabilities, &view, size)?;
    let mut nodes = vec![(Method::Rectify, rectify, error)];
    let desc = TextureDesc::of_map(
        MapEncoding::new(Technique::Hamburger6, Storage::Float16)?,
        [size; 2],
    );
    let noise = noise(desc.array_layers() as usize * size as usize * size as usize);
    let map = upload(gpu, &desc, &noise)?;
    for method in [Method::Serial, Method::Parallel] {
        let capabilities = Capabilities {
            software_adapter: method == Method::Serial,
            ..capabilities.clone()
        };
        let text = NodeText {
            node_type: "integrate_scattering",
            properties: json!({}),
            input: "rectified",
            output: "integrated",
        };
        let parameters = &view.parameters.integrate;
        let node = NodeOnMap::new(gpu, &capabilities, text, (&desc, &map), parameters)?;
        let error = sums_of_planes(&node.run(gpu)?, &noise, &view, size);
        checked(method, size, error, SUMS_TOLERANCE)?;
        nodes.push((method, node, error));
    }
    drop(noise);
    timed(gpu, clock, size, rounds, &capabilities, &nodes)
}

/// The node that resamples, and how far it is off.
fn rectified(
    gpu: &Gpu,
    capabilities: &Capabilities,
    view: &ScatteringView,
    size: u32,
) -> Result<(NodeOnMap, f64), CostError> {
    let bytes = two_surfaces(size);
    let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float16)?;
    let desc = TextureDesc::of_map(encoding, [size; 2]);
    let map = upload(gpu, &desc, &bytes)?;
    let text = NodeText {
        node_type: "rectify_moments",
        properties: json!({ "technique": "hamburger6", "storage": "float16", "extent": [size, size] }),
        input: "map",
        output: "rectified",
    };
    let node = NodeOnMap::new(
        gpu,
        capabilities,
        text,
        (&desc, &map),
        &view.parameters.rectify,
    )?;
    let resampled = Resampled {
        map: &bytes,
        size,
        light: view.light,
        view: &view.rectified,
    };
    // At most a million texels, of all rows.
    let error = resampled.error(&node.run(gpu)?, (size / 1024).pow(2).max(1));
    checked(Method::Rectify, size, error, RECTIFIED_TOLERANCE)?;
    Ok((node, error))
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
        .fold(0.0, |error, next| {
            if next.is_nan() || next > error {
                next
            } else {
                error
            }
        })
}

fn checked(method: Method, size: u32, error: f64, tolerance: f64) -> Result<(), CostError> {
    if error <= tolerance {
        return Ok(());
    }
    Err(CostError::WrongResult {
        what: format!("{method} of {size}x{size}"),
        error,
        tolerance,
    })
}

/// Reproducible texels over all channels of float16.
fn noise(texels: usize) -> Vec<u8> {
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
    let channels = (0..4 * texels).map(|_| random.random_range(-0.5..=0.5_f32));
    channels
        .flat_map(|channel| f16::from_f32(channel).to_le_bytes())
        .collect()
}

fn timed(
    gpu: &Gpu,
    clock: &Clock<'_>,
    size: u32,
    rounds: u32,
    capabilities: &Capabilities,
    nodes: &[(Method, NodeOnMap, f64)],
) -> Result<Vec<ScatteringRow>, CostError> {
    let both = TextureDesc {
        layers: 2,
        ..TextureDesc::new(Storage::Float16.format(), [size; 2])
    };
    let copies = Copies::new(gpu, &both, CopyWork::Compute)?;
    let mut subjects = vec![
        Subject {
            name: "compute copy".to_owned(),
            record: copies.by_shader(),
        },
        Subject {
            name: "interface copy".to_owned(),
            record: copies.by_interface(),
        },
    ];
    subjects.extend(nodes.iter().map(|(method, node, _)| Subject {
        name: method.to_string(),
        record: Box::new(|encoder| node.record(encoder)),
    }));
    let times = Rounds::run(clock, &subjects, rounds, || ())?;
    let numbers = CopyNumbers {
        compute: 0,
        api: 1,
        draw: None,
    };
    let texels = f64::from(size) * f64::from(size);
    let rows = nodes.iter().zip(2..);
    Ok(rows
        .map(|((method, node, error), subject)| ScatteringRow {
            size,
            method: *method,
            time: times.time(subject, numbers),
            bytes_per_texel: node.bytes_moved() as f64 / texels,
            error: *error,
            growth: None,
            chosen: method.chosen(capabilities.software_adapter),
        })
        .collect())
}
