//! Plants faults in `wgsl/`, `src` and `graph/src`, all in one build, and says which of them the tests notice.

mod judge;
mod plan;
mod report;
mod rust;
mod site;
mod suite;
mod tree;
mod wgsl;

use std::collections::BTreeSet;
use std::error::Error;
use std::fs;
use std::io;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::thread;

use judge::{Verdict, judge};
use plan::SHARES;
use report::Report;
use site::Site;
use suite::Binary;
use tree::Places;

/// Any other number plants another sample.
const SEED: u64 = 20;

/// Programs that hold texts, records or pages, not behaviour: any change of them is noticed.
const LEFT_OUT: [&str; 4] = ["documents", "node_shaders", "documented", "modules"];

const USAGE: &str = "usage: mutants [run [SECONDS] | again [SECONDS] | report]
  run      plants, builds, and judges each fault by at most SECONDS (60) of tests; goes on where it stopped
  again    judges those anew that no test noticed and that are not known to change nothing
  report   says what is known";

fn main() -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .canonicalize()?;
    let places = Places::new(root);
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (command, limit) = match arguments[..] {
        [command @ ("run" | "again" | "report")] => (command, 60.0),
        [command @ ("run" | "again"), seconds] => (command, seconds.parse()?),
        _ => return Err(USAGE.into()),
    };
    let mut report = Report::read(&places)?;
    if command != "report" {
        let sites = prepare(&places)?;
        let suite = suite::suite(&places, &LEFT_OUT)?;
        report.keep(&sites);
        run(
            &places,
            &sites,
            &suite,
            &mut report,
            limit,
            command == "again",
        )?;
    }
    report.print();
    Ok(())
}

/// The copy with all faults that compile.
fn prepare(places: &Places) -> Result<Vec<Site>, Box<dyn Error>> {
    let mut dropped: BTreeSet<String> = match fs::read(&places.dropped) {
        Ok(text) => serde_json::from_slice(&text)?,
        Err(_) => BTreeSet::new(),
    };
    loop {
        let sites = plan::plan(&places.root, SEED, &dropped)?;
        let planted = tree::plant(places, &sites)?;
        let refused = tree::refused(places, &planted)?;
        if refused.is_empty() {
            return Ok(sites);
        }
        for number in refused {
            println!("does not compile: {}", sites[number - 1].key());
            dropped.insert(sites[number - 1].key());
        }
        fs::write(&places.dropped, serde_json::to_vec_pretty(&dropped)?)?;
    }
}

/// Judges faults in order, two at a time, until each share has its number.
fn run(
    places: &Places,
    sites: &[Site],
    suite: &[Binary],
    report: &mut Report,
    limit: f64,
    again: bool,
) -> io::Result<()> {
    let report = Mutex::new(report);
    let (next, judged) = (Mutex::new(0), Mutex::new([0; SHARES.len()]));
    let work = || -> io::Result<()> {
        loop {
            let index = {
                let mut next = next.lock().expect("no thread panics with it");
                *next += 1;
                *next - 1
            };
            let Some(site) = sites.get(index) else {
                return Ok(());
            };
            let share = plan::share_of(&site.file);
            {
                let mut judged = judged.lock().expect("no thread panics with it");
                if judged[share] >= SHARES[share].judged {
                    continue;
                }
                judged[share] += 1;
            }
            let (known, equivalent) = {
                let report = report.lock().expect("no thread panics with it");
                let known = report.verdict(site).cloned();
                let equivalent = known.as_ref().is_some_and(|it| report.is_equivalent(it));
                (known, equivalent)
            };
            let stays = known.as_ref().is_some_and(|known| {
                known.invalid
                    || known.noticed_by.is_some()
                    || equivalent
                    || !again && known.passed == known.reaching
            });
            let verdict = match known {
                Some(known) if stays => known,
                None if !compiles(places, site, index + 1)? => Verdict::invalid(site),
                _ => judge(places, suite, site, index + 1, limit)?,
            };
            if verdict.invalid {
                judged.lock().expect("no thread panics with it")[share] -= 1;
            }
            if !stays {
                println!("{verdict}");
                report
                    .lock()
                    .expect("no thread panics with it")
                    .add(places, verdict)?;
            }
        }
    };
    thread::scope(|scope| {
        let workers = [scope.spawn(work), scope.spawn(work)];
        workers.into_iter().try_for_each(|it| {
            it.join()
                .unwrap_or_else(|_| Err(io::Error::other("a worker panicked")))
        })
    })
}

/// Whether shaders with a fault in WGSL are valid.
fn compiles(places: &Places, site: &Site, number: usize) -> io::Result<bool> {
    let folder = std::env::temp_dir().join(format!("mutants-{}-{number}", std::process::id()));
    let command = if site.file.starts_with("wgsl/") {
        fs::create_dir_all(&folder)?;
        let mut text = fs::read_to_string(places.root.join(&site.file))?;
        text.replace_range(site.range.clone(), &site.with);
        let module = folder.join("module.wgsl");
        fs::write(&module, text)?;
        let mut command = Command::new(places.target.join("release/moment-shadows"));
        command.arg("validate").arg(module);
        Some(command)
    } else if site.file.ends_with(".wgsl") {
        let mut command = Command::new(places.target.join("release/moment-shadows-lab"));
        command.args(["shaders", "--out"]).arg(&folder);
        command
            .env("MUTANT", number.to_string())
            .env("MUTANTS_TEXTS", &places.texts);
        Some(command)
    } else {
        None
    };
    let valid = match command {
        Some(mut command) => command
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()?
            .success(),
        None => true,
    };
    let _ = fs::remove_dir_all(folder);
    Ok(valid)
}
