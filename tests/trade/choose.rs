//! Choices within bounds.

use moment_shadows_graph::Graph;
use moment_shadows_lab::trade::Trade;
use moment_shadows_lab::trade::choose::{Bounds, Choice};

use crate::small;

#[test]
fn a_choice_keeps_to_its_bounds_and_says_why() {
    let mut trade = small(&["vsm", "hamburger4", "evsm4", "pcf"]);
    trade.axes.samples = vec![4];
    let folder = tempfile::tempdir().unwrap();
    let results = trade.run(folder.path()).unwrap();
    let scene = &results.scenes[0];
    let errors = || scene.rows.iter().map(|row| 100.0 * row.error().unwrap());
    let least = errors().fold(f64::INFINITY, f64::min);
    let most = errors().fold(0.0, f64::max);
    // Every row keeps to a bound that none exceeds: the fastest is chosen.
    let choice = Choice::of(
        scene,
        4,
        Bounds {
            error: Some(1.01 * most),
            ..Bounds::default()
        },
    );
    assert_eq!(choice.within, scene.rows.len());
    let chosen = choice.chosen().unwrap();
    let time = chosen.time.total.median;
    assert!(scene.rows.iter().all(|row| row.time.total.median >= time));
    // A bound that two moments cannot keep to.
    let choice = Choice::of(
        scene,
        4,
        Bounds {
            error: Some(1.02 * least),
            ..Bounds::default()
        },
    );
    let chosen = choice.chosen().unwrap();
    assert!(100.0 * chosen.error().unwrap() <= 1.02 * least);
    assert!(chosen.name != "vsm", "{}", chosen.name);
    let reasons = choice.reasons(&results).join("\n");
    assert!(
        reasons.contains("Two moments do not suffice: vsm in"),
        "{reasons}"
    );
    assert!(
        reasons.contains("The filter meets one surface at"),
        "{reasons}"
    );
    // Its graph is one, with the reasons in it, and with its map.
    let file = (trade.axes)
        .graph(&Trade::graph().unwrap(), chosen.cell)
        .unwrap();
    let text = choice.graph(&file, chosen.cell, &results).unwrap();
    let graph: Graph = text.parse().unwrap();
    let light = graph
        .imports
        .iter()
        .find(|import| import.name == "light_depth");
    let light = light.unwrap().value.as_ref().unwrap().texture().unwrap();
    let drawn = ([chosen.cell.map; 2], chosen.cell.samples);
    assert_eq!((light.size, light.samples), drawn);
    assert!(text.contains("Two moments do not suffice"), "{text}");
    // Percentage-closer filtering needs neither the nodes that make a map nor their edges.
    let cell = moment_shadows_lab::trade::axes::Cell {
        candidate: trade.axes.candidates.len() - 1,
        samples: 1,
        ..chosen.cell
    };
    let file = (trade.axes).graph(&Trade::graph().unwrap(), cell).unwrap();
    let graph: Graph = choice
        .graph(&file, cell, &results)
        .unwrap()
        .parse()
        .unwrap();
    let names: Vec<&str> = graph.nodes.iter().map(|node| node.name.as_str()).collect();
    assert_eq!((names, graph.edges.len()), (vec!["shade"], 2));
    // With a bound of bytes alone the least error is chosen, and what does not keep to it comes last.
    let bytes = scene
        .rows
        .iter()
        .map(|row| row.bytes_resident)
        .min()
        .unwrap();
    let choice = Choice::of(
        scene,
        4,
        Bounds {
            bytes: Some(2 * bytes),
            ..Bounds::default()
        },
    );
    let (within, beyond) = choice.rows.split_at(choice.within);
    assert!(!within.is_empty() && !beyond.is_empty());
    assert!(within.iter().all(|row| row.bytes_resident <= 2 * bytes));
    assert!(within.is_sorted_by_key(|row| row.error().unwrap()));
    // Nothing keeps to an impossible one, and the nearest comes first.
    let choice = Choice::of(
        scene,
        4,
        Bounds {
            error: Some(1e-6),
            ..Bounds::default()
        },
    );
    assert!(choice.chosen().is_none());
    assert_eq!(100.0 * choice.rows[0].error().unwrap(), least);
    assert!(choice.reasons(&results)[0].starts_with("No combination keeps to the bounds; "));
}
