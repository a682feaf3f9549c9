//! The crate `wesl`, the version of our lock file.

use moment_shadows::{Source, link, modules};
use wesl::{ModulePath, VirtualResolver, Wesl};

use crate::adapter::Adapter;
use crate::judge::{difference, judge};
use crate::roots::{Place, spread_imports};

/// What the crate makes of the shader `text` of a user who has the modules in `place`.
fn link_by_crate(text: &str, place: Place) -> Result<String, String> {
    let path = |path: &str| path.parse::<ModulePath>().unwrap();
    let mut resolver = VirtualResolver::new();
    for module in modules() {
        let at = format!("{}::{}::{}", place.path(), module.folder, module.name);
        let source = match place {
            Place::Package => module.source.to_owned(),
            Place::Copied => spread_imports(module.source),
        };
        resolver.add_module(path(&at), source.into());
    }
    resolver.add_module(path("package::main"), text.into());
    let linked = Wesl::new("")
        .set_custom_resolver(resolver)
        .compile(&path("package::main"))
        .map_err(|error| error.to_string())?;
    Ok(linked.to_string())
}

#[test]
fn the_crate_links_every_module_to_the_same_bits() {
    judge(|root, place| link_by_crate(&root.text(place), place));
}

#[test]
fn hexadecimal_floats_differ_by_the_crate() {
    // Why modules have none; and differences are seen.
    let text = "
const UNIT: f32 = 0x1p-24;
@group(2) @binding(0) var<storage, read_write> written: array<u32>;
@compute @workgroup_size(64) fn write_values(@builtin(global_invocation_id) id: vec3u) {
    written[id.x] = bitcast<u32>(UNIT);
}
";
    let adapter = Adapter::open();
    let name = "hexadecimal.wgsl";
    let ours = link(Source { name, text }, &[]).unwrap();
    let ours = adapter.run(ours.wgsl(), 1);
    assert!(
        ours.iter()
            .all(|&bits| f32::from_bits(bits) == 1.0 / 16777216.0)
    );
    let theirs = adapter.run(&link_by_crate(text, Place::Package).unwrap(), 1);
    assert!(difference(1, &ours, &theirs).is_some());
}
