//! Techniques that a command line names, and graphs with them in place of their own.

use moment_shadows::{Storage, Technique};
use moment_shadows_lab::candidate::{Candidate, TechniqueChoice, candidates};
use moment_shadows_lab::graph_file::GraphFile;
use moment_shadows_lab::techniques;

use crate::setup::graph;

fn storages(text: &str) -> Vec<Option<Storage>> {
    let choice: TechniqueChoice = text.parse().unwrap();
    choice.candidates().iter().map(Candidate::storage).collect()
}

#[test]
fn names_and_objects_are_techniques_in_every_storage_they_can_have() {
    use Storage::{Float16, Float32, Unorm8, Unorm16};
    let some = |all: &[Storage]| all.iter().copied().map(Some).collect::<Vec<_>>();
    assert_eq!(storages("vsm"), some(&[Unorm16, Float32, Float16]));
    assert_eq!(storages("convolution"), some(&[Unorm8, Unorm16, Float16]));
    assert_eq!(storages("evsm4"), some(&[Float32, Float16]));
    // An exponent that single precision alone can store.
    assert_eq!(storages(r#"{"esm":{"exponent":80}}"#), some(&[Float32]));
    for reading in ["binary", "pcf", "pcf_box", "pcss"] {
        assert_eq!(storages(reading), [None], "{reading}");
    }
    // The best storage, unless it is named.
    let choice = "hamburger4".parse::<TechniqueChoice>().unwrap();
    assert_eq!(choice.in_storage(None).unwrap().storage(), Some(Unorm16));
    let float16 = choice.in_storage(Some(Float16)).unwrap();
    assert_eq!(float16.storage(), Some(Float16));
}

#[test]
fn what_is_no_technique_is_refused_with_a_next_step() {
    let refused = |text: &str| text.parse::<TechniqueChoice>().unwrap_err().to_string();
    assert!(refused("vms").contains("`vsm`"), "{}", refused("vms"));
    assert!(refused("{").contains("this is no technique"));
    let exponent = refused(r#"{"evsm2":{"exponent":200}}"#);
    assert!(exponent.contains("from 1 to 40"), "{exponent}");
    let layers = refused(r#"{"lvsm":{"layers":9}}"#);
    assert!(layers.contains("1 to 8"), "{layers}");
    let choice = "evsm2".parse::<TechniqueChoice>().unwrap();
    let storage = choice.in_storage(Some(Storage::Unorm16)).unwrap_err();
    assert_eq!(storage.name, "storage");
    let legal = "it can as float32 or float16";
    assert!(storage.message.ends_with(legal), "{storage}");
}

#[test]
fn all_are_the_filterable_ones_and_two_references() {
    let all = Candidate::all();
    assert_eq!(all.len(), techniques::filterable().len() + 2);
    assert_eq!(all.iter().filter(|it| it.reads_depth()).count(), 2);
    assert_eq!(candidates(&[], None).unwrap(), all);
    // A storage keeps the references, and asks for itself of every choice.
    let unorm8 = candidates(&[], Some(Storage::Unorm8)).unwrap();
    assert_eq!(unorm8.len(), 3);
    let chosen = ["vsm", "convolution"].map(|name| name.parse::<TechniqueChoice>().unwrap());
    assert_eq!(candidates(&chosen, None).unwrap().len(), 6);
    assert_eq!(
        candidates(&chosen, Some(Storage::Float16)).unwrap().len(),
        2
    );
    let refused = candidates(&chosen, Some(Storage::Unorm8)).unwrap_err();
    assert_eq!(refused.name, "storage", "{refused}");
}

#[test]
fn graphs_take_other_techniques() {
    let own = graph(Storage::Unorm16, 3);
    let vsm = own
        .with_technique(&Technique::Vsm, Some(Storage::Float16))
        .unwrap();
    assert_eq!(vsm.node_entry("resolve", "properties")["technique"], "vsm");
    assert_eq!(
        vsm.node_entry("resolve", "properties")["storage"],
        "float16"
    );
    assert_eq!(vsm.technique(), Some(Technique::Vsm));
    // Plain depth: the map is not made, and the kernel is still known.
    let binary = vsm.with_technique(&Technique::Binary, None).unwrap();
    assert_eq!(binary.technique(), Some(Technique::Binary));
    assert!(binary.text.contains(r#"shade.depth"#));
    assert!(!binary.text.contains(r#"shade.map"#));
    assert_eq!(binary.kernel().unwrap().unwrap().radius(), 3);
    // An illegal pair is refused where it is said.
    let refused = own
        .with_technique(&Technique::Vsm, Some(Storage::Unorm8))
        .and_then(|file| {
            let gpu = crate::setup::open();
            let scene = moment_shadows_lab::scene::load("hall").unwrap();
            let frame = crate::setup::frame(&gpu, &scene, (32, 4), 3);
            moment_shadows_lab::graph_frame::GraphFrame::new(&gpu, &frame, &file).map(|_| ())
        })
        .unwrap_err();
    assert!(
        refused
            .to_string()
            .contains("'vsm' cannot be stored as unorm8"),
        "{refused}"
    );
    let bare = r#"{
  "version": 2,
  "imports": [{ "name": "map" }],
  "nodes": [],
  "edges": [],
  "outputs": []
}"#;
    let parsed = GraphFile::parse("bare.json", bare.to_owned(), None);
    let refused = parsed.and_then(|file| file.with_technique(&Technique::Vsm, None));
    assert!(refused.unwrap_err().to_string().contains("no resolve node"));
}

#[test]
fn a_graph_with_translucent_casters_is_refused_with_what_judges_them() {
    let text = include_str!("../../examples/translucent.json").to_owned();
    let refused = GraphFile::parse("translucent.json", text, None).unwrap_err();
    let refused = refused.to_string();
    for part in ["translucent.json", "'casters'", "transmittance"] {
        assert!(refused.contains(part), "{refused}");
    }
}

#[test]
fn graphs_resolve_in_the_blur_and_take_other_sizes() {
    let own = graph(Storage::Float16, 3);
    let joined = own.resolved_by_the_blur().unwrap();
    assert!(!joined.has_node("resolve"));
    assert_eq!(joined.encoding(), own.encoding());
    assert_eq!(joined.kernel().unwrap(), own.kernel().unwrap());
    assert!(
        joined.text.contains(r#""to":"blur.depth""#),
        "{}",
        joined.text
    );
    assert!(!joined.text.contains("blur.map"), "{}", joined.text);
    let refused = joined.resolved_by_the_blur().unwrap_err().to_string();
    assert!(refused.contains("no resolve node"), "{refused}");
    let small = own.with_import_size("light_depth", [64, 32]).unwrap();
    assert_eq!(small.import("light_depth").unwrap().size, [64, 32]);
    assert_eq!(small.import("camera_depth"), own.import("camera_depth"));
    let refused = own
        .with_import_size("sun", [64; 2])
        .unwrap_err()
        .to_string();
    assert!(refused.contains("'sun'"), "{refused}");
}
