//! Gates, growth and the table.

use crate::time;
use moment_shadows::Storage;
use moment_shadows_graph::TextureDesc;
use moment_shadows_lab::cost::blur::BOUNDS;
use moment_shadows_lab::cost::clock::ClockKind;
use moment_shadows_lab::cost::report::Conditions;
use moment_shadows_lab::cost::table::{CostTable, Facts, Gate, Row};

/// A subject at a size that takes so many copies and so many seconds per texel.
fn row(name: &str, size: u32, copies: f64, per_texel: f64, gate: Gate) -> Row {
    let mut time = time(copies, 0.1);
    time.seconds.median = per_texel * f64::from(size) * f64::from(size);
    let facts = Facts(vec![("size", size.into())]);
    let written = [TextureDesc::new(Storage::Unorm16.format(), [size; 2])];
    Row {
        gate,
        ..Row::new((name.to_owned(), facts), &written, [0; 2], time)
    }
}

fn table(clock: ClockKind, rows: Vec<Row>) -> CostTable {
    let conditions = Conditions {
        adapter: String::new(),
        driver: String::new(),
        device_type: String::new(),
        clock,
        rounds: 9,
    };
    CostTable::new(conditions, "it", rows)
}

#[test]
fn a_gate_holds_on_software_adapters_alone() {
    let gate = Gate {
        gate: Some(4.5),
        goal: Some(3.4),
        largest_growth: None,
    };
    let passed = |clock, copies| table(clock, vec![row("it", 256, copies, 1.0, gate)]).passed();
    assert!(passed(ClockKind::ProcessTime, 4.5));
    assert!(!passed(ClockKind::ProcessTime, 4.51));
    assert!(!passed(ClockKind::ProcessTime, f64::NAN));
    assert!(passed(ClockKind::Timestamps, 100.0));
    assert_eq!(
        BOUNDS.map(|(radius, gate, _)| (radius, gate)),
        [
            (4, Some(4.5)),
            (12, Some(8.0)),
            (32, None),
            (64, Some(24.0))
        ]
    );
}

#[test]
fn growth_is_measured_from_512_and_bounded() {
    let passed = |clock, gate, copies, largest| {
        let gate = Gate {
            gate,
            goal: None,
            largest_growth: Some(1.3),
        };
        let rows = vec![
            row("it", 256, copies, 9.0, gate),
            row("it", 512, copies, 1.0, gate),
            row("other", 512, 100.0, 0.1, Gate::default()),
            row("it", 4096, copies, largest, gate),
        ];
        let table = table(clock, rows);
        assert_eq!(table.rows[0].growth, None);
        assert_eq!(table.rows[1].growth, Some(1.0));
        assert!((table.rows[3].growth.unwrap() - largest).abs() < 1e-12);
        table.passed()
    };
    let cpu = ClockKind::ProcessTime;
    assert!(passed(cpu, Some(1.3), 1.3, 1.29));
    assert!(!passed(cpu, Some(1.3), 1.31, 1.0));
    assert!(!passed(cpu, Some(1.3), 1.0, 1.31));
    assert!(passed(cpu, None, 5.0, 1.0));
    assert!(!passed(cpu, None, 5.0, 1.31));
    assert!(passed(ClockKind::Timestamps, Some(1.3), 9.0, 2.0));
}
