//! The commands that documents name: what runs for seconds is run, and of everything else the arguments are parsed and the files
//! looked up.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

use std::path::{Path, PathBuf};
use std::process::Command;

use moment_shadows_graph::command::Cli;
use moment_shadows_lab::cli::parser;

/// Sub-commands that are run here, with arguments that make them short; `OUT` is a folder or a file in it.
const RUN: [(&str, &[&str]); 15] = [
    ("adapter", &[]),
    (
        "export",
        &[
            "--technique",
            "hamburger4",
            "--storage",
            "float16",
            "--target",
            "hlsl",
            "--out",
            "OUT/a.hlsl",
        ],
    ),
    ("ports", &["OUT/ports"]),
    ("graph", &["examples/hard_shadows.json", "--plan"]),
    ("export-plan", &["examples/hard_shadows.json"]),
    ("validate", &["examples/forward_shading.wgsl"]),
    (
        "render",
        &[
            "--scene",
            "hall",
            "--graph",
            "examples/hard_shadows.json",
            "--width",
            "64",
            "--map",
            "64",
            "--out",
            "OUT/a.png",
            "--truth",
        ],
    ),
    (
        "measure",
        &[
            "--scene",
            "hall",
            "--graph",
            "examples/hard_shadows.json",
            "--width",
            "64",
            "--map",
            "64",
        ],
    ),
    (
        "error",
        &[
            "--scene",
            "hall",
            "--graph",
            "examples/hard_shadows.json",
            "--width",
            "64",
            "--map",
            "64",
        ],
    ),
    (
        "first-frame",
        &["examples/hard_shadows.json", "--rounds", "1"],
    ),
    (
        "probe",
        &["hall", "--quick", "--map", "128", "--views", "1"],
    ),
    (
        "inspect",
        &[
            "hall",
            "--pixel",
            "20,25",
            "--width",
            "64",
            "--map",
            "64",
            "--technique",
            "vsm",
            "--out",
            "OUT/pixel.svg",
        ],
    ),
    ("vectors", &["tests/vectors/moment_problem.json"]),
    ("shaders", &["--out", "OUT/shaders"]),
    ("troubleshooting-pictures", &["--out", "OUT/pictures"]),
];

/// Sub-commands that are not run here, and why.
const LONG: [(&str, &str); 20] = [
    ("error-table", "peels whole scenes, for a minute each"),
    ("soft-error", "traces 256 rays per pixel"),
    ("scattering-error", "marches 1,024 steps per pixel"),
    ("march-error", "marches 1,024 steps per pixel"),
    ("scattering-flicker", "draws a walk of many frames"),
    ("soak", "draws a hundred thousand frames"),
    (
        "technique-pictures",
        "draws every technique in single precision with its truth",
    ),
    ("cost", "times work that should have the machine for itself"),
    ("cost-chart", "times two dozen graphs"),
    ("trade", "judges and times hundreds of combinations"),
    ("choose", "trades first"),
    ("scores", "draws every technique a dozen times"),
    ("contact-shadows", "judges pictures of three scenes"),
    ("best", "needs a finished trade"),
    ("claims", "judges, marches, traces and times for minutes"),
    (
        "sweep",
        "times work that should have the machine for itself",
    ),
    ("bias", "searches a million patches of depth"),
    ("transmittance", "blends and shades for a minute"),
    ("stability", "tries random inputs for a quarter of an hour"),
    (
        "isa",
        "needs the driver of one version, which `./run check` has",
    ),
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn documents() -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> = ["README.md", "CONTRIBUTING.md", "graph/README.md"]
        .map(|file| root().join(file))
        .to_vec();
    let mut folders = vec![root().join("docs"), root().join("graph/docs")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "md") {
                found.push(path);
            }
        }
    }
    found
}

