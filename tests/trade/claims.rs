//! Claims of papers: verdicts follow from figures by their rules.

use moment_shadows_lab::claims::evidence::{Evidence, Figure};
use moment_shadows_lab::claims::record::Verdict;
use moment_shadows_lab::claims::table::{CLAIMS, Claim};
use moment_shadows_lab::claims::{Extent, judge};
use moment_shadows_lab::trade::Judged;
use moment_shadows_lab::trade::results::{Errors, Figures};

#[test]
fn a_verdict_says_in_how_many_places_a_claim_holds() {
    for (holds, verdict) in [
        ([0, 0], Verdict::NotMeasured),
        ([7, 7], Verdict::Reproduced),
        ([6, 7], Verdict::Qualified),
        ([4, 8], Verdict::Qualified),
        ([3, 7], Verdict::Contradicted),
        ([0, 1], Verdict::Contradicted),
    ] {
        assert_eq!(Verdict::of(holds), verdict, "{holds:?}");
    }
}

/// A technique with these errors of pictures, view by view. Over surfaces they are twice as large, a half of that too light.
fn judged(name: &str, radius: u32, pictures: &[f64]) -> Judged {
    let figures = |error: f64| Figures {
        error,
        leaking: 0.5 * error,
        too_dark: 0.5 * error,
        percentile_95: error,
    };
    let errors = |(view, error): (u32, &f64)| Errors {
        view,
        picture: Some(figures(*error)),
        penumbra: None,
        surfaces: Some(figures(2.0 * error)),
        facing_surfaces: None,
        nan: 0,
        flip: None,
    };
    Judged {
        scene: "hall".to_owned(),
        radius,
        name: name.to_owned(),
        views: (0..).zip(pictures).map(errors).collect(),
    }
}

fn claim(one: &'static str, other: &'static str, figure: Figure) -> Claim {
    let [topic, source, says] = ["order", "a paper", "the one errs less"];
    Claim {
        topic,
        source,
        says,
        one,
        other,
        at_most: 1.0,
        figure,
    }
}

/// Views and filters are compared with themselves, and figures are the ones that a claim is about.
#[test]
fn figures_of_the_same_view_and_filter_are_compared() {
    let evidence = Evidence {
        hard: vec![
            judged("vsm unorm16", 2, &[0.01, 0.02]),
            judged("vsm unorm16", 6, &[0.05, 0.06]),
            judged("esm float32", 6, &[0.10, 0.20]),
            judged("esm float32", 2, &[0.03, 0.01]),
        ],
        ..Evidence::default()
    };
    let of = |figure| {
        let cases = evidence.cases(&claim("vsm unorm16", "esm float32", figure));
        let rounded = |figure: f64| (1e6 * figure).round() / 1e6;
        let case = |case: moment_shadows_lab::claims::evidence::Case| {
            (case.place, case.figures.map(rounded))
        };
        cases.into_iter().map(case).collect::<Vec<_>>()
    };
    let place = |view: u32, radius: u32| format!("hall, view {view}, radius {radius}");
    let pictures = [
        (place(0, 2), [1.0, 3.0]),
        (place(1, 2), [2.0, 1.0]),
        (place(0, 6), [5.0, 10.0]),
        (place(1, 6), [6.0, 20.0]),
    ];
    assert_eq!(of(Figure::Picture), pictures);
    let twice = pictures
        .clone()
        .map(|(place, figures)| (place, figures.map(|it| 2.0 * it)));
    assert_eq!(of(Figure::Surfaces), twice);
    assert_eq!(of(Figure::Leaking), pictures);
    let missing = claim("vsm unorm16", "evsm4 float32", Figure::Picture);
    assert!(evidence.cases(&missing).is_empty());
}

/// Some claims of each kind, on small pictures: each has its places and figures.
#[test]
fn claims_are_measured() {
    let figures = [
        Figure::Leaking,
        Figure::Air,
        Figure::AirTime,
        Figure::Growth,
    ];
    let some: Vec<Claim> = (figures.iter())
        .map(|figure| *CLAIMS.iter().find(|it| it.figure == *figure).unwrap())
        .collect();
    let record = judge(&some, Extent::Quick).unwrap();
    let text = record.to_string();
    for row in &record.rows {
        let [holds, all] = row.holds;
        assert!(all >= 1 && holds <= all, "{row:?}");
        assert!(row.means.iter().all(|mean| mean.is_finite()), "{row:?}");
        // How times grow is anything on a busy machine.
        let grows = row.figure[0].starts_with("growth");
        assert!(grows || row.means[1] > 0.0, "{row:?}");
        assert!(!row.worst.0.is_empty(), "{row:?}");
        assert_eq!(row.verdict, Verdict::of(row.holds));
        assert!(text.contains(&row.says), "{text}");
    }
    // One light leaks in both, and each claim with storages says which devices it is about.
    assert_eq!(record.rows[0].profile.as_deref(), Some("native"));
    assert_eq!(record.rows[1].profile, None);
}
