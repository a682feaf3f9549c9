//! Graph files: their passes, bytes and bandwidths.

use moment_shadows::{Profile, Storage};
use moment_shadows_lab::candidate::Candidate;
use moment_shadows_lab::command::cost;
use moment_shadows_lab::command::render::RenderOptions;
use moment_shadows_lab::cost::bandwidth::Memory;
use moment_shadows_lab::cost::blur::BlurredMap;
use moment_shadows_lab::cost::copies::CopyWork;
use moment_shadows_lab::cost::passes::cases;
use moment_shadows_lab::cost::protocol::FEWEST_ROUNDS;
use moment_shadows_lab::cost::texels::noise;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_file::GraphFile;
use moment_shadows_lab::scene;
use moment_shadows_lab::techniques::{self, described};
use std::path::{Path, PathBuf};

fn example(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    root.join("examples").join(name)
}

fn with_map(side: u32) -> RenderOptions {
    RenderOptions {
        map: Some(side),
        ..RenderOptions::default()
    }
}

/// What a technique gives, in every storage and with every kind of taps, is what it makes of the unfiltered depths.
#[test]
fn every_technique_is_found_right() {
    let text = std::fs::read_to_string(example("hard_shadows.json")).unwrap();
    let file = GraphFile::parse("hard_shadows.json", text, None).unwrap();
    let gpu = Gpu::open(Profile::NativeAdapter).unwrap();
    let scene = scene::load("fence-and-foliage").unwrap();
    let options = RenderOptions {
        size: Some([320, 180]),
        ..with_map(256)
    };
    let frames = [false, true].map(|reads_depth| {
        let mut drawn = options.drawn(&file).unwrap();
        drawn.samples = if reads_depth { 1 } else { drawn.samples };
        let margin = file.radius().unwrap();
        options.frame(&gpu, &scene, &drawn, margin).unwrap()
    });
    let reading_depth = techniques::reading_depth().into_iter();
    let mut candidates = Candidate::all();
    candidates.extend(reading_depth.map(Candidate::ReadingDepth));
    let mut without = Vec::new();
    for candidate in candidates {
        let graph = candidate.graph(&file).unwrap();
        let name = described(&graph.technique().unwrap());
        let frame = &frames[usize::from(candidate.reads_depth())];
        let (cases, _) = cases(&gpu, frame, &graph).unwrap();
        let shaded = cases.last().unwrap();
        assert_eq!(shaded.name, "shade/shade", "{name}");
        let Some(difference) = shaded.difference else {
            without.push(name);
            continue;
        };
        println!(
            "{name} in {:?}: {:.5}",
            candidate.storage(),
            difference.error
        );
        difference.accepted(&name).unwrap();
    }
    // Its taps differ from pixel to pixel, and a binary test has no filter.
    assert_eq!(without, ["binary", "binary", "pcf_poisson", "pcss"]);
}

/// Every pass of the example is found right, and its bytes are those of its textures.
#[test]
fn the_example_graph_is_checked_and_its_bytes_are_counted() {
    let memories: Vec<Memory> = vec!["224:GTX 970".parse().unwrap(), "100".parse().unwrap()];
    let cost = cost::graph(
        &example("hard_shadows.json"),
        &with_map(256),
        FEWEST_ROUNDS,
        memories.clone(),
    )
    .unwrap();
    let rows: Vec<_> = cost
        .passes
        .iter()
        .map(|pass| {
            assert!(pass.time.x_compute_copy.median > 0.0, "{}", pass.name);
            assert!(pass.time.x_api_copy.median > 0.0, "{}", pass.name);
            assert!(pass.error.is_some(), "{}", pass.name);
            (
                pass.name.as_str(),
                pass.work,
                pass.time.x_draw_copy.is_some(),
            )
        })
        .collect();
    assert_eq!(
        rows,
        [
            ("resolve/resolve", CopyWork::Compute, false),
            ("blur/blur along x", CopyWork::Compute, false),
            ("blur/blur along y", CopyWork::Compute, false),
            ("shade/shade", CopyWork::Fullscreen, true),
        ]
    );
    // 4 samples of 4 bytes and the parameters are read, 8 bytes are written; the blur reads and writes 8 bytes.
    let texels = 256 * 256;
    let costs = &cost.passes;
    assert_eq!(costs[0].bytes_written, 8 * texels);
    assert!(costs[0].bytes_read >= 16 * texels);
    // And the map's one region of 16 bytes.
    assert_eq!(costs[1].bytes_read, 8 * texels + 16);
    assert_eq!(costs[1].minimum_bytes, 16 * texels + 16);
    let moved: u64 = costs.iter().map(|pass| pass.minimum_bytes).sum();
    assert_eq!(cost.bytes_moved, moved);
    // 1,048,592 bytes at 100 GB/s.
    assert!((cost.passes[1].bounds[1].microseconds - 10.48592).abs() < 1e-9);
    for (bound, memory) in cost.bounds.iter().zip(&memories) {
        assert_eq!(*bound, memory.bound(moved));
    }
    let json = serde_json::to_value(&cost).unwrap();
    assert!(json["conditions"]["adapter"].is_string(), "{json}");
    assert!(json["passes"][3]["time"]["x_api_copy"]["median"].is_number());
    assert_eq!(json["passes"][3]["pass"], "shade/shade");
    assert_eq!(json["passes"][0]["bounds"][0]["memory"], "GTX 970");
    let text = cost.to_string();
    for part in [
        "resident",
        "total",
        "a lower bound, not a measurement",
        "GTX 970, 224 GB/s",
    ] {
        assert!(text.contains(part), "{text}");
    }
}

