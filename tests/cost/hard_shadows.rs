//! Hard shadows from end to end: what is compared, and what is said of it beside times.

use moment_shadows::{Profile, Technique};
use moment_shadows_lab::command::drawn::Drawn;
use moment_shadows_lab::compare::{self, compare};
use moment_shadows_lab::cost::clock::FEATURES;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::hard::{HardStage, candidates};

#[test]
fn maps_are_as_large_and_filters_as_wide() {
    let all = candidates().unwrap();
    let of_maps: Vec<_> = all.iter().filter(|it| !it.file.reads_depth()).collect();
    assert_eq!((of_maps.len(), all.len()), (6, 8));
    for candidate in of_maps {
        let encoding = candidate.file.encoding().unwrap();
        assert_eq!(encoding.bits_per_texel(), 64, "{}", candidate.name);
        assert_eq!(candidate.file.radius().unwrap(), 4, "{}", candidate.name);
    }
    let taps = all[6..].iter().map(|it| match it.file.technique() {
        Some(Technique::Pcf(taps)) => serde_json::to_value(taps).unwrap(),
        other => panic!("{other:?}"),
    });
    let taps: Vec<_> = taps.collect();
    // The graph's own kernel.
    assert_eq!(taps[0]["gaussian"]["radius"], 4);
    let sigma = taps[0]["gaussian"]["sigma"].as_f64().unwrap();
    assert!((sigma - 2.4).abs() < 1e-6, "{sigma}");
    assert_eq!(taps[1]["hardware"]["radius"], 2);
}

#[test]
fn errors_and_bytes_stand_beside_times() {
    let gpu = Gpu::open_with(Profile::Native, FEATURES).unwrap();
    let drawn = Drawn {
        map: [256; 2],
        picture: [160, 90],
        ..Drawn::default()
    };
    let options = compare::Options {
        scene: vec!["hall".to_owned()],
        cost: Some(9),
        ..compare::Options::default()
    };
    let reports = compare(&gpu, &options, candidates().unwrap(), |scene| {
        HardStage::new(&gpu, scene, drawn)
    });
    let report = &reports.unwrap()[0];
    println!("{report}");
    let rows = &report.rows;
    let error = |row: usize| rows[row].errors.error.facing.mean_absolute;
    // Both unorm16 and packed texels err less than two variances in as many bits.
    assert!(error(0) < error(4) && error(2) < error(4));
    // The same filter, texel by texel, errs as one sample per texel does in place of four.
    assert!(error(6) < 0.05, "{}", error(6));
    for pair in [0, 2, 4] {
        let [apart, joined] = [pair, pair + 1].map(|row| rows[row].errors.bytes_moved);
        // A map of 256 x 256 texels of 8 bytes is neither written nor read in between, and a block of parameters is read once less.
        let map = 2 * 8 * 256 * 256;
        assert!((map..map + 256).contains(&(apart - joined)));
        assert!((error(pair) - error(pair + 1)).abs() < 1e-3);
    }
    for row in rows {
        let cost = row.cost.unwrap();
        assert!(cost.total_ratio.median > 0.0, "{}", row.name);
        assert_eq!(cost.map.is_some(), !row.name.contains("comparison"));
    }
    assert_eq!(rows[0].cost.unwrap().total_ratio.median, 1.0);
}
