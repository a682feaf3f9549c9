//! What another linker made of the shaders, against what ours makes of them.

use moment_shadows::{Source, ValidationOptions, link, validate};

use crate::adapter::Adapter;
use crate::roots::{Place, Root, roots};

/// Validates what `link_root` makes of every root in every place, and compares the bits that it writes.
pub(crate) fn judge(link_root: impl Fn(&Root, Place) -> Result<String, String>) {
    let adapter = Adapter::open();
    let mut failures = Vec::new();
    for root in roots() {
        let name = root.name.as_str();
        let text = &root.text(Place::Package);
        let ours = link(Source { name, text }, &[]).unwrap();
        let ours = adapter.run(ours.wgsl(), root.words);
        for place in Place::ALL {
            let fault = link_root(&root, place).and_then(|text| {
                let source = Source { name, text: &text };
                let report = validate(source, &ValidationOptions::default());
                if !report.is_valid() {
                    return Err(report.to_string());
                }
                difference(root.words, &ours, &adapter.run(&text, root.words)).map_or(Ok(()), Err)
            });
            if let Err(fault) = fault {
                failures.push(format!("{name}, {place:?}: {fault}"));
            }
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

/// Where two texts of a shader that writes values differ, bit by bit.
pub(crate) fn difference(words: usize, ours: &[u32], theirs: &[u32]) -> Option<String> {
    assert_eq!(ours.len(), theirs.len());
    let mut differing = (0..ours.len()).filter(|&at| ours[at] != theirs[at]);
    let first = differing.next()?;
    let (ours, theirs) = (ours[first], theirs[first]);
    Some(format!(
        "{} words differ; the first is word {} of invocation {}: {ours:#x} ({}) as we link it, {theirs:#x} ({}) here",
        1 + differing.count(),
        first % words,
        first / words,
        f32::from_bits(ours),
        f32::from_bits(theirs),
    ))
}

#[test]
fn a_bit_that_differs_is_seen() {
    let ours = [1.0_f32, 2.0, 3.0, 4.0].map(f32::to_bits);
    assert_eq!(difference(2, &ours, &ours), None);
    let theirs = [ours[0], ours[1], ours[2] + 1, ours[3]];
    let said = difference(2, &ours, &theirs).unwrap();
    let first = "1 words differ; the first is word 0 of invocation 1: ";
    assert!(said.starts_with(first), "{said}");
}
