//! What errs least for its bits: the record, what the library goes by, and the table of the document.

use moment_shadows::{Profile, Technique};
use moment_shadows_lab::command::best::record;
use moment_shadows_lab::trade::best::Record;

use crate::read;

const BITS: [u32; 5] = [16, 32, 64, 128, 256];

fn recorded() -> Record {
    let text = std::fs::read_to_string(record()).unwrap();
    serde_json::from_str(&text).unwrap()
}

#[test]
fn the_library_goes_by_the_record() {
    let record = recorded();
    for profile in Profile::ALL {
        for bits in (0..=300).step_by(8) {
            let found = Technique::best(profile, bits);
            let found = found.map(|it| (it.technique().name().to_owned(), it.storage()));
            let wanted = record.best(profile, bits);
            let wanted = wanted.map(|row| (row.technique.clone(), row.storage));
            assert_eq!(found, wanted, "{profile}, {bits} bits");
        }
    }
}

#[test]
fn the_table_is_that_of_the_record() {
    let record = recorded();
    let profiles = [Profile::WebgpuCore, Profile::WebgpuTier1, Profile::Native];
    let mut table = "| bits per texel, at most | `webgpu-core` | `webgpu-tier1` | `native` |\n|---|---|---|---|\n".to_owned();
    for bits in BITS {
        let cell = |profile: Profile| match record.best(profile, bits) {
            None => "-".to_owned(),
            Some(row) => format!("`{}` in {}, {:.2} %", row.technique, row.storage, row.error),
        };
        table += &format!("| {bits} | {} |\n", profiles.map(cell).join(" | "));
    }
    let text = read("docs/choosing.md");
    assert!(text.contains(&table), "docs/choosing.md lacks\n{table}");
    let [map, samples] = record.map;
    let views = record.views;
    let said = format!("a map of {map} x {map} texels with {samples} samples, {views} views");
    assert!(text.contains(&said), "docs/choosing.md lacks '{said}'");
}
