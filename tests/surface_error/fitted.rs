//! How much light leaks over all surfaces with a range that is too long, and with one that fits itself.

use std::path::Path;

use moment_shadows::Storage;
use moment_shadows_lab::command::error;
use moment_shadows_lab::command::render::RenderOptions;

use crate::setup::options;

/// Light leaking and excess shadow over all surfaces by an example, with a range so many times too long.
fn figures(example: &str, scene: &str, storage: Storage, range_times: f64) -> [f64; 2] {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let graph = root.join(format!("examples/{example}.json"));
    let options = RenderOptions {
        scene: scene.to_owned(),
        storage: Some(storage),
        range_times,
        ..options(64, 4)
    };
    let report = error::measure(&options, &graph, Some(3), None).unwrap();
    let found = report.errors.surfaces.shading;
    [found.leaking, found.overdarkening]
}

#[test]
fn a_range_that_fits_itself_leaks_like_a_tight_one() {
    for scene in ["hall", "fence-and-foliage"] {
        for storage in [Storage::Unorm16, Storage::Float16] {
            let tight = figures("hard_shadows", scene, storage, 1.0);
            let too_long = figures("hard_shadows", scene, storage, 100.0);
            println!(
                "{scene}, {storage}: {tight:.4?} tight, {too_long:.4?} with 100 times the range"
            );
            assert!(too_long[0] > 1.5 * tight[0], "{scene}, {storage}");
            for times in [1.0, 10.0, 100.0] {
                let fitted = figures("fitted_range", scene, storage, times);
                println!("{scene}, {storage}: {fitted:.4?} fitted, of {times} times the range");
                assert!(fitted[0] <= 1.1 * tight[0], "{scene}, {storage}, {times}");
                assert!(
                    fitted[1] <= 1.1 * tight[1] + 1e-3,
                    "{scene}, {storage}, {times}"
                );
            }
        }
    }
}
