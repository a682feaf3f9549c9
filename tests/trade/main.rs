//! The trade: its truths see what they judge, its figures do not change, and it goes on where it stopped.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod choose;
mod claims;
mod inspect;
mod sweep;
mod truth;
mod views;
mod whole;

use moment_shadows::Profile;
use moment_shadows_lab::candidate::{Candidate, TechniqueChoice, candidates};
use moment_shadows_lab::trade::axes::Axes;
use moment_shadows_lab::trade::{Job, Trade};

/// Some techniques in all storages that native devices make.
fn some(names: &[&str]) -> Vec<Candidate> {
    let choices: Vec<TechniqueChoice> = names.iter().map(|name| name.parse().unwrap()).collect();
    let mut all = candidates(&choices, None).unwrap();
    all.retain(|candidate| Axes::offers(Profile::Native, candidate));
    all
}

/// A trade that takes seconds.
fn small(names: &[&str]) -> Trade {
    Trade {
        scenes: vec!["fence-and-foliage".to_owned()],
        axes: Axes {
            maps: vec![128, 256],
            radii: vec![4],
            samples: vec![1, 4],
            candidates: some(names),
        },
        profile: Profile::Native,
        picture: [160, 90],
        views: [2, 0],
        rounds: 9,
        stride: 8,
        ground: true,
        jobs: vec![Job::Hard],
    }
}
