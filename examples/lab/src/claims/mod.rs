//! What papers claim, measured: every claim is a comparison of two figures, and its verdict follows from how many places it holds in.

pub mod evidence;
pub mod record;
pub mod table;

use clap::ValueEnum;
use moment_shadows::Profile;

use self::evidence::{Evidence, Figure, MAP};
use self::record::{Judgement, Record};
use self::table::Claim;
use crate::candidate::{Candidate, TechniqueChoice};
use crate::command::argument::defaults;
use crate::command::scattering_error::{self, ScatteringErrorOptions};
use crate::command::soft_error::{self, SoftErrorOptions};
use crate::compare::{Options, Report};
use crate::cost::protocol::FEWEST_ROUNDS;
use crate::error::LabError;
use crate::progress;
use crate::scattering::ScatteringErrors;
use crate::soft::SoftErrors;
use crate::sweep::{Point, Sweep};
use crate::techniques::STORAGES;
use crate::trade::axes::Axes;
use crate::trade::{Job, Trade};

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Extent {
    /// What the verdicts are kept of.
    Full,
    /// The same on small maps and pictures of one scene: whether everything works.
    Quick,
}

impl Extent {
    fn pick<T>(self, full: T, quick: T) -> T {
        match self {
            Self::Full => full,
            Self::Quick => quick,
        }
    }

    /// The scenes of hard shadows.
    fn scenes(self) -> Vec<String> {
        let all = ["fence-and-foliage", "hall", "chairs"];
        all[..self.pick(3, 1)]
            .iter()
            .map(|it| (*it).to_owned())
            .collect()
    }

    /// Hard shadows of candidates.
    fn trade(self, candidates: Vec<Candidate>) -> Trade {
        Trade {
            scenes: self.scenes(),
            axes: Axes {
                maps: vec![self.pick(MAP, 128)],
                radii: self.pick(vec![2, 6], vec![4]),
                samples: vec![4],
                candidates,
            },
            profile: Profile::NativeAdapter,
            picture: self.pick([320, 180], [96, 54]),
            views: [self.pick(4, 1), 0],
            rounds: FEWEST_ROUNDS,
            stride: 8,
            ground: true,
            jobs: vec![Job::Hard],
        }
    }

    /// Times of hard shadows.
    fn sweep(self) -> Sweep {
        let pictures = self.pick(vec![[320, 180], [1280, 720], [1920, 1080]], vec![[64, 36]]);
        Sweep {
            scene: self.scenes()[0].clone(),
            profile: Profile::Native,
            maps: self.pick(vec![256, 1024, 2048], vec![64, 128]),
            held: Point {
                map: self.pick(MAP, 64),
                picture: self.pick([640, 360], [64, 36]),
                filter: 9,
            },
            picture_of_filters: self.pick([320, 180], [64, 36]),
            pictures,
            filters: self.pick(vec![3, 9, 17, 33], vec![3, 9]),
            rounds: FEWEST_ROUNDS,
        }
    }

    /// Light in the air: the scene, where the camera looks, and the sun's height.
    fn looks(self) -> Vec<[&'static str; 3]> {
        let hall = ["0", "towards", "away", "along"].map(|look| ["hall", look, ""]);
        let fence = [
            ["fence-and-foliage", "0", "15"],
            ["fence-and-foliage", "towards", "10"],
        ];
        let all = [&hall[..], &fence[..]].concat();
        all[..self.pick(all.len(), 1)].to_vec()
    }
}

/// Judges claims, by what is measured for them.
pub fn judge(claims: &[Claim], extent: Extent) -> Result<Record, LabError> {
    let mut candidates: Vec<Candidate> = Vec::new();
    for claim in claims.iter().filter(|claim| claim.figure.of_scenes()) {
        for name in [claim.one, claim.other] {
            let candidate = candidate(name)?;
            if !candidates.contains(&candidate) {
                candidates.push(candidate);
            }
        }
    }
    let trade = extent.trade(candidates);
    let has = |wanted: &[Figure]| claims.iter().any(|claim| wanted.contains(&claim.figure));
    let (mut adapter, mut evidence) = (String::new(), Evidence::default());
    if !trade.axes.candidates.is_empty() {
        (adapter, evidence.hard) = trade.judge()?;
    }
    if has(&[Figure::Air, Figure::AirTime]) {
        evidence.air = air(claims, extent)?;
    }
    if has(&[Figure::Soft, Figure::SoftTime]) {
        evidence.soft = soft(claims, extent)?;
    }
    let is_swept = |figure| matches!(figure, Figure::Time(_) | Figure::Growth);
    if claims.iter().any(|claim| is_swept(claim.figure)) {
        let sweep = extent.sweep();
        let bar = progress::bar(sweep.steps(), "sweeping");
        evidence.swept = Some(sweep.run(|| bar.inc(1))?);
        bar.finish_and_clear();
    }
    let judged = |claim: &Claim| Ok(Judgement::of(claim, &evidence, profile(claim)?));
    let rows: Result<_, LabError> = claims.iter().map(judged).collect();
    Ok(Record {
        adapter,
        scenes: trade.scenes.clone(),
        views: trade.views[0],
        radii: trade.axes.radii.clone(),
        map: trade.axes.largest_map(),
        rows: rows?,
    })
}

