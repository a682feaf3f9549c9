//! Sweeps over map, picture and filter.

use moment_shadows::Profile;
use moment_shadows_lab::sweep::{Point, Sweep};

/// Every technique has its time at every place, as a ratio to the copy and to percentage-closer filtering.
#[test]
fn every_technique_is_timed_at_every_place() {
    let sweep = Sweep {
        scene: "fence-and-foliage".to_owned(),
        profile: Profile::Native,
        maps: vec![64, 128],
        pictures: vec![[64, 36]],
        filters: vec![3, 33],
        held: Point {
            map: 64,
            picture: [64, 36],
            filter: 9,
        },
        picture_of_filters: [64, 36],
        rounds: 9,
    };
    let swept = sweep.run(|| ()).unwrap();
    let names = &swept.techniques;
    assert_eq!(names[..2], ["pcf", "pcf, comparison samplers"]);
    for technique in [
        "esm",
        "vsm",
        "evsm2",
        "evsm4",
        "lvsm",
        "convolution",
        "hamburger4",
        "hamburger6",
    ] {
        let count = names
            .iter()
            .filter(|name| name.split(' ').next() == Some(technique));
        assert_eq!(count.count(), 1, "{technique} in {names:?}");
    }
    let points: Vec<usize> = swept.axes.iter().map(|axis| axis.points.len()).collect();
    assert_eq!(points, [2, 1, 2]);
    for times in swept.axes.iter().flat_map(|axis| &axis.points) {
        assert_eq!(times.copies.len(), names.len());
        assert_eq!(times.of_percentage_closer[0].median, 1.0);
        assert!(times.copies.iter().all(|ratio| ratio.median > 0.0));
    }
    let text = swept.to_string();
    assert!(
        text.contains("texels per side of the filter: less time than pcf"),
        "{text}"
    );
    let folder = tempfile::tempdir().unwrap();
    let [svg, _] = swept.chart().save(folder.path(), "sweep").unwrap();
    assert!(std::fs::read_to_string(svg).unwrap().contains("hamburger4"));
}
