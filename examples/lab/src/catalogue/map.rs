//! What makes, filters, sums and shows maps.

use moment_shadows::{Finite, Kernel, MapEncoding, Storage, Technique, TextureFormat, ValueError};
use moment_shadows_graph::nodes::{
    Blur, BlurKernel, DebugMoments, Downsample, FitRange, PlaceLayers, Resolve, Show,
    SummedAreaTable,
};

use super::{SIZE, Variant};
use crate::techniques;

/// Regions of an atlas, where one is not enough.
const REGIONS: u32 = 16;

fn resolve(map: &MapEncoding) -> Variant {
    let node = Resolve {
        technique: Some(map.technique().clone()),
        blends: map.blends(),
        bits: None,
        storage: vec![map.storage()],
        mip_levels: Some(1),
    };
    Variant::new(node, map)
}

fn blur(map: &MapEncoding, radius: u32, per_frame: bool) -> Variant {
    let node = Blur {
        kernel: Kernel::gaussian(radius, 0.6 * radius as f32).map(Into::into),
        per_frame,
        resolve: None,
        rounded_inwards: false,
        mip_levels: Some(1),
    };
    Variant::new(node, map)
}

/// A blur of four samples per texel that resolves by itself.
fn resolved_blur(map: &MapEncoding, radius: u32, rounded_inwards: bool) -> Variant {
    let node = Blur {
        kernel: Kernel::gaussian(radius, 0.6 * radius as f32).map(Into::into),
        per_frame: false,
        resolve: Some(Resolve {
            technique: Some(map.technique().clone()),
            storage: vec![map.storage()],
            blends: 0,
            bits: None,
            mip_levels: Some(1),
        }),
        rounded_inwards,
        mip_levels: Some(1),
    };
    Variant::new(node, map).samples(4)
}

/// A kernel of radius 12 at most for each region.
fn in_scene(map: &MapEncoding) -> Variant {
    let width = Finite::new(0.05).unwrap_or_default();
    let node = Blur {
        kernel: Ok(BlurKernel::Scene { width, radius: 12 }),
        per_frame: false,
        resolve: None,
        rounded_inwards: false,
        mip_levels: Some(1),
    };
    Variant::new(node, map)
}

/// Every level but the first has a pass with the same shader, so that two levels are enough.
fn downsample(map: &MapEncoding) -> Variant {
    Variant::new(Downsample {}, map).mips(2)
}

