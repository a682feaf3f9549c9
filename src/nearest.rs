//! The names closest to a misspelt one, for the next step in an error.

/// Up to three of `candidates`, those with the fewest edits from `name` first, quoted and joined by commas.
#[must_use]
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    let mut ranked: Vec<_> = candidates
        .into_iter()
        .map(|candidate| (edits(name, candidate), candidate))
        .collect();
    ranked.sort_unstable();
    ranked.dedup();
    let quoted = ranked.iter().take(3).map(|(_, name)| format!("`{name}`"));
    quoted.collect::<Vec<_>>().join(", ")
}

/// Levenshtein's distance. Long names are cut, so that the cost stays bounded whatever a file contains.
fn edits(a: &str, b: &str) -> usize {
    const LONGEST: usize = 64;
    let b: Vec<char> = b.chars().take(LONGEST).collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().take(LONGEST).enumerate() {
        let mut diagonal = i;
        let mut left = i + 1;
        let mut next = vec![left];
        for (to, &above) in b.iter().zip(row.iter().skip(1)) {
            left = (left + 1)
                .min(above + 1)
                .min(diagonal + usize::from(from != *to));
            diagonal = above;
            next.push(left);
        }
        row = next;
    }
    row.last().copied().unwrap_or_default()
}