/// The technique in the storage that a claim names.
fn candidate(name: &str) -> Result<Candidate, LabError> {
    let (technique, storage) = name.split_once(' ').unwrap_or((name, ""));
    let storage = STORAGES.into_iter().find(|it| it.name() == storage);
    let choice: TechniqueChoice = technique.parse().map_err(LabError::refused)?;
    Ok(choice.in_storage(storage)?)
}

/// The smallest profile whose devices make both maps.
fn profile(claim: &Claim) -> Result<Option<String>, LabError> {
    if !claim.figure.of_scenes() {
        return Ok(None);
    }
    let mut needed = Profile::WebgpuCore;
    for name in [claim.one, claim.other] {
        needed = candidate(name)?.profile_with(needed);
    }
    Ok(Some(needed.name().to_owned()))
}

/// What a comparison takes: the techniques that claims of some figures name.
fn options(claims: &[Claim], scene: &str, figures: [Figure; 2]) -> Options {
    let about = claims.iter().filter(|it| figures.contains(&it.figure));
    let mut only: Vec<String> = Vec::new();
    for name in about.flat_map(|claim| [claim.one, claim.other]) {
        if !only.iter().any(|known| known == name) {
            only.push(name.to_owned());
        }
    }
    Options {
        scene: vec![scene.to_owned()],
        only,
        cost: Some(FEWEST_ROUNDS),
        ..Options::default()
    }
}

fn air(
    claims: &[Claim],
    extent: Extent,
) -> Result<Vec<(String, Report<ScatteringErrors>)>, LabError> {
    let mut found = Vec::new();
    for [scene, look, elevation] in extent.looks() {
        let mut arguments = vec![scene, "--view", look];
        if !elevation.is_empty() {
            arguments.extend(["--elevation", elevation]);
        }
        let of_extent = extent.pick(
            [
                "--width=320",
                "--height=180",
                "--map=1024",
                "--columns=512",
                "--rows=512",
                "--steps=1024",
            ],
            [
                "--width=32",
                "--height=18",
                "--map=64",
                "--columns=64",
                "--rows=64",
                "--steps=256",
            ],
        );
        arguments.extend(of_extent);
        let of = ScatteringErrorOptions {
            compare: options(claims, scene, [Figure::Air, Figure::AirTime]),
            ..defaults(&arguments)
        };
        let place = format!("{scene}, view {look}");
        found.extend((scattering_error::run(&of)?.into_iter()).map(|it| (place.clone(), it)));
    }
    Ok(found)
}

fn soft(claims: &[Claim], extent: Extent) -> Result<Vec<(String, Report<SoftErrors>)>, LabError> {
    let mut found = Vec::new();
    for (scene, view) in [
        ("hall", "0"),
        ("chairs", "0"),
        ("hall", "1"),
        ("chairs", "1"),
    ]
    .into_iter()
    .take(extent.pick(4, 1))
    {
        let of_extent = extent.pick(
            ["--width=320", "--height=180", "--map=1024", "--samples=256"],
            ["--width=32", "--height=18", "--map=64", "--samples=16"],
        );
        let mut arguments = vec![scene, "--view", view];
        arguments.extend(of_extent);
        let of = SoftErrorOptions {
            compare: options(claims, scene, [Figure::Soft, Figure::SoftTime]),
            ..defaults(&arguments)
        };
        let place = format!("{scene}, view {view}");
        found.extend((soft_error::run(&of)?.into_iter()).map(|it| (place.clone(), it)));
    }
    Ok(found)
}