/// What a line says without its comment and the variables in front; what stands in quotes is one word.
fn words(line: &str) -> Vec<String> {
    let line = line.split(" #").next().unwrap_or_default();
    let mut words: Vec<String> = Vec::new();
    for (number, part) in line.split('"').enumerate() {
        match number % 2 {
            0 => words.extend(part.split_whitespace().map(str::to_owned)),
            _ => words.push(part.to_owned()),
        }
    }
    let is_variable = |word: &String| {
        let name = word.split_once('=').map(|(name, _)| name);
        name.is_some_and(|name| name.chars().all(|it| it.is_uppercase() || it == '_'))
    };
    words.into_iter().skip_while(is_variable).collect()
}

/// Programs of others that documents run.
const OTHERS: [&str; 3] = ["npm", "node", "python3"];

/// The commands of a document; whether each stands in a block to be pasted.
fn commands(text: &str) -> Vec<(Vec<String>, bool)> {
    let is_command = |words: &[String]| {
        let first = words.first().map(String::as_str);
        first.is_some_and(|first| {
            let ours = ["./run", "cargo", "moment-shadows", "moment-shadows-lab"].contains(&first);
            let of_others = OTHERS.contains(&first);
            (ours || of_others) && words.len() > 1 || first.ends_with(".sh")
        })
    };
    let mut fence: Option<String> = None;
    let mut found: Vec<(Vec<String>, bool)> = Vec::new();
    for line in text.lines() {
        if let Some(kind) = line.strip_prefix("```") {
            fence = fence.is_none().then(|| kind.to_owned());
            continue;
        }
        match fence.as_deref() {
            Some("sh") if line.starts_with('#') => {}
            Some("sh") => {
                let words = words(line);
                assert!(
                    words.is_empty() || is_command(&words),
                    "what runs '{line}'?"
                );
                found.extend((!words.is_empty()).then_some((words, true)));
            }
            Some("text") if is_command(&words(line)) => found.push((words(line), false)),
            // What is broken over lines goes on.
            Some("text") if line.starts_with("      ") => {
                if let Some((last, _)) = found.last_mut() {
                    last.extend(words(line));
                }
            }
            Some(kind) => assert!(
                !is_command(&words(line)),
                "'{line}' in a block of kind '{kind}'"
            ),
            None => {
                let spans = line.split('`').skip(1).step_by(2).map(words);
                found.extend(
                    spans
                        .filter(|words| is_command(words))
                        .map(|words| (words, false)),
                );
            }
        }
    }
    found
}

/// Checks a sub-command of a command of ours: fully where it is to be pasted, else that it and its flags are there. Gives its
/// name.
fn check_ours(parser: clap::Command, arguments: &[String], pasted: bool) -> String {
    let name = arguments[0].clone();
    if name.starts_with("--") {
        assert_eq!(name, "--help");
        return name;
    }
    let command = parser
        .find_subcommand(&name)
        .unwrap_or_else(|| panic!("there is no sub-command '{name}'"));
    let flags: Vec<String> = command
        .get_arguments()
        .filter_map(|it| it.get_long())
        .map(|it| format!("--{it}"))
        .collect();
    let letters = |it: char| !(it.is_alphanumeric() || it == '-');
    for flag in arguments
        .iter()
        .flat_map(|word| word.split(letters))
        .filter(|word| word.starts_with("--"))
    {
        assert!(
            flags.iter().any(|known| known == flag),
            "'{name}' has no flag '{flag}'"
        );
    }
    if pasted {
        let whole = [parser.get_name().to_owned()]
            .into_iter()
            .chain(arguments.iter().cloned());
        parser
            .try_get_matches_from(whole)
            .unwrap_or_else(|error| panic!("{arguments:?}: {error}"));
    }
    for file in arguments
        .iter()
        .filter(|it| it.starts_with("examples/") || it.starts_with("docs/"))
    {
        assert!(root().join(file).exists(), "'{file}' does not exist");
    }
    name
}

