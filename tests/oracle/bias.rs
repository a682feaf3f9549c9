//! The search for moment biases.

use moment_shadows::{Storage, Technique};
use moment_shadows_lab::bias::{
    BiasTechnique, Condition, Form, error_factor, measure, rounded, search,
};

const SAMPLES: usize = 30_000;

/// The factors that were found independently, by maximisation in other coordinates; they are stated to three digits.
#[test]
fn error_factors_are_the_known_ones() {
    let published = Form::published();
    let [line, interval] = [Condition::Line, Condition::Interval];
    let named = |name: &str| {
        published
            .iter()
            .find(|form| form.name == name)
            .unwrap()
            .clone()
    };
    let library = Form::of_library;
    for (form, factor) in [
        (library(Storage::Unorm16, line), 4.88),
        (library(Storage::Unorm8, line), 4.88),
        (library(Storage::Float16, line), 4.88),
        (library(Storage::Float32, line), 9.91),
        (library(Storage::Unorm16, interval), 6.14),
        (library(Storage::Float32, interval), 18.4),
        (named("theta_4, 0.8/0.2"), 14.8),
        (named("raw [0,1], 0.8/0.2"), 755.0),
    ] {
        let found = error_factor(&form);
        assert!(
            (found / factor - 1.0).abs() < 2e-3,
            "{}: {found}, not {factor}",
            form.name
        );
    }
    for &storage in Technique::Hamburger6.row().storages {
        // All have the same basis and the same target.
        let found = error_factor(&Form::of_six_moments(storage).unwrap());
        assert!((found / 7.15 - 1.0).abs() < 2e-3, "{storage}: {found}");
    }
    // The target is on the boundary itself.
    assert_eq!(error_factor(&named("theta_4, 1/2")), f64::INFINITY);
}

#[test]
fn the_search_confirms_the_library_and_stays_within_the_bound() {
    let table = search(BiasTechnique::Hamburger4, None, (0, SAMPLES, 8), || ()).unwrap();
    println!("{table}");
    assert_eq!(table.rows.len(), 3 + Form::published().len());
    let interval = search(BiasTechnique::Hausdorff4, None, (0, SAMPLES, 8), || ()).unwrap();
    println!("{interval}");
    assert_eq!(interval.rows.len(), 3);
    for row in table.rows[..3].iter().chain(&interval.rows) {
        let library = row.library.unwrap();
        let needed = row.three_roundings.all;
        // Enough, and not twice as much as needed; rare patches need up to 10 % more than these samples do.
        assert!(
            library > 0.9 * needed && library < 2.0 * needed,
            "{}: {needed:e}",
            row.form
        );
        // One rounding needs less than the first-order bound, which is tight.
        let once = row.one_rounding.all;
        assert!(
            once < row.bound && once > 0.6 * row.bound,
            "{}: {once:e}",
            row.form
        );
        assert!(row.recommended >= row.three_roundings.most);
        assert!(row.recommended <= 1.6 * row.three_roundings.most);
        assert_eq!(row.three_roundings.beyond_repair, 0.0);
    }
    // Texels that are rounded inwards need a third of their bias, all of them, and that is far less than one rounding to the nearest needs.
    for row in &table.rows[..2] {
        let inwards = row.inwards.unwrap();
        let library = row.library_inwards.unwrap();
        assert!(inwards.all <= 0.334 * library, "{}: {inwards:?}", row.form);
        assert!(inwards.most > 0.3 * library, "{}: {inwards:?}", row.form);
        assert!(3.0 * inwards.all < row.one_rounding.most, "{}", row.form);
    }
    assert!(
        table.rows[2..]
            .iter()
            .chain(&interval.rows)
            .all(|row| row.inwards.is_none())
    );
    // No bias towards (1/2, 1/2, 1/2, 1/2) repairs depths that were clamped to the ends of [0, 1].
    for row in table.rows.iter().filter(|row| row.form.ends_with("1/2")) {
        assert_eq!(row.three_roundings.all, f64::INFINITY);
        let share = row.three_roundings.beyond_repair;
        assert!((0.01..0.2).contains(&share), "{}: {share}", row.form);
    }
    // Half precision is finest around zero, and depth in [0, 1] wastes bits.
    let needed = |name: &str| {
        let row = table.rows.iter().find(|row| row.form == name).unwrap();
        row.three_roundings.all
    };
    assert!(needed("f16, not centred") > 1.3 * needed("float16"));
    assert!(needed("theta_4, 0.8/0.2") > 1.8 * needed("unorm16"));
    assert!(needed("raw [0,1], 0.8/0.2") > 40.0 * needed("float32"));
}

