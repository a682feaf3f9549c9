//! Frames that change everything show what a session shows that is new.

use moment_shadows_lab::soak::{SoakDesc, run};

use crate::gpu;

#[test]
fn a_session_shows_what_a_new_one_shows_whatever_was_before() {
    let desc = SoakDesc {
        frames: 200,
        every: 10,
        seed: 7,
    };
    let mut frames = 0;
    let found = run(&gpu(), &desc, || frames += 1).unwrap();
    println!("{found}");
    assert_eq!([frames, found.compared], [200, 20]);
    assert!(found.resizes >= 2 && found.layers > 150, "{found}");
    assert_eq!(found.different, 0, "{found}");
}
