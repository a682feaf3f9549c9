//! What lights the air with the least error: the record, and what the library goes by.

use moment_shadows::{AirLight, Resolution, ScatteringWay};
use moment_shadows_lab::scattering::{WaysRecord, ways_record};

#[test]
fn the_library_goes_by_the_record() {
    let text = std::fs::read_to_string(ways_record()).unwrap();
    let record: WaysRecord = serde_json::from_str(&text).unwrap();
    let mut found = 0;
    for light in [AirLight::Sun, AirLight::Spot, AirLight::Point] {
        for homogeneous in [false, true] {
            let suits = record.rows.iter();
            let rows: Vec<_> = suits
                .filter(|row| row.light == light && row.homogeneous == homogeneous)
                .map(|row| (row.way, row.lookups, row.error))
                .collect();
            let known: Vec<_> = ScatteringWay::by_error(light, homogeneous).collect();
            assert_eq!(known, rows, "{light:?}, {homogeneous}");
            assert!(rows.is_sorted_by(|a, b| a.2 <= b.2));
            found += rows.len();
        }
    }
    assert_eq!(found, record.rows.len());
}

#[test]
fn the_best_keeps_to_its_lookups_and_is_prefiltered_for_suns_in_one_density() {
    let best = ScatteringWay::best;
    // The same for every light: six moments stay for suns in homogeneous air, where few lookups are to be had.
    assert_eq!(
        best(AirLight::Sun, true, 2.0),
        Some(ScatteringWay::Prefiltered)
    );
    assert_ne!(
        best(AirLight::Sun, true, 64.0),
        Some(ScatteringWay::Prefiltered)
    );
    for light in [AirLight::Sun, AirLight::Spot, AirLight::Point] {
        assert_eq!(best(light, false, 0.25), None);
        let most = best(light, false, f64::INFINITY);
        let full = ScatteringWay::Marched {
            steps: 64,
            resolution: Resolution::Full,
        };
        assert_eq!(most, Some(full), "{light:?}");
        for lookups in [0.5, 1.0, 2.0, 4.0, 8.0, 16.0] {
            let way = best(light, false, lookups).unwrap();
            let mut all = ScatteringWay::by_error(light, false);
            let (_, taken, error) = all.find(|(it, ..)| *it == way).unwrap();
            assert!(taken <= lookups, "{light:?} {lookups}");
            // Nothing else within the lookups is better.
            let mut all = ScatteringWay::by_error(light, false);
            assert!(all.all(|(_, of_way, off)| of_way > lookups || off >= error));
        }
    }
}