/// Checks what cargo is told: packages, tests and folders that are there. Gives the sub-command of ours that it runs.
fn check_cargo(words: &[String], pasted: bool) -> Option<String> {
    let known = [
        "build", "run", "test", "add", "install", "doc", "fmt", "clippy",
    ];
    assert!(known.contains(&words[1].as_str()), "{words:?}");
    let after = |flag: &str| {
        let place = words.iter().position(|word| word == flag)?;
        words.get(place + 1)
    };
    let package = after("-p").map(String::as_str);
    let folder = match package {
        None | Some("moment-shadows") => ".",
        Some("moment-shadows-graph") => "graph",
        Some("moment-shadows-lab") => "examples/lab",
        Some("moment-shadows-fuzz") => "fuzz",
        Some(other) => panic!("'{other}' is no package"),
    };
    if let Some(test) = after("--test") {
        let files = [
            format!("{folder}/tests/{test}.rs"),
            format!("{folder}/tests/{test}/main.rs"),
        ];
        assert!(
            files.iter().any(|file| root().join(file).exists()),
            "there is no test '{test}'"
        );
    }
    if let Some(path) = after("--path") {
        // Beside a project of the reader's own.
        let path = path.trim_start_matches("../moment-shadows/");
        assert!(
            root().join(path).join("Cargo.toml").exists(),
            "'{path}' is no package"
        );
    }
    if let Some(feature) = after("--features") {
        let graph = std::fs::read_to_string(root().join("graph/Cargo.toml")).unwrap();
        let declared = graph.contains(&format!("\n{feature} = ["));
        assert!(declared, "there is no feature '{feature}'");
    }
    let ours = words.iter().position(|word| word == "--")? + 1;
    match package {
        Some("moment-shadows-lab") => Some(check_ours(parser(), &words[ours..], pasted)),
        // Arguments of the tests' own program.
        _ => None,
    }
}

#[test]
fn every_command_of_the_documents_is_right() {
    let script = std::fs::read_to_string(root().join("run")).unwrap();
    let mut count = 0;
    for document in documents() {
        let text = std::fs::read_to_string(&document).unwrap();
        for (words, pasted) in commands(&text) {
            count += 1;
            println!("{}: {}", document.display(), words.join(" "));
            let ours = match words[0].as_str() {
                "./run" => {
                    let way = format!("  {})", words[1]);
                    assert!(script.contains(&way), "./run has no '{}'", words[1]);
                    None
                }
                script if script.ends_with(".sh") => {
                    assert!(root().join(script).exists(), "'{script}' does not exist");
                    None
                }
                "cargo" => check_cargo(&words, pasted),
                "node" => {
                    let path = words[1].trim_start_matches("../moment-shadows/");
                    assert!(root().join(path).exists(), "'{path}' does not exist");
                    None
                }
                "npm" | "python3" => None,
                "moment-shadows" => Some(check_ours(Cli::parser(), &words[1..], pasted)),
                _ => Some(check_ours(parser(), &words[1..], pasted)),
            };
            let is_known = |name: &String| {
                name == "--help"
                    || RUN.iter().any(|(run, _)| run == name)
                    || LONG.iter().any(|(long, _)| long == name)
            };
            assert!(
                ours.as_ref().is_none_or(is_known),
                "{ours:?} is neither run nor named as long"
            );
        }
    }
    assert!(count > 30, "{count}");
}

#[test]
fn short_commands_run() {
    for (name, arguments) in RUN {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().display().to_string();
        let arguments = arguments
            .iter()
            .map(|argument| argument.replace("OUT", &out));
        let mut command = Command::new(env!("CARGO_BIN_EXE_moment-shadows-lab"));
        let output = command
            .arg(name)
            .args(arguments)
            .current_dir(root())
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{name}: {said}");
        let is_told =
            !output.stdout.is_empty() || std::fs::read_dir(folder.path()).unwrap().next().is_some();
        assert!(is_told, "{name} says nothing");
    }
    // The long ones are there, and say what they take.
    for (name, _) in LONG {
        let mut command = Command::new(env!("CARGO_BIN_EXE_moment-shadows-lab"));
        assert!(
            command
                .args([name, "--help"])
                .output()
                .unwrap()
                .status
                .success(),
            "{name}"
        );
    }
}
