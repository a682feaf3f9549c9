//! What the march through the camera's depth takes of the light at contacts, and what false shadow it makes.

use moment_shadows::{ContactShadows, Profile, Storage};
use moment_shadows_lab::candidate::TechniqueChoice;
use moment_shadows_lab::contact_shadows::ContactTrial;
use moment_shadows_lab::trade::axes::Axes;
use moment_shadows_lab::trade::{Job, Trade};

fn trial(scene: &str, views: u32) -> ContactTrial {
    let hamburger: TechniqueChoice = "hamburger4".parse().unwrap();
    let in_storage = |storage| hamburger.in_storage(Some(storage)).unwrap();
    ContactTrial {
        trade: Trade {
            scenes: vec![scene.to_owned()],
            axes: Axes {
                maps: vec![512],
                radii: vec![2],
                samples: vec![4],
                candidates: [Storage::Unorm16, Storage::Float16]
                    .map(in_storage)
                    .to_vec(),
            },
            profile: Profile::NativeAdapter,
            picture: [640, 360],
            views: [views, 0],
            rounds: 9,
            stride: 8,
            ground: true,
            jobs: vec![Job::Hard],
        },
        contact: ContactShadows::default(),
        steps: 16,
    }
}

#[test]
fn the_march_halves_the_leak_at_feet_and_hardly_darkens_what_is_lit() {
    for (scene, views) in [("chairs", 2), ("hall", 1), ("fence-and-foliage", 1)] {
        let report = trial(scene, views).run(|| ()).unwrap();
        println!("{report}");
        for row in &report.rows {
            let false_shadow = row.false_shadow().unwrap();
            assert!(
                false_shadow <= 0.005,
                "{}, {}: {false_shadow}",
                row.scene,
                row.name
            );
            if scene == "chairs" {
                let leak = row.leak().unwrap();
                let pixels: usize = row.views.iter().map(|view| view.in_full_shadow).sum();
                assert!(pixels > 150, "{pixels}");
                assert!(
                    leak.maps > 0.002 && leak.march <= 0.5 * leak.maps,
                    "{}: {leak:?}",
                    row.name
                );
            }
        }
    }
}