/// 16 MiB at 224 GB/s: 16,777,216 / 224,000 bytes per microsecond.
#[test]
fn a_bandwidth_bounds_time_from_below() {
    let memory: Memory = "224:GTX 970".parse().unwrap();
    assert_eq!(memory.to_string(), "GTX 970, 224 GB/s");
    let bound = memory.bound(16 << 20);
    assert!((bound.microseconds - 74.898_285_714).abs() < 1e-6);
    assert_eq!("448".parse::<Memory>().unwrap().name, "448 GB/s");
    for wrong in ["", "fast", "0", "-1", "inf", "NaN", ":GTX 970"] {
        let refused = wrong.parse::<Memory>().unwrap_err().to_string();
        assert!(
            refused.starts_with(&format!("'{wrong}' is no bandwidth")),
            "{refused}"
        );
    }
}

/// Mip levels are compared with copies of their own size, and those below 64x64 texels are one row.
#[test]
fn mip_levels_are_checked_and_small_ones_are_summed() {
    // Eight probes per pixel take a software adapter many seconds per picture.
    let text = std::fs::read_to_string(example("mipmapped_shadows.json")).unwrap();
    let fewer = text.replace("\"anisotropy\": 8", "\"anisotropy\": 1");
    assert_ne!(text, fewer);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mipmapped.json");
    std::fs::write(&path, fewer).unwrap();
    let cost = cost::graph(&path, &with_map(256), FEWEST_ROUNDS, Memory::known()).unwrap();
    let rows: Vec<_> = cost
        .passes
        .iter()
        .map(|pass| (pass.name.as_str(), pass.texture.as_str(), pass.small))
        .collect();
    assert_eq!(
        rows,
        [
            ("resolve/resolve", "rgba16unorm 256x256", false),
            ("blur/blur along x", "rgba16unorm 256x256", false),
            ("blur/blur along y", "rgba16unorm 256x256", false),
            ("downsample/mip level 1", "rgba16unorm 128x128", false),
            ("downsample/mip level 2", "rgba16unorm 64x64", false),
            (
                "downsample/mip level 3 to mip level 8",
                "rgba16unorm 32x32 .. rgba16unorm 1x1",
                true
            ),
            ("shade/shade", "r8unorm 1280x720", false),
        ]
    );
    let checked: Vec<_> = cost
        .passes
        .iter()
        .map(|pass| pass.error.is_some())
        .collect();
    // The reference of shading knows no mip levels.
    assert_eq!(checked, [true, true, true, true, true, true, false]);
    // 32 x 32 texels and a third of it, 8 bytes each.
    assert_eq!(cost.passes[5].bytes_written, 8 * 1365);
}

/// One direction of a blur alone leaves the other undone; a number beyond the plan's passes is refused.
#[test]
fn passes_are_recorded_one_by_one() {
    let gpu = Gpu::open(Profile::Native).unwrap();
    let storage = Storage::Unorm16;
    let channels = noise(storage, 64 * 64);
    let kernel = moment_shadows::Kernel::gaussian(4, 2.4).unwrap();
    let map = BlurredMap::new(&gpu, storage, [64, 64], &channels, kernel, false).unwrap();
    let zeros = vec![[0.0; 4]; 64 * 64];
    let after = |passes: Option<&[usize]>| {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        map.record(passes, &mut encoder).unwrap();
        gpu.queue.submit([encoder.finish()]);
        map.read(&gpu).unwrap()
    };
    assert_eq!(after(Some(&[])), zeros);
    assert_eq!(after(Some(&[0])), zeros);
    let second = after(Some(&[1]));
    assert_ne!(second, zeros);
    assert_eq!(after(None), second);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let refused = map.record(Some(&[0, 2]), &mut encoder).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "pass number 2 was asked for, but the plan has 2, counted from 0"
    );
}
