//! The biases of tables, against a search over patches.

use moment_shadows::{Storage, SummedAreaTable};
use moment_shadows_lab::bias::search_tables;

const SAMPLES: usize = 20_000;

#[test]
fn the_search_confirms_the_biases() {
    let tables = search_tables(SAMPLES, 11, || ()).unwrap();
    println!("{tables}");
    assert_eq!(tables.rows.len(), 9);
    for row in &tables.rows {
        for (needed, library) in [
            (row.line.all, row.library[0]),
            (row.interval.all, row.library[1]),
        ] {
            // Enough, and at most two and a half times as much: rare patches need more than these samples do, and the error of
            // all channels is seldom as large as it can be.
            let label = format!("{} {}: {needed:e}, {library:e}", row.source, row.side);
            assert!(library > needed && library < 2.5 * needed, "{label}");
        }
        let (deficit, smallest) = (row.variance_deficit, row.smallest_variance);
        let label = format!("{} {}: {deficit:e}, {smallest:e}", row.source, row.side);
        assert!(smallest > deficit && smallest < 4.0 * deficit, "{label}");
    }
}

/// What is stated beside the functions.
#[test]
fn biases_follow_from_the_unit() {
    let alpha = |source, side| {
        let table = SummedAreaTable::new(source, [side; 2]).unwrap();
        table.moment_bias().alpha
    };
    for (source, side, expected) in [
        (Storage::Float32, 9, 1e-6),
        (Storage::Float32, 27, 1e-6),
        (Storage::Float32, 65, 2.8e-6),
        (Storage::Unorm16, 9, 3.8e-5),
        (Storage::Unorm16, 256, 3.8e-5),
        (Storage::Float16, 27, 6.0e-4),
    ] {
        let found = alpha(source, side);
        assert!(
            (found / expected - 1.0).abs() < 0.015,
            "{source} {side}: {found:e}"
        );
    }
    let coarsest = SummedAreaTable::new(Storage::Float32, [65537, 1]).unwrap();
    assert_eq!(coarsest.unit(), 65535);
    assert_eq!(coarsest.moment_bias(), Storage::Fixed32.moment_bias());
    assert_eq!(
        coarsest.hausdorff_moment_bias(),
        Storage::Fixed32.hausdorff_moment_bias()
    );
}
