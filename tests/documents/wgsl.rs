//! The page of WGSL modules is what the modules say.

use moment_shadows::modules;

use crate::kept;

const INTRODUCTION: &str = "# The WGSL modules

Every module of the library, with what a shader can import from it. Generated from `wgsl/`; a test holds it. A module of `wgsl/FOLDER/NAME.wgsl`
is imported as `moment_shadows::FOLDER::NAME`; every name begins with that of its module:

```wgsl
import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity_of_texel};
```

`moment_shadows::link` links such a shader to plain WGSL, with what it uses and nothing else; `validate` checks it, too. The lines are
[WESL](https://wesl-lang.dev). All functions have a defined result for every finite input, and may be called from non-uniform control flow.
";

/// A definition at the top level of a module, with the comment in front of it.
struct Definition {
    comment: String,
    /// Up to the body of a function, the fields of a struct, the whole of a constant.
    head: String,
}

fn definitions(source: &str) -> Vec<Definition> {
    let mut found = Vec::new();
    let mut comment: Vec<&str> = Vec::new();
    let mut lines = source.lines();
    while let Some(line) = lines.next() {
        if let Some(text) = line.strip_prefix("//") {
            comment.push(text.trim());
        } else if ["fn ", "const ", "alias "]
            .iter()
            .any(|kind| line.starts_with(kind))
        {
            let mut head = line.to_owned();
            // Over several lines: all parameters of a function, and of a constant its type.
            if line.ends_with('(') {
                for next in lines.by_ref() {
                    head = head.trim_end_matches(',').to_owned();
                    if next.starts_with(')') {
                        head += next;
                        break;
                    }
                    let separator = if head.ends_with('(') { "" } else { ", " };
                    head += &format!("{separator}{}", next.trim());
                }
                if let Some((named, _)) = line.split_once(" = ") {
                    head = named.to_owned();
                }
            }
            let head = head.trim_end_matches([' ', '{', ';']).to_owned();
            let comment = comment.join(" ");
            found.push(Definition { comment, head });
        } else if line.starts_with("struct ") {
            let fields = lines.by_ref().take_while(|line| *line != "}");
            let fields = fields.map(str::trim).filter(|line| !line.starts_with("//"));
            let fields: Vec<&str> = fields.collect();
            let head = format!("{line} {} }}", fields.join(" ").trim_end_matches(','));
            let comment = comment.join(" ");
            found.push(Definition { comment, head });
        }
        if !line.starts_with("//") {
            comment.clear();
        }
    }
    found
}

/// The first sentence of a comment. A point within an abbreviation or a number is followed by something else than a capital.
fn sentence(comment: &str) -> &str {
    let ends = comment.match_indices(". ").map(|(at, _)| at);
    let mut ends = ends.filter(|at| {
        let before = &comment[..*at];
        let next = comment[at + 2..].chars().next();
        !before.ends_with("et al") && next.is_some_and(|next| next.is_uppercase() || next == '`')
    });
    ends.next().map_or(comment, |at| &comment[..=at])
}

/// The comment at the head of a module, after its imports: what it computes.
fn opening(source: &str) -> String {
    let lines = source.lines().skip_while(|line| !line.starts_with("//"));
    let lines = lines.take_while(|line| line.starts_with("//") && *line != "//");
    let lines = lines.map(|line| line.trim_start_matches("//").trim());
    lines.collect::<Vec<_>>().join(" ")
}

fn page() -> String {
    let mut page = INTRODUCTION.to_owned();
    let mut folder = "";
    for module in modules() {
        if module.folder != folder {
            folder = module.folder;
            page.push_str(&format!("\n## {folder}\n"));
        }
        let (name, source) = (module.name, module.source);
        page.push_str(&format!("\n### {folder}::{name}\n\n{}\n", opening(source)));
        for (kind, heading) in [
            ("struct ", "struct"),
            ("alias ", "alias"),
            ("fn ", "function"),
            ("const ", "constant"),
        ] {
            let all = definitions(source);
            let of_kind: Vec<_> = all.iter().filter(|it| it.head.starts_with(kind)).collect();
            if of_kind.is_empty() {
                continue;
            }
            page.push_str(&format!("\n| {heading} | |\n|---|---|\n"));
            for Definition { comment, head } in of_kind {
                let head = head.trim_start_matches(kind).replace('|', "\\|");
                let meaning = sentence(comment).replace('|', "\\|");
                page.push_str(&format!("| `{head}` | {meaning} |\n"));
            }
        }
    }
    page
}

#[test]
fn the_page_is_what_the_modules_say() {
    kept("docs/wgsl.md", &page());
}

#[test]
fn every_definition_that_naga_finds_is_on_the_page() {
    let page = page();
    for module in modules() {
        let source = moment_shadows::Source {
            name: module.name,
            text: module.source,
        };
        let linked = moment_shadows::link(source, &[]).unwrap().into_wgsl();
        let parsed = naga::front::wgsl::parse_str(&linked).unwrap();
        let functions = parsed
            .functions
            .iter()
            .filter_map(|(_, it)| it.name.clone());
        let constants = parsed
            .constants
            .iter()
            .filter_map(|(_, it)| it.name.clone());
        for name in functions.chain(constants) {
            let found = [
                format!("| `{name}("),
                format!("| `{name}:"),
                format!("| `{name} "),
            ];
            assert!(found.iter().any(|it| page.contains(it)), "{name}");
        }
    }
}
