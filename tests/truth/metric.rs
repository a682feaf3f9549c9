//! Error figures.

use moment_shadows_lab::metric::{compare, excess};

#[test]
fn error_figures_are_those_of_the_definition() {
    let truth = [0.0, 1.0, 0.5, 0.5, 1.0];
    let estimate = [0.25, 0.5, 0.5, 0.25, f32::NAN];
    let comparison = compare(&estimate, &truth, &[true, true, true, true, false]).unwrap();
    let facing = comparison.facing;
    assert_eq!(facing.samples, 4);
    assert_eq!((facing.leaking, facing.overdarkening), (0.1875, 0.0625));
    assert_eq!(facing.mean_absolute, 0.25);
    assert_eq!((facing.percentile_95, facing.maximum), (0.5, 0.5));
    assert_eq!(comparison.penumbra.samples, 2);
    assert_eq!(comparison.penumbra.mean_absolute, 0.125);
    assert_eq!(comparison.nan_pixels, 1);
    assert_eq!(comparison.picture_mean_absolute, 2.0 / 5.0);
    assert!(comparison.to_string().contains("NaN pixels 1"));
    // 95 % of 20 values: the second largest.
    let mut estimate = [0.0f32; 20];
    (estimate[3], estimate[7]) = (0.5, 0.25);
    let figures = compare(&estimate, &[0.0; 20], &[true; 20]).unwrap().facing;
    assert_eq!((figures.percentile_95, figures.maximum), (0.25, 0.5));
    let nothing = compare(&[], &[], &[]).unwrap();
    assert!(nothing.facing.mean_absolute.is_nan());
    assert!(nothing.to_string().contains("no pixel"), "{nothing}");
    let json = serde_json::to_value(nothing.facing).unwrap();
    assert_eq!(json["maximum"], serde_json::Value::Null);
    let error = compare(&[0.0], &[0.0, 1.0], &[true]).unwrap_err();
    assert!(
        error.to_string().contains("the estimate has 1 entries"),
        "{error}"
    );
}

#[test]
fn excess_is_relative_to_the_exact_bound() {
    let truth = [1.0, 1.0, 0.0, 0.0];
    let facing = [true; 4];
    let exact = compare(&[0.75, 0.75, 0.0, 0.0], &truth, &facing).unwrap();
    let stored = compare(&[0.75, 0.5, 0.25, 0.0], &truth, &facing).unwrap();
    let found = excess(&stored, &exact);
    assert_eq!((found.error, found.leaking), (Some(1.0), Some(0.5)));
    let perfect = compare(&truth, &truth, &facing).unwrap();
    assert_eq!(excess(&stored, &perfect).error, None);
    assert!(found.to_string().contains("error +100.0 %"));
}
