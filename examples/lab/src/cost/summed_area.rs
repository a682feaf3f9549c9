//! Summed-area tables: both tiles of the node, and the usual way, of maps of several sizes.

use moment_shadows::{MapEncoding, MapRegion, Storage, Technique, TextureFormat};
use moment_shadows_graph::nodes::SummedAreaTable;
use moment_shadows_graph::record::Recording;
use moment_shadows_graph::{Capabilities, TextureDesc};
use serde_json::Value;

use super::SubjectList;
use super::copies::CopyWork;
use super::harness::{Case, Difference};
use super::protocol::Record;
use super::table::{Facts, Gate};
use super::texels::{encode, noise};
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::node_on_map::NodeOnMap;
use crate::summed_area::{NaiveTable, node, reference};

/// Tables of maps of up to a size.
pub const TABLES: SubjectList = SubjectList {
    title: "summed-area table of rgba16unorm, in copies of the table",
    sizes: &[256, 512, 1024, 2048, 4096, 8192],
    cases,
};

/// What the node may cost.
const GATE: Gate = Gate {
    gate: Some(3.5),
    goal: Some(2.3),
    largest_growth: Some(1.3),
};

fn cases(gpu: &Gpu, size: u32) -> Result<Vec<Case>, LabError> {
    let source = MapEncoding::new(Technique::Hamburger4, Storage::Unorm16)?;
    let bytes = encode(
        source.storage(),
        &noise(source.storage(), (size * size) as usize),
    );
    let desc = TextureDesc::of_map(source, [size; 2]);
    let integers: Vec<u32> = bytes
        .chunks_exact(2)
        .map(|pair| u32::from(u16::from_le_bytes([pair[0], pair[1]])))
        .collect();
    let whole = MapRegion::new([0; 2], [size; 2]);
    let expected = reference::table(&integers, 4, size as usize, &[whole]);
    let capabilities = Capabilities::of_device(&gpu.adapter, &gpu.device);
    // Sums are exact.
    let difference = |found: &[u32]| {
        let [found, expected] = [found, &expected].map(|sums| sums.iter().map(|&sum| sum.into()));
        Difference::of(found, expected, 0.0)
    };
    let case = |method: &str, tile: [u32; 2], chosen, bytes, found: &[u32], record| Case {
        name: method.to_owned(),
        facts: Facts(vec![
            ("size", size.into()),
            ("method", method.into()),
            (
                "invocations",
                (size.div_ceil(tile[0]) * size.div_ceil(tile[1])).into(),
            ),
            ("chosen", Value::Bool(chosen)),
        ]),
        record,
        written: vec![TextureDesc::new(TextureFormat::Rgba32Uint, [size; 2])],
        work: CopyWork::Compute,
        bytes,
        difference: Some(difference(found)),
        gate: if chosen { GATE } else { Gate::default() },
    };
    let mut cases = Vec::new();
    for (method, tile, software_adapter) in [
        ("software_tiles", [16, 16], true),
        ("hardware_tiles", [8, 16], false),
    ] {
        let text = node(SummedAreaTable::default().largest_kernel);
        let chosen = software_adapter == capabilities.software_adapter;
        let capabilities = Capabilities {
            software_adapter,
            ..capabilities.clone()
        };
        let node = NodeOnMap::new(gpu, &capabilities, &text, &desc, &bytes)?;
        let found: Vec<u32> = bytemuck::pod_collect_to_vec(&node.made(gpu)?.concat());
        let moved = node.bytes();
        let record: Record<'static> =
            Box::new(move |encoder| node.record(Recording::default(), encoder));
        cases.push(case(method, tile, chosen, moved, &found, record));
    }
    let naive = NaiveTable::new(gpu, &desc, &bytes)?;
    let found = naive.run(gpu)?;
    let moved =
        NaiveTable::bytes_per_texel().map(|bytes| u64::from(bytes * size) * u64::from(size));
    let record: Record<'static> = Box::new(move |encoder| {
        naive.record(encoder);
        Ok(())
    });
    cases.push(case("naive", [size, 1], false, moved, &found, record));
    Ok(cases)
}