#[test]
fn the_search_confirms_the_biases_of_six_moments() {
    let table = search(BiasTechnique::Hamburger6, None, (0, SAMPLES, 8), || ()).unwrap();
    println!("{table}");
    assert_eq!(table.rows.len(), 4);
    for row in &table.rows {
        let library = row.library.unwrap();
        let needed = row.three_roundings.all;
        // Enough, and not twice as much as needed; that of float32 serves decoding and evaluation in f32, whose roundings are no
        // storage's.
        let most = if row.form == "float32" { 30.0 } else { 2.0 };
        assert!(
            library > 0.9 * needed && library < most * needed,
            "{}: {needed:e}",
            row.form
        );
        // One rounding needs less than the first-order bound; few patches come near all the errors that it adds up.
        let once = row.one_rounding.all;
        assert!(
            once < row.bound && once > 0.5 * row.bound,
            "{}: {once:e}",
            row.form
        );
        assert_eq!(row.target.len(), 6);
        assert_eq!(row.three_roundings.beyond_repair, 0.0);
    }
    let refused = search(
        BiasTechnique::Hamburger6,
        Some(Storage::Unorm8),
        (0, 10, 8),
        || (),
    );
    let refused = refused.unwrap_err().to_string();
    assert!(refused.contains("not stored as unorm8"), "{refused}");
    let unorm10 = search(
        BiasTechnique::Hamburger6,
        Some(Storage::Unorm10),
        (0, 10, 8),
        || (),
    );
    assert_eq!(unorm10.unwrap().rows[0].form, "unorm10");
}

#[test]
fn an_interval_asks_for_a_little_more() {
    for storage in Storage::OF_FOUR_MOMENTS {
        let [line, interval] = [Condition::Line, Condition::Interval].map(|condition| {
            measure(
                &Form::of_library(storage, condition),
                (0, SAMPLES, 9),
                || (),
            )
            .unwrap()
        });
        assert!(interval.one_rounding.all <= interval.bound);
        let ratio = interval.three_roundings.all / line.three_roundings.all;
        assert!((1.0..2.5).contains(&ratio), "{storage}: {ratio}");
        // The target of the real line is on the interval's boundary, and repairs nothing there.
        let mut wrong = Form::of_library(storage, Condition::Interval);
        wrong.target = Form::of_library(storage, Condition::Line).target;
        let wrong = measure(&wrong, (0, 3000, 9), || ()).unwrap();
        assert_eq!(wrong.three_roundings.all, f64::INFINITY);
        assert_eq!(wrong.error_factor, f64::INFINITY);
    }
}

#[test]
fn the_search_is_the_same_on_any_number_of_threads() {
    let run = |count| {
        let threads = rayon::ThreadPoolBuilder::new()
            .num_threads(count)
            .build()
            .unwrap();
        let search = || {
            search(
                BiasTechnique::Hausdorff4,
                Some(Storage::Float16),
                (0, 9000, 10),
                || (),
            )
        };
        threads.install(search).unwrap()
    };
    assert_eq!(run(1), run(3));
    assert_eq!(run(1).rows.len(), 1);
    let refused = search(BiasTechnique::Hausdorff4, None, (0, 0, 10), || ());
    assert!(refused.unwrap_err().to_string().starts_with("0 samples"));
}

#[test]
fn stored_values_are_the_nearest() {
    // 1/3 is exact in 16-bit fixed point (21845 / 65535); halves of steps round away from zero.
    assert_eq!(rounded(Storage::Unorm16, 1.0 / 3.0), 21845.0 / 65535.0);
    assert_eq!(rounded(Storage::Unorm16, -0.1), 0.0);
    assert_eq!(rounded(Storage::Unorm16, 1.1), 1.0);
    // Ties to even in half precision: 11 bits of mantissa.
    assert_eq!(rounded(Storage::Float16, 0.25 + 2.0_f32.powi(-13)), 0.25);
    assert_eq!(
        rounded(Storage::Float16, 0.25 + 3.0 * 2.0_f32.powi(-13)),
        0.25 + 2.0_f32.powi(-11)
    );
    assert_eq!(rounded(Storage::Float32, 0.1), 0.1);
    // 10 bits: 1/3 is 341 / 1023.
    assert_eq!(rounded(Storage::Unorm10, 1.0 / 3.0), 341.0 / 1023.0);
    assert_eq!(rounded(Storage::Unorm10, 0.6 / 1023.0), 1.0 / 1023.0);
    assert_eq!(rounded(Storage::Unorm10, 1.1), 1.0);
}
