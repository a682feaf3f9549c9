//! Every link of the documents goes to a file that is there, and to a heading of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::read;

/// Where the repository is; links of rustdoc pages, which nothing makes absolute, name it.
const REPOSITORY: &str = env!("CARGO_PKG_REPOSITORY");

/// All documents, and the front pages of the crates, as paths from the root.
pub(crate) fn documents() -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found: Vec<String> = [
        "README.md",
        "CONTRIBUTING.md",
        "CHANGELOG.md",
        "graph/README.md",
        "src/lib.rs",
        "graph/src/lib.rs",
    ]
    .map(str::to_owned)
    .to_vec();
    let mut folders = vec![PathBuf::from("docs"), PathBuf::from("graph/docs")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(root.join(&folder)).unwrap() {
            let path = folder.join(entry.unwrap().file_name());
            if root.join(&path).is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "md") {
                found.push(path.display().to_string());
            }
        }
    }
    found.sort();
    found
}

/// The targets of links and pictures. Of code only rustdoc comments count, and nothing between fences.
fn targets(file: &str) -> Vec<String> {
    let text = read(file);
    let mut fenced = false;
    let mut found = Vec::new();
    for line in text.lines() {
        let line = match file.ends_with(".rs") {
            true => line.strip_prefix("//!").unwrap_or_default(),
            false => line,
        };
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        } else if !fenced {
            let rests = line.split("](").skip(1);
            found.extend(rests.filter_map(|rest| Some(rest.split_once(')')?.0.to_owned())));
        }
    }
    found
}

/// The anchors of a page's headings, as GitHub makes them: what is between fences is no heading, and those of equal headings are
/// numbered from the second on.
fn anchors(text: &str) -> Vec<String> {
    let kept = |letter: &char| letter.is_alphanumeric() || "-_ ".contains(*letter);
    let (mut fenced, mut found) = (false, Vec::new());
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        } else if line.starts_with('#') && !fenced {
            let title = line.trim_start_matches('#').trim().to_lowercase();
            let anchor: String = title.chars().filter(kept).collect();
            let anchor = anchor.replace(' ', "-");
            let count = counts.entry(anchor.clone()).or_default();
            found.push(match *count {
                0 => anchor,
                again => format!("{anchor}-{again}"),
            });
            *count += 1;
        }
    }
    found
}

#[test]
fn anchors_are_numbered_and_not_taken_from_code() {
    let text = "# A title\n```sh\n# no heading\n```\n## It's `so`\n## A title\n## A title\n";
    let expected = ["a-title", "its-so", "a-title-1", "a-title-2"];
    assert_eq!(anchors(text), expected);
}

/// What is wrong with a link of a file, if something is.
fn fault(file: &str, target: &str) -> Option<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
    let of_repository = path.strip_prefix(REPOSITORY).map(|rest| {
        let rest = rest.trim_start_matches('/');
        let rest = ["blob/main/", "tree/main/", "raw/main/"]
            .iter()
            .find_map(|prefix| rest.strip_prefix(prefix))
            .unwrap_or(rest);
        if rest.is_empty() { "README.md" } else { rest }
    });
    let is_rust = file.ends_with(".rs");
    let linked = match of_repository {
        Some(path) => root.join(path),
        None if path.starts_with("https://") => return None,
        None if is_rust && path.contains(['/', '.']) => return Some("is relative".to_owned()),
        // Items that rustdoc looks up, and says so where there are none.
        None if is_rust => return None,
        None if path.is_empty() => root.join(file),
        None => root.join(file).parent()?.join(path),
    };
    if !linked.exists() {
        return Some("does not exist".to_owned());
    }
    let text = std::fs::read_to_string(&linked).unwrap_or_default();
    let found = anchor.is_empty() || anchors(&text).iter().any(|known| known == anchor);
    (!found).then(|| format!("has no heading '{anchor}'"))
}

#[test]
fn every_link_goes_somewhere() {
    assert!(REPOSITORY.starts_with("https://"), "'{REPOSITORY}'");
    let mut faults = Vec::new();
    let mut count = 0;
    for file in documents() {
        for target in targets(&file) {
            count += 1;
            faults.extend(fault(&file, &target).map(|fault| format!("{file}: {target} {fault}")));
        }
    }
    assert_eq!(faults, Vec::<String>::new());
    assert!(count > 80, "{count}");
    assert_eq!(
        fault("docs/wgsl.md", "missing.md").as_deref(),
        Some("does not exist")
    );
    assert!(fault("README.md", "docs/wgsl.md#nowhere").is_some());
    assert!(fault("src/lib.rs", "docs/wgsl.md").is_some());
}
