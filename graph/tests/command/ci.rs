//! docs/ci.md: every line that it gives to paste is run as it stands.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Output};

use moment_shadows::Rule;

const PAGE: &str = include_str!("../../../docs/ci.md");
const GOOD: &str = "@fragment fn main() -> @location(0) vec4f { return vec4f(1.0); }\n";
const BAD: &str = "fn mask(i: u32) -> u32 { return 1u << i | 1u; }\n";

/// The blocks of a language.
fn blocks(language: &str) -> Vec<&'static str> {
    let start = format!("```{language}\n");
    let after = PAGE.split(start.as_str()).skip(1);
    after
        .map(|rest| rest.split("```").next().unwrap())
        .collect()
}

fn block(language: &str) -> &'static str {
    let blocks = blocks(language);
    assert_eq!(blocks.len(), 1, "{language}");
    blocks[0]
}

/// A folder with shaders, and the command on the path. `cargo` is one that says what it is asked for.
fn project(shaders: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("shaders")).unwrap();
    for (name, text) in shaders {
        fs::write(folder.path().join("shaders").join(name), text).unwrap();
    }
    fs::create_dir(folder.path().join("bin")).unwrap();
    let binary = folder.path().join("bin/moment-shadows");
    std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_moment-shadows"), binary).unwrap();
    executable(
        &folder.path().join("bin/cargo"),
        "#!/bin/sh\necho \"cargo $*\"\n",
    );
    folder
}

fn executable(path: &Path, text: &str) {
    fs::write(path, text).unwrap();
    fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
}