/// Maps of four moments.
pub(super) fn of_four_moments(four: &MapEncoding) -> Result<Vec<Variant>, ValueError> {
    let storage = four.storage();
    let unorm16 = storage == Storage::Unorm16;
    let mut all = Vec::new();
    for (samples, regions, listed) in [
        (1, 1, true),
        (2, 1, false),
        (4, 1, true),
        (8, 1, false),
        (4, REGIONS, false),
    ] {
        let made = resolve(four).samples(samples).regions(regions);
        let name = format!("resolve_{storage}_{samples}");
        let settings = format!("{storage}, {samples} samples");
        all.push(made.file(name, listed).row(listed, settings, &[]));
    }
    let fitted = resolve(four).samples(4).fitted();
    let settings = format!("{storage}, 4 samples, fitted");
    let fitted = fitted.file(format!("resolve_fitted_{storage}"), unorm16);
    all.push(fitted.row(unorm16, settings, &[]));
    for (kind, samples) in [("distances", 1), ("distances_samples", 4)] {
        let made = resolve(four)
            .samples(samples)
            .depth(TextureFormat::R32Float);
        all.push(made.file(format!("resolve_{kind}_{storage}"), false));
    }
    let blurred = |kind: &str, radius, per_frame, regions, kept| {
        blur(four, radius, per_frame)
            .regions(regions)
            .file(format!("blur_{kind}_{storage}"), kept)
    };
    let row = |radius| format!("{storage}, radius {radius}");
    all.extend([
        blurred("unrolled", 1, false, 1, unorm16),
        blurred("unrolled_radius_4", 4, false, 1, false).row(true, row(4), &[]),
        blurred("unrolled_radius_12", 12, false, 1, false).row(true, row(12), &[]),
        blurred("unrolled_radius_12", 12, false, REGIONS, false),
        // Taps in blocks of 16, for 16 texels at a time.
        blur(four, 32, false).row(true, row(32), &[5]),
        blur(four, 64, false).row(true, row(64), &[9]),
        // A workgroup looks for its region; it may be the last.
        blur(four, 4, false)
            .regions(4)
            .row(unorm16, row(4) + ", 4 regions", &[4]),
        resolved_blur(four, 4, false)
            .file(format!("blur_resolved_{storage}"), unorm16)
            .row(unorm16, format!("{storage}, radius 4, 4 samples"), &[]),
        resolved_blur(four, 12, false).row(
            unorm16,
            format!("{storage}, radius 12, 4 samples"),
            &[],
        ),
        // The weights are parameters: one text for every radius.
        blurred("uniform", 1, true, 1, unorm16),
        blurred("uniform", 1, true, REGIONS, false),
        // Kernels of radius 12 as parameters, of all regions and of each.
        blur(four, 12, true)
            .regions(4)
            .row(unorm16, row(12) + ", per frame, 4 regions", &[4, 3]),
        in_scene(four)
            .regions(4)
            .file(format!("blur_in_scene_{storage}"), unorm16)
            .row(
                unorm16,
                row(12) + " at most, a kernel for each of 4 regions",
                &[4, 3],
            ),
    ]);
    // No other storages are rounded inwards.
    if four.clone().rounded_inwards().is_ok() {
        let name = format!("blur_inwards_{storage}");
        let row = |radius| format!("{storage}, radius {radius}, 4 samples, inwards");
        let kept = 2 * usize::from(unorm16);
        all.extend([
            resolved_blur(four, 4, true)
                .file(name, kept)
                .row(unorm16, row(4), &[]),
            resolved_blur(four, 12, true).row(unorm16, row(12), &[]),
        ]);
    }
    let name = format!("downsample_{storage}");
    let smaller = downsample(four).file(&name, unorm16);
    all.push(smaller.row(true, storage.to_string(), &[]));
    all.push(downsample(four).regions(REGIONS).file(name, false));
    for (name, show) in [
        ("moments", Show::Moments),
        ("mean", Show::Mean),
        ("deviation", Show::Deviation),
        ("validity", Show::Validity),
    ] {
        let listed = unorm16 && show == Show::Validity;
        let shown = Variant::new(DebugMoments { show, level: 0 }, four)
            .file(format!("debug_moments_{storage}_{name}"), listed);
        all.push(shown.row(listed, storage.to_string(), &[]));
    }
    all.extend(summed(four)?);
    Ok(all)
}

/// Summed-area tables with both tiles, of four moments and of two.
fn summed(four: &MapEncoding) -> Result<Vec<Variant>, ValueError> {
    let storage = four.storage();
    let unorm16 = storage == Storage::Unorm16;
    let table = |kind: &str, regions, kept: usize| {
        Variant::new(SummedAreaTable::default(), four)
            .regions(regions)
            .file(format!("summed_area_table{kind}_{storage}"), kept)
    };
    let counted = |table: Variant, listed, tile: [u32; 2]| {
        // Tiles but the last, four or two at a time.
        let steps = |axis: usize, unrolled| (SIZE[axis] / tile[axis] - 1).div_ceil(unrolled);
        let settings = format!("{storage}, tiles of {}x{}", tile[0], tile[1]);
        // Rows of a tile.
        table
            .row(listed, settings, &[tile[1]])
            .pass("sum rows", &[steps(0, 4)])
            .pass("sum columns", &[steps(1, 2)])
    };
    let software = table("_software", 1, 0).on(|capabilities| capabilities.software_adapter = true);
    let two = MapEncoding::new(Technique::Vsm, storage)?;
    Ok(vec![
        // Storages change the text of tiles alone.
        counted(table("", 1, if unorm16 { 4 } else { 1 }), true, [8, 16]),
        counted(software, unorm16, [16, 16]),
        table("", REGIONS, 0),
        table("_vsm", 1, usize::from(!unorm16)).connected(&two),
    ])
}

