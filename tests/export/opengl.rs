//! Which nodes wgpu runs on OpenGL: the README names those that it does not.

use std::collections::BTreeSet;

use moment_shadows::{Backend, Source, ValidationOptions, validate};
use moment_shadows_lab::shaders::nodes;

#[test]
fn the_readme_names_the_nodes_that_read_depth_maps() {
    let mut refused = BTreeSet::new();
    let mut written = BTreeSet::new();
    for node in nodes().unwrap().into_iter().filter(|it| it.is_kept) {
        let options = ValidationOptions {
            profile: node.shader.profile,
            ..ValidationOptions::default()
        };
        let source = Source {
            name: &node.shader.name,
            text: &node.shader.wgsl,
        };
        let report = validate(source, &options);
        match report.written().any(|it| it == Backend::Glsl450) {
            true => written.insert(node.node),
            false => refused.insert(node.node),
        };
    }
    let readme = include_str!("../../README.md");
    let (_, section) = readme.split_once("## Where it runs").unwrap();
    let (section, _) = section.split_once("\n## ").unwrap();
    let named = section.split('`').skip(1).step_by(2);
    assert_eq!(named.map(str::to_owned).collect::<BTreeSet<_>>(), refused);
    assert!(
        written.contains("blur") && written.contains("summed_area_table"),
        "{written:?}"
    );
}
