//! npm's `wesl`, which `check/wesl.mjs` runs.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::judge::judge;
use crate::roots::{Place, roots};

#[test]
#[ignore = "needs node and the packages of check/package.json: ./run check"]
fn npms_linker_links_every_module_to_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    for place in Place::ALL {
        fs::create_dir(folder.path().join(place.name())).unwrap();
        for root in roots() {
            let file = format!("{}/{}.wgsl", place.name(), root.name);
            fs::write(folder.path().join(file), root.text(place)).unwrap();
        }
    }
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("check/wesl.mjs");
    let status = Command::new("node").arg(script).arg(folder.path()).status();
    assert!(status.unwrap().success());
    judge(|root, place| {
        let file = format!("{}/{}.linked", place.name(), root.name);
        fs::read_to_string(folder.path().join(file)).map_err(|error| error.to_string())
    });
}
