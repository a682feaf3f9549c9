//! What is known of all faults.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;

use serde::Deserialize;

use crate::judge::Verdict;
use crate::plan::{SHARES, share_of};
use crate::site::Site;
use crate::tree::Places;

/// A fault that changes nothing that anyone can see, and why.
#[derive(Deserialize)]
struct Equivalent {
    file: String,
    code: String,
    what: String,
    why: String,
}

#[derive(Default)]
pub struct Report {
    verdicts: BTreeMap<String, Verdict>,
    equivalents: Vec<Equivalent>,
}

impl Report {
    pub fn read(places: &Places) -> io::Result<Self> {
        let equivalents = serde_json::from_str(include_str!("../equivalents.json"))?;
        let mut report = Self {
            verdicts: BTreeMap::new(),
            equivalents,
        };
        for line in fs::read_to_string(&places.results)
            .unwrap_or_default()
            .lines()
        {
            let verdict: Verdict = serde_json::from_str(line)?;
            report.verdicts.insert(verdict.key(), verdict);
        }
        Ok(report)
    }

    /// Forgets faults that are not planted any more.
    pub fn keep(&mut self, sites: &[Site]) {
        let keys: BTreeSet<_> = sites.iter().map(Site::key).collect();
        self.verdicts.retain(|key, _| keys.contains(key));
    }

    pub fn verdict(&self, site: &Site) -> Option<&Verdict> {
        self.verdicts.get(&site.key())
    }

    pub fn add(&mut self, places: &Places, verdict: Verdict) -> io::Result<()> {
        self.verdicts.insert(verdict.key(), verdict);
        // Beside it first: a run that is ended leaves no half of it.
        let beside = places.results.with_extension("new");
        let lines = self.verdicts.values().map(serde_json::to_string);
        let lines: Vec<String> = lines.collect::<Result<_, _>>()?;
        fs::write(&beside, lines.join("\n") + "\n")?;
        fs::rename(beside, &places.results)
    }

    pub fn is_equivalent(&self, verdict: &Verdict) -> bool {
        self.why_equivalent(verdict).is_some()
    }

    fn why_equivalent(&self, verdict: &Verdict) -> Option<&str> {
        let equals = |it: &&Equivalent| {
            (&it.file, &it.code, &it.what) == (&verdict.file, &verdict.code, &verdict.what)
        };
        self.equivalents
            .iter()
            .find(equals)
            .map(|it| it.why.as_str())
    }

    pub fn print(&self) {
        let judged: Vec<_> = self.verdicts.values().filter(|it| !it.invalid).collect();
        let left = judged.iter().copied().filter(|it| it.noticed_by.is_none());
        let (equal, survivors): (Vec<&Verdict>, Vec<&Verdict>) =
            left.partition(|it| self.why_equivalent(it).is_some());
        println!("\nEquivalent:");
        for verdict in &equal {
            println!(
                "  {verdict}\n      {}",
                self.why_equivalent(verdict).unwrap_or_default()
            );
        }
        println!("\nNoticed by no test:");
        for verdict in &survivors {
            println!("  {verdict}");
        }
        println!();
        let rows = SHARES
            .iter()
            .enumerate()
            .map(|(index, share)| (share.name, Some(index)))
            .chain([("all", None)]);
        for (name, share) in rows {
            let count = |of: &mut dyn Iterator<Item = &Verdict>| {
                of.filter(|it| share.is_none_or(|share| share_of(&it.file) == share))
                    .count()
            };
            let (all, equal, survivors) = (
                count(&mut judged.iter().copied()),
                count(&mut equal.iter().copied()),
                count(&mut survivors.iter().copied()),
            );
            let noticed = all - equal - survivors;
            let percent = 100.0 * noticed as f64 / (all - equal).max(1) as f64;
            println!(
                "{name:10} {all:3} judged, {noticed:3} noticed, {equal:2} equivalent, {survivors:2} survive: {percent:.1} % of those that can be noticed"
            );
        }
    }
}
