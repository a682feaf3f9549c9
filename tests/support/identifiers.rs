//! Names that are legal in WGSL and that JavaScript libraries which reflect shaders take for keywords.

/// The words of address spaces and access modes, and `block`, which `wgsl_reflect` knows.
const TAKEN: [&str; 9] = [
    "block",
    "function",
    "private",
    "read",
    "read_write",
    "storage",
    "uniform",
    "workgroup",
    "write",
];

/// The lines of a text, which has `//` comments only, that use one of [`TAKEN`] as an identifier.
pub(crate) fn taken_identifiers(text: &str) -> Vec<&str> {
    let lines = text.lines().filter(|line| {
        let code = line.split("//").next().unwrap_or_default();
        TAKEN.iter().any(|word| is_identifier(word, code))
    });
    lines.collect()
}

/// Whether the word is an identifier somewhere: neither at the ends of a list as in `var<storage, read_write>`, nor in the path of a module.
fn is_identifier(word: &str, code: &str) -> bool {
    let of_name = |c: char| c.is_alphanumeric() || c == '_';
    code.match_indices(word).any(|(start, _)| {
        let (before, after) = (&code[..start], &code[start + word.len()..]);
        let whole = !before.ends_with(of_name) && !after.starts_with(of_name);
        let listed = before.trim_end().ends_with('<') || after.trim_start().starts_with('>');
        let path = before.ends_with("::") || after.starts_with("::");
        whole && !listed && !path
    })
}

#[test]
fn an_identifier_is_told_from_an_address_space() {
    let planted = "
import moment_shadows::map::storage::{STORAGE_FLOAT16};
@group(0) @binding(0) var<storage, read_write> values: array<f32>; // storage
@group(0) @binding(1) var map: texture_storage_2d<r32float, write>;
fn sum(state: ptr<function, u32>, storage: u32) {
fn copy(place: vec2u, workgroup: vec3u) {
    return input.storage;
    for (var block = 0u; block < 4u; block++) {
    let stored = storage_is_float(stored_as);
@compute @workgroup_size(64) fn read(@builtin(workgroup_id) workgroup_id: vec3u) {";
    let found = taken_identifiers(planted);
    let expected: Vec<_> = planted.lines().collect();
    assert_eq!(
        found,
        [5, 6, 7, 8, 10].map(|line: usize| expected[line - 1])
    );
}
