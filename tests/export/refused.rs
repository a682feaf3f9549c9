//! What cannot be exported.

use moment_shadows::{
    LayerSplits, MapEncoding, Storage, SummedAreaTable, Target, Technique, export,
};

/// Why an encoding is refused, in the same words for every language.
fn reason(encoding: &MapEncoding) -> String {
    let reasons = Target::ALL.map(|target| export(encoding, target).unwrap_err());
    assert!(reasons.iter().all(|it| *it == reasons[0]));
    reasons[0].message.clone()
}

#[test]
fn layers_that_are_placed_on_the_device_are_refused() {
    let technique = Technique::Lvsm {
        layers: 4,
        overlap: Default::default(),
        splits: LayerSplits::Lloyd,
    };
    let encoding = MapEncoding::new(technique, Storage::Float16).unwrap();
    assert!(reason(&encoding).contains("export it with splits that are given"));
}

#[test]
fn summed_area_tables_are_refused() {
    let table = SummedAreaTable::new(Storage::Unorm16, [64, 64]).unwrap();
    let encoding = MapEncoding::of_table(Technique::Hamburger4, table).unwrap();
    assert!(reason(&encoding).contains("export the map that it is made of"));
}
