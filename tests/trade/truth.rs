//! Truths with many samples per texel.

use moment_shadows_lab::command::render::RenderOptions;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_file::GraphFile;
use moment_shadows_lab::host::read_depth_samples;
use moment_shadows_lab::scene;
use moment_shadows_lab::truth::kernel::{even_positions, sample_positions};
use moment_shadows_lab::truth::surface::{DepthRounding, MomentDepths};

/// Every axis has all samples at different places, in the middle of as many parts; they are those of any square that is as large.
#[test]
fn positions_are_even() {
    let positions = even_positions(64);
    for axis in 0..2 {
        let mut places: Vec<f64> = positions.iter().map(|position| position[axis]).collect();
        places.sort_by(f64::total_cmp);
        for (index, place) in places.iter().enumerate() {
            assert!(
                (place - (index as f64 + 0.5) / 64.0).abs() < 1e-12,
                "{place}"
            );
        }
    }
    // Eight by eight squares hold one each.
    let mut squares: Vec<[u32; 2]> = (positions.iter())
        .map(|position| position.map(|place| (8.0 * place) as u32))
        .collect();
    squares.sort_unstable();
    squares.dedup();
    assert_eq!(squares.len(), 64);
}

/// Maps that are drawn one by one, each moved by a part of a texel, hold what a multisampled map holds at the same places.
#[test]
fn moved_maps_are_the_samples_of_one() {
    let text = include_str!("../../examples/hard_shadows.json").to_owned();
    let file = GraphFile::parse("hard_shadows.json", text, None).unwrap();
    let options = RenderOptions {
        map: Some(256),
        size: Some([160, 90]),
        ..RenderOptions::default()
    };
    let gpu = Gpu::open(moment_shadows::Profile::Native).unwrap();
    let scene = scene::load("fence-and-foliage").unwrap();
    let drawn = options.drawn(&file).unwrap();
    let frame = options.frame(&gpu, &scene, &drawn, 4).unwrap();
    let light = &frame.desc.light;
    let stored = read_depth_samples(&gpu, &frame.light_map.texture).unwrap();
    let at_once = MomentDepths::from_stored(light, &stored, DepthRounding::Float32).unwrap();
    let one_by_one = frame
        .light_samples(&gpu, sample_positions(4).unwrap())
        .unwrap();
    let (mut same, mut all) = (0, 0);
    for y in 0..256 {
        for sample in 0..4 {
            let rows = [&at_once, &one_by_one].map(|depths| depths.row(y, sample, 0, 256));
            for (one, other) in rows[0].iter().zip(rows[1]) {
                all += 1;
                same += usize::from((one - other).abs() < 1e-5);
            }
        }
    }
    assert_eq!(all, 4 * 256 * 256);
    // Vertices snap to a grid of 1/256 texel, to other places of it when all is moved: that shows along edges alone.
    println!("{same} of {all} are the same");
    assert!(same as f64 > 0.995 * f64::from(all), "{same}");
}