/// Fitting ranges and placing layers, for one depth map with one region and one with several.
pub(super) fn of_depth(any: &MapEncoding) -> Vec<Variant> {
    let node = PlaceLayers::default();
    let place = |samples, regions| {
        Variant::new(node, any)
            .samples(samples)
            .regions(regions)
            .file(format!("place_layers_{samples}"), regions == 1)
    };
    let fit = |samples, regions| {
        Variant::new(FitRange {}, any)
            .samples(samples)
            .regions(regions)
            .file(format!("fit_range_{samples}"), regions == 1)
            .without_camera()
    };
    // The tiles of the picture per invocation, whose corners are unrolled, come before the blocks.
    let seeing = Variant::new(FitRange {}, any)
        .file("fit_range_seen", 4_usize)
        .row(true, "1 samples, of what the camera sees", &[])
        .pass("see tiles", &[1])
        .pass("find ends", &[1, 1, 4, 8])
        .pass("fit ranges", &[1, 4, 8])
        .pass("keep ranges", &[1]);
    vec![
        // Memory of the workgroup that is cleared; blocks of a workgroup, or workgroups per invocation; halvings of their ends.
        fit(1, 1)
            .row(true, "1 samples", &[])
            .pass("find ends", &[1, 4, 8])
            .pass("fit ranges", &[1, 4, 8])
            .pass("keep ranges", &[1]),
        fit(4, 1),
        fit(4, REGIONS),
        seeing,
        // Splits of layers of equal depth, where there is no state yet; parts of a tile, or tiles per invocation; halvings of
        // a workgroup's sums. And for either of two splits the others that it may pass, in front and behind.
        place(1, 1)
            .row(true, format!("{} layers, 1 samples", node.layers), &[])
            .pass("sum tiles", &[3, 4, 8])
            .pass("step splits", &[3, 4, 8, 2, 2, 2, 2]),
        place(4, 1),
        place(4, REGIONS),
    ]
}

/// How another technique's map is made and filtered.
pub(super) fn of_technique(map: &MapEncoding) -> Vec<Variant> {
    let drawn = map.storage().is_drawn();
    let suffix = format!("{}_{}", techniques::label(map.technique()), map.storage());
    let mut all = Vec::new();
    if map.storage().is_written_once() {
        let storage = map.storage();
        let row = |radius| format!("{storage}, radius {radius}, 4 samples");
        return vec![
            resolved_blur(map, 4, false)
                .file(format!("blur_resolved_{storage}"), 2_usize)
                .row(true, row(4), &[]),
            resolved_blur(map, 12, false).row(true, row(12), &[]),
        ];
    }
    // A map that several techniques read is made and filtered alike for all of them.
    let reads = |other: &Technique| other.row().shares_map_with(&map.technique().row());
    let first = Technique::examples().into_iter().find(reads);
    if first.is_none_or(|first| first.name() == map.technique().name()) {
        let name = format!("resolve_{suffix}");
        all.push(
            resolve(map)
                .samples(4)
                .file(name, super::is_kept(map) || drawn),
        );
    }
    // Only logarithms are filtered otherwise.
    if suffix.contains("logarithmic") {
        let name = format!("blur_{suffix}");
        all.push(blur(map, 1, false).file(name, false));
    }
    if drawn {
        all.extend(by_drawing(map, &suffix));
    }
    all
}

/// A map that is drawn: whatever changes the text of what draws it. One region is looked for, too.
fn by_drawing(map: &MapEncoding, suffix: &str) -> Vec<Variant> {
    let mut all = vec![
        resolve(map)
            .file(format!("resolve_single_{suffix}"), false)
            .row(true, map.to_string(), &[1]),
        resolve(map)
            .samples(4)
            .regions(REGIONS)
            .file(format!("resolve_{suffix}"), false),
        super::shade::in_mip_levels(map, suffix),
        blur(map, 4, false).row(true, format!("{map}, radius 4"), &[1]),
        // A loop that looks for the region, and one over all taps.
        blur(map, 32, false).row(true, format!("{map}, radius 32"), &[1, 65]),
    ];
    for regions in [1, REGIONS] {
        let one = regions == 1;
        for (kind, per_frame) in [("unrolled", false), ("uniform", true)] {
            let name = format!("blur_{kind}_{suffix}");
            all.push(blur(map, 1, per_frame).regions(regions).file(name, one));
        }
        let name = format!("downsample_{suffix}");
        let smaller = downsample(map).regions(regions).file(name, one);
        all.push(smaller.row(one, map.to_string(), &[1]));
    }
    all
}
