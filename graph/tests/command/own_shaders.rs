use moment_shadows::{Source, ValidationOptions, validate};

#[test]
fn shaders_are_valid() {
    for entry in std::fs::read_dir("shaders").unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        let name = path.display().to_string();
        let source = Source { name: &name, text: &text };
        let report = validate(source, &ValidationOptions::default());
        assert!(report.is_valid(), "{report}");
    }
}