fn sh(folder: &Path, line: &str) -> Output {
    let path = std::env::var("PATH").unwrap();
    Command::new("sh")
        .args(["-euc", line])
        .current_dir(folder)
        .env("PATH", format!("{}:{path}", folder.join("bin").display()))
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn the_workflow_runs() {
    let yaml = block("yaml");
    let lines: Vec<&str> = yaml
        .lines()
        .filter_map(|line| line.trim().strip_prefix("- run: "))
        .collect();
    let [install, validate] = lines[..] else {
        panic!("two lines are run: {lines:?}");
    };
    let folder = project(&[("good.wgsl", GOOD)]);
    // Installing is not for a test; that the package has these features is.
    let asked = text(&sh(folder.path(), install).stdout);
    assert_eq!(asked.trim(), install);
    let manifest = include_str!("../../Cargo.toml");
    assert!(manifest.contains("name = \"moment-shadows-graph\"") && manifest.contains("\ncli = ["));
    assert!(install.contains("moment-shadows-graph --no-default-features --features cli"));

    let good = sh(folder.path(), validate);
    assert!(good.status.success(), "{good:?}");
    let folder = project(&[("good.wgsl", GOOD), ("bad.wgsl", BAD)]);
    let bad = sh(folder.path(), validate);
    assert_eq!(bad.status.code(), Some(1));
    let printed = text(&bad.stdout);
    assert!(
        printed.starts_with("::error file=shaders/bad.wgsl,line=1,"),
        "{printed}"
    );
}

#[test]
fn commands_within_sentences_run() {
    let folder = project(&[("bad.wgsl", BAD)]);
    let line = "moment-shadows validate shaders --format sarif > shaders.sarif";
    assert!(PAGE.contains(line));
    assert_eq!(sh(folder.path(), line).status.code(), Some(1));
    let written = fs::read_to_string(folder.path().join("shaders.sarif")).unwrap();
    assert!(
        written.contains("\"uri\": \"shaders/bad.wgsl\""),
        "{written}"
    );

    let engine = folder.path().join("shaders/my_engine");
    fs::create_dir_all(engine.join("sky")).unwrap();
    fs::write(
        engine.join("lights.wgsl"),
        "fn light_at() -> f32 { return 1.0; }\n",
    )
    .unwrap();
    fs::write(engine.join("sky/sun.wgsl"), "const SUN = 1.0;\n").unwrap();
    let import = "import my_engine::lights::{light_at};";
    assert!(PAGE.contains(import));
    fs::write(
        folder.path().join("user.wgsl"),
        format!("{import}\nfn f() {{ _ = light_at(); }}\n"),
    )
    .unwrap();
    let common = folder.path().join("shaders/common");
    fs::create_dir(&common).unwrap();
    fs::copy(engine.join("lights.wgsl"), common.join("lights.wgsl")).unwrap();
    for option in [
        "--module shaders/my_engine",
        "--module shaders/my_engine/lights.wgsl",
        "--module my_engine=shaders/common",
        "--allow f16,subgroups",
    ] {
        assert!(PAGE.contains(option), "{option}");
        let module = match option.starts_with("--allow") {
            true => "--module shaders/my_engine ",
            false => "",
        };
        let found = sh(
            folder.path(),
            &format!("moment-shadows validate user.wgsl {module}{option}"),
        );
        assert!(found.status.success(), "{option}: {}", text(&found.stdout));
    }
}

#[test]
fn the_hook_looks_at_what_is_committed() {
    let folder = project(&[("good one.wgsl", GOOD), ("bad.wgsl", BAD)]);
    let run = |line: &str| sh(folder.path(), line);
    let identity = "-c user.name=nobody -c user.email=nobody@example.org";
    assert!(run("git init -q .").status.success());
    executable(&folder.path().join(".git/hooks/pre-commit"), block("bash"));
    // Nothing to look at, a valid shader, and one that is not.
    let none = run(&format!("git {identity} commit -q --allow-empty -m none"));
    assert!(none.status.success(), "{none:?}");
    let good = run(&format!(
        "git add 'shaders/good one.wgsl' && git {identity} commit -q -m good"
    ));
    assert!(good.status.success(), "{good:?}");
    let bad = run(&format!(
        "git add shaders/bad.wgsl && git {identity} commit -q -m bad"
    ));
    assert!(!bad.status.success());
    let said = text(&bad.stdout) + &text(&bad.stderr);
    assert!(said.contains("shaders/bad.wgsl:1:"), "{said}");
}

#[test]
fn json_looks_as_it_is_shown() {
    let folder = project(&[("sky.wgsl", BAD)]);
    let printed = sh(
        folder.path(),
        "moment-shadows validate shaders --format json",
    );
    assert_eq!(text(&printed.stdout), block("json"));
}

#[test]
fn every_rule_is_described() {
    for rule in Rule::ALL {
        let row = format!("| `{rule}` | {} |", rule.description());
        assert!(PAGE.contains(&row), "{row}");
    }
}

/// Names the project that the page's own test is run for.
const PROJECT: &str = "PROJECT_WITH_SHADERS";

/// The page's own test. Where it is run among ours there is no project: it reads modules of the library.
mod own {
    mod std {
        pub(super) mod fs {
            use ::std::path::PathBuf;

            pub(in super::super) use ::std::fs::read_to_string;

            pub(in super::super) fn read_dir(
                folder: &str,
            ) -> ::std::io::Result<::std::fs::ReadDir> {
                let project = ::std::env::var_os(super::super::super::PROJECT);
                ::std::fs::read_dir(match project {
                    Some(project) => PathBuf::from(project).join(folder),
                    None => PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../wgsl/maths"),
                })
            }
        }
    }

    include!("own_shaders.rs");
}

/// The test that the page gives to projects, as it stands there.
#[test]
fn the_test_for_projects_finds_faults() {
    let own = include_str!("own_shaders.rs");
    assert_eq!(block("rust"), own);
    let folder = project(&[("good.wgsl", GOOD)]);
    let this = std::env::current_exe().unwrap();
    let run = |folder: &Path| {
        Command::new(&this)
            .args(["--exact", "ci::own::shaders_are_valid"])
            .env(PROJECT, folder)
            .output()
            .unwrap()
    };
    let good = run(folder.path());
    assert!(good.status.success(), "{}", text(&good.stdout));
    let folder = project(&[("bad.wgsl", BAD)]);
    let bad = run(folder.path());
    assert!(!bad.status.success());
    assert!(text(&bad.stdout).contains("shaders/bad.wgsl:1:"), "{bad:?}");
}
